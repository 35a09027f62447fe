// Tip deflection of the cantilever against the number of parts, by the paper's formulation and with
// the gradient of the map itself.
#include "figures/figure.h"
#include "figures/scene_model.h"

namespace sem::figures {
namespace {

// Density 1: u_y of (4, 0.5) by an independent graded finite element solution, plane strain, E_log.
// At this load E_log and linear elasticity differ by 1e-4 of it.
constexpr double truth = -0.03703440;
const int part_counts[] = {1, 2, 4, 8, 16};
const double cutoffs[] = {0.51, 0.75, 1.01, 1.5};

struct Formulation {
  const char *title, *origins;
  bool exact_gradient;
};
const Formulation formulations[] = {{"draft: one origin", "one", false},
                                    {"published: shared origins", "shared_parts", false},
                                    {"shared origins, ∇w kept in F", "shared_parts", true}};

double tip(const Formulation& formulation, double cutoff, int m) {
  const std::string n = std::to_string(m);
  const SceneModel beam(
      "cantilever",
      {"solids[0].shape.parts=[" + n + ",1," + n + ",1]", "solids[0].material.density=1",
       "solids[0].material.model=\"linear\"", "analysis.load_steps=1", "method.quadrature.rays=80",
       "method.origins=\"" + std::string(formulation.origins) + "\"",
       "method.weights.cutoff=" + std::to_string(cutoff)});
  if (formulation.exact_gradient) use_exact_gradient(*beam.model);
  return beam.displacement(beam.equilibrium().value(), {4, 0.5})[1];
}

Data compute() {
  Data data;
  auto& table = data.add("deflection", {"formulation", "cutoff", "parts", "tip_uy"});
  for (int f = 0; f < 3; ++f)
    for (const double cutoff : cutoffs)
      for (const int m : part_counts)
        table.add({double(f), cutoff, double(m), tip(formulations[f], cutoff, m)});
  return data;
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  for (int f = 0; f < 3; ++f) {
    Panel& panel = plot.panel(0, f);
    panel.title = formulations[f].title;
    panel.x = {.label = "parts along the beam", .lower = 0.8, .upper = 20, .logarithmic = true};
    for (const int m : part_counts) panel.x.ticks.push_back({double(m), std::to_string(m)});
    panel.y = {.label = f == 0 ? "tip deflection (% of the truth)" : "",
               .lower = 10,
               .upper = 10000,
               .logarithmic = true,
               .tick_labels = f == 0};
    panel.horizontal(100, "truth");
    for (int k = 0; k < 4; ++k) {
      const DataTable line = data["deflection"].where("formulation", f).where("cutoff", cutoffs[k]);
      std::vector<double> percent;
      for (const double uy : line["tip_uy"]) percent.push_back(100 * uy / truth);
      panel.curve(line["parts"], percent, series(k, "cutoff " + number_text(cutoffs[k]) + " m"));
    }
  }
}

}  // namespace

Figure deflection_parts() {
  return {
      "deflection_parts",
      "Tip deflection of a 4 x 1 cantilever against the number of parts: the paper's formulation "
      "becomes ever softer and converges at no cutoff; with the gradient of the map itself it "
      "is too stiff throughout",
      7,
      2.8,
      compute,
      draw};
}

}  // namespace sem::figures
