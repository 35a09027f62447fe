#include "sem/scene/analysis.h"

#include <cmath>

#include "sem/base/stopwatch.h"
#include "sem/solve/integrators.h"

namespace sem {

Eigen::VectorXd LoadInTime::mean() const {
  Eigen::VectorXd f = constant;
  for (const auto& load : periodic) f += load.force;
  return f;
}

Eigen::VectorXd LoadInTime::at(double time) const {
  Eigen::VectorXd f = constant;
  for (const auto& [force, oscillation] : periodic)
    f += (1 + oscillation.amplitude * std::sin(2 * M_PI * time / oscillation.period)) * force;
  return f;
}

long n_steps(const Analysis& analysis) {
  return std::lround(analysis.duration / analysis.time_step);
}

AnalysisReport march(const System& system, const Analysis& analysis, State& state,
                     const StepCallback& on_step, const std::function<void(double)>& set_load) {
  AnalysisReport report;
  const Stopwatch preparing;
  TimeStepper stepper(system, analysis.time_step, analysis.integrator);
  report.seconds = preparing.seconds();
  Eigen::VectorXd before, acceleration;
  const long last = n_steps(analysis);
  const double share = analysis.integrator == Integrator::implicit_midpoint ? 0.5 : 1;
  while (state.step < last) {
    before = state.v;
    if (set_load) set_load((double(state.step) + share) * analysis.time_step);
    const Stopwatch watch;
    const StepReport step = stepper.step(state);
    report.seconds += watch.seconds();
    report.iterations += step.iterations;
    report.residual = std::max(report.residual, step.residual);
    report.status = step.status;
    if (step.status != Status::converged) break;
    ++report.n_steps;
    state.time = double(state.step) * analysis.time_step;  // not a sum of rounded steps
    report.n_retried += step.n_substeps > 1;
    acceleration = (state.v - before) / analysis.time_step;
    on_step(state, {acceleration, step.iterations, step.residual, step.n_substeps});
  }
  report.counters = stepper.counters();
  report.condition_estimate = stepper.condition_estimate();
  return report;
}

AnalysisReport equilibrium(const System& system, const Analysis& analysis,
                           const Eigen::VectorXd& target, State& state, const PinPath& path) {
  StaticOptions options;
  options.target = target;
  options.path = path;
  options.n_load_steps = analysis.load_steps;
  options.max_iterations = analysis.max_iterations;
  options.tolerance = analysis.tolerance;
  const Stopwatch watch;
  const StaticReport solved = solve_static(system, state, options);
  AnalysisReport report;
  report.status = solved.status;
  report.n_steps = solved.n_load_steps;
  report.n_retried = solved.n_halvings;
  report.iterations = solved.iterations;
  report.residual = solved.residual;
  report.condition_estimate = solved.condition_estimate;
  report.counters = solved.counters;
  report.seconds = watch.seconds();
  return report;
}

}  // namespace sem
