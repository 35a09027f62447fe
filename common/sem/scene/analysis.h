#pragma once
// The three analyses of a scene on its system. No dimension, no files.

#include <functional>
#include <string>

#include "sem/scene/scene.h"
#include "sem/solve/newton.h"
#include "sem/solve/statics.h"
#include "sem/solve/system.h"

namespace sem {

/// f(t) = constant + sum_k (1 + amplitude_k sin(2 pi t / period_k)) force_k, N.
struct LoadInTime {
  struct Periodic {
    Eigen::VectorXd force;
    Oscillation oscillation;
  };
  Eigen::VectorXd constant;
  std::vector<Periodic> periodic;

  Eigen::VectorXd mean() const;  ///< without amplitudes
  Eigen::VectorXd at(double time) const;
};

/// How an analysis went.
struct AnalysisReport {
  Status status = Status::converged;
  long n_steps = 0;         ///< steps (dynamics) or load steps (statics) done
  long n_retried = 0;       ///< of these, steps that needed substeps or halving
  long iterations = 0;
  double residual = 0;      ///< the worst
  double condition_estimate = 0;
  Counters counters;
  double seconds = 0;       ///< in the solver alone
};

/// What happened in a step.
struct StepInfo {
  const Eigen::VectorXd& acceleration;  ///< (v1 - v0) / dt, n; empty in statics
  int iterations;
  double residual;
  int n_substeps;
};
using StepCallback = std::function<void(const State&, const StepInfo&)>;

/// Number of steps of a dynamic analysis.
long n_steps(const Analysis& analysis);

/// Integrates from state.step to the end, calling back after every step. Stops
/// with the status and the last good state if a step fails for good. `set_load`, if any, is called before
/// every step with the time, s, at which its forces act (its end, or its middle): it may change system.load.
AnalysisReport march(const System& system, const Analysis& analysis, State& state,
                     const StepCallback& on_step, const std::function<void(double)>& set_load = {});

/// Static equilibrium with the pins led to `target`, straight or along `path` (statics.h).
AnalysisReport equilibrium(const System& system, const Analysis& analysis,
                           const Eigen::VectorXd& target, State& state, const PinPath& path = {});

}  // namespace sem
