#include "src2d/tutorials/matrices.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <ostream>

#include "sem/lesson/numbers.h"
#include "sem/method/monomials.h"

namespace sem::tutorial {

using Decomposition = Eigen::CompleteOrthogonalDecomposition<MatrixXd>;
using EigenSolver = Eigen::SelfAdjointEigenSolver<MatrixXd>;
using Sparse = Eigen::SparseMatrix<double>;

void print(std::ostream& out, const std::string& title, const MatrixXd& matrix) {
  out << title << ":\n" << rounded(matrix);
}

MatrixXd moments(const MatrixXd& a, const VectorXd& v, const MatrixXd& b) {
  const MatrixXd scaled = a * v.asDiagonal();
  return scaled * b.transpose();
}

MatrixXd monomial_rows(int n, const Points<2>& X, const Vec<2>& origin) {
  const Monomials<2> m(n);
  MatrixXd rows(X.cols(), m.size());
  for (int s = 0; s < X.cols(); ++s) m.values(X.col(s) - origin, rows.row(s));
  return rows;
}

MatrixXd pseudo_inverse(const MatrixXd& A) { return Decomposition(A).pseudoInverse(); }

MatrixXd least_squares(const MatrixXd& A, const MatrixXd& B) { return Decomposition(A).solve(B); }

MatrixXd solve(const MatrixXd& A, const MatrixXd& B) { return A.ldlt().solve(B); }

VectorXd solve_free(const Sparse& K, const std::vector<bool>& free, const VectorXd& f, VectorXd u) {
  std::vector<Eigen::Triplet<double>> ones;  // selects the free entries
  for (int i = 0; i < K.rows(); ++i)
    if (free[i]) {
      ones.emplace_back(i, int(ones.size()), 1);
      u[i] = 0;
    }
  Sparse select(K.rows(), Eigen::Index(ones.size()));
  select.setFromTriplets(ones.begin(), ones.end());
  const Sparse K_free = select.transpose() * K * select;
  const VectorXd load = select.transpose() * (f - K * u);
  return u + select * Eigen::SimplicialLDLT<Sparse>(K_free).solve(load);
}

int rank(const MatrixXd& A) {
  Decomposition decomposition;
  decomposition.setThreshold(1e-9);
  return int(decomposition.compute(A).rank());
}

Mat<2> rotation(const Mat<2>& A) {
  const Eigen::JacobiSVD<Mat<2>> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Mat<2> U = svd.matrixU(), V = svd.matrixV();
  const Vec<2> sign(1, U.determinant() * V.determinant());
  return U * sign.asDiagonal() * V.transpose();
}

VectorXd eigenvalues(const MatrixXd& A) {
  return EigenSolver(A, Eigen::EigenvaluesOnly).eigenvalues();
}

VectorXd last_eigenvector(const MatrixXd& A) { return EigenSolver(A).eigenvectors().rightCols(1); }

MatrixXd kernel(const MatrixXd& A, double zero) {
  if (A.size() == 0) return A;
  const EigenSolver eigen(A);
  const auto small = eigen.eigenvalues().array() < zero * eigen.eigenvalues().maxCoeff();
  return eigen.eigenvectors().leftCols(small.count());
}

Vibrations vibrations(const MatrixXd& K, const MatrixXd& M, double zero) {
  const EigenSolver sizes(M);
  const auto seen = sizes.eigenvalues().array() > zero * sizes.eigenvalues().maxCoeff();
  const MatrixXd V = sizes.eigenvectors().rightCols(seen.count());
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(V.transpose() * K * V,
                                                                  V.transpose() * M * V);
  return {solver.eigenvalues(), V * solver.eigenvectors()};
}

}  // namespace sem::tutorial
