#pragma once
// The boundary's own measure of the inside, by the divergence theorem: the
// independent truth beside the interior quadrature.

#include <functional>
#include <optional>

#include "sem/method/loops.h"

namespace sem {

/// Moments of the body about a point C.
template <int Dim>
struct Moments {
  double volume = 0;                   ///< area (2D, m^2) or volume (m^3)
  Vec<Dim> first = Vec<Dim>::Zero();   ///< integral of X - C
  Mat<Dim> second = Mat<Dim>::Zero();  ///< integral of (X - C) (X - C)^T
  bool available = true;               ///< false: the boundary does not determine it
};

/// Calls visit(X, flux) at quadrature points of all that bounds the body, parts and gaps' caps,
/// with the orientations found in loops: sum of flux * P(X) = integral over the inside of dP/dX_0
/// for any smooth P. Where solids overlap only the outer boundary of the union counts (its ends
/// found by bisection). Gauss rule of 32 points on every Bezier piece (trimmed
/// parts: the region's): to rounding for polynomials
/// of moderate degree. Returns false where the boundary does not determine the inside.
template <int Dim>
bool visit_boundary_flux(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                         const std::function<void(const Vec<Dim>& X, double flux)>& visit);

/// Moments about a point by those fluxes: exact for polynomial parts up to degree 15, to rounding
/// for moderate rational ones.
template <int Dim>
Moments<Dim> boundary_moments(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                              const Vec<Dim>& about = Vec<Dim>::Zero());

/// 1 and all monomials of (X - center) / (size / 2) to a degree, in the order of Monomials,
/// integrated over the inside by the same fluxes; none where they are not available.
template <int Dim>
std::optional<Eigen::VectorXd> boundary_moments_to_degree(const Boundary<Dim>& boundary,
                                                          const Loops<Dim>& loops, int degree,
                                                          const Vec<Dim>& center, double size);

/// Length (m) or area (m^2, of what trims leave) of every part, by Gauss' rule of 32 points on every piece.
template <int Dim>
std::vector<double> part_measures(const Boundary<Dim>& boundary);

/// Moments of a quadrature rule, for comparison.
template <int Dim>
Moments<Dim> quadrature_moments(const Points<Dim>& position, const Eigen::VectorXd& weight,
                                const Vec<Dim>& about = Vec<Dim>::Zero());

}  // namespace sem
