#pragma once
// Eigen's decompositions as the tests use them: compiled once, as each takes long to compile.

#include <Eigen/Core>

namespace sem::test {

/// Of a symmetric A, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A);
/// Descending.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& A);
/// The X that makes |A X - B| least; A has full column rank.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace sem::test
