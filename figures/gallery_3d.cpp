// All scenes in space, deformed, coloured by stress.
#include <algorithm>
#include <cmath>
#include <limits>

#include "figures/solid_states.h"
#include "sem/base/error.h"
#include "sem/picture/scales.h"

namespace sem::figures {
namespace {

struct Shown {
  const char* scene;
  double time;  // s, of a dynamic scene
};
const Shown scenes[] = {{"cube", 0.4},      {"torus", 0.4},    {"tyre", 0.13},
                        {"rocket", 0.3},    {"beam", 0.8},     {"twist", 0},
                        {"animal", 0.5},    {"castle", 0.34},  {"mug", 0},
                        {"mug_trimmed", 0}, {"mug_free", 0.1}, {"beam_condensed", 0}};
constexpr int n_columns = 4;

State shown_state(SolidModel& solid, double time) {
  if (solid.scene.analysis.kind == AnalysisKind::dynamics) return solid.after(time);
  const auto state = solid.equilibrium();
  if (!state) throw InputError(solid.scene.name, "analysis", "no equilibrium", "one");
  return *state;
}

Data compute() {
  Data data;
  auto times = DataTable({"time"});
  for (const auto& shown : scenes) {
    SolidModel solid(shown.scene, {"probes=[]"});
    const State state = shown_state(solid, shown.time);
    times.add({state.time});
    add_body(data, shown.scene, *solid.model, solid.scene.solids);
    add_state(data, std::string(shown.scene) + " deformed", *solid.model, state);
  }
  data.add("times", times.columns()) = times;
  return data;
}

std::string stress_text(double pascal) {
  return pascal >= 1e6 ? number_text(pascal / 1e6, 2) + " MPa"
                       : number_text(pascal / 1e3, 2) + " kPa";
}

void draw_scene(Panel& panel, const Data& data, int number) {
  const std::string name = scenes[number].scene, state = name + " deformed";
  const double largest = round_up(solid_state_of(data, name, state).largest);
  const double time = data["times"]["time"][number];
  panel.title = name;
  panel.lines_below = {(time > 0 ? "t = " + number_text(time, 2) + " s, " : "static, ") + "to " +
                       stress_text(largest)};
  const ColorScale scale{0, largest};
  const SolidState deformed = solid_state_of(data, name, state);
  const auto rest = surfaces_of(data, name + " ");
  auto seen = seen_points(deformed.parts, deformed.trims);
  double ground = std::numeric_limits<double>::infinity();
  for (const auto& X : seen) ground = std::min(ground, X[2]);
  for (const auto& X : seen_points(rest, deformed.trims)) seen.push_back(X);
  const auto scene = [deformed, rest, scale, ground](double point) {
    auto result = stressed(deformed, scale, point);
    result.lines.push_back(rest_lines(rest, deformed.parts, 0.4 * point, deformed.trims));
    result.ground = ground;
    return result;
  };
  draw_view(panel, {scene, seen, {.from = {0.5, -1, 0.42}}, {}, true});
}

void draw(Plot& plot, const Data& data) {
  for (int number = 0; number < int(std::size(scenes)); ++number)
    draw_scene(plot.panel(number / n_columns, number % n_columns), data, number);
  plot.color_bar({0, 1}, "von Mises stress (of the scale's end)");
}

}  // namespace

Figure gallery_3d() {
  Figure figure{"gallery_3d",
                "The scenes of sem3d, deformed; gray lines: at rest, of what moved. Colours are the von Mises "
                "stress, each scene's scale ending where the text below says",
                7,
                5.8,
                compute,
                draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
