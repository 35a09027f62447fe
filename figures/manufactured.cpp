// Weights judged on a smooth manufactured solution without clamps: the error in the energy norm against the
// degree, on a convex and on a non-convex body.
#include "figures/figure.h"
#include "src2d/baseline/manufactured.h"

namespace sem::figures {
namespace {

const int part_counts[] = {1, 2, 4};

ManufacturedError solve(int shape, int m, int degree, DistanceWeight weight) {
  MethodOptions method;
  method.formulation = Formulation::condensed;
  method.weights.variant = weight;
  method.weights.cutoff = 0.75;
  method.projection.degree = degree;
  method.interior_rule.rule = InteriorRule::resolved;
  method.interior_rule.weight_tolerance = weight == DistanceWeight::sided ? 1e-6 : 3e-2;
  return solve_manufactured(baseline::manufactured_body(shape == 0, m), method);
}

Data compute() {
  Data data;
  auto& table = data.add("error", {"shape", "published", "parts", "degree", "unknowns", "points", "energy_error"});
  const auto add = [&](int shape, DistanceWeight weight, int m, int degree) {
    const auto result = solve(shape, m, degree, weight);
    table.add({double(shape), double(weight == DistanceWeight::published), double(m), double(degree),
               double(result.n_unknowns), double(result.n_points), result.energy});
  };
  for (const int shape : {0, 1})
    for (int degree = 1; degree <= 4; ++degree) {
      for (const int m : part_counts) add(shape, DistanceWeight::sided, m, degree);
      add(shape, DistanceWeight::published, 1, degree);
    }
  return data;
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  for (const int shape : {0, 1}) {
    Panel& panel = plot.panel(0, shape);
    panel.title = shape == 0 ? "square" : "L";
    panel.x = {.label = "degree n", .lower = 0.8, .upper = 4.2, .ticks = {{1, "1"}, {2, "2"}, {3, "3"}, {4, "4"}}};
    panel.y = {.label = shape == 0 ? "relative error (energy norm)" : "", .lower = 1e-5, .upper = 1000, .logarithmic = true};
    panel.y.tick_labels = shape == 0;
    const DataTable all = data["error"].where("shape", shape);
    int k = 0;
    for (const int m : part_counts) {
      const DataTable line = all.where("published", 0).where("parts", m);
      panel.curve(line["degree"], line["energy_error"],
                  series(k++, "sided, " + std::to_string(m) + (m == 1 ? " part" : " parts")));
    }
    const DataTable line = all.where("published", 1);
    panel.curve(line["degree"], line["energy_error"], series(k, "published, 1 part"));
  }
}

}  // namespace

Figure manufactured() {
  Figure figure = {"manufactured",
                   "A smooth manufactured solution without clamps: with sided weights the error in the energy norm falls "
                   "with the degree and where parts are split, on a convex and a non-convex body, until it meets that of "
                   "the quadrature (tolerance 1e-6; with 1e-4 at a few 1e-3); with the published weights, which jump "
                   "inside, it exceeds the solution",
                   7,
                   2.8,
                   compute,
                   draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
