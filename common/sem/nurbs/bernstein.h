#pragma once
// Internal: polynomials of one variable on [0, 1] in Bernstein form,
// f(s) = sum_i c[i] B_i(s), c of length degree + 1.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sem/nurbs/nurbs.h"

namespace sem::detail {

/// Both halves of f, as polynomials on [0, 1] again. `right` may be `c`.
inline void split_half(const double* c, int degree, double* left, double* right) {
  for (int i = 0; i <= degree; ++i) right[i] = c[i];
  for (int j = 0; j <= degree; ++j) {
    left[j] = right[0];
    for (int i = 0; i < degree - j; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
}

/// Binomial coefficients (n over 0..n), n < 3 max_nurbs_degree.
inline const double* binomials(int n) {
  constexpr int n_rows = 3 * max_nurbs_degree;
  static const auto table = [] {
    std::vector<std::array<double, n_rows>> rows(n_rows);
    for (int m = 0; m < n_rows; ++m) {
      rows[m][0] = 1;
      for (int k = 1; k <= m; ++k) rows[m][k] = rows[m][k - 1] * (m - k + 1) / k;
    }
    return rows;
  }();
  return table[n].data();
}

/// f(s) and f'(s), both divided by (1 - s)^degree or, in the upper half,
/// by s^degree. `scaled` holds c[i] times the binomial (degree over i).
/// Horner in s / (1 - s) <= 1, as well conditioned as de Casteljau.
struct ValueSlope {
  double value, slope;
};
inline ValueSlope evaluate_scaled(const double* scaled, int degree, double s) {
  const bool upper = s > 0.5;
  const double larger = upper ? s : 1 - s, inverse = 1 / larger;
  const double r = (upper ? 1 - s : s) * inverse;
  const double* c = upper ? scaled : scaled + degree;
  const int back = upper ? 1 : -1;
  double value = *c, derivative = 0;
  for (int i = 0; i < degree; ++i) {
    c += back;
    derivative = derivative * r + value;
    value = value * r + *c;
  }
  const double slope = derivative * inverse * inverse - degree * value * inverse;
  return {value, upper ? -slope : slope};
}

/// f(s) and f'(s) by de Casteljau; scratch holds degree + 1.
inline ValueSlope evaluate(const double* c, int degree, double s, double* scratch) {
  for (int i = 0; i <= degree; ++i) scratch[i] = c[i];
  for (int n = degree; n > 1; --n)
    for (int i = 0; i < n; ++i) scratch[i] += s * (scratch[i + 1] - scratch[i]);
  const double slope = scratch[1] - scratch[0];
  return {scratch[0] + s * slope, degree * slope};
}

/// The only sign change of f inside (0, 1), from the sign given to the other:
/// Newton, kept inside a bracket. The values at the ends may be rounding.
/// scratch holds degree + 1.
inline double single_root(const double* c, int degree, bool start_positive, double* scratch) {
  const double* binomial = binomials(degree);
  for (int i = 0; i <= degree; ++i) scratch[i] = c[i] * binomial[i];
  double lower = 0, upper = 1;
  const bool secant = c[0] != 0 && c[degree] != 0 && (c[0] > 0) != (c[degree] > 0);
  double s = secant ? c[0] / (c[0] - c[degree]) : 0.5;
  double step = 1;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const auto [value, slope] = evaluate_scaled(scratch, degree, s);
    if (value == 0) return s;
    ((value > 0) == start_positive ? lower : upper) = s;
    const double newton = s - value / slope;
    // Bisect where Newton leaves the bracket or no longer halves the step.
    const bool trusted = newton > lower && newton < upper && std::abs(newton - s) < 0.5 * step;
    const double next = trusted ? newton : 0.5 * (lower + upper);
    step = std::abs(next - s);
    // Newton squares the error: after such a step the next is rounding.
    if (step <= (trusted ? 1e-12 : 1.2e-16)) return next;
    s = next;
  }
  return s;
}

/// Number of sign changes of the coefficients, zeros left out: at least that of the roots inside (0, 1).
inline int sign_changes(const std::vector<double>& c) {
  int n = 0;
  double previous = 0;
  for (const double value : c) {
    if (value == 0) continue;
    n += previous != 0 && (value > 0) != (previous > 0);
    previous = value;
  }
  return n;
}

/// Appends the roots of f inside its interval, here named [lower, upper]; roots closer than 1e-9 count once.
inline void append_roots(const std::vector<double>& c, double lower, double upper, std::vector<double>& roots) {
  const int degree = int(c.size()) - 1, n_changes = sign_changes(c);
  if (n_changes == 0) return;
  if (upper - lower < 1e-9) {
    roots.push_back((lower + upper) / 2);
    return;
  }
  if (n_changes == 1) {
    std::vector<double> scratch(c.size());
    const bool start_positive = *std::find_if(c.begin(), c.end(), [](double v) { return v != 0; }) > 0;
    roots.push_back(lower + (upper - lower) * single_root(c.data(), degree, start_positive, scratch.data()));
    return;
  }
  std::vector<double> left(c.size()), right(c.size());
  split_half(c.data(), degree, left.data(), right.data());
  const double middle = (lower + upper) / 2;
  if (right[0] == 0) roots.push_back(middle);
  append_roots(left, lower, middle, roots);
  append_roots(right, middle, upper, roots);
}

/// All Bernstein polynomials of a degree at s and their derivatives up to
/// `order` (0 to 2): out[m][i], rows of length `row`.
inline void bernstein_basis(int degree, double s, int order, int row, double* out) {
  double* B = out;
  B[0] = 1;
  for (int j = 1; j <= degree; ++j) {
    // Derivative m needs the basis of degree - m.
    for (int m = 1; m <= order; ++m)
      if (j == degree - m + 1)
        for (int i = 0; i < j; ++i) out[m * row + i] = B[i];
    B[j] = s * B[j - 1];
    for (int i = j - 1; i > 0; --i) B[i] = (1 - s) * B[i] + s * B[i - 1];
    B[0] *= 1 - s;
  }
  for (int m = 1; m <= order; ++m) {
    double* D = out + m * row;
    if (degree < m) {
      for (int i = 0; i <= degree; ++i) D[i] = 0;
      continue;
    }
    for (int k = degree - m + 1; k <= degree; ++k) {  // to degree k by differences
      D[k] = k * D[k - 1];
      for (int i = k - 1; i > 0; --i) D[i] = k * (D[i - 1] - D[i]);
      D[0] *= -k;
    }
  }
}

/// Splits a tensor product patch at s along an axis: c holds n_u by n_v
/// coefficients, u fastest. `right` may be `c`.
template <int N>
void split_patch(const Vec<N>* c, const int* degree, int axis, double s, Vec<N>* left,
                 Vec<N>* right) {
  const int n_u = degree[0] + 1, n_v = degree[1] + 1;
  if (right != c) std::copy(c, c + n_u * n_v, right);
  const int stride = axis == 0 ? 1 : n_u, n_lines = axis == 0 ? n_v : n_u;
  for (int line = 0; line < n_lines; ++line) {
    const int start = line * (axis == 0 ? n_u : 1);
    Vec<N>* r = right + start;
    Vec<N>* l = left + start;
    for (int j = 0; j <= degree[axis]; ++j) {
      l[j * stride] = r[0];
      for (int i = 0; i < degree[axis] - j; ++i)
        r[i * stride] += s * (r[(i + 1) * stride] - r[i * stride]);
    }
  }
}

}  // namespace sem::detail
