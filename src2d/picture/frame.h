#pragma once
// One frame of a run: the deformed body, what it carries, when.

#include <optional>

#include "sem/draw/canvas.h"
#include "src2d/picture/outline.h"

namespace sem {

/// Draws states of one scene, all in the same view (view_box). Solids are tinted by their number,
/// so that holes stay empty and overlaps are seen; rest shape dashed; ends of parts as dots;
/// control points in gray; pins in red: a triangle holds both components, a bar lets the point
/// slide along it.
///
/// Discs at the quadrature points show the von Mises stress. In dynamics the colours end at a round
/// number from expected_stress, the same in all frames: higher stresses look alike, so the frame's
/// own maximum stands below the bar. In statics and modes they end at the frame's own maximum.
/// Points where the material is inverted are gray and counted.
class FramePainter {
 public:
  explicit FramePainter(const Scene<2>& scene) : scene_(scene) {}
  /// Sizes follow the canvas: lettering is 14 pixels high on one of 800 x 600. All states belong to
  /// the model that is drawn first.
  void draw(Canvas& canvas, const Model<2>& model, const State& state);

  /// The pixels of a canvas in which the world is drawn; labels stand around them.
  static Box<2> area(const Canvas& canvas);

 private:
  // What is the same in all frames.
  struct Setup {
    Outline outline;
    Box<2> view;
    double stress_limit;  // Pa, 0: the frame's own
  };
  class Drawing;

  const Scene<2>& scene_;
  std::optional<Setup> setup_;
};

}  // namespace sem
