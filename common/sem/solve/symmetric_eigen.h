#pragma once
// Eigenvalues and eigenvectors of a symmetric matrix.

#include <Eigen/Eigenvalues>

namespace sem {

/// H v = value v.
template <class Matrix>
struct SymmetricEigen {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Matrix::MaxRowsAtCompileTime, 1>
      values;      ///< all, ascending
  Matrix vectors;  ///< n by n_vectors, orthonormal: those of the last n_vectors values
};

/// Eigen's tridiagonalisation and QR iteration for H (lower triangle read) of a dynamic size, with
/// the vectors of the n_vectors largest eigenvalues; does not allocate if the type bounds the size.
/// Unlike SelfAdjointEigenSolver it multiplies only these vectors by the Householder reflections,
/// one by one: less work for few vectors, and a quarter of the time to compile.
template <class Matrix>
SymmetricEigen<Matrix> symmetric_eigen(const Matrix& H, Eigen::Index n_vectors) {
  const Eigen::Index n = H.rows();
  const Eigen::Tridiagonalization<Matrix> reduced(H);
  Eigen::SelfAdjointEigenSolver<Matrix> solver(n);
  solver.computeFromTridiagonal(
      reduced.diagonal(), reduced.subDiagonal(),
      n_vectors > 0 ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly);
  SymmetricEigen<Matrix> result{solver.eigenvalues(), Matrix(n, n_vectors)};
  if (n_vectors == 0) return result;
  result.vectors = solver.eigenvectors().rightCols(n_vectors);
  Matrix reflections = reduced.packedMatrix();  // v_i = (0, ..., 0, 1, tail of column i)
  reflections.diagonal(-1).setOnes();
  for (Eigen::Index j = 0; j < n_vectors; ++j)
    for (Eigen::Index i = n - 2; i >= 0; --i) {  // x := (I - tau_i v_i v_i^T) x
      const auto v = reflections.col(i).tail(n - i - 1);
      auto x = result.vectors.col(j).tail(n - i - 1);
      x -= reduced.householderCoefficients()(i) * v.dot(x) * v;
    }
  return result;
}

}  // namespace sem
