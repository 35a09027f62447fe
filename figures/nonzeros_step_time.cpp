// Non-zeros of the stiffness matrix and the time of a step as a bar grows, part by part.
#include "figures/figure.h"
#include "figures/scene_model.h"
#include "sem/solve/integrators.h"

namespace sem::figures {
namespace {

const char* const origins[] = {"shared_parts", "one"};

Data compute() {
  Data data;
  auto& table = data.add(
      "bars", {"one_origin", "parts", "unknowns", "nonzeros", "assembly_seconds", "step_seconds"});
  for (const int one : {0, 1})
    for (int m = 2; m <= (one ? 32 : 64); m *= 2) {
      // Each part is a metre long: it has the same neighbours in a bar of any length.
      const std::string n = std::to_string(m);
      const SceneModel bar("cantilever", {"solids[0].shape.upper=[" + n + ",1]",
                                          "solids[0].shape.parts=[" + n + ",1," + n + ",1]",
                                          "probes=[]", "method.weights.cutoff=0.6",
                                          "method.quadrature.rays=" + std::to_string(5 * m),
                                          "method.origins=\"" + std::string(origins[one]) + "\""});
      const System& system = bar.model->system;
      SymmetricMatrix K = system.potential->new_hessian();
      const double assembly =
          fastest_of(3, [&] { system.potential->hessian(system.rest, false, K); });
      TimeStepper stepper(system, 1e-3, Integrator::linearly_implicit_euler);
      State state = bar.model->initial;
      const double step = fastest_of(3, [&] { stepper.step(state); });
      table.add({double(one), double(2 * m + 2), double(system.size()),
                 double(stiffness_pattern(bar.model->discretization).n_nonzeros()), assembly,
                 step});
    }
  return data;
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  Panel &count = plot.panel(0, 0), &time = plot.panel(0, 1);
  count.title = "Stiffness matrix";
  time.title = "A step";
  count.x = time.x = {.label = "unknowns", .lower = 30, .upper = 2000, .logarithmic = true};
  count.y = {.label = "non-zeros", .lower = 1e3, .upper = 1e6, .logarithmic = true};
  time.y = {.label = "time (s)", .lower = 5e-5, .upper = 2, .logarithmic = true};
  const char* const names[] = {"shared origins", "one origin"};
  const std::vector<double> dotted = {1.2, 1.6};
  for (const int one : {0, 1}) {
    const DataTable line = data["bars"].where("one_origin", one);
    const auto& n = line["unknowns"];
    Series style = series(one, names[one]);
    style.dash = {};
    count.curve(n, line["nonzeros"], style);
    style.label = "";
    time.curve(n, line["step_seconds"], style);
    style.dash = dotted;
    time.curve(n, line["assembly_seconds"], style);
  }
  time.legend_entry({.label = "of it the assembly of K", .color = colors::gray, .dash = dotted});
  count.slope(1, 400, 1200, 1e4);
  count.slope(2, 80, 240, 1e5);
  time.slope(3, 600, 1400, 2.5e-4);
}

}  // namespace

Figure nonzeros_step_time() {
  return {
      "nonzeros_step_time",
      "A bar that grows part by part: with shared origins the non-zeros of the stiffness "
      "matrix grow like the unknowns, with one origin like their square; in a linearly implicit "
      "step the dense factorisation outgrows the assembly",
      7,
      2.8,
      compute,
      draw};
}

}  // namespace sem::figures
