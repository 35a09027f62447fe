#pragma once
// What can be done to the parts of any shape.

#include <array>

#include "sem/scene/scene.h"

namespace sem::shapes3d {

using Parts = std::vector<ScenePart<3>>;

/// X -> move + R (scale * X): first scaled along the axes, then turned, then moved.
struct Placement {
  Vec<3> scale{1, 1, 1};  ///< > 0, so that outward stays outward
  Vec<3> axis{0, 0, 1};   ///< through 0; not 0, any length
  double angle = 0;       ///< rad
  Vec<3> move{0, 0, 0};   ///< m

  Mat<3> linear()
      const;  ///< R diag(scale); Rodrigues' formula, exact for quarter turns about x, y, z
};
void place(Parts& parts, const Placement& placement);

/// Cuts every part at equal steps of its parameters; the pieces of "side" are "side.1", "side.2",
/// ..., u running fastest.
void split(Parts& parts, const std::array<int, 2>& n);

/// Raises all degrees to at least this.
void elevate(Parts& parts, int degree);

/// Control points of different parts that are the same but for rounding (1e-13 of the size) become
/// the same bit for bit; so do their weights.
void weld(Parts& parts);

}  // namespace sem::shapes3d
