#pragma once
// Moments of an interior rule: made right by new weights, or kept by fewer points.

#include <optional>

#include "sem/method/quadrature.h"

namespace sem {

/// What a stage that works with moments achieved.
struct MomentReport {
  int degree = 0;  ///< 0: the stage was not asked for
  int points_before = 0, points_after = 0;
  double error_before = 0;  ///< largest relative error of a moment up to the degree
  double error_after = 0;
};

/// All monomials of (X - center) / (size / 2) to a degree, 1 first, then as in Monomials,
/// integrated by the rule.
template <int Dim>
Eigen::VectorXd moments_to_degree(const Quadrature<Dim>& rule, int degree, const Vec<Dim>& center,
                                  double size);

/// Largest difference of these moments from `target`, each relative to the integral of the monomial's magnitude.
template <int Dim>
double moment_error(const Quadrature<Dim>& rule, int degree, const Vec<Dim>& center, double size,
                    const Eigen::VectorXd& target);

/// Moment fitting: changes the weights, w >= 0, so that the moments become `target` (as
/// moments_to_degree gives them), with the least sum of (change)^2 / weight. Points whose weight
/// becomes 0 are removed. Dual Newton: w = w0 max(0, 1 + phi lambda), phi: the monomials made
/// orthonormal in the rule. The rule is left as it was where the targets cannot be met.
template <int Dim>
MomentReport fit_moments(Quadrature<Dim>& rule, int degree, const Vec<Dim>& center, double size,
                         const Eigen::VectorXd& target);

/// Compression: some of the points with new weights > 0 that have the same moments to the degree
/// (in each solid), at most as many as there are moments (Tchakaloff's theorem, by non-negative
/// least squares). The rule is left as it was where that does not make it smaller.
template <int Dim>
MomentReport compress(Quadrature<Dim>& rule, int degree, const Vec<Dim>& center, double size);

}  // namespace sem
