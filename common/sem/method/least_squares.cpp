#include "sem/method/least_squares.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

namespace sem {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(B);
}

PseudoInverse pseudo_inverse(const Eigen::MatrixXd& A, double tolerance) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(tolerance);
  decomposition.compute(A);
  PseudoInverse result{decomposition.solve(Eigen::MatrixXd::Identity(A.rows(), A.rows())), int(decomposition.rank()), 1};
  if (result.rank > 0)
    result.condition = std::abs(decomposition.matrixQTZ()(0, 0) /
                                decomposition.matrixQTZ()(result.rank - 1, result.rank - 1));
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
