#pragma once
// Quadrature rules on (-1, 1).

#include <vector>

namespace sem {

/// Nodes ascending, weights sum to 2.
struct LineRule {
  std::vector<double> node, weight;
};

/// Middles of n equal cells, n >= 1.
LineRule midpoint_rule(int n);

/// n-point Gauss-Legendre rule, n >= 1: exact to degree 2n - 1.
LineRule gauss_legendre(int n);

/// n-point Gauss-Lobatto rule, n >= 2, ends included: exact to degree 2n - 3.
LineRule gauss_lobatto(int n);

/// How an integrand behaves where its interval ends.
enum class EndKind {
  smooth,   ///< analytic
  root,     ///< analytic in the square root of the distance to the end
  closing,  ///< that root times an analytic function: what a chord does where it closes
};

/// n-point rule for an integrand with these ends, weights > 0, nodes inside (-1, 1). Gauss-Legendre
/// after a substitution that makes the integrand analytic: x + 1 ~ t^2 (lower end), sin^2 (both),
/// its half that an even function needs (closing at one end), Gauss-Chebyshev of the second
/// kind (closing at both). The weights sum to 2 only to the rule's accuracy.
LineRule rule_between(EndKind lower, EndKind upper, int n);

}  // namespace sem
