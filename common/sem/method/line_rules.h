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

}  // namespace sem
