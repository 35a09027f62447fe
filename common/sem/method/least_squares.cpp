#include "sem/method/least_squares.h"

#include <Eigen/QR>
#include <algorithm>
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

std::vector<int> independent_rows(const Eigen::MatrixXd& G, int n_first, double tolerance) {
  const int n = int(G.rows());
  Eigen::MatrixXd L(n, n);
  Eigen::VectorXd left = G.diagonal();
  const auto first_largest = [&] {
    const double most = left.maxCoeff(), nearly = most - 1e-6 * std::abs(most);
    return int(std::find_if(left.begin(), left.end(), [&](double v) { return v >= nearly; }) - left.begin());
  };
  std::vector<int> chosen;
  while (int(chosen.size()) < n) {
    const int c = int(chosen.size()), pivot = c < n_first ? c : first_largest();
    if (!(left[pivot] > tolerance)) break;
    L.col(c) = (G.col(pivot) - L.leftCols(c) * L.row(pivot).head(c).transpose()) / std::sqrt(left[pivot]);
    left -= L.col(c).cwiseAbs2();
    left[pivot] = -1;
    chosen.push_back(pivot);
  }
  return chosen;
}

Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& A) {
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(A);
  return decomposition.householderQ() * Eigen::MatrixXd::Identity(A.rows(), decomposition.rank());
}

}  // namespace sem
