#pragma once
// Directions of light that stand for a key light of some extent and for the sky.

#include <Eigen/Core>
#include <vector>

#include "src3d/render/renderer.h"

namespace sem::render {

struct Light {
  Eigen::Vector3f toward;  ///< unit, to the light
  float weight;            ///< of the sky's light times the cosine; 0: key light
};

/// Equal parts of the key light's disc, then points spread evenly over the sphere whose weights sum
/// to 1, times cosine, for a free surface that faces up.
std::vector<Light> lights(const Lighting& lighting, const Vec<3>& up, const Vec<3>& key_direction);

/// From positions in the unit ball to [0, 1]^3 of a parallel view along the light; depth grows away
/// from it.
Eigen::Matrix4f light_matrix(const Eigen::Vector3f& toward);

}  // namespace sem::render
