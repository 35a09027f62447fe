// The condensed formulation converges: the cantilever's tip against the number of parts, the degree and
// the cutoff.
#include "figures/figure.h"
#include "figures/scene_model.h"

namespace sem::figures {
namespace {

// u_y of (4, 0.5) at density 10 by an independent graded finite element solution, E_log.
constexpr double truth = -0.3684452;
const int part_counts[] = {1, 2, 4, 8};
const double cutoffs[] = {0.55, 0.65, 0.75, 1, 1.25, 1.5, 1.75, 2};

struct Outcome {
  double tip, unknowns;
};

Outcome solve(int degree, int m, double cutoff) {
  const std::string n = std::to_string(m);
  const SceneModel beam("cantilever_condensed",
                        {"solids[0].shape.parts=[" + n + ",1," + n + ",1]",
                         "method.degree=" + std::to_string(degree),
                         "method.weights.cutoff=" + std::to_string(cutoff)});
  return {beam.displacement(beam.equilibrium().value(), {4, 0.5})[1], double(beam.model->n_unknowns())};
}

Data compute() {
  Data data;
  auto& parts = data.add("parts", {"degree", "parts", "unknowns", "tip_uy"});
  for (int degree = 1; degree <= 4; ++degree)
    for (const int m : part_counts) {
      const Outcome outcome = solve(degree, m, 0.75);
      parts.add({double(degree), double(m), outcome.unknowns, outcome.tip});
    }
  auto& reach = data.add("cutoff", {"degree", "cutoff", "tip_uy"});
  for (int degree = 1; degree <= 4; ++degree)
    for (const double cutoff : cutoffs) reach.add({double(degree), cutoff, solve(degree, 4, cutoff).tip});
  return data;
}

std::vector<double> error_percent(const DataTable& table) {
  std::vector<double> error;
  for (const double uy : table["tip_uy"]) error.push_back(100 * std::abs(uy / truth - 1));
  return error;
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  Panel& refinement = plot.panel(0, 0);
  refinement.title = "parts are split";
  refinement.x = {.label = "unknowns", .lower = 50, .upper = 1000, .logarithmic = true};
  refinement.y = {.label = "error of the tip (%)", .lower = 1e-5, .upper = 100, .logarithmic = true};
  Panel& reach = plot.panel(0, 1);
  reach.title = "4 parts along, any cutoff";
  reach.x = {.label = "cutoff (m)", .lower = 0.4, .upper = 2.1};
  reach.y = {.label = "", .lower = 1e-5, .upper = 100, .logarithmic = true, .tick_labels = false};
  for (int degree = 1; degree <= 4; ++degree) {
    const Series style = series(degree - 1, "degree " + std::to_string(degree));
    const DataTable line = data["parts"].where("degree", degree);
    refinement.curve(line["unknowns"], error_percent(line), style);
    const DataTable across = data["cutoff"].where("degree", degree);
    reach.curve(across["cutoff"], error_percent(across), style);
  }
}

}  // namespace

Figure condensed_convergence() {
  return {"condensed_convergence",
          "Condensed formulation, the same cantilever: the error of the tip falls with parts and degree; "
          "from degree 3 on it stays below 0.1 % for every cutoff that covers the solid (0.5 m)",
          7,
          2.8,
          compute,
          draw};
}

}  // namespace sem::figures
