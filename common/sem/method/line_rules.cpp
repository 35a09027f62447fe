#include "sem/method/line_rules.h"

#include <algorithm>
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

namespace {

// The rule for t in (0, 1) carried to x = position(t) in (0, 1), dx = slope(t) dt, then to (-1, 1).
template <class Position, class Slope>
LineRule substituted(const LineRule& in_t, const Position& position, const Slope& slope) {
  LineRule rule = in_t;
  for (size_t k = 0; k < rule.node.size(); ++k) {
    const double t = in_t.node[k];
    rule.node[k] = 2 * position(t) - 1;
    rule.weight[k] = 2 * in_t.weight[k] * slope(t);
  }
  return rule;
}

LineRule on_unit_interval(LineRule rule) {
  for (size_t k = 0; k < rule.node.size(); ++k) {
    rule.node[k] = (1 + rule.node[k]) / 2;
    rule.weight[k] /= 2;
  }
  return rule;
}

// The positive half of the Gauss rule with 2n points: exact for even functions to degree 4n - 2.
LineRule even_half(int n) {
  const LineRule all = gauss_legendre(2 * n);
  return {{all.node.begin() + n, all.node.end()}, {all.weight.begin() + n, all.weight.end()}};
}

LineRule chebyshev_second(int n) {
  LineRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (int k = 0; k < n; ++k) {
    const double angle = std::numbers::pi * (k + 1) / (n + 1);
    rule.node[k] = -std::cos(angle);
    rule.weight[k] = std::numbers::pi / (n + 1) * std::sin(angle);
  }
  return rule;
}

}  // namespace

LineRule rule_between(EndKind lower, EndKind upper, int n) {
  if (lower == EndKind::closing && upper == EndKind::closing) return chebyshev_second(n);
  if (lower == EndKind::smooth && upper == EndKind::smooth) return gauss_legendre(n);
  if (lower != EndKind::smooth && upper != EndKind::smooth)
    return substituted(
        on_unit_interval(gauss_legendre(n)),
        [](double t) { return std::pow(std::sin(std::numbers::pi / 2 * t), 2); },
        [](double t) { return std::numbers::pi / 2 * std::sin(std::numbers::pi * t); });
  const bool at_lower = lower != EndKind::smooth;
  const EndKind kind = at_lower ? lower : upper;
  const LineRule in_t =
      kind == EndKind::closing ? even_half(n) : on_unit_interval(gauss_legendre(n));
  LineRule rule = substituted(
      in_t, [](double t) { return t * t; }, [](double t) { return 2 * t; });
  if (at_lower) return rule;
  std::reverse(rule.node.begin(), rule.node.end());
  std::reverse(rule.weight.begin(), rule.weight.end());
  for (double& x : rule.node) x = -x;
  return rule;
}

}  // namespace sem
