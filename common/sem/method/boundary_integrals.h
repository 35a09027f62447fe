#pragma once
// The boundary's own measure of the inside, by the divergence theorem: the
// independent truth beside the interior quadrature.

#include "sem/method/loops.h"

namespace sem {

/// Moments of the body about a point C.
template <int Dim>
struct Moments {
  double volume = 0;                             ///< area (2D, m^2) or volume (m^3)
  Vec<Dim> first = Vec<Dim>::Zero();             ///< integral of X - C
  Mat<Dim> second = Mat<Dim>::Zero();            ///< integral of (X - C) (X - C)^T
  bool available = true;                         ///< false: the boundary does not determine it
};

/// integral over the inside = sum over parts and caps of the flux of a
/// primitive, with the orientations found in loops; where solids overlap only
/// the outer boundary of the union counts (its ends found by bisection).
/// Gauss rule of 32 points on every Bezier piece: exact for polynomial parts
/// up to degree 15, to rounding for moderate rational ones.
template <int Dim>
Moments<Dim> boundary_moments(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                              const Vec<Dim>& about = Vec<Dim>::Zero());

/// Moments of a quadrature rule, for comparison.
template <int Dim>
Moments<Dim> quadrature_moments(const Points<Dim>& position, const Eigen::VectorXd& weight,
                                const Vec<Dim>& about = Vec<Dim>::Zero());

}  // namespace sem
