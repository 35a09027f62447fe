#pragma once
// What a quadrature rule is judged by: integrands that resemble smooth energies.

#include <algorithm>
#include <array>
#include <vector>

#include "sem/base/dim.h"

namespace sem {

/// With xi = (X - center) / (size / 2): 1 and all monomials of xi to degree 6; exp(+-xi_a) for
/// every axis a; cosine and sine of `waves` waves over the size, along the axes and the
/// diagonals of every two axes.
template <int Dim>
class SmoothIntegrands {
 public:
  SmoothIntegrands(const Vec<Dim>& center, double size, double waves);

  int size() const { return n_; }
  /// All values at X, size().
  Eigen::VectorXd values(const Vec<Dim>& X) const;
  /// sum += weight * values(X), without allocating.
  void add(const Vec<Dim>& X, double weight, Eigen::VectorXd& sum) const;
  /// The fastest rate of change, 1/m: 2 pi waves / size, or that of xi^6 at the end of the size.
  double rate() const { return std::max(wave_number_, 6 / half_size_); }

 private:
  Vec<Dim> center_;
  double half_size_, wave_number_;
  std::vector<std::array<int, 2>>
      product_;  // of each monomial: a monomial of one degree less, an axis
  std::vector<Vec<Dim>> directions_;
  int n_;
};

}  // namespace sem
