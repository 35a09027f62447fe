#include "sem/method/monomials.h"

namespace sem {
namespace {

double power(double x, int n) {
  double result = 1;
  for (; n > 0; --n) result *= x;
  return result;
}

// All exponents of Dim variables from `axis` on that sum to `left`, first powers falling.
template <int Dim>
void append_exponents(int axis, int left, std::array<int, Dim>& exponent,
                      std::vector<std::array<int, Dim>>& out) {
  if (axis == Dim - 1) {
    exponent[axis] = left;
    out.push_back(exponent);
    return;
  }
  for (int e = left; e >= 0; --e) {
    exponent[axis] = e;
    append_exponents<Dim>(axis + 1, left - e, exponent, out);
  }
}

}  // namespace

template <int Dim>
Monomials<Dim>::Monomials(int degree) : first_{0} {
  std::array<int, Dim> exponent{};
  for (int k = 1; k <= degree; ++k) {
    first_.push_back(size());
    append_exponents<Dim>(0, k, exponent, exponent_);
  }
  first_.push_back(size());
}

template <int Dim>
void Monomials<Dim>::values(const Vec<Dim>& x,
                            Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> m) const {
  for (int j = 0; j < size(); ++j) {
    m[j] = 1;
    for (int a = 0; a < Dim; ++a) m[j] *= power(x[a], exponent_[j][a]);
  }
}

template <int Dim>
void Monomials<Dim>::derivatives(const Vec<Dim>& x, int axis,
                                 Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> m) const {
  for (int j = 0; j < size(); ++j) {
    const int e = exponent_[j][axis];
    m[j] = e == 0 ? 0 : e * power(x[axis], e - 1);
    for (int a = 0; a < Dim; ++a)
      if (a != axis) m[j] *= power(x[a], exponent_[j][a]);
  }
}

template class Monomials<2>;
template class Monomials<3>;

}  // namespace sem
