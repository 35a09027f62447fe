#include "sem/method/least_squares.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include "sem/base/orthogonal_columns.h"

namespace sem {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(B);
}

PseudoInverse pseudo_inverse(const Eigen::MatrixXd& A, double tolerance) {
  Eigen::MatrixXd B = A, V;
  orthogonalise_columns(B, V);  // A = B V^T
  const Eigen::VectorXd sigma = B.colwise().norm();
  PseudoInverse result{Eigen::MatrixXd::Zero(A.cols(), A.rows()), 0, 1};
  int& rank = result.rank;
  while (rank < sigma.size() && sigma[rank] > tolerance * sigma[0]) {
    const Eigen::VectorXd b = B.col(rank) / sigma[rank];
    const Eigen::VectorXd v = V.col(rank) / sigma[rank];
    result.matrix.noalias() += v * b.transpose();
    ++rank;
  }
  if (rank > 0) result.condition = sigma[0] / sigma[rank - 1];
  return result;
}

Eigen::MatrixXd gram_matrix(const Eigen::MatrixXd& A, const Eigen::VectorXd& weight) {
  const Eigen::MatrixXd weighted = weight.asDiagonal() * A;
  return A.transpose() * weighted;
}

Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  return qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), qr.rank());
}

}  // namespace sem
