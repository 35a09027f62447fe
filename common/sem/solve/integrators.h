#pragma once
// Time integration of M z'' + grad V(z) = f, pinned entries at rest or led.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sem/solve/newton.h"
#include "sem/solve/system.h"

namespace sem {

/// linearly_implicit_euler (the paper's), order 1, damps:
///   (M + dt^2 K) dv = -dt (grad V(z) - f + dt K v), K = K(z); v += dv; z += dt v.
/// implicit_euler, order 1, damps: v1 = v0 - dt M^-1 (grad V(z1) - f), z1 = z0 + dt v1.
/// implicit_midpoint, order 2, keeps linear and angular momentum:
///   v1 = v0 - dt M^-1 (grad V((z0 + z1)/2) - f), z1 = z0 + dt (v0 + v1)/2.
/// M may be singular as long as M + dt^2 K is not.
/// Pinned entries that are led (System::motion) stand at the end of a step where the motion says;
/// their v1 follows from that by the same z1 = z0 + dt v1 or dt (v0 + v1)/2, so that the reactions'
/// work over a midpoint step, their force there times z1 - z0, is the energy it adds (exactly if V
/// is quadratic).
enum class Integrator { linearly_implicit_euler, implicit_euler, implicit_midpoint };

/// "linearly_implicit_euler", "implicit_euler", "implicit_midpoint".
const char* name(Integrator integrator);

/// Inverse of name(). Throws InputError(file, field, ...) for an unknown name.
Integrator integrator(const std::string& text, const std::string& file = "",
                      const std::string& field = "integrator");

struct StepOptions {
  double tolerance = 1e-13;  ///< Newton's, see NewtonReport; rounding level accepted too
  int max_iterations = 30;   ///< Newton's, per substep
  int max_halvings = 6;      ///< a failed step is retried as 2, 4, ..., 2^max_halvings substeps
};

struct StepReport {
  Status status = Status::converged;
  int n_substeps = 1;
  int iterations = 0;   ///< linear solves, failed attempts included
  double residual = 0;  ///< worst substep: Newton's, or that of the linear system
  Energies energies;    ///< of the state returned
};

/// Advances a state by fixed steps. A quadratic potential is assembled once, in
/// the constructor, and M + c dt^2 K is factorised once and again only when dt
/// changes (a retry in substeps changes it). step() allocates nothing then, and
/// nothing of its own otherwise. The result depends on the
/// state alone, not on steps taken before: a resumed run repeats the bits.
class TimeStepper {
 public:
  /// `system` must outlive this. Its load may change between steps, nothing else. dt > 0, s.
  TimeStepper(const System& system, double dt, Integrator integrator,
              const StepOptions& options = {});

  /// On success z, v, time and step advance; pinned entries that stay get v = 0.
  /// A step that does not converge, whose linear system is solved no better than
  /// to 1e-4, or that ends where V is not finite, is retried in substeps; if all retries fail the
  /// status says why and the state is untouched.
  StepReport step(State& state);

  void set_time_step(double dt) { dt_ = dt; }
  double time_step() const { return dt_; }

  /// Totals since construction, Newton's included.
  Counters counters() const;
  /// Of the last system matrix factorised.
  double condition_estimate() const;

 private:
  Status advance(double dt, double end, StepReport& report);
  Status advance_linear(double dt, StepReport& report);
  Status advance_newton(double dt, StepReport& report);
  Status factorize(double dt);
  bool factorize_matrix(double dt);
  void set_stiffness(bool project_psd);
  void set_gradient(const Eigen::VectorXd& z);
  double potential_energy(const Eigen::VectorXd& z);
  void set_energies(const State& state, double potential, Energies& energies);
  bool uses_newton() const;

  const System& system_;
  double dt_;
  Integrator integrator_;
  StepOptions options_;
  double theta_;  // weight of the end of the step: 1 Euler, 1/2 midpoint
  PotentialWork work_of_;
  bool quadratic_;  // V(z) = V(rest) + g0 . (z - rest) + 1/2 (z - rest) . K (z - rest)
  double factorized_dt_ = 0;
  Counters counters_;
  Newton newton_;
  SymmetricMatrix stiffness_, matrix_;
  SparseCholesky cholesky_;
  double rest_energy_ = 0, end_energy_ = 0;
  Eigen::VectorXd rest_gradient_, z_, v_, gradient_, work_, increment_, drift_;
  Eigen::VectorXd rhs_, dv_;
  std::vector<int> led_;          // entries that the motion leads
  Eigen::VectorXd end_, travel_;  // where to; by how much, 0 on the others
};

}  // namespace sem
