#include "sem/method/least_squares.h"

#include <Eigen/LU>
#include <Eigen/QR>

namespace sem {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(B);
}

}  // namespace sem
