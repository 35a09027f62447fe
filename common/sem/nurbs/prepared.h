#pragma once
// A NURBS cut into rational Bezier pieces with boxes: what hits and closest
// points work on.

#include "sem/nurbs/nurbs.h"

namespace sem {

/// One rational Bezier piece over a box of the parameters, with control
/// points as positions (not multiplied by the weights), so that the sign of
/// a coordinate difference is exact.
template <int ParamDim, int Dim>
struct BezierPiece {
  Param<ParamDim> lower, upper;  ///< its part of the domain
  std::array<int, ParamDim> degree;
  Points<Dim> points;       ///< Dim by prod (degree + 1), u fastest
  Eigen::VectorXd weights;  ///< > 0
  Box<Dim> box;             ///< holds the piece: weights > 0, so the convex hull does
  /// Curves: Bernstein coefficients foot(k, 0..Dim) of a polynomial that has
  /// the sign of (C(s) - X).C'(s), foot(k, 0) - foot(k, 1..Dim).(X - box
  /// centre) for any X; closest points are among its roots.
  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> foot;
};

/// A NURBS and its Bezier pieces.
template <int ParamDim, int Dim>
struct PreparedNurbs {
  Nurbs<ParamDim, Dim> nurbs;
  std::array<std::vector<Interval>, ParamDim> spans;  ///< knot spans along each axis
  std::vector<BezierPiece<ParamDim, Dim>> pieces;     ///< one per span (box), u fastest
  Box<Dim> box;                                       ///< of all pieces
};

/// Cuts a NURBS into Bezier pieces. Neighbouring pieces share control points
/// and weights bit for bit unless the NURBS is discontinuous between them;
/// where it is clamped, the end points are its own control points bit for
/// bit; equal coordinates stay equal (a straight axis-parallel edge stays
/// exactly so).
template <int ParamDim, int Dim>
PreparedNurbs<ParamDim, Dim> prepare(const Nurbs<ParamDim, Dim>& nurbs);

/// Position on a piece at local parameters in [0, 1].
template <int ParamDim, int Dim>
Vec<Dim> point(const BezierPiece<ParamDim, Dim>& piece, const Param<ParamDim>& s);

}  // namespace sem
