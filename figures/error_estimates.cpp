// How far a run's own error estimate is from its error: condensed scenes with known answers.
#include <cmath>

#include "figures/figure.h"
#include "figures/scene_model.h"
#include "sem/scene/estimate.h"

namespace sem::figures {
namespace {

struct Body {
  std::string title, scene;
  std::vector<std::string> always;              // overrides
  std::vector<std::vector<std::string>> loads;  // each with...
  std::vector<std::string> parts;               // ... each of these, ...
  std::vector<double> cutoffs;                  // m; all cover the solid
  int lowest_degree;                            // ... and degrees from this to 4
  std::vector<double> truths;                   // of frequencies, or of the probe at each load; empty: the scene's own
};

const std::vector<Body>& bodies() {
  static const std::vector<Body> all = {
      // Independent graded finite elements of high degree, E_log; at densities 1, 10 and 40.
      {"cantilever",
       "cantilever_condensed",
       {},
       {{"solids[0].material.density=1", "probes[0].truth=[-1.774756e-4,-0.03703440]"},
        {"solids[0].material.density=10", "probes[0].truth=[-0.01760132,-0.3684452]"},
        {"solids[0].material.density=40", "probes[0].truth=[-0.25118,-1.37317]"}},
       {"[2,1,2,1]", "[4,1,4,1]"},
       {0.75, 1.5},
       2,
       {}},
      {"Cook's membrane",
       "cook",
       {},
       {{"solids[0].material.poisson_ratio=0.3", "probes[0].truth=[-1.438027,1.840498]"},
        {"solids[0].material.poisson_ratio=0.4999", "probes[0].truth=[-1.17473,1.56823]"}},
       {"[2,2,2,2]", "[4,4,4,4]"},
       {30},
       2,
       {}},
      {"U with a gap",
       "u_gap",
       {"method.formulation=condensed", "method.weights.distance=sided", "method.quadrature.method=resolved"},
       {{}},
       {"[2,3,1,2,1,2,1,3]", "[4,6,2,4,1,4,2,6]"},
       {0.8, 1.05},
       2,
       {}},
      // Lame's closed form.
      {"ring",
       "annulus",
       {"method.formulation=condensed", "method.weights.distance=sided", "method.quadrature.method=resolved"},
       {{}},
       {"8", "16"},
       {0.75, 1.5},
       3,
       {}},
      {"frequencies",
       "cantilever_modes",
       {"method.formulation=condensed", "method.weights.distance=sided", "method.quadrature.method=resolved"},
       {{}},
       {"[2,1,2,1]", "[4,1,4,1]"},
       {0.75},
       2,
       {0.6359577, 3.194055, 4.137009, 7.297032, 11.734567, 12.288746}}};
  return all;
}

// Adds a row for every frequency, or for the displacement of every probe with a truth.
void add_estimates(const Body& body, int number, int degree, double cutoff, const SceneModel& model, DataTable& table) {
  const ErrorEstimate estimate = estimate_error(model.scene, body.scene);
  const auto add = [&](double error, double estimated, double truth) {
    table.add({double(number), double(degree), double(model.scene.solids[0].parts.size()), cutoff, error / truth, estimated / truth});
  };
  for (size_t m = 0; m < body.truths.size(); ++m)
    add(std::abs(estimate.value[m] - body.truths[m]), estimate.estimate[m], body.truths[m]);
  for (const auto& probe : model.scene.probes) {
    if (!probe.truth) continue;
    Vec<2> error = Vec<2>::Zero(), estimated = error;
    for (size_t c = 0; c < estimate.columns.size(); ++c)
      for (int a = 0; a < 2; ++a)
        if (estimate.columns[c] == probe.name + (a == 0 ? "_x_m" : "_y_m")) {
          error[a] = estimate.value[c] - (*probe.truth)[a];
          estimated[a] = estimate.estimate[c];
        }
    add(error.norm(), estimated.norm(), probe.truth->norm());
  }
}

Data compute() {
  Data data;
  auto& table = data.add("estimates", {"body", "degree", "parts", "cutoff", "error", "estimate"});
  for (size_t b = 0; b < bodies().size(); ++b) {
    const Body& body = bodies()[b];
    for (const auto& load : body.loads)
      for (const auto& parts : body.parts)
        for (int degree = body.lowest_degree; degree <= 4; ++degree)
          for (const double cutoff : body.cutoffs) {
            std::vector<std::string> overrides = body.always;
            overrides.insert(overrides.end(), load.begin(), load.end());
            const std::string field = body.scene == "annulus" ? "arcs" : "parts";
            overrides.push_back("solids[0].shape." + field + "=" + parts);
            overrides.push_back("method.degree=" + std::to_string(degree));
            overrides.push_back("method.weights.cutoff=" + std::to_string(cutoff));
            add_estimates(body, int(b), degree, cutoff, SceneModel(body.scene, overrides), table);
          }
  }
  return data;
}

void draw(Plot& plot, const Data& data) {
  Panel& panel = plot.panel(0, 0);
  constexpr double lower = 5e-7, upper = 1;
  panel.x = {.label = "true error, relative", .lower = lower, .upper = upper, .logarithmic = true};
  panel.y = {.label = "estimated error, relative", .lower = lower, .upper = upper, .logarithmic = true};
  for (const double ratio : {0.2, 1.0, 5.0}) {
    const Series line{.label = ratio == 1 ? "equal" : ratio == 5 ? "factor 5" : "",
                      .color = colors::gray,
                      .width = 0.8,
                      .dash = ratio == 1 ? std::vector<double>{} : std::vector<double>{4, 2}};
    panel.curve({lower, upper}, {ratio * lower, ratio * upper}, line);
  }
  for (size_t b = 0; b < bodies().size(); ++b) {
    const DataTable rows = data["estimates"].where("body", double(b));
    Series style = series(int(b), bodies()[b].title);
    style.width = 0;
    panel.curve(rows["error"], rows["estimate"], style);
  }
}

}  // namespace

Figure error_estimates() {
  return {"error_estimates",
          "A run's estimate of its error against the error, for condensed scenes with known answers",
          3.3,
          3.1,
          compute,
          draw,
          {},
          true};
}

}  // namespace sem::figures
