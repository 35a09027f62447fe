#include "src2d/baseline/scene_model.h"

#include "sem/base/error.h"
#include "sem/scene/analysis.h"
#include "sem/scene/read_scene.h"
#include "sem/scene/builtin.h"
#include "src2d/shapes/shape_fields.h"

namespace sem::baseline {
namespace {

Scene<2> builtin_scene(const std::string& name, const std::vector<std::string>& overrides) {
  for (const auto& scene : builtin_scenes<2>())
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

Map<2> exact_map(const Discretization<2>& d, const Points<2>& X) {
  const WeightOptions& options = d.options.weights;
  const auto distances =
      measure_distances(d.boundary, d.loops, X, options.variant, options.cutoff, 2);
  auto theta = distance_weights(distances, options);
  distance_weight_gradients(d.boundary, X, distances, theta);
  return blended_map(X, blending_weights(theta, d.boundary, X), d.origins, d.projection,
                     d.unknowns.size(), true, 2);
}

void use_exact_gradient(Model<2>& model) {
  auto& d = model.discretization;
  d.interior = exact_map(d, d.quadrature.position);
  model.energy =
      std::make_unique<InternalEnergy<2>>(d.interior, d.quadrature.weight, model.materials,
                                          model.stability_stiffness * model.stability);
  model.system.potential = model.energy.get();
}

}  // namespace sem::baseline
