#include "figures/solid_model.h"

#include "sem/base/error.h"
#include "sem/scene/analysis.h"
#include "sem/scene/builtin.h"
#include "sem/scene/read_scene.h"
#include "src3d/shapes/shape_fields.h"

namespace sem::figures {
namespace {

Scene<3> solid_scene(const std::string& name, const std::vector<std::string>& overrides) {
  for (const auto& builtin : builtin_scenes<3>())
    if (builtin.name == name) {
      Scene<3> scene = read_scene<3>(builtin.text, name, shapes3d::describe_shape, overrides);
      scene.method.n_threads = 1;
      return scene;
    }
  throw InputError("", "scene", name, "a built-in scene");
}

}  // namespace

SolidModel::SolidModel(const std::string& name, const std::vector<std::string>& overrides)
    : scene(solid_scene(name, overrides)), model(build_model(scene, name)) {}

std::optional<State> SolidModel::equilibrium() const {
  State state = model->initial;
  const auto report =
      sem::equilibrium(model->system, scene.analysis, model->target, state, model->path);
  if (report.status != Status::converged) return {};
  return state;
}

State SolidModel::after(double seconds) {
  State state = model->initial;
  Analysis analysis = scene.analysis;
  analysis.duration = seconds;
  const auto report = march(
      model->system, analysis, state, [](const State&, const StepInfo&) {}, model->set_load());
  if (report.status != Status::converged)
    throw InputError(scene.name, "analysis", describe(report.status), "steps that converge");
  return state;
}

Vec<3> SolidModel::displacement(const State& state, const Vec<3>& X) const {
  return evaluate(map_at<3>(model->discretization, X, false), state.z).col(0) - X;
}

}  // namespace sem::figures
