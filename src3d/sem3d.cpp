// sem3d: elastic solids in space from their NURBS boundary.
#include "sem/program/program.h"
#include "src3d/picture/frame.h"
#include "src3d/shapes/shape_fields.h"

int main(int argc, char** argv) {
  using namespace sem;
  return run_program<3>(
      {"sem3d", "elastic solids in space, described by their NURBS boundary alone",
       builtin_scenes<3>(), shapes3d::describe_shape, make_solid_painter},
      argc, argv);
}
