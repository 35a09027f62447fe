#pragma once
// Least squares with unknowns that must not be negative.

#include <Eigen/Core>

namespace sem {

/// Solution of min |A x - b|, x >= 0.
struct NonNegative {
  Eigen::VectorXd x;    ///< at most as many positive entries as A has rows, if |A x - b| is 0
  double residual = 0;  ///< |A x - b|
  bool converged = false;
};

/// Lawson and Hanson's active set method: columns enter one at a time, the one along which the
/// residual falls fastest; those that would turn negative leave. Ends when no column promises more
/// than `tolerance` times |b| (or after 5 times as many steps as A has columns). Columns of A must
/// not be zero.
NonNegative solve_non_negative(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                               double tolerance = 1e-14);

}  // namespace sem
