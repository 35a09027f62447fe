#pragma once
// Small free vibrations about a state: K phi = omega^2 M phi on the free entries.

#include <Eigen/Core>

#include "sem/solve/system.h"

namespace sem {

struct Modes {
  Status status = Status::converged;
  Eigen::VectorXd omega;   ///< rad/s, ascending; rigid motions near 0; -sqrt(-omega^2) if unstable
  Eigen::MatrixXd shapes;  ///< n by #modes, phi . M phi = 1, largest entry > 0, pinned entries 0
  Eigen::VectorXd residuals;  ///< |K phi - omega^2 M phi| / ((|K| + omega^2 |M|) |phi|)
  int n_massless = 0;         ///< free directions without mass (omega infinite): never returned
};

/// The lowest modes about z with K = d2V/dz2(z), at most n_modes of them: fewer
/// if there are fewer directions with mass. M may be singular (K must cover its
/// null space, else Status::singular) and K may be (rigid motions).
/// Dense: M phi = mu (K + s M) phi, omega^2 = 1/mu - s, about 10 n^3 operations.
Modes vibration_modes(const System& system, const Eigen::VectorXd& z, int n_modes);

/// True if the symmetric A, scaled to a unit diagonal, has an eigenvalue that is
/// zero to rounding (or a diagonal entry of zero with all its row): a motion
/// without stiffness. Computes all eigenvalues: for diagnosis only.
bool is_singular(const Eigen::MatrixXd& A);

}  // namespace sem
