// The cantilever released from rest: the tip against the truth, and the error against the time
// step.
#include <cmath>

#include "figures/figure.h"
#include "figures/scene_model.h"
#include "sem/scene/analysis.h"

namespace sem::figures {
namespace {

// u_y of (4, 0.5) at 0.3 s, density 400: independent finite element solution (E_log, plane strain).
// Before the wave from the clamp arrives at 0.218 s the tip falls freely.
constexpr double duration = 0.3, truth = -0.45050, wave_arrives = 0.218, gravity = 10;
constexpr int n_integrators = 3, n_shown = 6;
const char* const names[] = {"linearly implicit Euler", "implicit Euler", "implicit midpoint"};

SceneModel beam(const std::string& origins) {
  return SceneModel("cantilever",
                    {"solids[0].material.density=400", "solids[0].shape.parts=[8,1,8,1]",
                     "method.weights.cutoff=0.56", "method.origins=\"" + origins + "\""});
}

struct Flight {
  std::vector<double> tip;  // u_y after 0, 1, ... n steps
  Points<2> end;            // all quadrature points at the end
};

Flight fly(const SceneModel& body, Integrator integrator, int n) {
  const auto& d = body.model->discretization;
  const auto tip = map_at<2>(d, Vec<2>(4, 0.5), false);
  Analysis analysis;
  analysis.integrator = integrator;
  analysis.time_step = duration / n;
  analysis.duration = duration;
  State state = body.model->initial;
  Flight flight{{0}, {}};
  march(body.model->system, analysis, state, [&](const State& now, const StepInfo&) {
    flight.tip.push_back(evaluate(tip, now.z)(1, 0) - 0.5);
  });
  flight.end = evaluate(d.interior, state.z);
  return flight;
}

void add_run(DataTable& table, int body, int integrator, const Flight& flight) {
  const int n = int(flight.tip.size()) - 1;
  for (int k = 0; k <= n; ++k)
    table.add({double(body), double(integrator), duration * k / n, flight.tip[k]});
}

// Bodies: 0 shared origins, 1 one origin. Runs of integrator 3 have small steps of the midpoint
// rule.
Data compute() {
  Data data;
  const SceneModel shared = beam("shared_parts"), one = beam("one");
  DataTable errors({"integrator", "time_step", "tip_error", "change_to_fine"});
  auto& runs = data.add("runs", {"body", "integrator", "time", "uy"});
  const Flight fine = fly(shared, Integrator::implicit_midpoint, 240);
  add_run(runs, 0, n_integrators, fine);
  add_run(runs, 1, n_integrators, fly(one, Integrator::implicit_midpoint, 60));
  for (int i = 0; i < n_integrators; ++i)
    for (const int n : {3, 6, 12, 24, 48}) {
      const Flight flight = fly(shared, Integrator(i), n);
      if (n == n_shown) add_run(runs, 0, i, flight);
      const double change = (flight.end - fine.end).norm() / std::sqrt(double(fine.end.cols()));
      errors.add({double(i), duration / n, std::abs(flight.tip.back() - truth), change});
    }
  data.add("errors", errors.columns()) = errors;
  return data;
}

// Linearly implicit and implicit Euler nearly coincide: markers of different size.
Series style_of(int i) {
  Series style = series(i, names[i]);
  style.dash = {};
  style.marker_size = i == 0 ? 6 : 3.5;
  return style;
}

void draw_paths(Panel& panel, const Data& data) {
  panel.title = "Tip";
  panel.x = {.label = "time (s)"};
  panel.y = {.label = "displacement (m)"};
  std::vector<Vec<2>> fall;
  for (int k = 0; k <= 50; ++k) {
    const double t = wave_arrives * k / 50;
    fall.push_back({t, -gravity * t * t / 2});
  }
  const Color gray{0.75, 0.75, 0.75};
  panel.curve(fall,
              {.label = "truth: free fall, then the value at 0.3 s", .color = gray, .width = 5});
  panel.curve({Vec<2>(duration, truth)},
              {.color = gray, .width = 0, .marker = MarkerShape::circle, .marker_size = 10});
  const auto run = [&](int body, int integrator, const Series& style) {
    const DataTable path = data["runs"].where("body", body).where("integrator", integrator);
    panel.curve(path["time"], path["uy"], style);
  };
  run(0, n_integrators, {.label = "shared origins, small steps"});
  run(1, n_integrators, {.label = "one origin, small steps", .dash = {4, 2}});
  for (int i = 0; i < n_integrators; ++i) {
    Series style = style_of(i);
    style.label = "";
    style.width = 0;
    run(0, i, style);
  }
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  draw_paths(plot.panel(0, 0), data);
  const char* const columns[] = {"tip_error", "change_to_fine"};
  const char* const titles[] = {"Tip against the truth", "All points against small steps"};
  for (int k = 0; k < 2; ++k) {
    Panel& panel = plot.panel(0, k + 1);
    panel.title = titles[k];
    panel.x = {.label = "time step (s)", .lower = 5e-3, .upper = 0.15, .logarithmic = true};
    panel.y = {.label = k == 0 ? "error at 0.3 s (m)" : "",
               .lower = 5e-5,
               .upper = 0.5,
               .logarithmic = true,
               .tick_labels = k == 0};
    for (int i = 0; i < n_integrators; ++i) {
      const DataTable line = data["errors"].where("integrator", i);
      panel.curve(line["time_step"], line[columns[k]], style_of(i));
    }
    panel.slope(1, 2e-2, 6e-2, 8e-3);
    if (k == 1) panel.slope(2, 2e-2, 6e-2, 1e-4);
  }
}

}  // namespace

Figure release() {
  return {
      "release",
      "Cantilever released from rest: with shared origins the tip falls freely until the wave "
      "from the clamp arrives (0.218 s), as in truth, with one origin it does not; Euler's "
      "rules (markers: steps of 0.05 s) are of order 1, the midpoint rule is far more accurate, "
      "though these steps show its order 2 only unevenly",
      7,
      2.8,
      compute,
      draw};
}

}  // namespace sem::figures
