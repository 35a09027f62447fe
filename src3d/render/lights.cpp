#include "src3d/render/lights.h"

#include <cmath>

namespace sem::render {
namespace {

const double golden_angle = M_PI * (3 - std::sqrt(5.0));

// Two directions that complete a unit vector.
std::array<Vec<3>, 2> across(const Vec<3>& n) {
  Vec<3> axis = Vec<3>::Zero();
  Eigen::Index smallest = 0;
  n.cwiseAbs().minCoeff(&smallest);
  axis[smallest] = 1;
  const Vec<3> a = n.cross(axis).normalized();
  return {a, n.cross(a)};
}

}  // namespace

std::vector<Light> lights(const Lighting& lighting, const Vec<3>& up, const Vec<3>& key_direction) {
  std::vector<Light> result;
  const Vec<3> key = key_direction.normalized();
  const auto [a, b] = across(key);
  const double extent = std::tan(lighting.key_radius * M_PI / 180);
  for (int k = 0; k < lighting.n_key; ++k) {
    const double r = extent * std::sqrt((k + 0.5) / lighting.n_key);
    const Vec<3> l = key + r * (std::cos(k * golden_angle) * a + std::sin(k * golden_angle) * b);
    result.push_back({l.normalized().cast<float>(), 0});
  }
  const auto [c, d] = across(up);
  std::vector<double> weight;
  double sum = 0;
  for (int k = 0; k < lighting.n_ambient; ++k) {
    const double height = 1 - (2 * k + 1.0) / lighting.n_ambient,
                 r = std::sqrt(1 - height * height);
    const Vec<3> l =
        height * up + r * (std::cos(k * golden_angle) * c + std::sin(k * golden_angle) * d);
    weight.push_back(lighting.from_below + (1 - lighting.from_below) * (0.5 + 0.5 * height));
    sum += weight.back() * std::max(height, 0.0);
    result.push_back({l.cast<float>(), 0});
  }
  for (int k = 0; k < lighting.n_ambient; ++k)
    result[lighting.n_key + k].weight = float(weight[k] / sum);
  return result;
}

Eigen::Matrix4f light_matrix(const Eigen::Vector3f& toward) {
  const auto [a, b] = across(toward.cast<double>());
  Eigen::Matrix4f m = Eigen::Matrix4f::Zero();
  m.row(0).head<3>() = 0.5f * a.cast<float>();
  m.row(1).head<3>() = 0.5f * b.cast<float>();
  m.row(2).head<3>() = -0.5f * toward;
  m.col(3) << 0.5f, 0.5f, 0.5f, 1;
  return m;
}

}  // namespace sem::render
