#include "sem/method/smooth_integrands.h"

#include <cmath>
#include <numbers>

namespace sem {

template <int Dim>
SmoothIntegrands<Dim>::SmoothIntegrands(const Vec<Dim>& center, double size, double waves)
    : center_(center), half_size_(size / 2), wave_number_(2 * std::numbers::pi * waves / size) {
  // Each monomial from one of the degree before: X_a times those that have no factor before a.
  product_.push_back({-1, 0});
  for (int degree = 1, begin = 0; degree <= 6; ++degree) {
    const int end = int(product_.size());
    for (int lower = begin; lower < end; ++lower)
      for (int a = product_[lower][1]; a < Dim; ++a) product_.push_back({lower, a});
    begin = end;
  }
  for (int a = 0; a < Dim; ++a) directions_.push_back(Vec<Dim>::Unit(a));
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < a; ++b)
      for (const double sign : {1.0, -1.0})
        directions_.push_back((Vec<Dim>::Unit(a) + sign * Vec<Dim>::Unit(b)).normalized());
  n_ = int(product_.size()) + 2 * Dim + 2 * int(directions_.size());
}

template <int Dim>
void SmoothIntegrands<Dim>::add(const Vec<Dim>& X, double weight, Eigen::VectorXd& sum) const {
  const Vec<Dim> xi = (X - center_) / half_size_;
  std::array<double, 84> monomial;  // C(6 + 3, 3)
  monomial[0] = weight;
  sum[0] += weight;
  int next = 1;
  for (; next < int(product_.size()); ++next)
    sum[next] += monomial[next] = monomial[product_[next][0]] * xi[product_[next][1]];
  for (int a = 0; a < Dim; ++a) {
    const double grown = std::exp(xi[a]);
    sum[next++] += weight * grown;
    sum[next++] += weight / grown;
  }
  for (const auto& direction : directions_) {
    const double phase = wave_number_ * direction.dot(X - center_);
    sum[next++] += weight * std::cos(phase);
    sum[next++] += weight * std::sin(phase);
  }
}

template <int Dim>
Eigen::VectorXd SmoothIntegrands<Dim>::values(const Vec<Dim>& X) const {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(n_);
  add(X, 1, f);
  return f;
}

template class SmoothIntegrands<2>;
template class SmoothIntegrands<3>;

}  // namespace sem
