#pragma once
// Cholesky factorisation that tells a singular matrix from a regular one.

#include <Eigen/Core>
#include <limits>

namespace sem {

/// A = S^-1 L L^T S^-1 with S = 1 / sqrt(diag A): scaling makes the pivots of L, in
/// (0, 1], independent of the units of the unknowns. Reuses its storage; Eigen's
/// blocked kernels may take workspace of their own from the heap if A has more
/// than some 500 rows.
class Cholesky {
 public:
  /// Reserves room for n by n.
  explicit Cholesky(int n = 0) : factor_(n, n), scale_(n) {}

  /// Factorises the symmetric A (lower triangle read). False, and no factor,
  /// unless A is finite and positive definite with every squared pivot above 8 n eps.
  bool compute(const Eigen::MatrixXd& A);

  /// b := A^-1 b.
  void solve_in_place(Eigen::VectorXd& b) const;

  /// B := C^-1 B and B := C^-T B for the factor C = S^-1 L of A = C C^T.
  void solve_factor_in_place(Eigen::MatrixXd& B) const;
  void solve_transposed_factor_in_place(Eigen::MatrixXd& B) const;

  /// (largest pivot / smallest pivot)^2 of L: a cheap lower bound of the
  /// condition number of the scaled A; infinity without a factor.
  double condition_estimate() const;

 private:
  Eigen::MatrixXd factor_;
  Eigen::VectorXd scale_;  // 1 / sqrt(A_ii)
  bool ok_ = false;
};

/// Relative size below which a squared pivot or an eigenvalue of an n by n matrix is rounding.
inline double zero_level(Eigen::Index n) { return 8 * double(n) * std::numeric_limits<double>::epsilon(); }

}  // namespace sem
