#include "src3d/shapes/parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sem/base/rotation.h"
#include "src3d/shapes/surfaces.h"

namespace sem::shapes3d {

Mat<3> Placement::linear() const {
  return rotation<3>(angle * axis.normalized()) * scale.asDiagonal();
}

void place(Parts& parts, const Placement& placement) {
  const Mat<3> A = placement.linear();
  for (auto& part : parts) {
    auto& points = part.shape.control_points;
    points = ((A * points).colwise() + placement.move).eval();
  }
}

void split(Parts& parts, const std::array<int, 2>& n) {
  if (n[0] * n[1] == 1) return;
  Parts pieces;
  for (const auto& part : parts) {
    int number = 0;
    for (auto& piece : split(part.shape, n[0], n[1]))
      pieces.push_back({part.name + '.' + std::to_string(++number),
                        std::move(piece),
                        part.material,
                        {},
                        part.color});
  }
  parts = std::move(pieces);
}

void elevate(Parts& parts, int degree) {
  for (auto& part : parts) part.shape = elevated(std::move(part.shape), degree);
}

void weld(Parts& parts) {
  struct Control {
    int part, index;
  };
  std::vector<Control> controls;
  Vec<3> lower = Vec<3>::Constant(INFINITY), upper = -lower;
  for (size_t p = 0; p < parts.size(); ++p) {
    const auto& points = parts[p].shape.control_points;
    lower = lower.cwiseMin(points.rowwise().minCoeff());
    upper = upper.cwiseMax(points.rowwise().maxCoeff());
    for (Eigen::Index i = 0; i < points.cols(); ++i) controls.push_back({int(p), int(i)});
  }
  const double same = 1e-13 * (upper - lower).norm();
  const auto position = [&](const Control& c) {
    return parts[c.part].shape.control_points.col(c.index);
  };
  std::stable_sort(controls.begin(), controls.end(), [&](const Control& a, const Control& b) {
    return position(a)[0] < position(b)[0];
  });
  std::vector<bool> done(controls.size(), false);
  for (size_t a = 0; a < controls.size(); ++a) {
    if (done[a]) continue;
    const Vec<3> X = position(controls[a]);
    const double w = parts[controls[a].part].shape.weights[controls[a].index];
    for (size_t b = a + 1; b < controls.size() && position(controls[b])[0] - X[0] <= same; ++b) {
      auto at = position(controls[b]);
      if (done[b] || (Vec<3>(at) - X).norm() > same) continue;
      at = X;
      done[b] = true;
      double& weight = parts[controls[b].part].shape.weights[controls[b].index];
      if (std::abs(weight - w) <= 1e-13 * w) weight = w;
    }
  }
}

}  // namespace sem::shapes3d
