#include "linear_algebra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace sem::test {

using Eigen::MatrixXd;

Eigen::VectorXd eigenvalues(const MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd singular_values(const MatrixXd& A) { return Eigen::JacobiSVD<MatrixXd>(A).singularValues(); }

MatrixXd least_squares(const MatrixXd& A, const MatrixXd& B) { return Eigen::HouseholderQR<MatrixXd>(A).solve(B); }

}  // namespace sem::test
