#pragma once
// Where the picture that a ray sees of the boundary changes.

#include <vector>

#include "sem/method/loops.h"

namespace sem {

/// Coordinates along the transverse axis at which a ray's intervals, as functions of that
/// coordinate, may not be smooth, ascending, from the lower to the upper end of the boundary;
/// values closer than 1e-12 of the model's size count once.
/// 2D: ends of all Bezier pieces of parts and caps (joints, knots), their extrema, and crossings
/// between pieces, bisected to rounding where the order of the pieces along two neighbouring
/// rays differs.
/// 3D: ends of the boxes of all Bezier pieces, of trimmed parts and their corners: complete for polygons
/// that lie in planes across the axes.
template <int Dim>
std::vector<double> critical_values(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                    int ray_axis, int transverse_axis);
template <>
std::vector<double> critical_values<2>(const Boundary<2>& boundary, const Loops<2>& loops,
                                       int ray_axis, int transverse_axis);
template <>
std::vector<double> critical_values<3>(const Boundary<3>& boundary, const Loops<3>& loops,
                                       int ray_axis, int transverse_axis);

}  // namespace sem
