#pragma once
// Singular value decomposition of small matrices.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sem {

/// Rotates the columns of A, m by n, until they are orthogonal: A becomes A V with V, n by n, orthogonal, resized
/// as needed. The lengths of A's columns, descending, are then the singular values: A = (U diag(s)) V^T.
/// One-sided Jacobi rotations (Hestenes 1958): simple, and accurate also for small singular values.
template <class Matrix, class Square>
void orthogonalise_columns(Matrix& A, Square& V) {
  const Eigen::Index n = A.cols();
  V.setIdentity(n, n);
  const auto rotate = [](auto&& x, auto&& y, double c, double s) {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double old = x[i];
      x[i] = c * old - s * y[i];
      y[i] = s * old + c * y[i];
    }
  };
  const double rounding = double(A.rows()) * std::numeric_limits<double>::epsilon();
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < 40; ++sweep) {
    rotated = false;
    for (Eigen::Index p = 0; p < n; ++p)
      for (Eigen::Index q = p + 1; q < n; ++q) {
        const double a = A.col(p).squaredNorm(), b = A.col(q).squaredNorm(), ab = A.col(p).dot(A.col(q));
        if (std::abs(ab) <= rounding * std::sqrt(a) * std::sqrt(b)) continue;
        rotated = true;
        const double zeta = (b - a) / (2 * ab);
        const double t = std::copysign(1 / (std::abs(zeta) + std::hypot(1, zeta)), zeta);
        const double c = 1 / std::hypot(1, t);
        rotate(A.col(p), A.col(q), c, c * t);
        rotate(V.col(p), V.col(q), c, c * t);
      }
  }
  for (Eigen::Index p = 0; p < n; ++p) {  // longest first
    Eigen::Index longest = p;
    for (Eigen::Index q = p + 1; q < n; ++q)
      if (A.col(q).squaredNorm() > A.col(longest).squaredNorm()) longest = q;
    if (longest == p) continue;
    A.col(p).swap(A.col(longest));
    V.col(p).swap(V.col(longest));
  }
}

}  // namespace sem
