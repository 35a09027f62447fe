#pragma once
// Solids for the tests of pictures, as meshes.

#include "src3d/render/tessellate.h"
#include "src3d/shapes/solids.h"

namespace sem::test {

inline std::vector<PreparedNurbs<2, 3>> prepared(const std::vector<ScenePart<3>>& parts) {
  std::vector<PreparedNurbs<2, 3>> surfaces;
  for (const auto& part : parts) surfaces.push_back(prepare(part.shape));
  return surfaces;
}

/// A ball about z with collapsed edges at its poles: half circle, turned.
inline std::vector<PreparedNurbs<2, 3>> ball_with_poles(double radius) {
  Nurbs<1, 2> half;
  const double h = std::sqrt(0.5);
  half.degree = {2};
  half.knots = {std::vector<double>{0, 0, 0, 1, 1, 2, 2, 2}};
  half.control_points.resize(2, 5);
  half.control_points << 0, radius, radius, radius, 0, -radius, -radius, 0, radius, radius;
  half.weights.resize(5);
  half.weights << 1, h, 1, h, 1;
  ScenePart<2> profile;
  profile.name = "ball";
  profile.shape = half;
  return prepared(shapes3d::make_parts(shapes3d::Revolution{{profile}}));
}

inline void add(render::RenderScene& scene, const std::vector<PreparedNurbs<2, 3>>& surfaces,
                const render::Mesh& like, double flatness = 1e-3) {
  for (const auto& surface : surfaces) {
    render::Mesh mesh = tessellate(surface, render::Flatness{flatness});
    mesh.color = like.color;
    mesh.lit = like.lit;
    mesh.kept = like.kept;
    scene.meshes.push_back(mesh);
  }
}

}  // namespace sem::test
