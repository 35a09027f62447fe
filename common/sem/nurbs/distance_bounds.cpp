#include "sem/nurbs/distance_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/kernels.h"

namespace sem::detail {

double DistanceBounds::set(const Vec4* c, const std::array<int, 2>& degree, bool kernel,
                           int& where) {
  degree_ = degree;
  const int p = degree[0], q = degree[1], row = 2 * p + 1, n = (p + 1) * (q + 1);
  const double* Bp = binomials(p);
  const double* Bq = binomials(q);
  const size_t n_squares = size_t(row) * (2 * q + 1);
  q_.resize(n_squares);
  v_.resize(n_squares);
  if (kernel) {
    alignas(32) double scaled[4 * 13 * 13];
    for (int j = 0, a = 0; j <= q; ++j)
      for (int i = 0; i <= p; ++i, ++a)
        Eigen::Map<Vec4, Eigen::Aligned16>(scaled + 4 * a) = Bp[i] * Bq[j] * c[a];
    return kernels->square_distance(scaled, p, q, q_.data(), v_.data(), &where);
  }
  scaled_.resize(n);
  for (int j = 0, a = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i, ++a) scaled_[a] = Bp[i] * Bq[j] * c[a];
  square_.assign(n_squares, Vec4::Zero());
  for (int j = 0, a = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i, ++a) {
      square_[2 * (j * row + i)] += scaled_[a].cwiseProduct(scaled_[a]);
      const Vec4 twice = 2 * scaled_[a];
      for (int l = j, b = a + 1; l <= q; ++l)
        for (int k = l == j ? i + 1 : 0; k <= p; ++k, ++b)
          square_[(j + l) * row + i + k] += twice.cwiseProduct(scaled_[b]);
    }
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < n_squares; ++i) {
    q_[i] = square_[i].head<3>().sum();
    v_[i] = square_[i][3];
    const double ratio = q_[i] / v_[i];
    if (ratio < least) {
      least = ratio;
      where = int(i);
    }
  }
  return least;
}

DistanceCurvature DistanceBounds::curvature(double m) {
  const int p = 2 * degree_[0], q = 2 * degree_[1], row = p + 1;
  const double* Bp = binomials(p);
  const double* Bq = binomials(q);
  const double infinity = std::numeric_limits<double>::infinity();
  DistanceCurvature bounds{infinity, infinity, 0, infinity, 0};
  f_.resize(q_.size());
  for (int j = 0, i = 0; j <= q; ++j)
    for (int k = 0; k <= p; ++k, ++i) {
      const double inverse = 1 / (Bp[k] * Bq[j]);
      f_[i] = (q_[i] - m * v_[i]) * inverse;
      bounds.least_v = std::min(bounds.least_v, v_[i] * inverse);
      bounds.largest_v = std::max(bounds.largest_v, v_[i] * inverse);
    }
  for (int j = 0; j <= q; ++j)
    for (int k = 0; k <= p; ++k) {
      const double* at = &f_[j * row + k];
      if (k + 2 <= p) bounds.uu = std::min(bounds.uu, at[0] - 2 * at[1] + at[2]);
      if (j + 2 <= q) bounds.vv = std::min(bounds.vv, at[0] - 2 * at[row] + at[2 * row]);
      if (k < p && j < q)
        bounds.uv = std::max(bounds.uv, std::abs(at[0] - at[1] - at[row] + at[row + 1]));
    }
  bounds.uu *= p * (p - 1);
  bounds.vv *= q * (q - 1);
  bounds.uv *= p * q;
  return bounds;
}

bool DistanceBounds::at_most_one_stationary(double m, double most) {
  const int n_u = 2 * degree_[0] + 1, n_f = int(q_.size());
  const double infinity = std::numeric_limits<double>::infinity();
  double lower[2] = {infinity, infinity}, upper[2] = {-infinity, -infinity};  // of f_u, f_v
  double uu = infinity, vv = infinity, uv = 0;
  for (const double value : {m, std::max(m, most)}) {
    const DistanceCurvature bounds = curvature(value);
    uu = std::min(uu, bounds.uu);
    vv = std::min(vv, bounds.vv);
    uv = std::max(uv, bounds.uv);
    for (int i = 0; i < n_f; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const int next = axis == 0 ? i + 1 : i + n_u;
        if (axis == 0 ? next % n_u == 0 : next >= n_f) continue;
        lower[axis] = std::min(lower[axis], f_[next] - f_[i]);
        upper[axis] = std::max(upper[axis], f_[next] - f_[i]);
      }
  }
  const bool rises = lower[0] > 0 || lower[1] > 0, falls = upper[0] < 0 || upper[1] < 0;
  return rises || falls || (uu > 0 && vv > 0 && uu * vv > uv * uv);
}

}  // namespace sem::detail
