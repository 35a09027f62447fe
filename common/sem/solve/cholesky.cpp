#include "sem/solve/cholesky.h"

#include <cmath>
#include <limits>

#include "sem/solve/dense_kernels.h"

namespace sem {

bool Cholesky::compute(const Eigen::MatrixXd& A) {
  const Eigen::Index n = A.rows();
  ok_ = false;
  factor_.resize(n, n);
  scale_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(A(i, i) > 0) || !std::isfinite(A(i, i))) return false;
    scale_(i) = 1 / std::sqrt(A(i, i));
  }
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = j; i < n; ++i) factor_(i, j) = A(i, j) * scale_(i) * scale_(j);
  if (!dense_kernels().cholesky(factor_.data(), int(n), int(n))) return false;
  for (Eigen::Index i = 0; i < n; ++i)  // written so that NaN fails
    if (!(factor_(i, i) * factor_(i, i) > zero_level(n))) return false;
  return ok_ = true;
}

void Cholesky::solve_in_place(Eigen::VectorXd& b) const {
  b.array() *= scale_.array();
  factor_.triangularView<Eigen::Lower>().solveInPlace(b);
  factor_.triangularView<Eigen::Lower>().transpose().solveInPlace(b);
  b.array() *= scale_.array();
}

void Cholesky::solve_factor_in_place(Eigen::MatrixXd& B) const {
  for (Eigen::Index j = 0; j < B.cols(); ++j) B.col(j).array() *= scale_.array();
  Eigen::MatrixXd rows = B.transpose();  // B^T := B^T L^-T
  const int n = int(B.rows()), m = int(B.cols());
  dense_kernels().solve_right(factor_.data(), n, rows.data(), m, m, n);
  B = rows.transpose();
}

void Cholesky::solve_transposed_factor_in_place(Eigen::MatrixXd& B) const {
  factor_.triangularView<Eigen::Lower>().transpose().solveInPlace(B);
  for (Eigen::Index j = 0; j < B.cols(); ++j) B.col(j).array() *= scale_.array();
}

double Cholesky::condition_estimate() const {
  if (!ok_) return std::numeric_limits<double>::infinity();
  if (factor_.rows() == 0) return 1;
  const double ratio = factor_.diagonal().maxCoeff() / factor_.diagonal().minCoeff();
  return ratio * ratio;
}

}  // namespace sem
