// The kernels of dense_kernels.h, included once a set of instructions: Eigen is renamed, so that the
// templates compiled for one are no one else's.
#define Eigen SEM_KERNEL_EIGEN
#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "sem/solve/dense_kernels.h"

namespace sem::detail {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
using View = Eigen::Map<Matrix, 0, Eigen::OuterStride<>>;
using ConstView = Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>;

View view(double* A, int rows, int columns, int ld) { return {A, rows, columns, Eigen::OuterStride<>(ld)}; }
ConstView view(const double* A, int rows, int columns, int ld) { return {A, rows, columns, Eigen::OuterStride<>(ld)}; }

constexpr int narrow = 3;  // so few columns do not pay for the copies that a product of matrices makes

bool cholesky(double* A, int n, int ld) {
  auto all = view(A, n, n, ld);
  Eigen::Ref<Matrix> target(all);
  const Eigen::LLT<Eigen::Ref<Matrix>> factor(target);  // in place
  return factor.info() == Eigen::Success;
}

void solve_right(const double* L, int ld_l, double* B, int ld_b, int m, int n) {
  auto target = view(B, m, n, ld_b);
  view(L, n, n, ld_l).transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(target);
}

void add_scaled_product(double factor, double* C, int ld_c, const double* A, int ld_a, const double* B, int ld_b, int m, int n, int k) {
  auto target = view(C, m, n, ld_c);
  const auto left = view(A, m, k, ld_a), right = view(B, n, k, ld_b);
  if (n <= narrow) {
    for (int j = 0; j < n; ++j) target.col(j).noalias() += factor * (left * right.row(j).transpose());
    return;
  }
  target.noalias() += factor * left * right.transpose();
}

void add_product(double* C, int ld_c, const double* A, int ld_a, const double* B, int ld_b, int m, int n, int k) {
  view(C, m, n, ld_c).noalias() += view(A, k, m, ld_a).transpose() * view(B, k, n, ld_b);
}

void add_lower_product(double* C, int ld_c, const double* A, int ld_a, const double* B, int ld_b, int n, int k) {
  auto target = view(C, n, n, ld_c);
  target.triangularView<Eigen::Lower>() += view(A, k, n, ld_a).transpose() * view(B, k, n, ld_b);
}

void weigh_rows(double* C, int ld_c, const double* const* factors, int n_factors, const double* A, int ld_a, int m, int n) {
  using Column = Eigen::Map<Eigen::ArrayXd>;
  using ConstColumn = Eigen::Map<const Eigen::ArrayXd>;
  for (int j = 0; j < n; ++j) {
    const auto product = [&](int d) { return ConstColumn(factors[d], m) * ConstColumn(A + long(j) * ld_a + long(d) * m, m); };
    Column column(C + long(j) * ld_c, m);
    if (n_factors == 3) {
      column = product(0) + product(1) + product(2);
      continue;
    }
    column = product(0);
    for (int d = 1; d < n_factors; ++d) column += product(d);
  }
}

// By products of rectangles, whose order of summation does not depend on where the matrix begins in memory as that
// of Eigen's symmetric product does.
void multiply_panel(const double* A, int ld, int n, int m, const double* x, const double* u, double* y, double* v) {
  using Vector = Eigen::Map<Eigen::VectorXd>;
  using ConstVector = Eigen::Map<const Eigen::VectorXd>;
  constexpr int at_once = 16;
  for (int j = 0; j < n; j += at_once) {
    const int w = n - j < at_once ? n - j : at_once, rest = n - j - w;
    const double* corner = A + j + long(j) * ld;
    for (int c = 0; c < w; ++c) {
      double sum = corner[c + long(c) * ld] * x[j + c];
      for (int i = c + 1; i < w; ++i) {
        sum += corner[i + long(c) * ld] * x[j + i];
        y[j + i] += corner[i + long(c) * ld] * x[j + c];
      }
      y[j + c] += sum;
    }
    if (rest == 0) continue;
    const auto below = view(corner + w, rest, w, ld);
    Vector(y + j + w, rest).noalias() += below * ConstVector(x + j, w);
    Vector(y + j, w).noalias() += below.transpose() * ConstVector(x + j + w, rest);
  }
  if (m == 0) return;
  const auto below = view(A + n, m, n, ld);
  Vector(y, n).noalias() += below.transpose() * ConstVector(u, m);
  Vector(v, m).noalias() = below * ConstVector(x, n);
}

}  // namespace

const DenseKernels SEM_KERNELS{SEM_KERNEL_NAME, cholesky, solve_right, add_scaled_product, add_product, add_lower_product, weigh_rows, multiply_panel};

}  // namespace sem::detail
