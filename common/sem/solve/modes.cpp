#include "sem/solve/modes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sem/solve/cholesky.h"
#include "sem/solve/symmetric_eigen.h"

namespace sem {

namespace {

// Factorises K + s M with the smallest of a few shifts s that make it well positive definite; false if none does.
// None is tiny: rigid motions with mu = 1/s must not drown the others.
bool factorize_shifted(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M, Cholesky& cholesky) {
  const double ratio = M.trace() > 0 ? std::abs(K.trace()) / M.trace() : 0;
  for (const double share : {0., 1e-4, 1e-2, 1., 100., 1e4})
    if (cholesky.compute(K + share * ratio * M) && cholesky.condition_estimate() < 1e10)
      return true;
  return false;
}

// Rayleigh quotient: free of the cancellation in 1/mu - s.
double signed_omega(const Eigen::VectorXd& phi, const Eigen::MatrixXd& K,
                    const Eigen::MatrixXd& M) {
  const double squared = phi.dot(K * phi) / phi.dot(M * phi);
  return std::copysign(std::sqrt(std::abs(squared)), squared);
}

}  // namespace

Modes vibration_modes(const System& system, const Eigen::VectorXd& z, int n_modes) {
  const int n = system.size(), n_free = int(system.free.size());
  Modes modes;
  modes.shapes.resize(n, 0);
  if (n_free == 0) return modes;
  SymmetricMatrix hessian = system.potential->new_hessian(), mass = hessian;
  system.potential->hessian(z, false, hessian);
  mass.add(1, system.mass);
  const Eigen::MatrixXd K = hessian.dense(system.free), M = mass.dense(system.free);
  if (!K.allFinite() || !M.allFinite()) {
    modes.status = Status::not_finite;
    return modes;
  }
  Cholesky cholesky(n_free);
  if (!factorize_shifted(K, M, cholesky)) {
    modes.status = Status::singular;
    return modes;
  }
  // M phi = mu (K + s M) phi with K + s M = C C^T: C^-1 M C^-T (C^T phi) = mu (C^T phi).
  Eigen::MatrixXd half = M;
  cholesky.solve_factor_in_place(half);
  half.transposeInPlace();
  cholesky.solve_factor_in_place(half);
  const auto eigen = symmetric_eigen(half, std::clamp(n_modes, 0, n_free));
  // mu descending = omega ascending; mu = 0 without mass.
  const Eigen::VectorXd mu = eigen.values.reverse();
  const double no_mass = 8 * n_free * std::numeric_limits<double>::epsilon() * std::max(mu(0), 0.);
  const int n_massive = int((mu.array() > no_mass).count());
  modes.n_massless = n_free - n_massive;

  const int n_found = std::clamp(n_modes, 0, n_massive);
  std::vector<std::pair<double, int>> order;
  Eigen::MatrixXd shapes = eigen.vectors.rightCols(n_found);
  cholesky.solve_transposed_factor_in_place(shapes);
  for (int k = 0; k < n_found; ++k) order.push_back({signed_omega(shapes.col(n_found - 1 - k), K, M), n_found - 1 - k});
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });

  modes.omega.resize(n_found);
  modes.residuals.resize(n_found);
  modes.shapes.setZero(n, n_found);
  for (int k = 0; k < n_found; ++k) {
    const auto [omega, column] = order[k];
    Eigen::VectorXd phi = shapes.col(column);
    Eigen::Index largest;
    phi.cwiseAbs().maxCoeff(&largest);
    phi /= std::copysign(std::sqrt(phi.dot(M * phi)), phi(largest));
    const double squared = omega * std::abs(omega);
    modes.omega(k) = omega;
    modes.residuals(k) = (K * phi - squared * (M * phi)).norm() /
                         ((K.norm() + std::abs(squared) * M.norm()) * phi.norm());
    for (int a = 0; a < n_free; ++a) modes.shapes(system.free[a], k) = phi(a);
  }
  return modes;
}

bool is_singular(const Eigen::MatrixXd& A) {
  if (A.rows() == 0) return false;
  const Eigen::VectorXd diagonal = A.diagonal().cwiseAbs();
  // A zero on the diagonal of an indefinite matrix is no zero eigenvalue: scale by the row then.
  Eigen::VectorXd scale(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const double size = std::max(diagonal(i), zero_level(A.rows()) * A.row(i).norm());
    if (!(size > 0)) return true;
    scale(i) = 1 / std::sqrt(size);
  }
  const Eigen::MatrixXd scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Eigen::VectorXd values = symmetric_eigen(scaled, 0).values.cwiseAbs();
  return values.minCoeff() <= zero_level(A.rows()) * values.maxCoeff();
}

}  // namespace sem
