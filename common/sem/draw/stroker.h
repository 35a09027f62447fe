#pragma once
// The area of a thick line, as triangles: what a stroke covers, independent of the back end.

#include <span>
#include <vector>

#include "sem/draw/canvas.h"

namespace sem {

/// Distinct finite points in a row.
struct Chain {
  std::vector<Vec<2>> points;
  bool closed = false;
};

/// The chains of a stroke: points that are not finite interrupt it, repeated ones are dropped. A
/// closed line with a gap becomes open.
std::vector<Chain> split_at_gaps(std::span<const Vec<2>> points, bool closed);

/// 1 / sin(half the corner's angle) up to which a corner is mitred: 60 degrees.
constexpr double miter_limit = 2.0 + 1e-9;

/// Triangles (three corners each, in either orientation, overlapping) whose union is the line of
/// canvas.h drawn through the points with the style's width, joins, caps and dashes. Round parts
/// deviate from the circle by less than `tolerance` pixels.
std::vector<Vec<2>> stroke_triangles(std::span<const Vec<2>> points, const Stroke& style,
                                     double tolerance = 0.05);

}  // namespace sem
