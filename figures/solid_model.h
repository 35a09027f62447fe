#pragma once
// Built-in scenes in space, changed by overrides, as models that a figure can solve.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sem/scene/model.h"

namespace sem::figures {

/// A built-in scene with overrides as of `sem3d run --set`, and its model, on one thread. Neither
/// moves: models refer to themselves. Throws InputError as read_scene and build_model do.
struct SolidModel {
  Scene<3> scene;
  std::unique_ptr<Model<3>> model;

  explicit SolidModel(const std::string& name, const std::vector<std::string>& overrides = {});
  SolidModel(const SolidModel&) = delete;

  /// Statically loaded from rest, as the scene's analysis says; none if no equilibrium is found.
  std::optional<State> equilibrium() const;
  /// After so many seconds of the scene's dynamic analysis. Throws InputError if a step fails.
  State after(double seconds);
  /// Displacement of a rest point, m.
  Vec<3> displacement(const State& state, const Vec<3>& X) const;
};

}  // namespace sem::figures
