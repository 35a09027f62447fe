#pragma once
// All points where a line meets a curve (2D) or a surface (3D), by
// subdivision in Bernstein form: none is missed, and each lies on both to
// rounding.

#include <vector>

#include "sem/nurbs/prepared.h"

namespace sem {

/// X(t) = origin + t * direction, direction of any length > 0.
template <int Dim>
struct Line {
  Vec<Dim> origin, direction;
};

/// Where a line meets a part.
template <int Dim>
struct Hit {
  double t;          ///< along the line
  Param<Dim - 1> u;  ///< on the part
  bool crosses;      ///< the part changes sides here, see append_hits
  bool tangent;      ///< the line is tangent to the part here, to about 1e-6 rad
  bool along;        ///< an end of a stretch where the part runs along the line
};

/// Appends all hits of the part (of its region, where it is trimmed) with the line, t in [t_min, t_max], sorted
/// by t. End points and tangencies are included; where the part passes
/// within rounding (about 10 eps of the largest coordinate difference) it
/// counts as touching. A hit on a joint of two pieces, also on the joint
/// that closes the curve, is reported once. t of a tangency is as well
/// conditioned as the tangent point, u of it only to the square root.
///
/// 2D: `crosses` is exact: let side(X) be the sign of the distance to the
/// line, 0 counting as +, with (-direction_y, direction_x) positive (for a
/// line along an axis this is exactly a comparison of coordinates). The
/// number of hits with `crosses` over all t is odd if and only if the side
/// of the first and of the last point of the curve differ (each continuous
/// stretch alone, if it has jumps). Hence parity along a loop of parts that
/// share end points bit for bit is consistent for every line, also through
/// joints and along straight parts. A part (of it) along the line gives a
/// hit at each end of each Bezier piece of that stretch.
///
/// 3D: `crosses` says that the line is not tangent; lines through the edges
/// that parts share are not made consistent between the parts.
///
/// Does not allocate once `out` and the scratch of this thread are large
/// enough.
template <int Dim>
void append_hits(const PreparedNurbs<Dim - 1, Dim>& part, const Line<Dim>& line, double t_min,
                 double t_max, std::vector<Hit<Dim>>& out);

template <>
void append_hits<2>(const PreparedNurbs<1, 2>& part, const Line<2>& line, double t_min,
                    double t_max, std::vector<Hit<2>>& out);
template <>
void append_hits<3>(const PreparedNurbs<2, 3>& part, const Line<3>& line, double t_min,
                    double t_max, std::vector<Hit<3>>& out);

}  // namespace sem
