#pragma once
// Static equilibrium: grad V(z) = f on the free entries, pinned entries given.
//
// Newton's method with a backtracking line search on V(z) - f . z (newton.h),
// in load steps: at load factor s in (0, 1] the load is s f and the pinned
// entries stand at z_start + s (target - z_start) or path(s).

#include <Eigen/Core>

#include "sem/solve/newton.h"
#include "sem/solve/system.h"

namespace sem {

struct StaticOptions {
  Eigen::VectorXd
      target;            ///< n: where pinned entries are led (free ones ignored); empty: they stay
  PinPath path;          ///< on the way to the target, which it ends at; empty: straight
  int n_load_steps = 1;  ///< >= 1; a quadratic potential always takes one
  int max_halvings = 8;  ///< how often the load step may be halved after a failure
  double tolerance = 1e-10;  ///< on the residual relative to the reference force
  int max_iterations = 50;   ///< per load step
};

struct StaticReport {
  Status status = Status::converged;
  double load_factor = 0;  ///< s of the state returned; 1 if converged
  int n_load_steps = 0;    ///< converged ones
  int n_halvings = 0;
  int iterations = 0;   ///< Newton iterations, failed load steps included
  double residual = 0;  ///< |grad V - s f| on free entries / reference force, last load step tried
  double reference_force = 0;     ///< N; see NewtonReport
  Energies energies;              ///< of the state returned, with the full load
  double condition_estimate = 0;  ///< see Cholesky::condition_estimate
  Counters counters;
};

/// Leads `state.z` to equilibrium; v, time and step are not touched. A load
/// step that fails is halved; if that does not help either, the status says
/// why and state.z is the last equilibrium found on the way. A tangent with
/// rigid motions left ends with Status::singular at once. A quadratic
/// potential takes one factorisation and one iteration.
StaticReport solve_static(const System& system, State& state, const StaticOptions& options = {});

}  // namespace sem
