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
  Nurbs<2, 3> surface;
  surface.degree = {1, 1};
  surface.knots.fill({0, 0, 1, 1});
  surface.control_points.resize(3, 4);
  surface.weights.setOnes(4);
  for (int v = 0; v <= 1; ++v)
    for (int u = 0; u <= 1; ++u) {
      auto X = surface.control_points.col(u + 2 * v);
      X[axis] = plane;
      X[axes[0]] = interpolate(box.lower[axes[0]], box.upper[axes[0]], i + u, box.n_parts[axes[0]]);
      X[axes[1]] = interpolate(box.lower[axes[1]], box.upper[axes[1]], j + v, box.n_parts[axes[1]]);
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
