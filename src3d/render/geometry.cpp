#include "src3d/render/geometry.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sem::render {
namespace {

auto kind(const Mesh& mesh) {
  const Vec<3> normal = mesh.kept ? mesh.kept->normal : Vec<3>::Zero();
  return std::tuple(-mesh.color.a, mesh.casts_shadow, normal[0], normal[1], normal[2],
                    mesh.kept ? mesh.kept->offset : 0);
}

Eigen::Vector4f kept_plane(const Mesh& mesh, const Ball& ball) {
  if (!mesh.kept) return {0, 0, 0, 1};
  const double offset = (mesh.kept->offset - mesh.kept->normal.dot(ball.center)) / ball.radius;
  const Eigen::Vector3f n = mesh.kept->normal.cast<float>();
  return {-n[0], -n[1], -n[2], float(offset)};
}

void append(const Mesh& mesh, const Ball& ball, Triangles& all) {
  const unsigned base = unsigned(all.vertices.size() / 11);
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    const Eigen::Vector3f x = ball.map(mesh.position[i]), n = mesh.normal[i].cast<float>();
    const Color& c = mesh.colors.empty() ? mesh.color : mesh.colors[i];
    all.vertices.insert(all.vertices.end(),
                        {x[0], x[1], x[2], n[0], n[1], n[2], float(c.r), float(c.g), float(c.b),
                         float(mesh.color.a), mesh.lit ? 1.f : 0.f});
  }
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) all.indices.push_back(base + unsigned(corner));
}

// Directions across a chain at its points, in pixels: half-way between the segments' normals,
// longer at corners so that the width stays; sharper corners than 60 degrees are cut.
std::vector<Eigen::Vector2f> miters(const std::vector<Eigen::Vector2f>& x) {
  const std::size_t n = x.size();
  std::vector<Eigen::Vector2f> normal(n - 1), result(n);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const Eigen::Vector2f d = x[k + 1] - x[k];
    normal[k] = d.norm() > 1e-6f ? Eigen::Vector2f(-d[1], d[0]).normalized()
                : k > 0          ? normal[k - 1]
                                 : Eigen::Vector2f(0, 1);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const Eigen::Vector2f &a = normal[k == 0 ? 0 : k - 1], &b = normal[std::min(k, n - 2)];
    result[k] = (a + b) / std::max(1 + a.dot(b), 0.5f);
  }
  return result;
}

}  // namespace

Box<3> bounding_box(const RenderScene& scene) {
  Box<3> box;
  for (const auto& mesh : scene.meshes)
    for (const auto& X : mesh.position)
      if (!mesh.kept || mesh.kept->normal.dot(X) <= mesh.kept->offset) box.include(X);
  for (const auto& lines : scene.lines)
    for (const auto& chain : lines.chains)
      for (const auto& X : chain) box.include(X);
  for (const auto& sphere : scene.spheres) {
    box.include(Vec<3>(sphere.center.array() - sphere.radius));
    box.include(Vec<3>(sphere.center.array() + sphere.radius));
  }
  return box;
}

Ball ball_of(const RenderScene& scene) {
  const Box<3> box = bounding_box(scene);
  Ball ball;
  if (!(box.diagonal() < std::numeric_limits<double>::infinity())) return ball;
  ball.center = (box.lower + box.upper) / 2;
  if (box.diagonal() > 0) ball.radius = box.diagonal() / 2;
  return ball;
}

Triangles triangles_of(const RenderScene& scene, const Ball& ball) {
  std::vector<const Mesh*> meshes;
  for (const auto& mesh : scene.meshes) meshes.push_back(&mesh);
  std::stable_sort(meshes.begin(), meshes.end(),
                   [](const Mesh* a, const Mesh* b) { return kind(*a) < kind(*b); });
  Triangles all;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    if (m == 0 || kind(*meshes[m - 1]) != kind(*meshes[m]))
      all.batches.push_back({int(all.indices.size()), 0, meshes[m]->color.a,
                             meshes[m]->casts_shadow, kept_plane(*meshes[m], ball)});
    append(*meshes[m], ball, all);
    all.batches.back().count = int(all.indices.size()) - all.batches.back().first;
  }
  return all;
}

Eigen::Matrix4f clip_matrix(const Camera& camera, const Ball& ball, double reach, int width,
                            int height) {
  const Eigen::Vector3d eye = (camera.eye - ball.center) / ball.radius;
  const double middle = camera.back.dot(eye), farthest = middle + 1 + reach;
  const double nearest =
      camera.parallel ? middle - 1 - reach : std::max(middle - 1 - reach, 0.02 * farthest);
  // Pixels of the ball's coordinates: x = center + focal r.(X - eye) / depth, and so on.
  Eigen::Matrix4d to_view = Eigen::Matrix4d::Identity();
  to_view.row(0).head<3>() = camera.right;
  to_view.row(1).head<3>() = camera.up;
  to_view.row(2).head<3>() = camera.back;
  to_view.topRightCorner<3, 1>() = -to_view.topLeftCorner<3, 3>() * eye;
  const double fx = 2 * camera.focal / width * (camera.parallel ? ball.radius : 1),
               fy = 2 * camera.focal / height * (camera.parallel ? ball.radius : 1);
  const double x0 = 2 * camera.center[0] / width - 1, y0 = 1 - 2 * camera.center[1] / height;
  Eigen::Matrix4d project = Eigen::Matrix4d::Zero();
  if (camera.parallel) {
    project.diagonal() << fx, fy, -2 / (farthest - nearest), 1;
    project.col(3) << x0, y0, -(farthest + nearest) / (farthest - nearest), 1;
  } else {
    project(0, 0) = fx;
    project(0, 2) = -x0;
    project(1, 1) = fy;
    project(1, 2) = -y0;
    project(2, 2) = -(farthest + nearest) / (farthest - nearest);
    project(2, 3) = -2 * farthest * nearest / (farthest - nearest);
    project(3, 2) = -1;
  }
  return (project * to_view).cast<float>();
}

std::vector<float> widened(const Lines& lines, const Camera& camera, const Ball& ball,
                           const Eigen::Matrix4f& to_clip, int width, int height) {
  constexpr double lift = 0.004;  // of the ball's radius
  const Eigen::Array2f pixels(0.5f * float(width), 0.5f * float(height));
  const auto& c = lines.color;
  std::vector<float> result;
  for (const auto& chain : lines.chains) {
    if (chain.size() < 2) continue;
    std::vector<Eigen::Vector4f> clip;
    std::vector<Eigen::Vector2f> at;
    for (const auto& X : chain) {
      clip.push_back(to_clip *
                     ball.map(X + lift * ball.radius * camera.toward(X)).homogeneous().matrix());
      at.push_back((clip.back().head<2>() / clip.back()[3]).array() * pixels);
    }
    const auto across = miters(at);
    const auto corner = [&](std::size_t k, float side, const Eigen::Vector2f& extension) {
      Eigen::Vector4f x = clip[k];
      const Eigen::Vector2f shift = side * 0.5f * float(lines.width) * across[k] + extension;
      x.head<2>() += x[3] * (shift.array() / pixels).matrix();
      result.insert(result.end(),
                    {x[0], x[1], x[2], x[3], float(c.r), float(c.g), float(c.b), float(c.a)});
    };
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      // Half a width longer at both ends, so that chains that meet leave no notch.
      const Eigen::Vector2f d = (at[k + 1] - at[k]).stableNormalized() * 0.5f * float(lines.width);
      const Eigen::Vector2f none(0, 0), before = k == 0 ? Eigen::Vector2f(-d) : none,
                                        after = k + 2 == chain.size() ? d : none;
      corner(k, 1, before), corner(k, -1, before), corner(k + 1, 1, after);
      corner(k + 1, 1, after), corner(k, -1, before), corner(k + 1, -1, after);
    }
  }
  return result;
}

}  // namespace sem::render
