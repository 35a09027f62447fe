#pragma once
// Built-in scenes, changed by overrides, as models that a figure can solve.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sem/scene/model.h"

namespace sem::figures {

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

/// In place of the paper's diffuse gradient (draft eq. 12) F becomes that of x(X): grad w is kept.
void use_exact_gradient(Model<2>& model);

/// Which control points the stiffness matrix couples, found from the structure of the operators
/// alone.
struct StiffnessPattern {
  Eigen::MatrixX<bool> elastic, stability;  ///< #unknowns / 2 squared: both components, each alone

  int size() const { return int(elastic.rows()); }
  bool coupled(int i, int j) const { return elastic(i, j) || stability(i, j); }
  /// Of the matrix on z.
  long n_nonzeros() const;
};
StiffnessPattern stiffness_pattern(const Discretization<2>& discretization);

/// Shortest of several calls, s.
double fastest_of(int n_calls, const std::function<void()>& call);

}  // namespace sem::figures
