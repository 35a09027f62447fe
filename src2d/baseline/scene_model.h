#pragma once
// Built-in scenes, changed by overrides, as models that a figure or a tutorial can solve.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sem/scene/model.h"

namespace sem::baseline {

/// A built-in scene with overrides as of `sem2d run --set`, and its model. Neither moves: models
/// refer to themselves. Throws InputError as read_scene and build_model do.
struct SceneModel {
  Scene<2> scene;
  std::unique_ptr<Model<2>> model;

  explicit SceneModel(const std::string& name, const std::vector<std::string>& overrides = {});
  SceneModel(const SceneModel&) = delete;

  /// Statically loaded from rest, as the scene's analysis says; none if no equilibrium is found.
  std::optional<State> equilibrium() const;
  /// Displacement of a rest point, m.
  Vec<2> displacement(const State& state, const Vec<2>& X) const;
};

/// The paper's map at rest points with the gradient of x(X) in place of the diffuse one (draft eq. 12): grad w
/// is kept.
Map<2> exact_map(const Discretization<2>& discretization, const Points<2>& X);
/// F of the model becomes that of x(X).
void use_exact_gradient(Model<2>& model);

}  // namespace sem::baseline
