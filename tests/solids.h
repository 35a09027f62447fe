#pragma once
// Small solids for the tests, in both dimensions, made without the shape libraries.

#include <cmath>
#include <vector>

#include "sem/nurbs/bezier_curve.h"
#include "sem/nurbs/refine.h"

namespace sem::test {

template <int Dim>
using Parts = std::vector<Nurbs<Dim - 1, Dim>>;

/// Straight parts between consecutive points, closed.
inline Parts<2> polygon(const std::vector<Vec<2>>& points) {
  Parts<2> parts;
  for (size_t i = 0; i < points.size(); ++i)
    parts.push_back(segment<2>(points[i], points[(i + 1) % points.size()]));
  return parts;
}

/// One piece, biquadratic; control points and weights are to be set.
inline Nurbs<2, 3> biquadratic_patch() {
  Nurbs<2, 3> patch;
  patch.degree = {2, 2};
  patch.knots.fill({0, 0, 0, 1, 1, 1});
  patch.control_points.resize(3, 9);
  patch.weights.resize(9);
  return patch;
}

/// Rational quadratic arc of a circle, less than half a turn.
inline Nurbs<1, 2> arc(const Vec<2>& center, double radius, double from, double to) {
  const double half = (to - from) / 2, middle = (from + to) / 2;
  Points<2> points(2, 3);
  points << center + radius * Vec<2>(std::cos(from), std::sin(from)),
      center + radius / std::cos(half) * Vec<2>(std::cos(middle), std::sin(middle)),
      center + radius * Vec<2>(std::cos(to), std::sin(to));
  return bezier_curve<2>(points, Eigen::Vector3d(1, std::cos(half), 1));
}

inline Parts<2> circle(const Vec<2>& center, double radius, int n_arcs = 4) {
  Parts<2> parts;
  for (int k = 0; k < n_arcs; ++k)
    parts.push_back(arc(center, radius, 2 * M_PI * k / n_arcs, 2 * M_PI * (k + 1) / n_arcs));
  return parts;
}

inline Nurbs<2, 3> bilinear(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& d) {
  Nurbs<2, 3> patch;
  patch.degree = {1, 1};
  patch.knots.fill({0, 0, 1, 1});
  patch.control_points.resize(3, 4);
  patch.control_points << a, b, c, d;
  patch.weights = Eigen::Vector4d::Ones();
  return patch;
}

/// Box from `lower` to `upper`: straight sides or bilinear faces; each cut in
/// `n` along every parameter.
template <int Dim>
Parts<Dim> box(const Vec<Dim>& lower, const Vec<Dim>& upper, int n = 1);

template <>
inline Parts<2> box<2>(const Vec<2>& lower, const Vec<2>& upper, int n) {
  std::vector<Vec<2>> corners = {lower, {upper[0], lower[1]}, upper, {lower[0], upper[1]}}, points;
  for (int c = 0; c < 4; ++c)
    for (int k = 0; k < n; ++k) points.push_back(corners[c] + double(k) / n * (corners[(c + 1) % 4] - corners[c]));
  return polygon(points);
}

template <>
inline Parts<3> box<3>(const Vec<3>& lower, const Vec<3>& upper, int n) {
  Parts<3> parts;
  const auto corner = [&](int axis, int side, int i, int j) {
    Vec<3> X;
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    X[axis] = side ? upper[axis] : lower[axis];
    X[b] = lower[b] + (upper[b] - lower[b]) * i / n;
    X[c] = lower[c] + (upper[c] - lower[c]) * j / n;
    return X;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          parts.push_back(bilinear(corner(axis, side, i, j), corner(axis, side, i + 1, j),
                                   corner(axis, side, i, j + 1), corner(axis, side, i + 1, j + 1)));
  return parts;
}

/// Rational quadratic arcs and segments in the plane of x (distance from the z axis) and y = z, turned about that axis
/// in quarters: patches with du x dv outward for arcs that run up (poles where they end on the axis).
inline Parts<3> turned(const Parts<2>& arcs) {
  Parts<3> parts;
  for (int k = 0; k < 4; ++k)
    for (const auto& part : arcs) {
      const auto curve = elevate_degree(part, 0, 2 - part.degree[0]);
      const auto around = arc({0, 0}, 1, M_PI / 2 * k, M_PI / 2 * (k + 1));
      Nurbs<2, 3> patch = biquadratic_patch();
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const Vec<2> X = curve.control_points.col(j);
          const double radius = std::abs(X[0]) < 1e-15 ? 0 : X[0];
          patch.control_points.col(3 * j + i) << radius * around.control_points.col(i), X[1];
          patch.weights[3 * j + i] = curve.weights[j] * around.weights[i];
        }
      parts.push_back(patch);
    }
  return parts;
}

inline Parts<3> ball() {
  return turned({arc({0, 0}, 1, -M_PI / 2, 0), arc({0, 0}, 1, 0, M_PI / 2)});
}

/// About the z axis.
inline Parts<3> torus(double radius, double tube_radius) {
  return turned(circle({radius, 0}, tube_radius));
}

template <int Dim>
Parts<Dim> unit_box(int n = 1) {
  return box<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), n);
}

/// Control points stacked as the unknown z.
template <int Dim>
Eigen::VectorXd stacked(const Points<Dim>& p) {
  return Eigen::Map<const Eigen::VectorXd>(p.data(), p.size());
}

}  // namespace sem::test
