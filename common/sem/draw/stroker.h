#pragma once
// The area of a thick line, as triangles: what a stroke covers, independent of the back end.

#include <span>
#include <vector>

#include "sem/draw/canvas.h"

namespace sem {

/// Triangles (three corners each, in either orientation, overlapping) whose union is the line of
/// canvas.h drawn through the points with the style's width, joins, caps and dashes. Round parts
/// deviate from the circle by less than `tolerance` pixels.
std::vector<Vec<2>> stroke_triangles(std::span<const Vec<2>> points, const Stroke& style,
                                     double tolerance = 0.05);

}  // namespace sem
