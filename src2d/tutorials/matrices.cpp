#include "src2d/tutorials/matrices.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <ostream>

#include "sem/lesson/numbers.h"
#include "sem/method/least_squares.h"
#include "sem/method/monomials.h"

namespace sem::tutorial {

using EigenSolver = Eigen::SelfAdjointEigenSolver<MatrixXd>;
constexpr double zero_pivot = 1e-9;

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

MatrixXd pseudo_inverse(const MatrixXd& A) { return sem::pseudo_inverse(A, 1e-12).matrix; }

MatrixXd least_squares(const MatrixXd& A, const MatrixXd& B) { return sem::least_squares(A, B); }

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

int rank(const MatrixXd& A) { return sem::pseudo_inverse(A, zero_pivot).rank; }

Mat<2> rotation(const Mat<2>& A) {
  // R^T A is symmetric: sin(a) (A_00 + A_11) = cos(a) (A_10 - A_01).
  return Eigen::Rotation2Dd(std::atan2(A(1, 0) - A(0, 1), A(0, 0) + A(1, 1))).toRotationMatrix();
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
  MatrixXd V = sizes.eigenvectors().rightCols(seen.count());  // V^T M V = 1:
  for (int j = 0; j < V.cols(); ++j) V.col(j) /= std::sqrt(V.col(j).dot(M * V.col(j)));
  const EigenSolver solver(moments(V.transpose(), VectorXd::Ones(K.rows()), (K * V).transpose()));
  return {solver.eigenvalues(), V * solver.eigenvectors()};
}

}  // namespace sem::tutorial
