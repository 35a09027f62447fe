#pragma once
// Dense least squares in one place, compiled once.

#include <Eigen/Core>

namespace sem {

/// X of least norm among those that minimise |A X - B|; A of any shape and rank. A: m by n, B: m by k.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Orthonormal basis of A's column space, m by rank (rank: singular to rounding is left out).
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& A);

}  // namespace sem
