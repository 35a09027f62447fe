#pragma once
// A NURBS cut into rational Bezier pieces with boxes: what hits and closest
// points work on, and what is evaluated often.

#include <memory>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/kernel_forms.h"
#include "sem/nurbs/region.h"

namespace sem {

namespace detail {
struct FootCells;
struct SurfaceCells;
}

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
};

/// A NURBS and its Bezier pieces.
template <int ParamDim, int Dim>
struct PreparedNurbs {
  Nurbs<ParamDim, Dim> nurbs;
  std::array<std::vector<Interval>, ParamDim> spans;  ///< knot spans along each axis
  std::vector<BezierPiece<ParamDim, Dim>> pieces;     ///< one per span (box), u fastest
  Box<Dim> box;                                       ///< of all pieces
  std::shared_ptr<const detail::PowerForm> power;     ///< for the kernels; null: too inaccurate
  std::shared_ptr<const detail::FootCells> feet;      ///< for closest points; curves in the plane
  std::shared_ptr<const detail::SurfaceCells> cells;    ///< for closest points; surfaces
  std::shared_ptr<const Region<ParamDim, Dim>> region;  ///< what the part is trimmed to; null: all of its domain.
                                                        ///< Hits and closest points keep to it.
};

/// Cuts a NURBS into Bezier pieces. Neighbouring pieces share control points
/// and weights bit for bit unless the NURBS is discontinuous between them;
/// where it is clamped, the end points are its own control points bit for
/// bit; equal coordinates stay equal (a straight axis-parallel edge stays
/// exactly so).
template <int ParamDim, int Dim>
PreparedNurbs<ParamDim, Dim> prepare(const Nurbs<ParamDim, Dim>& nurbs);

/// Position at u as point(part.nurbs, u), to 1e-14 of the size of the part,
/// about ten times faster: one polynomial a piece in powers of the distance
/// from its middle, with AVX2 where the processor has it. Where powers would
/// lose digits (see power_form.h) it is point(part.nurbs, u) itself.
template <int ParamDim, int Dim>
Vec<Dim> point(const PreparedNurbs<ParamDim, Dim>& part, const Param<ParamDim>& u) {
  if (!part.power) return point(part.nurbs, u);
  alignas(32) double X[4];
  part.power->point(*part.power, u.data(), X);
  return Eigen::Map<const Vec<Dim>>(X);
}

/// Position and first derivatives dX/du, dX/dv.
template <int ParamDim, int Dim>
struct PointSlopes {
  Vec<Dim> point;
  Eigen::Matrix<double, Dim, ParamDim> first;
};

/// Position and first derivatives in the same way.
template <int ParamDim, int Dim>
PointSlopes<ParamDim, Dim> point_slopes(const PreparedNurbs<ParamDim, Dim>& part,
                                        const Param<ParamDim>& u) {
  if (!part.power) {
    const auto at = derivatives(part.nurbs, u, 1);
    return {at.point, at.first};
  }
  alignas(32) double X[4], slopes[4 * ParamDim];
  part.power->slopes(*part.power, u.data(), X, slopes);
  using Slopes = Eigen::Matrix<double, Dim, ParamDim>;
  return {Eigen::Map<const Vec<Dim>>(X),
          Eigen::Map<const Slopes, 0, Eigen::OuterStride<4>>(slopes)};
}

/// Position on a piece at local parameters in [0, 1].
template <int ParamDim, int Dim>
Vec<Dim> point(const BezierPiece<ParamDim, Dim>& piece, const Param<ParamDim>& s);

}  // namespace sem
