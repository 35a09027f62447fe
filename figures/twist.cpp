// A beam of 22 parts twisted by a whole turn: its shape and stress, torque and energy.
#include <algorithm>
#include <cmath>

#include "figures/solid_states.h"
#include "sem/base/error.h"

namespace sem::figures {
namespace {

constexpr int n_steps = 16, n_shown = 4;  // of 22.5 degrees; quarters of a turn
constexpr int turning = 1;                // the pin that turns

// Moment of the turning pin's forces about the beam's axis, N m.
double torque(const SolidModel& beam, const State& state) {
  const Eigen::VectorXd force = reaction(beam.model->system, state.z);
  const Vec<3>& center = beam.scene.pins[turning].center;
  double moment = 0;
  for (const int c : beam.model->held[turning].controls) {
    const Vec<3> arm = state.z.segment<3>(3 * c) - center, f = force.segment<3>(3 * c);
    moment += arm.cross(f)[0];
  }
  return moment;
}

Data compute() {
  SolidModel beam("twist");
  beam.scene.analysis.load_steps = 1;
  Data data;
  add_body(data, "beam", *beam.model);
  DataTable curve({"degrees", "torque", "energy"});
  State state = beam.model->initial;
  add_state(data, "0", *beam.model, state);
  curve.add({0, torque(beam, state), beam.model->energy->energy(state.z)});
  for (int step = 1; step <= n_steps; ++step) {
    // From one angle to the next as the scene's pin turns.
    const PinPath part = [&](double s) { return beam.model->path((step - 1 + s) / n_steps); };
    if (equilibrium(beam.model->system, beam.scene.analysis, part(1), state, part).status !=
        Status::converged)
      throw InputError("twist", "analysis", "no equilibrium", "one at every angle");
    curve.add({360.0 * step / n_steps, torque(beam, state), beam.model->energy->energy(state.z)});
    if (step * n_shown % n_steps == 0)
      add_state(data, std::to_string(step * n_shown / n_steps), *beam.model, state);
  }
  data.add("curve", curve.columns()) = curve;
  return data;
}

render::RenderScene scene_of(const Data& data, int shown, const ColorScale& scale, double point) {
  auto scene = stressed(solid_state_of(data, "beam", std::to_string(shown)), scale, point);
  scene.up = Vec<3>(1, 0, 0);  // it stands on the end that is held
  return scene;
}

std::vector<double> in_units(std::vector<double> values, double unit) {
  for (double& value : values) value /= unit;
  return values;
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.column_shares = {1, 1, 1, 1, 1, 1.9};
  double largest = 0;
  for (int k = 0; k <= n_shown; ++k)
    largest = std::max(largest, solid_state_of(data, "beam", std::to_string(k)).largest);
  const ColorScale scale{0, largest / 1e6}, in_pascal{0, largest};
  const Box<3> box = box_of(data, "0");  // corners of twisted parts stay within
  for (int k = 0; k <= n_shown; ++k) {
    Panel& panel = plot.panel(0, k, 2, 1);
    panel.title = number_text(360.0 * k / n_shown) + "°";
    draw_view(panel,
              {[data, k, in_pascal](double point) { return scene_of(data, k, in_pascal, point); },
               render::corners(box),
               {.from = {0.3, -1, 0.35}, .up = {1, 0, 0}},
               {},
               true});
    if (k == n_shown) panel.color_bar(scale, "von Mises stress (MPa)");
  }
  const DataTable& curve = data["curve"];
  Panel &moment = plot.panel(0, n_shown + 1), &energy = plot.panel(1, n_shown + 1);
  moment.x = energy.x = {.label = "", .lower = 0, .upper = 360};
  for (int k = 0; k <= n_shown; ++k)
    for (Panel* panel : {&moment, &energy})
      panel->x.ticks.push_back(
          {360.0 * k / n_shown, panel == &energy ? number_text(360.0 * k / n_shown) : ""});
  energy.x.label = "angle (degrees)";
  moment.y = {.label = "torque (kN m)", .lower = 0};
  energy.y = {.label = "energy (kJ)", .lower = 0};
  moment.curve(curve["degrees"], in_units(curve["torque"], 1e3), series(0));
  energy.curve(curve["degrees"], in_units(curve["energy"], 1e3), series(1));
}

}  // namespace

Figure twist() {
  Figure figure{"twist",
                "A beam of 22 parts, one end held, the other turned through a whole turn in steps "
                "of 22.5 degrees: shape and stress, torque at the turned end and elastic energy "
                "(the paper's formulation, one origin)",
                7,
                3.2,
                compute,
                draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
