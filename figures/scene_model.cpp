#include "figures/scene_model.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "sem/base/error.h"
#include "sem/scene/analysis.h"
#include "sem/scene/read_scene.h"
#include "src2d/scenes/builtin.h"
#include "src2d/shapes/shape_fields.h"

namespace sem::figures {
namespace {

Scene<2> builtin_scene(const std::string& name, const std::vector<std::string>& overrides) {
  for (const auto& scene : builtin_scenes())
    if (scene.name == name)
      return read_scene<2>(scene.text, name, shapes2d::describe_shape, overrides);
  throw InputError("", "scene", name, "a built-in scene");
}

}  // namespace

SceneModel::SceneModel(const std::string& name, const std::vector<std::string>& overrides)
    : scene(builtin_scene(name, overrides)), model(build_model(scene, name)) {}

std::optional<State> SceneModel::equilibrium() const {
  State state = model->initial;
  const auto report = sem::equilibrium(model->system, scene.analysis, model->target, state);
  if (report.status != Status::converged) return {};
  return state;
}

Vec<2> SceneModel::displacement(const State& state, const Vec<2>& X) const {
  return evaluate(map_at<2>(model->discretization, X, false), state.z).col(0) - X;
}

void use_exact_gradient(Model<2>& model) {
  auto& d = model.discretization;
  const auto& X = d.quadrature.position;
  const WeightOptions& options = d.options.weights;
  const auto distances =
      measure_distances(d.boundary, d.loops, X, options.variant, options.cutoff, 2);
  auto theta = distance_weights(distances, options);
  distance_weight_gradients(d.boundary, X, distances, theta);
  d.weights = blending_weights(theta, d.boundary, X);
  d.interior = blended_map(X, d.weights, d.origins, d.projection, d.unknowns.size(), true, 2);
  model.energy =
      std::make_unique<InternalEnergy<2>>(d.interior, d.quadrature.weight, model.materials,
                                          model.stability_stiffness * model.stability);
  model.system.potential = model.energy.get();
}

long StiffnessPattern::n_nonzeros() const {
  return 4 * elastic.count() + 2 * (stability.array() && !elastic.array()).count();
}

StiffnessPattern stiffness_pattern(const Discretization<2>& d) {
  const int n = d.unknowns.size();
  const Eigen::MatrixX<bool> none = Eigen::MatrixX<bool>::Constant(n, n, false);
  StiffnessPattern pattern{none, none};
  const auto couple = [](Eigen::MatrixX<bool>& matrix, const std::vector<int>& columns) {
    for (const int i : columns)
      for (const int j : columns) matrix(i, j) = true;
  };
  for (const auto& block : d.interior.blocks) couple(pattern.elastic, block.columns);
  for (const auto& block : d.on_boundary.blocks)
    for (const int s : block.points) {
      std::vector<int> columns = block.columns;
      columns.insert(columns.end(), d.samples.column.begin() + d.samples.row[s],
                     d.samples.column.begin() + d.samples.row[s + 1]);
      couple(pattern.stability, columns);
    }
  return pattern;
}

double fastest_of(int n_calls, const std::function<void()>& call) {
  double fastest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n_calls; ++i) {
    const auto start = std::chrono::steady_clock::now();
    call();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    fastest = std::min(fastest, spent.count());
  }
  return fastest;
}

}  // namespace sem::figures
