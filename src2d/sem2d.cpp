// sem2d: elastic solids in the plane from their NURBS boundary.
#include <memory>

#include "sem/draw/raster.h"
#include "sem/program/program.h"
#include "src2d/picture/frame.h"
#include "src2d/shapes/shape_fields.h"

namespace {

using namespace sem;

Painter<2> make_painter(const Scene<2>& scene) {
  struct Frames {
    FramePainter painter;
    RasterCanvas canvas;
  };
  const auto frames = std::shared_ptr<Frames>(
      new Frames{FramePainter(scene), RasterCanvas(scene.output.width, scene.output.height)});
  return [frames](const Model<2>& model, const State& state) {
    frames->canvas.clear();
    frames->painter.draw(frames->canvas, model, state);
    return frames->canvas.finish();
  };
}

}  // namespace

int main(int argc, char** argv) {
  return run_program<2>(
      {"sem2d", "elastic solids in the plane, described by their NURBS boundary alone",
       builtin_scenes<2>(), shapes2d::describe_shape, make_painter},
      argc, argv);
}
