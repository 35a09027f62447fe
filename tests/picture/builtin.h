#pragma once
// Built-in scenes for the tests of pictures, changed by overrides.

#include <memory>
#include <stdexcept>

#include "sem/scene/model.h"
#include "sem/scene/read_scene.h"
#include "sem/scene/builtin.h"
#include "src2d/shapes/shape_fields.h"

namespace sem::test {

inline Scene<2> builtin(const std::string& name, const std::vector<std::string>& overrides = {}) {
  for (const auto& scene : builtin_scenes<2>())
    if (scene.name == name)
      return read_scene<2>(scene.text, name, shapes2d::describe_shape, overrides);
  throw std::runtime_error("no scene " + name);
}

/// A scene with its model; neither moves, as painters and models refer to them.
struct Body {
  Scene<2> scene;
  std::unique_ptr<Model<2>> model;
  explicit Body(Scene<2> s) : scene(std::move(s)), model(build_model(scene, scene.name)) {}
  explicit Body(const std::string& name, const std::vector<std::string>& overrides = {})
      : Body(builtin(name, overrides)) {}
  Body(const Body&) = delete;

  /// The body moved by x -> A X + b, at a time.
  State moved(const Mat<2>& A, const Vec<2>& b, double time = 0) const {
    State state = model->initial;
    state.z = affine_field<2>(model->discretization.unknowns, A, b);
    state.time = time;
    return state;
  }
};

}  // namespace sem::test
