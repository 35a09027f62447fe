#pragma once
// One frame of a run in space: the deformed body, its stress, its pins, when.

#include <functional>
#include <memory>
#include <optional>

#include "sem/draw/canvas.h"
#include "sem/draw/image.h"
#include "sem/scene/model.h"

namespace sem {

/// Draws states of one scene, all from the same camera, which frames the visited_box; up is against
/// gravity. Lines along the ends of parts; those of the rest shape faint; pins in red: for a
/// control point that is held a ball on the surface, where its basis function has its middle (of a
/// trimmed part within its trims), and a bar along the directions that it may slide. A white ground
/// at the lowest place visited receives shadows.
///
/// The surface shows the von Mises stress of the quadrature points: at a vertex the mean over the
/// nearest ones of its solid at rest, weighted by distance. The colour scale is that of the 2D
/// frames (scales.h). Where the nearest point is inverted the surface is gray. Without any stress
/// solids have their tints.
class SolidPainter {
 public:
  explicit SolidPainter(const Scene<3>& scene);
  ~SolidPainter();
  /// As FramePainter in 2D: sizes follow the canvas, all states belong to the model drawn first.
  void draw(Canvas& canvas, const Model<3>& model, const State& state);
  /// From now on the camera stands in this direction from the body (any length; not along up).
  void look_from(const Vec<3>& from) { from_ = from; }

  /// The pixels of a canvas in which the world is drawn.
  static Box<2> area(const Canvas& canvas);

 private:
  struct Setup;
  class Drawing;
  const Scene<3>& scene_;
  std::optional<Vec<3>> from_;
  std::unique_ptr<Setup> setup_;
};

/// A painter for programs: frames of the size that the scene asks for.
std::function<Image(const Model<3>&, const State&)> make_solid_painter(const Scene<3>& scene);

}  // namespace sem
