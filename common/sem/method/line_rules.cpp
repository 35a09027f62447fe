#include "sem/method/line_rules.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace sem {
namespace {

struct Legendre {
  double value, slope;  // P_n(x), P_n'(x)
};

Legendre legendre(int n, double x) {
  double previous = 1, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (previous - x * value) / (1 - x * x)};
}

}  // namespace

LineRule midpoint_rule(int n) {
  assert(n >= 1);
  LineRule rule{std::vector<double>(n), std::vector<double>(n, 2.0 / n)};
  for (int k = 0; k < n; ++k) rule.node[k] = (2 * k + 1.0) / n - 1;
  return rule;
}

LineRule gauss_legendre(int n) {
  assert(n >= 1);
  LineRule rule{std::vector<double>(n, 0.0), std::vector<double>(n, 2.0)};
  if (n == 1) return rule;
  for (int k = 0; k < n; ++k) {
    double x = -std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5));
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Legendre p = legendre(n, x);
      const double step = p.value / p.slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    const double slope = legendre(n, x).slope;
    rule.node[k] = x;
    rule.weight[k] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

LineRule gauss_lobatto(int n) {
  assert(n >= 2);
  LineRule rule{std::vector<double>(n), std::vector<double>(n, 2.0 / (n * (n - 1.0)))};
  rule.node.front() = -1;
  rule.node.back() = 1;
  // Inner nodes: roots of P'_{n-1}, by Newton with P'' from Legendre's equation.
  for (int k = 1; k < n - 1; ++k) {
    double x = -std::cos(std::numbers::pi * k / (n - 1.0));
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Legendre p = legendre(n - 1, x);
      const double second = (2 * x * p.slope - n * (n - 1.0) * p.value) / (1 - x * x);
      const double step = p.slope / second;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    const double value = legendre(n - 1, x).value;
    rule.node[k] = x;
    rule.weight[k] = 2 / (n * (n - 1.0) * value * value);
  }
  return rule;
}

}  // namespace sem
