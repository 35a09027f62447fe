// Draft eq. 14: what a fixed number of columns per point costs in accuracy and saves in time.
#include <cmath>

#include "figures/figure.h"
#include "figures/scene_model.h"

namespace sem::figures {
namespace {

// Displacements of all quadrature points, m; not a number if a motion without stiffness is left.
Points<2> displacements(const SceneModel& beam) {
  const auto& d = beam.model->discretization;
  const auto state = beam.equilibrium();
  if (!state) return Points<2>::Constant(2, d.quadrature.size(), std::nan(""));
  return evaluate(d.interior, state->z) - d.quadrature.position;
}

double assembly_seconds(const SceneModel& beam) {
  const System& system = beam.model->system;
  SymmetricMatrix K = system.potential->new_hessian();
  return fastest_of(10, [&] { system.potential->hessian(system.rest, false, K); });
}

Data compute() {
  const std::vector<std::string> settings = {
      "solids[0].shape.parts=[8,1,8,1]", "solids[0].material.model=\"linear\"",
      "analysis.load_steps=1",           "method.quadrature.rays=80",
      "method.origins=\"shared_parts\"", "method.weights.cutoff=0.6"};
  Data data;
  const SceneModel full("cantilever", settings);
  const Points<2> u = displacements(full);
  std::size_t most = 0;
  for (const auto& block : full.model->discretization.interior.blocks)
    most = std::max(most, unknowns_of(full.model->discretization.interior, block).size());
  data.add("full", {"columns", "assembly_seconds"}).add({double(most), assembly_seconds(full)});
  auto& table = data.add(
      "pruned", {"renormalised", "kept", "change_of_B", "change_of_solution", "assembly_seconds"});
  for (const int renormalise : {0, 1})
    for (int kept = 4; kept < int(most); kept += 4) {
      auto with = settings;
      with.push_back("method.kept_columns=" + std::to_string(kept));
      with.push_back(std::string("method.renormalise=") + (renormalise ? "true" : "false"));
      const SceneModel pruned("cantilever", with);
      table.add({double(renormalise), double(kept),
                 pruned.model->discretization.pruning.relative_error,
                 (displacements(pruned) - u).norm() / u.norm(), assembly_seconds(pruned)});
    }
  return data;
}

void draw(Plot& plot, const Data& data) {
  Panel &error = plot.panel(0, 0), &time = plot.panel(0, 1);
  error.x = time.x = {.label = "columns kept per point"};
  error.y = {.label = "relative change", .lower = 1e-4, .upper = 20, .logarithmic = true};
  time.y = {.label = "assembly of K (ms)", .lower = 0};
  const char* const names[] = {"as cut", "renormalised"};
  for (const int k : {0, 1}) {
    const DataTable line = data["pruned"].where("renormalised", k);
    error.curve(line["kept"], line["change_of_B"], series(2 * k, std::string("B, ") + names[k]));
    error.curve(line["kept"], line["change_of_solution"],
                series(2 * k + 1, std::string("solution, ") + names[k]));
    if (k == 0) continue;
    std::vector<double> ms;
    for (const double s : line["assembly_seconds"]) ms.push_back(1e3 * s);
    time.curve(line["kept"], ms, series(0));
  }
  time.horizontal(1e3 * data["full"].value("assembly_seconds"), "all");
}

}  // namespace

Figure pruning() {
  return {"pruning",
          "Draft eq. 14: cutting B to its largest columns changes a beam's static solution ten to "
          "two hundred times more than B, renormalised or not; assembly is hardly "
          "faster before few columns are left, since points that keep different ones no longer share products",
          7,
          2.6,
          compute,
          draw};
}

}  // namespace sem::figures
