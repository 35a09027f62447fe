// What accuracy costs in space: the error of the beam's sag under its weight against the time of
// preparation and solution, for both formulations and for finite elements of another program.
#include <cmath>

#include "figures/figure.h"
#include "figures/measured.h"
#include "figures/solid_model.h"
#include "sem/base/timing.h"

namespace sem::figures {
namespace {

// Of the free end, m: quadratic and graded finite elements, independent of this code.
constexpr double truth = -4.595, truth_error = 0.005;
const Vec<3> tip(5, 0.5, 1);
const int slices[] = {1, 2, 3, 4, 5, 7};  // 4 k + 2 parts

enum Method { projected, condensed_2, condensed_3, n_methods };

Measured run(int method, int k) {
  const bool paper = method == projected;
  // 18 points a slice: 25, on 64 rays, move the condensed sag by a tenth of its error.
  const double start = thread_seconds();
  const SolidModel beam(
      paper ? "beam" : "beam_condensed",
      {"solids[0].shape.parts=[" + std::to_string(k) + ",1,1]", "gravity=[0,0,-10]",
       "analysis={\"type\":\"static\"}",
       "method.degree=" + std::to_string(method == condensed_3 ? 3 : 2), "method.quadrature.rays=6",
       "method.quadrature.points=" + std::to_string((paper ? 5 : 18) * k),
       paper ? "method.weights.cutoff=0.501" : "method.weights.cutoff=1.5"});
  const double prepared = thread_seconds();
  const auto state = beam.equilibrium();
  const double solved = thread_seconds();
  return {double(beam.model->n_unknowns()), state ? beam.displacement(*state, tip)[2] : NAN,
          prepared - start, solved - prepared};
}

Data compute() {
  Data data;
  auto& runs = data.add(
      "runs", {"method", "parts", "unknowns", "uz", "preparation_seconds", "solution_seconds"});
  for (int method = 0; method < n_methods; ++method)
    for (const int k : slices) {
      const Measured m = fastest([&] { return run(method, k); });
      runs.add({double(method), 4.0 * k + 2, m.unknowns, m.value, m.preparation, m.solution});
    }
  // Given from elsewhere: DOLFINx, one thread of another machine, tetrahedra.
  auto& peers = data.add("peers", {"degree", "unknowns", "relative_error", "given_seconds"});
  peers.add({2, 1575, 0.016, 0.21});
  peers.add({2, 9963, 5e-3, 2.5});
  peers.add({2, 30927, 3e-3, 11});
  peers.add({1, 30927, 0.02, 8.8});
  return data;
}

void draw(Plot& plot, const Data& data) {
  using enum MarkerShape;
  Panel& panel = plot.panel(0, 0);
  panel.x = {.label = "time of one thread (s)", .lower = 2e-3, .upper = 20, .logarithmic = true};
  panel.y = {.label = "relative error of the sag", .lower = 5e-4, .upper = 1, .logarithmic = true};
  const Series styles[] = {
      {.label = "projected (the paper's), n = 2", .color = colors::gray, .marker = circle},
      {.label = "condensed, n = 2", .color = colors::okabe_ito[5], .marker = square},
      {.label = "condensed, n = 3", .color = colors::okabe_ito[0], .marker = triangle}};
  for (int method = 0; method < n_methods; ++method) {
    const DataTable line = data["runs"].where("method", method);
    std::vector<double> seconds, error;
    for (int k = 0; k < line.n_rows(); ++k) {
      seconds.push_back(line.value("preparation_seconds", k) + line.value("solution_seconds", k));
      error.push_back(std::abs(line.value("uz", k) / truth - 1));
    }
    panel.curve(seconds, error, styles[method]);
  }
  for (const int degree : {1, 2}) {
    const DataTable given = data["peers"].where("degree", degree);
    panel.curve(
        given["given_seconds"], given["relative_error"],
        {.label = degree == 1 ? "DOLFINx, linear tetrahedra" : "DOLFINx, quadratic tetrahedra",
         .width = 0,
         .marker = degree == 1 ? plus : cross,
         .marker_size = 6});
  }
  panel.horizontal(truth_error / -truth, "error bar of the truth");
}

}  // namespace

Figure work_precision_3d() {
  Figure figure{"work_precision_3d",
                "A beam of 6 to 30 parts bent by its weight, error of its sag against time of "
                "preparation and "
                "solution: the condensed formulation costs less than quadratic tetrahedra at "
                "errors of 2 %, as much "
                "at half a percent. Black: given from another machine, for comparison",
                7,
                3.6,
                compute,
                draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
