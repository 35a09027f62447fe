#pragma once
// From world coordinates to pixels, and round numbers for axes.

#include <span>
#include <string>
#include <vector>

#include "sem/base/dim.h"

namespace sem {

/// Uniform scaling of a world box (y up) to the middle of a rectangle of the canvas (y down), as
/// large as fits. Both boxes need a positive extent in at least one direction; `canvas` in both.
class View2 {
 public:
  View2(const Box<2>& world, const Box<2>& canvas);

  /// World position to pixels.
  Vec<2> map(const Vec<2>& world) const {
    return {canvas_center_[0] + scale_ * (world[0] - world_center_[0]),
            canvas_center_[1] - scale_ * (world[1] - world_center_[1])};
  }
  std::vector<Vec<2>> map(std::span<const Vec<2>> world) const;
  /// Pixels per unit of the world.
  double scale() const { return scale_; }

 private:
  Vec<2> world_center_, canvas_center_;
  double scale_;
};

/// The step 1, 2 or 5 times a power of ten that divides [lo, hi] into at most n intervals, as near
/// to n as possible; lo < hi, n >= 1.
double nice_step(double lo, double hi, int n);

/// The multiples of nice_step(lo, hi, n) in [lo, hi], ascending, zero exact.
std::vector<double> nice_ticks(double lo, double hi, int n);

/// The value with as many decimals as the step needs, with the minus sign U+2212, e.g. for an axis.
std::string tick_label(double value, double step);

}  // namespace sem
