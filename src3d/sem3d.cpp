// sem3d: elastic solids in space from their NURBS boundary.
#include "sem/program/program.h"
#include "src3d/cad/cad.h"
#include "src3d/cad/cad_scene.h"
#include "src3d/picture/frame.h"
#include "src3d/shapes/shape_fields.h"

namespace {

void write_solids(const std::string& file, const sem::Scene<3>& scene,
                  const sem::Points<3>& controls) {
  write_cad(file, sem::cad_parts(scene.solids, &controls));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace sem;
  return run_program<3>({"sem3d",
                         "elastic solids in space, described by their NURBS boundary alone",
                         builtin_scenes<3>(),
                         shapes3d::describe_shape,
                         make_solid_painter,
                         {{"step", "igs", "stp", "iges"}, is_cad_file, cad_scene, write_solids}},
                        argc, argv);
}
