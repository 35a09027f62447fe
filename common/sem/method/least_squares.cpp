#include "sem/method/least_squares.h"

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
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(A.rows(), A.rows());
  PseudoInverse result{decomposition.solve(identity), int(decomposition.rank()), 1};
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
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(A);
  return decomposition.householderQ() * Eigen::MatrixXd::Identity(A.rows(), decomposition.rank());
}

}  // namespace sem
