#pragma once
// The box as named parts. Where two parts meet, their edges are the same bit for bit.

#include <array>

#include "src3d/shapes/parts.h"

namespace sem::shapes3d {

/// A box with faces along the axes, z up. A face is "left", "right" (lower and
/// upper x), "front", "back" (y), "bottom" or "top" (z); cut into equal patches it
/// is "left.1", "left.2", ..., the patch's first parameter running fastest.
/// Patches are bilinear; du x dv points out of the box.
struct Box {
  Vec<3> lower{0, 0, 0}, upper{1, 1, 1};   ///< m, lower < upper
  std::array<int, 3> n_parts = {1, 1, 1};  ///< along x, y, z; >= 1
};
/// The faces in the order named above.
Parts make_parts(const Box& box);

}  // namespace sem::shapes3d
