// The beam's sag against the number of parts: the paper's formulation at three cutoffs, the condensed one at two
// degrees, under the full weight and a thousandth of it; there also with patches along the held face's edges.
#include <algorithm>

#include "figures/figure.h"
#include "figures/solid_model.h"
#include "sem/solve/integrators.h"

namespace sem::figures {
namespace {

// Lowest displacement of the free end, m, E_iso: quadratic finite elements, independent of this
// code. `reference`: what the published code gives, the tip after 20 linearly implicit steps of
// 0.1 s. `published_fem`: what the paper compares with, the lowest point passed in such steps.
struct Load {
  const char* title;
  double gravity, truth;
};
const Load loads[] = {{"a thousandth of the weight", 0.01, -0.009452}, {"full weight", 10, -4.595}};
constexpr double published_fem = -4.1579;
const std::pair<int, double> reference[] = {{6, -1.582},  {10, -2.975}, {14, -3.599}, {18, -3.771},
                                            {22, -3.973}, {26, -4.118}, {30, -4.014}, {42, -4.033}};

const int slices[] = {1, 2, 3, 4, 5, 7, 10};  // 4 k + 2 parts
const double cutoffs[] = {0.501, 0.75, 1.01};
const Vec<3> tip(5, 0.5, 1);
constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> overrides(int k, double gravity, int points_a_slice, double cutoff) {
  return {"solids[0].shape.parts=[" + std::to_string(k) + ",1,1]",
          "gravity=[0,0," + std::to_string(-gravity) + "]", "analysis={\"type\":\"static\"}",
          "method.quadrature.points=" + std::to_string(points_a_slice * k),
          "method.weights.cutoff=" + std::to_string(cutoff)};
}

double sag(const SolidModel& beam) {
  const auto state = beam.equilibrium();
  return state ? beam.displacement(*state, tip)[2] : none;
}

// The tip in the paper's own run, 20 linearly implicit steps of 0.1 s: its lowest place, its last.
std::pair<double, double> sag_in_steps(const SolidModel& beam) {
  const Map<3> map = map_at<3>(beam.model->discretization, tip, false);
  TimeStepper stepper(beam.model->system, 0.1, Integrator::linearly_implicit_euler);
  State state = beam.model->initial;
  double lowest = 0, last = 0;
  for (int step = 0; step < 20; ++step) {
    if (stepper.step(state).status != Status::converged) return {none, none};
    last = evaluate(map, state.z)(2, 0) - tip[2];
    lowest = std::min(lowest, last);
  }
  return {lowest, last};
}

Data compute() {
  Data data;
  auto& condensed = data.add("condensed", {"load", "degree", "parts", "unknowns", "uz"});
  for (int load = 0; load < 2; ++load)
    for (const int degree : {2, 3})
      for (const int k : slices) {
        if (load == 1 && k > 7) continue;  // minutes: some 17 solutions, not two
        auto with = overrides(k, loads[load].gravity, 25, 1.5);
        with.push_back("method.quadrature.rays=" + std::to_string(degree + 5));
        with.push_back("method.degree=" + std::to_string(degree));
        const SolidModel beam("beam_condensed", with);
        condensed.add({double(load), double(degree), 4.0 * k + 2, double(beam.model->n_unknowns()),
                       sag(beam)});
      }
  auto& patched = data.add("patched", {"parts", "unknowns", "uz"});
  for (const int k : slices) {
    const SolidModel beam("beam_condensed",
                          {"solids[0].shape.parts=[" + std::to_string(k) + ",1,1]",
                           "gravity=[0,0," + std::to_string(-loads[0].gravity) + "]", "analysis={\"type\":\"static\"}",
                           "method.quadrature={\"method\":\"resolved\"}", "method.weights.patch_levels=1"});
    patched.add({4.0 * k + 2, double(beam.model->n_unknowns()), sag(beam)});
  }
  auto& projected = data.add(
      "projected", {"load", "cutoff", "parts", "unknowns", "uz", "uz_lowest", "uz_in_steps"});
  for (int load = 0; load < 2; ++load)
    for (const double cutoff : cutoffs)
      for (const int k : slices) {
        const SolidModel beam("beam", overrides(k, loads[load].gravity, 5, cutoff));
        const auto [lowest, last] = sag_in_steps(beam);
        projected.add({double(load), cutoff, 4.0 * k + 2, double(beam.model->n_unknowns()),
                       sag(beam), lowest, last});
      }
  auto& published = data.add("published", {"parts", "uz_in_steps"});
  for (const auto& [parts, uz] : reference) published.add({double(parts), uz});
  return data;
}

std::vector<double> percent(const std::vector<double>& uz, double truth) {
  std::vector<double> share;
  for (const double u : uz) share.push_back(100 * u / truth);
  return share;
}

std::vector<double> error_percent(const std::vector<double>& uz, double truth) {
  std::vector<double> error;
  for (const double u : uz) error.push_back(100 * std::abs(u / truth - 1));
  return error;
}

Axis parts_axis(bool labelled) {
  Axis axis{.label = labelled ? "parts" : "", .lower = 4, .upper = 44};
  for (const int k : slices)
    axis.ticks.push_back({4.0 * k + 2, labelled ? std::to_string(4 * k + 2) : ""});
  return axis;
}

Series condensed_style(int degree) {
  return series(degree - 2, "condensed, n = " + std::to_string(degree));
}

Series patched_style() { return series(2, "condensed, n = 3, patches along the held edges"); }

void draw_shares(Panel& panel, const Data& data, int load) {
  const double truth = loads[load].truth;
  panel.title = loads[load].title;
  panel.x = parts_axis(false);
  panel.y = {.label = load == 0 ? "sag (% of the truth)" : "", .lower = 20, .upper = 160};
  panel.y.tick_labels = load == 0;
  panel.horizontal(100, load == 0 ? "truth" : "");
  for (int c = 0; c < 3; ++c) {
    const DataTable line = data["projected"].where("load", load).where("cutoff", cutoffs[c]);
    panel.curve(line["parts"], percent(line["uz"], truth),
                series(3 + c, "projected, cutoff " + number_text(cutoffs[c]) + " m"));
  }
  if (load == 1) {
    const DataTable& published = data["published"];
    panel.curve(published["parts"], percent(published["uz_in_steps"], truth),
                {.label = "published code, 20 steps of 0.1 s",
                 .color = colors::gray,
                 .width = 0.8,
                 .marker = MarkerShape::cross,
                 .marker_size = 3.5});
    const DataTable own = data["projected"].where("load", 1).where("cutoff", cutoffs[0]);
    panel.curve(own["parts"], percent(own["uz_in_steps"], truth),
                {.label = "projected, cutoff 0.501 m, 20 steps of 0.1 s",
                 .color = colors::gray,
                 .width = 0.8,
                 .dash = {2, 1.5}});
    const double fem = 100 * published_fem / truth;
    panel.curve({4, 44}, {fem, fem},
                {.label = "FEM of the paper, its lowest in such steps",
                 .color = colors::gray,
                 .width = 0.8,
                 .dash = {1, 1.5}});
  }
  const DataTable line = data["condensed"].where("load", load).where("degree", 3);
  panel.curve(line["parts"], percent(line["uz"], truth), condensed_style(3));
}

void draw_errors(Panel& panel, const Data& data, int load) {
  panel.x = parts_axis(true);
  panel.y = {.label = load == 0 ? "error of the sag (%)" : "",
             .lower = 0.05,
             .upper = 20,
             .logarithmic = true,
             .tick_labels = load == 0};
  for (const int degree : {2, 3}) {
    const DataTable line = data["condensed"].where("load", load).where("degree", degree);
    panel.curve(line["parts"], error_percent(line["uz"], loads[load].truth),
                condensed_style(degree));
  }
  if (load == 0)
    panel.curve(data["patched"]["parts"], error_percent(data["patched"]["uz"], loads[load].truth), patched_style());
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.shared_legend = true;
  for (int load = 0; load < 2; ++load) draw_shares(plot.panel(0, load), data, load);
  for (int load = 0; load < 2; ++load) draw_errors(plot.panel(1, load), data, load);
}

}  // namespace

Figure beam_parts_3d() {
  Figure figure{"beam_parts_3d",
                "Sag of the 5 x 1 x 1 beam under a thousandth of its weight and all of it against "
                "the number of parts: the paper's formulation passes through the truth, where "
                "depending on the cutoff; the condensed one comes ever closer to it",
                7,
                4.4,
                compute,
                draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
