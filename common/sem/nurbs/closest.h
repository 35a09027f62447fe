#pragma once
// The globally closest point of a curve (2D) or a surface (3D).

#include <limits>

#include "sem/nurbs/prepared.h"

namespace sem {

/// Closest point of a part.
template <int Dim>
struct ClosestPoint {
  Param<Dim - 1> u;
  Vec<Dim> point;
  double distance;
};

/// The point of the part closest to X, found by branch and bound, not from a
/// start value: no point of the part is closer by more than 1e-14 of
/// (distance + size of the part). Among points as close as that: 2D, the one
/// of smallest parameter; 3D, the same one for the same input. 3D gives up
/// the certificate, not the answer, after 50000 patches of a cell (a piece or a part of one), which
/// only a whole curve of equally close points can take. Of a trimmed part: the closest point of its region.
///
/// If no point is within `cutoff`, the distance may be returned as infinity,
/// with NaN for u and point. At a jump of the part, u is the knot and point
/// the limit that is closer. Where the distance has a regular minimum inside
/// a piece, u is as well known as rounding of the offset's slope allows, not
/// only to the square root of the distance's. Does not allocate in the steady state.
template <int Dim>
ClosestPoint<Dim> closest_point(const PreparedNurbs<Dim - 1, Dim>& part, const Vec<Dim>& X,
                                double cutoff = std::numeric_limits<double>::infinity());

template <>
ClosestPoint<2> closest_point(const PreparedNurbs<1, 2>& part, const Vec<2>& X, double cutoff);
template <>
ClosestPoint<3> closest_point(const PreparedNurbs<2, 3>& part, const Vec<3>& X, double cutoff);

}  // namespace sem
