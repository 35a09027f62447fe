// What each integrator keeps of a free flight: energy, angular momentum, the centroid's straight
// line.
#include <algorithm>
#include <cmath>

#include "figures/figure.h"
#include "figures/scene_model.h"
#include "sem/scene/analysis.h"
#include "sem/scene/monitor.h"

namespace sem::figures {
namespace {

constexpr int n_integrators = 3;
const char* const names[] = {"linearly implicit Euler", "implicit Euler", "implicit midpoint"};
constexpr double time_step = 0.02, duration = 3;  // s

Data compute() {
  const SceneModel disc("disc");
  const Monitor<2> monitor(disc.scene, *disc.model);
  const auto columns = monitor.columns();
  const auto at = [&](const std::string& name) {
    return std::find(columns.begin(), columns.end(), name) - columns.begin();
  };
  Data data;
  auto& table = data.add(
      "history", {"integrator", "time", "energy", "angular_momentum", "centroid_off_its_line"});
  std::vector<double> start;
  for (int i = 0; i < n_integrators; ++i) {
    const auto record = [&](const State& state) {
      const auto row = monitor.row(state, {}, 0, 0, 1);
      if (start.empty()) start = row;
      const double speed = start[at("momentum_x_kg_m_s")] / disc.model->total_mass();
      const double x = start[at("centroid_x_m")] + speed * state.time,
                   y = start[at("centroid_y_m")];
      table.add({double(i), state.time, row[at("total_J")], row[at("angular_momentum_z_kg_m2_s")],
                 std::hypot(row[at("centroid_x_m")] - x, row[at("centroid_y_m")] - y)});
    };
    State state = disc.model->initial;
    record(state);
    Analysis analysis;
    analysis.integrator = Integrator(i);
    analysis.time_step = time_step;
    analysis.duration = duration;
    march(disc.model->system, analysis, state,
          [&](const State& now, const StepInfo&) { record(now); });
  }
  return data;
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  const char* const labels[] = {"total energy / initial", "angular momentum / initial",
                                "centroid off its line (m)"};
  const char* const columns[] = {"energy", "angular_momentum", "centroid_off_its_line"};
  for (int column = 0; column < 3; ++column) {
    Panel& panel = plot.panel(0, column);
    panel.x = {.label = "time (s)"};
    panel.y = {.label = labels[column]};
    if (column == 2) {
      panel.y.logarithmic = true;
      panel.y.lower = 1e-18;
      panel.y.upper = 1e-10;
    }
    for (int i = 0; i < n_integrators; ++i) {
      const DataTable run = data["history"].where("integrator", i);
      std::vector<double> values = run[columns[column]];
      if (column < 2)
        for (double& value : values) value /= run[columns[column]][0];
      Series style = series(i, names[i]);
      style.marker.reset();
      panel.curve(run["time"], values, style);
    }
  }
}

}  // namespace

Figure integrators() {
  return {"integrators",
          "A spinning disc in free flight: both Euler rules damp energy and angular momentum, "
          "implicit midpoint keeps them; the centroid stays on its line to rounding for all",
          7,
          2.6,
          compute,
          draw,
          {"centroid_off_its_line"}};
}

}  // namespace sem::figures
