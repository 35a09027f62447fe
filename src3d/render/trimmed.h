#pragma once
// Trimmed surfaces as triangles and lines, for drawing only.

#include "src3d/render/tessellate.h"

namespace sem::render {

/// tessellate() of a surface with a region: a grid of at least 48 cells a piece and direction, its
/// cells cut where their sides leave the region (to 1e-9 of a side). Corners of the region are cut
/// off inside a cell.
Mesh tessellate_trimmed(const PreparedNurbs<2, 3>& surface, const Flatness& flatness);

/// The region's border as the triangles have it: segments, in any order.
std::vector<Chain> trimmed_outline(const PreparedNurbs<2, 3>& surface);

}  // namespace sem::render
