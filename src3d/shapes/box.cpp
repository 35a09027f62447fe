#include "src3d/shapes/box.h"

namespace sem::shapes3d {
namespace {

// a + (b - a) k / n, exact at both ends.
double interpolate(double a, double b, int k, int n) {
  return 2 * k <= n ? a + double(k) / n * (b - a) : b + double(n - k) / n * (a - b);
}

// Patch (i, j) of the face of constant `axis`; u along axes[0], v along axes[1].
Nurbs<2, 3> patch(const Box& box, int axis, double plane, const std::array<int, 2>& axes, int i,
                  int j) {
  const int p = box.degree;
  Nurbs<2, 3> surface;
  surface.degree = {p, p};
  for (auto& knots : surface.knots) {
    knots.assign(p + 1, 0.0);
    knots.insert(knots.end(), p + 1, 1.0);
  }
  surface.control_points.resize(3, (p + 1) * (p + 1));
  surface.weights.setOnes((p + 1) * (p + 1));
  const auto coordinate = [&](int a, int part, int k) {
    return interpolate(box.lower[a], box.upper[a], part * p + k, box.n_parts[a] * p);
  };
  for (int v = 0; v <= p; ++v)
    for (int u = 0; u <= p; ++u) {
      auto X = surface.control_points.col(u + v * (p + 1));
      X[axis] = plane;
      X[axes[0]] = coordinate(axes[0], i, u);
      X[axes[1]] = coordinate(axes[1], j, v);
    }
  return surface;
}

}  // namespace

Parts make_parts(const Box& box) {
  const char* names[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};
  Parts parts;
  for (int axis = 0; axis < 3; ++axis)
    for (int upper = 0; upper < 2; ++upper) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      const std::array<int, 2> axes = upper ? std::array{b, c} : std::array{c, b};
      const int n_u = box.n_parts[axes[0]], n_v = box.n_parts[axes[1]];
      for (int k = 0; k < n_u * n_v; ++k) {
        std::string name = names[axis][upper];
        if (n_u * n_v > 1) name += '.' + std::to_string(k + 1);
        const double plane = upper ? box.upper[axis] : box.lower[axis];
        parts.push_back({name, patch(box, axis, plane, axes, k % n_u, k / n_u), {}});
      }
    }
  return parts;
}

}  // namespace sem::shapes3d
