#pragma once
// Newton's method for the one minimisation problem that statics, implicit
// Euler and implicit midpoint share.

#include <Eigen/Core>

#include "sem/solve/sparse_cholesky.h"
#include "sem/solve/system.h"

namespace sem {

struct NewtonOptions {
  double tolerance = 1e-10;
  int max_iterations = 50;
};

struct NewtonReport {
  Status status = Status::converged;
  int iterations = 0;
  double residual = 0;  ///< |r| / reference_force
  /// The largest of: |load| on free entries, |grad V| on all entries (reactions
  /// included) at the start and at the end, |inertia M drift|; N.
  double reference_force = 0;
};

/// Over the free entries of the increment u,
///   minimise V(base + u) - load . u + inertia/2 (u - drift)^T M (u - drift),
///   r(u) = grad V(base + u) - load + inertia M (u - drift).
/// inertia [1/s^2] is 0 in statics.
struct IncrementProblem {
  const Eigen::VectorXd& base;  ///< n
  const Eigen::VectorXd& load;  ///< n
  double inertia = 0;
  const Eigen::VectorXd& drift;       ///< n
  const Eigen::VectorXd& prescribed;  ///< n: u of the pinned entries (free ones ignored)
};

/// Keeps every workspace: solving allocates nothing of its own, save to diagnose a matrix that
/// even projected is not positive definite.
class Newton {
 public:
  /// `system` must outlive this.
  explicit Newton(const System& system);

  /// Starts at u = 0. Pinned entries are brought to their prescribed values by a
  /// tangent predictor, then Newton steps with backtracking (Armijo) follow; near
  /// the solution, where the energy is all rounding, a step is judged by its
  /// residual. The direction comes from the Cholesky factor of the raw Hessian;
  /// if that is indefinite, of the projected one; if that fails, of the
  /// projected one plus a multiple of its diagonal. Converged: residual <=
  /// tolerance, or r is down to the rounding of the internal forces
  /// (and below 1e-4 of the largest forces on the way; or nothing
  /// is loaded, and there is inertia or these are rounding too). On failure
  /// u is the last iterate. Never returns a non-finite u.
  NewtonReport minimize(const IncrementProblem& problem, const NewtonOptions& options,
                        Eigen::VectorXd& u);

  const Counters& counters() const { return counters_; }
  double condition_estimate() const { return cholesky_.condition_estimate(); }

 private:
  double evaluate(const IncrementProblem& problem, const Eigen::VectorXd& u);
  void assemble(double inertia, bool project_psd);
  bool factorize();
  void add_shift(double share);
  Status direction(double inertia);
  bool predict(const IncrementProblem& problem, Eigen::VectorXd& u);
  bool line_search(const IncrementProblem& problem, Eigen::VectorXd& u);
  bool is_rounding(const IncrementProblem& problem, const Eigen::VectorXd& u, double norm,
                   double largest_force);
  double reference_force(const IncrementProblem& problem);
  bool pins_move(const IncrementProblem& problem);

  const System& system_;
  PotentialWork work_of_;
  Counters counters_;
  SymmetricMatrix hessian_, matrix_;
  SparseCholesky cholesky_;
  Eigen::VectorXd z_, gradient_, inertial_, residual_, step_, trial_, mass_step_, work_;
  Eigen::VectorXd diagonal_;
  double energy_ = 0;
};

}  // namespace sem
