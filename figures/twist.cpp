// A beam of 22 parts twisted by a whole turn in both formulations: its shape and stress, torque and energy.
#include <algorithm>
#include <cmath>

#include "figures/solid_states.h"
#include "sem/base/error.h"

namespace sem::figures {
namespace {

constexpr int n_steps = 16, n_shown = 4;  // of 22.5 degrees; quarters of a turn

struct Variant {
  std::string name, title;
  std::vector<std::string> overrides;
};
const std::vector<Variant> variants = {
    {"paper", "the paper's formulation", {}},
    {"condensed",
     "condensed",
     {"method.formulation=condensed", "method.weights.distance=sided", "method.weights.cutoff=1.5",
      "method.quadrature.weight_tolerance=0.01"}}};

// Of the pin that turns, which leads the body along beam.model->path by 2 pi, N m: the power of its forces per
// angular velocity.
double torque(const SolidModel& beam, const State& state, double share) {
  constexpr double step = 1e-4;
  const Eigen::VectorXd way = (beam.model->path(share + step) - beam.model->path(share - step)) / (2 * step);
  return reaction(beam.model->system, state.z).dot(way) / (2 * M_PI);
}

void add_variant(const Variant& variant, Data& data) {
  SolidModel beam("twist", variant.overrides);
  beam.scene.analysis.load_steps = 1;
  if (!data.has("beam surfaces")) add_body(data, "beam", *beam.model);
  DataTable curve({"degrees", "torque", "energy"});
  State state = beam.model->initial;
  add_state(data, variant.name + "0", *beam.model, state);
  curve.add({0, torque(beam, state, 0), beam.model->energy->energy(state.z)});
  for (int step = 1; step <= n_steps; ++step) {
    // From one angle to the next as the scene's pin turns.
    const PinPath part = [&](double s) { return beam.model->path((step - 1 + s) / n_steps); };
    if (equilibrium(beam.model->system, beam.scene.analysis, part(1), state, part).status !=
        Status::converged)
      throw InputError("twist", "analysis", "no equilibrium", "one at every angle");
    curve.add({360.0 * step / n_steps, torque(beam, state, double(step) / n_steps),
               beam.model->energy->energy(state.z)});
    if (step * n_shown % n_steps == 0)
      add_state(data, variant.name + std::to_string(step * n_shown / n_steps), *beam.model, state);
  }
  data.add(variant.name + " curve", curve.columns()) = curve;
}

// Saint-Venant's torque per angle of a bar of square section whose ends are free to warp, N m.
double torsion_stiffness(const Scene<3>& scene) {
  const Material& material = scene.solids[0].material;
  const double width = 1, length = 5, G = material.youngs_modulus / (2 * (1 + material.poisson_ratio));
  double series = 0;
  for (int n = 1; n < 100; n += 2) series += std::tanh(n * M_PI / 2) / std::pow(n, 5);
  return G * std::pow(width, 4) * (1. / 3 - 64 / std::pow(M_PI, 5) * series) / length;
}

Data compute() {
  Data data;
  data.add("torsion", {"saint_venant"}).add({torsion_stiffness(SolidModel("twist").scene)});
  for (const auto& variant : variants) add_variant(variant, data);
  return data;
}

render::RenderScene scene_of(const Data& data, const std::string& state, const ColorScale& scale, double point) {
  auto scene = stressed(solid_state_of(data, "beam", state), scale, point);
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
  for (const auto& variant : variants) {
    plot.row_titles.push_back(variant.title);
    for (int k = 0; k <= n_shown; ++k)
      largest = std::max(largest, solid_state_of(data, "beam", variant.name + std::to_string(k)).largest);
  }
  const ColorScale scale{0, largest / 1e6}, in_pascal{0, largest};
  const Box<3> box = box_of(data, variants[0].name + "0");  // corners of twisted parts stay within
  for (int row = 0; row < int(variants.size()); ++row)
    for (int k = 0; k <= n_shown; ++k) {
      Panel& panel = plot.panel(row, k);
      panel.title = number_text(360.0 * k / n_shown) + "°";
      const std::string state = variants[row].name + std::to_string(k);
      draw_view(panel,
                {[data, state, in_pascal](double point) { return scene_of(data, state, in_pascal, point); },
                 render::corners(box),
                 {.from = {0.3, -1, 0.35}, .up = {1, 0, 0}},
                 {},
                 true});
      if (k == n_shown) panel.color_bar(scale, "von Mises stress (MPa)");
    }
  Panel &moment = plot.panel(0, n_shown + 1), &energy = plot.panel(1, n_shown + 1);
  moment.x = energy.x = {.label = "", .lower = 0, .upper = 360};
  for (int k = 0; k <= n_shown; ++k)
    for (Panel* panel : {&moment, &energy})
      panel->x.ticks.push_back({360.0 * k / n_shown, number_text(360.0 * k / n_shown)});
  energy.x.label = "angle (degrees)";
  moment.y = {.label = "torque (kN m)", .lower = 0};
  energy.y = {.label = "energy (kJ)", .lower = 0};
  energy.legend = LegendPlace::below;
  Series line = {.label = "Saint-Venant, small angles", .color = {0.5, 0.5, 0.5}, .width = 0.8};
  const double angle = 0.75 * 2 * M_PI;
  moment.curve({0, 270}, {0, data["torsion"].value("saint_venant") * angle / 1e3}, line);
  for (int v = 0; v < int(variants.size()); ++v) {
    const DataTable& curve = data[variants[v].name + " curve"];
    Series style = series(v);
    moment.curve(curve["degrees"], in_units(curve["torque"], 1e3), style);
    style.label = variants[v].title;
    energy.curve(curve["degrees"], in_units(curve["energy"], 1e3), style);
  }
}

}  // namespace

Figure twist() {
  Figure figure{"twist",
                "A beam of 22 parts, one end held, the other turned through a whole turn in steps "
                "of 22.5 degrees, in both formulations (degree 2): shape and stress, torque of the turning pin and "
                "elastic energy. In the paper's the parts come apart and their corners fold; the condensed one starts 1.5 % above "
                "Saint-Venant's torque (its ends cannot warp)",
                7,
                5.8,
                compute,
                draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
