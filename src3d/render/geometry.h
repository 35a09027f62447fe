#pragma once
// A scene as arrays for OpenGL: positions about the scene's centre in units of its radius, floats.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "src3d/render/camera.h"
#include "src3d/render/render_scene.h"

namespace sem::render {

/// The ball about the scene's box: positions become (X - center) / radius.
struct Ball {
  Vec<3> center = Vec<3>::Zero();
  double radius = 1;
  Eigen::Vector3f map(const Vec<3>& X) const { return ((X - center) / radius).cast<float>(); }
};
Ball ball_of(const RenderScene& scene);

/// A run of triangles of the same kind.
struct Batch {
  int first = 0, count = 0;  ///< indices
  double opacity = 1;
  bool casts_shadow = true;
  Eigen::Vector4f kept = {0, 0, 0, 1};
};

/// All triangles: position, normal, colour, whether lit (11 floats a vertex).
struct Triangles {
  std::vector<float> vertices;
  std::vector<unsigned> indices;
  std::vector<Batch> batches;
};
/// Meshes of the same kind in one batch, opaque ones first.
Triangles triangles_of(const RenderScene& scene, const Ball& ball);

/// From the ball's coordinates to OpenGL's clip space; the depth range holds the ball and `reach`
/// times its radius around it.
Eigen::Matrix4f clip_matrix(const Camera& camera, const Ball& ball, double reach, int width,
                            int height);

/// Lines as triangles in clip space: position, colour (8 floats a vertex). Moved towards the camera
/// by a little, so that a line on a surface is seen.
std::vector<float> widened(const Lines& lines, const Camera& camera, const Ball& ball,
                           const Eigen::Matrix4f& to_clip, int width, int height);

}  // namespace sem::render
