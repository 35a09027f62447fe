#pragma once
// Linear algebra of the tutorials: fits, kernels, eigenvalues, a solve. Compiled once, as Eigen's
// decompositions take long to compile.

#include <Eigen/SparseCore>
#include <iosfwd>
#include <string>
#include <vector>

#include "sem/base/dim.h"

namespace sem::tutorial {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// "title:" and the matrix, a row a line.
void print(std::ostream& out, const std::string& title, const MatrixXd& matrix);

/// sum_s v_s a_s b_s^T over the columns of a and b.
MatrixXd moments(const MatrixXd& a, const VectorXd& v, const MatrixXd& b);
/// The library's monomials of degree 1 to n: m(X - origin) in a row for each column of X.
MatrixXd monomial_rows(int n, const Points<2>& X, const Vec<2>& origin);

/// Moore-Penrose inverse.
MatrixXd pseudo_inverse(const MatrixXd& A);
/// The X that makes |A X - B| least; of several the least.
MatrixXd least_squares(const MatrixXd& A, const MatrixXd& B);
/// A^-1 B of a symmetric A (LDL^T).
MatrixXd solve(const MatrixXd& A, const MatrixXd& B);
/// u with K u = f in the rows that are free; elsewhere u is given. K is symmetric and positive
/// definite in the free rows.
VectorXd solve_free(const Eigen::SparseMatrix<double>& K, const std::vector<bool>& free,
                    const VectorXd& f, VectorXd u);

/// Number of independent rows (or columns), to 1e-9 of the largest pivot.
int rank(const MatrixXd& A);
/// The rotation R nearest to A: A = R S with S symmetric.
Mat<2> rotation(const Mat<2>& A);
/// Eigenvalues of a symmetric A, ascending; the eigenvector of the largest.
VectorXd eigenvalues(const MatrixXd& A);
VectorXd last_eigenvector(const MatrixXd& A);
/// Orthonormal vectors that span the kernel of a symmetric positive semi-definite A: eigenvalues
/// below `zero` times the largest count as 0.
MatrixXd kernel(const MatrixXd& A, double zero = 1e-12);
/// K v = lambda M v, v^T M v = 1, by rising lambda, among the v that M (symmetric, positive
/// semi-definite) sees: eigenvalues of M below `zero` times the largest count as 0.
struct Vibrations {
  VectorXd lambda;
  MatrixXd v;  ///< in columns
};
Vibrations vibrations(const MatrixXd& K, const MatrixXd& M, double zero);

}  // namespace sem::tutorial
