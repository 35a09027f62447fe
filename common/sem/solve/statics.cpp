#include "sem/solve/statics.h"

#include <algorithm>
#include <cassert>

namespace sem {

StaticReport solve_static(const System& system, State& state, const StaticOptions& options) {
  assert(options.n_load_steps >= 1);
  const Eigen::Index n = system.size();
  StaticReport report;
  Newton newton(system);
  const Eigen::VectorXd no_drift = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd travel = no_drift, prescribed(n), load(n), increment(n);
  if (options.target.size() > 0) {
    assert(options.target.size() == n);
    travel = options.target - state.z;
    for (const int i : system.free) travel(i) = 0;
  }

  double stride = system.potential->quadratic() ? 1 : 1. / options.n_load_steps;
  while (report.load_factor < 1) {
    double factor = report.load_factor + stride;
    if (factor > 1 - 1e-9) factor = 1;
    load = factor * system.load;
    if (options.path)
      prescribed = options.path(factor) - state.z;
    else
      prescribed = (factor - report.load_factor) * travel;
    const NewtonReport step =
        newton.minimize({state.z, load, 0, no_drift, prescribed},
                        {options.tolerance, options.max_iterations}, increment);
    report.iterations += step.iterations;
    report.status = step.status;
    report.residual = step.residual;
    report.reference_force = step.reference_force;
    if (step.status == Status::converged) {
      state.z += increment;
      report.load_factor = factor;
      if (factor == 1 && options.target.size() > 0)  // to the last bit
        state.z = (travel.array() != 0).select(options.target, state.z);
      ++report.n_load_steps;
    } else if (step.status == Status::singular || report.n_halvings == options.max_halvings) {
      break;
    } else {
      stride /= 2;
      ++report.n_halvings;
    }
  }
  State at_rest{state.z, no_drift};
  report.energies = energies(system, at_rest);
  report.condition_estimate = newton.condition_estimate();
  report.counters = newton.counters();
  return report;
}

}  // namespace sem
