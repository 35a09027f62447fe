// Non-zeros of the stiffness matrix and the time of a step as a beam grows to 394 parts.
#include "figures/growing_beam.h"

#include <algorithm>
#include <cmath>

#include "figures/figure.h"
#include "figures/scene_model.h"
#include "sem/solve/integrators.h"
#include "sem/solve/sparse_cholesky.h"

namespace sem::figures {

std::unique_ptr<SolidModel> growing_beam_of(int n_slices) {
  const int points = std::max(11, n_slices + n_slices / 10);
  const std::vector<std::string> overrides = {
      "solids[0].shape.upper=[" + std::to_string(0.5 * n_slices) + ",1,1]",
      "solids[0].shape.parts=[" + std::to_string(n_slices) + ",1,1]",
      "probes=[]",
      "method.origins=\"shared_parts\"",
      "method.quadrature.rays=9",
      "method.quadrature.points=" + std::to_string(points)};
  return std::make_unique<SolidModel>("beam", overrides);
}

namespace {

const int slices[] = {1, 2, 3, 5, 7, 10, 16, 22, 32, 44, 66, 98};
// Seconds a step of the published code on the reference's machine, beams b1 to b10 of the same
// parts and about as many points: measured with Octave and its own kernels, one core.
const std::pair<int, double> published_code[] = {
    {162, 0.100}, {378, 0.131}, {594, 0.232}, {810, 0.386}, {1134, 0.697}};
// The published curve's end.
constexpr double published_unknowns = 5000, published_step = 20;

Data compute() {
  Data data;
  auto& table =
      data.add("beams", {"parts", "unknowns", "points", "nonzeros", "factor_nonzeros",
                         "factor_flops", "preparation_seconds", "factor_seconds", "step_seconds"});
  for (const int n : slices) {
    std::unique_ptr<SolidModel> beam;
    const double preparation = fastest_of(1, [&] { beam = growing_beam_of(n); });
    const auto& d = beam->model->discretization;
    const System& system = beam->model->system;
    SymmetricMatrix K = system.potential->new_hessian();
    system.potential->hessian(system.rest, false, K);
    K.add(1, system.mass);
    SparseCholesky cholesky(K.plan(), 3, system.free);
    const double factor = fastest_of(2, [&] { cholesky.compute(K); });
    TimeStepper stepper(system, 0.1, Integrator::linearly_implicit_euler);
    State state = beam->model->initial;
    const double step = fastest_of(2, [&] { stepper.step(state); });
    const double size = system.size();
    const double triangle = double(K.plan()->n_nodes()) * (K.plan()->n_nodes() + 1) / 2;
    table.add(
        {4.0 * n + 2, size, double(d.quadrature.size()), double(stiffness_pattern(d).n_nonzeros()),
         9 * std::round(K.plan()->fill() * triangle), cholesky.factor_work().flops, preparation, factor, step});
  }
  auto& measured = data.add("reference", {"unknowns", "time"});
  for (const auto& [unknowns, time] : published_code) measured.add({double(unknowns), time});
  data.add("published", {"unknowns", "time"}).add({published_unknowns, published_step});
  return data;
}

// Proportional to the unknowns from the beam of 50 parts on.
void draw_guide(Panel& panel, const DataTable& beams, const std::vector<double>& values) {
  const auto& n = beams["unknowns"];
  const int first = int(std::upper_bound(beams["parts"].begin(), beams["parts"].end(), 50.0) -
                        beams["parts"].begin());
  const double share = values[first] / n[first];
  panel.curve({n[first], n.back()}, {values[first], share * n.back()},
              {.label = "in proportion, from 66 parts on",
               .color = colors::gray,
               .width = 0.8,
               .dash = {4, 2}});
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.shared_legend = true;
  const DataTable& beams = data["beams"];
  const auto& n = beams["unknowns"];
  Panel &count = plot.panel(0, 0), &time = plot.panel(0, 1);
  count.x = time.x = {.label = "unknowns", .lower = 100, .upper = 2e4, .logarithmic = true};
  count.y = {.label = "entries", .lower = 1e4, .upper = 2e8, .logarithmic = true};
  time.y = {.label = "time (s)", .lower = 1e-5, .upper = 50, .logarithmic = true};
  count.title = "Matrices";
  time.title = "A step";
  std::vector<double> square;
  for (const double unknowns : n) square.push_back(unknowns * unknowns);
  count.curve(n, square, {.label = "dense", .color = colors::gray, .width = 0.8, .dash = {1, 1.5}});
  count.curve(n, beams["nonzeros"], series(0, "K"));
  count.curve(n, beams["factor_nonzeros"], series(2, "factor of M + Δt² K"));
  time.curve(n, beams["step_seconds"], series(1, "step"));
  time.curve(n, beams["factor_seconds"], series(3, "of it the factorisation"));
  const DataTable &reference = data["reference"], &published = data["published"];
  time.curve(reference["unknowns"], reference["time"],
             {.label = "published code, measured",
              .width = 0.8,
              .marker = MarkerShape::cross,
              .marker_size = 4});
  time.curve(published["unknowns"], published["time"],
             {.label = "published", .width = 0, .marker = MarkerShape::square, .marker_size = 5});
  draw_guide(count, beams, beams["nonzeros"]);
  draw_guide(time, beams, beams["step_seconds"]);
}

}  // namespace

Figure growing_beam() {
  Figure figure{
      "growing_beam",
      "A beam that grows from 6 to 394 parts (half a metre and four parts a slice): non-zeros of "
      "the stiffness matrix and of the factor, and the time of a linearly implicit step on one "
      "core, against the unknowns",
      7,
      3.1,
      compute,
      draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
