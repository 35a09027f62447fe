#pragma once
// Dense least squares in one place, compiled once.

#include <Eigen/Core>
#include <vector>

namespace sem {

/// X of least norm among those that minimise |A X - B|; A of any shape and rank. A: m by n, B: m by k.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Minimum-norm inverse of an m by n matrix.
struct PseudoInverse {
  Eigen::MatrixXd matrix;  ///< n by m
  int rank;                ///< directions kept
  double condition;        ///< largest over smallest pivot kept, a lower estimate of the condition; 1 at rank 0
};

/// Of A, by a complete orthogonal decomposition; pivots of at most tolerance * largest are cut.
PseudoInverse pseudo_inverse(const Eigen::MatrixXd& A, double tolerance);

/// A^T diag(weight) A, n by n. A: m by n.
Eigen::MatrixXd gram_matrix(const Eigen::MatrixXd& A, const Eigen::VectorXd& weight);

/// Indices of rows of a positive semi-definite G that are independent, in the order chosen: the first n_first, then
/// by the largest remaining diagonal of a Cholesky factorisation with pivots, until that is not above `tolerance`. Of
/// diagonals that are equal to 1e-6 the first is taken: symmetric bodies have many, and the choice must not hang on
/// the last bit.
std::vector<int> independent_rows(const Eigen::MatrixXd& G, int n_first, double tolerance);

/// Orthonormal basis of A's column space, m by rank (rank: singular to rounding is left out).
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& A);

}  // namespace sem
