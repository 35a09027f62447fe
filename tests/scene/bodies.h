#pragma once
// Small scenes made in code, in both dimensions.

#include "sem/scene/run.h"
#include "solids.h"

namespace sem::test {

/// A unit box of one solid, two parts per side or face and direction, no loads, no pins.
template <int Dim>
Scene<Dim> box_scene(MaterialModel model = MaterialModel::neo_ref, int n = 1) {
  Scene<Dim> scene;
  scene.name = "box";
  SceneSolid<Dim> solid{"box", {model, 1e4, 0.3, 100}, {}};
  for (const auto& shape : unit_box<Dim>(n))
    solid.parts.push_back({"part." + std::to_string(solid.parts.size() + 1), shape, {}});
  scene.solids.push_back(solid);
  scene.method.rays.n_rays = 4;
  scene.method.interval.points = 4;
  scene.method.weights.cutoff = 1;
  scene.method.projection.degree = 1;
  scene.analysis.time_step = 0.01;
  scene.output.error_estimate = false;
  scene.output.frame_rate = 0;
  return scene;
}

/// Holds the control points on the face X_axis = 0.
template <int Dim>
Pin<Dim> face_pin(int axis) {
  Pin<Dim> pin;
  Box<Dim> box{Vec<Dim>::Constant(-1), Vec<Dim>::Constant(2)};
  box.upper[axis] = 0;
  pin.where.box = box;
  pin.axes.fill(true);
  return pin;
}

}  // namespace sem::test
