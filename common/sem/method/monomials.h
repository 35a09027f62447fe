#pragma once
// The polynomial basis m(X) (draft eq. 1 and 13, for any degree and dimension).

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sem/base/dim.h"

namespace sem {

/// Monomials of degree 1..n in Dim variables, C(n + Dim, Dim) - 1 of them, by
/// degree and within a degree by falling powers of the first variables:
/// x, y, x^2, xy, y^2, ... (the draft's eq. 1 lists x^2, y^2, xy).
template <int Dim>
class Monomials {
 public:
  explicit Monomials(int degree);

  int degree() const { return int(first_.size()) - 2; }
  int size() const { return int(exponent_.size()); }
  /// Monomials of degree k are first(k) .. first(k + 1), k = 1..n.
  int first(int k) const { return first_[k]; }
  const std::array<int, Dim>& exponent(int m) const { return exponent_[m]; }

  /// m(x), size().
  void values(const Vec<Dim>& x, Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> m) const;
  /// d m / d x_axis, size().
  void derivatives(const Vec<Dim>& x, int axis,
                   Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> m) const;

 private:
  std::vector<std::array<int, Dim>> exponent_;
  std::vector<int> first_;  // degree + 2; first_[0] = first_[1] = 0
};

}  // namespace sem
