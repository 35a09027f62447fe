#include "sem/draw/canvas.h"

#include <cmath>
#include <numbers>

namespace sem {
namespace {

Polyline corners(const Box<2>& box) {
  return {box.lower, {box.upper[0], box.lower[1]}, box.upper, {box.lower[0], box.upper[1]}};
}

/// Regular polygon with its first corner in the direction `start` (radians from x towards y).
Polyline regular_polygon(const Vec<2>& center, double radius, int n_corners, double start) {
  Polyline polygon;
  for (int i = 0; i < n_corners; ++i) {
    const double angle = start + 2 * std::numbers::pi * i / n_corners;
    polygon.emplace_back(center + radius * Vec<2>(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

}  // namespace

void Canvas::line(const Vec<2>& a, const Vec<2>& b, const Stroke& style) {
  const Vec<2> ends[] = {a, b};
  stroke(ends, style);
}

void Canvas::fill_box(const Box<2>& box, const Color& color) { fill(corners(box), color); }

void Canvas::stroke_box(const Box<2>& box, Stroke style) {
  style.closed = true;
  stroke(corners(box), style);
}

void Canvas::marker(const Vec<2>& position, MarkerShape shape, double size, const Color& color) {
  constexpr double pi = std::numbers::pi;
  const double r = size / 2, thickness = std::max(1.0, size / 5);
  switch (shape) {
    case MarkerShape::circle: {
      constexpr double deviation = 0.05;  // pixels between the circle and the polygon
      const int n_corners =
          r > 2 * deviation ? int(std::ceil(pi / std::acos(1 - deviation / r))) : 4;
      return fill(regular_polygon(position, r, n_corners, 0), color);
    }
    case MarkerShape::square:
      return fill(regular_polygon(position, 1.25 * r, 4, pi / 4), color);
    case MarkerShape::diamond:
      return fill(regular_polygon(position, 1.25 * r, 4, 0), color);
    case MarkerShape::triangle:
      return fill(regular_polygon(position, 1.35 * r, 3, -pi / 2), color);
    case MarkerShape::plus:
    case MarkerShape::cross: {
      // One polygon with twelve corners, so that a transparent colour does not add up in the
      // middle.
      const double a = shape == MarkerShape::plus ? 0 : pi / 4, h = thickness / 2, l = 1.1 * r;
      Polyline outline;
      for (int arm = 0; arm < 4; ++arm) {
        const Eigen::Rotation2Dd to_arm(a + arm * pi / 2);
        for (const Vec<2>& x : {Vec<2>(h, -h), Vec<2>(l, -h), Vec<2>(l, h)})
          outline.emplace_back(position + to_arm * x);
      }
      return fill(outline, color);
    }
  }
}

}  // namespace sem
