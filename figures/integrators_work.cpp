// What accuracy in time costs: the error of each integrator against its processor time, on a linear
// body whose motion the modes give in closed form, and on a nonlinear one against a fine run.
#include <cmath>

#include "figures/figure.h"
#include "figures/scene_model.h"
#include "sem/base/timing.h"
#include "sem/scene/analysis.h"
#include "sem/solve/modes.h"

namespace sem::figures {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int n_integrators = 3, n_bodies = 2;
const char* const names[] = {"linearly implicit Euler", "implicit Euler", "implicit midpoint"};
const char* const titles[] = {"linear, against its modes", "nonlinear, against a fine run"};
constexpr double duration = 0.5, coarsest = 0.05;  // s
constexpr int n_halvings = 8;                      // of the coarsest step
const Vec<2> tip(4, 0.5);

// The cantilever let go from rest under its weight: with 400 kg/m^3 its tip is at -1.3 m after half
// a second.
std::vector<std::string> overrides(bool linear) {
  return {std::string("solids[0].material.model=\"") + (linear ? "linear" : "neo_log") + "\"",
          "solids[0].material.density=400", "method.degree=2", "method.threads=1",
          "analysis={\"type\":\"dynamic\"}"};
}

struct Run {
  double uy, seconds;  // of the tip, m; processor time of all steps
};

Run run(const SceneModel& beam, Integrator integrator, double step) {
  Analysis analysis;
  analysis.integrator = integrator;
  analysis.time_step = step;
  analysis.duration = duration;
  State state = beam.model->initial;
  const double start = thread_seconds();
  const auto report =
      march(beam.model->system, analysis, state, [](const State&, const StepInfo&) {});
  const double seconds = thread_seconds() - start;
  return {report.status == Status::converged ? beam.displacement(state, tip)[1] : NAN, seconds};
}

// z(t) = z_eq + sum_k cos(omega_k t) phi_k (phi_k . M (z_0 - z_eq)), all modes: of a linear body,
// let go at rest.
double tip_by_modes(const SceneModel& beam) {
  const System& system = beam.model->system;
  const State& start = beam.model->initial;
  const auto rest = beam.equilibrium();
  if (!rest) return NAN;
  const Modes modes = vibration_modes(system, start.z, int(system.free.size()));
  const VectorXd away = start.z - rest->z;
  VectorXd inertia;
  system.mass.multiply(away, inertia);
  State state = *rest;
  for (int k = 0; k < modes.omega.size(); ++k)
    state.z += std::cos(modes.omega[k] * duration) * modes.shapes.col(k).dot(inertia) *
               modes.shapes.col(k);
  return beam.displacement(state, tip)[1];
}

// Implicit midpoint, of order 2, extrapolated from two fine steps.
double tip_by_fine_steps(const SceneModel& beam) {
  const double step = coarsest / (1 << (n_halvings + 2));
  const double coarse = run(beam, Integrator::implicit_midpoint, 2 * step).uy;
  const double fine = run(beam, Integrator::implicit_midpoint, step).uy;
  return fine + (fine - coarse) / 3;
}

Data compute() {
  Data data;
  DataTable truths({"body", "uy"}),
      runs({"body", "integrator", "time_step", "uy", "march_seconds"});
  for (int body = 0; body < n_bodies; ++body) {
    const bool linear = body == 0;
    const SceneModel beam("cantilever_condensed", overrides(linear));
    truths.add({double(body), linear ? tip_by_modes(beam) : tip_by_fine_steps(beam)});
    for (int i = 0; i < n_integrators; ++i)
      for (int k = 0; k <= n_halvings; ++k) {
        const double step = coarsest / (1 << k);
        const Run one = run(beam, Integrator(i), step);
        runs.add({double(body), double(i), step, one.uy, one.seconds});
      }
  }
  data.add("truths", truths.columns()) = truths;
  data.add("runs", runs.columns()) = runs;
  return data;
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  for (int body = 0; body < n_bodies; ++body) {
    const double truth = data["truths"].where("body", body).value("uy", 0);
    for (const int by_time : {0, 1}) {
      Panel& panel = plot.panel(body, by_time);
      panel.title = by_time ? "" : titles[body];
      const bool last = body == n_bodies - 1;
      panel.x = {.label = !last     ? ""
                          : by_time ? "processor time (s)"
                                    : "time step (s)",
                 .lower = by_time ? 1e-3 : 1e-4,
                 .upper = by_time ? 100. : 0.1,
                 .logarithmic = true,
                 .tick_labels = last};
      panel.y = {.label = by_time ? "" : "relative error of the tip",
                 .lower = 1e-8,
                 .upper = 3,
                 .logarithmic = true,
                 .tick_labels = !by_time};
      for (int i = 0; i < n_integrators; ++i) {
        const DataTable line = data["runs"].where("body", body).where("integrator", i);
        std::vector<double> error = line["uy"];
        for (double& u : error) u = std::abs(u / truth - 1);
        panel.curve(line[by_time ? "march_seconds" : "time_step"], error, series(i, names[i]));
      }
    }
  }
}

}  // namespace

Figure integrators_work() {
  Figure figure{
      "integrators_work",
      "A cantilever let go from rest, error of its tip after half a second against time step and "
      "processor "
      "time: both Euler rules are of order 1, implicit midpoint of order 2 and the cheapest at "
      "every error it "
      "was asked for; on a linear body a step is one solution with a matrix factorised once",
      7,
      4.6,
      compute,
      draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
