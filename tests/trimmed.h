#pragma once
// Trimmed patches and solids for the tests.

#include "sem/method/trims.h"
#include "solids.h"

namespace sem::test {

/// Closed polygon in the parameter plane.
inline std::vector<Nurbs<1, 2>> polygon_trim(const std::vector<Vec<2>>& points) {
  return polygon(points);
}

/// The border of a patch's domain.
inline std::vector<Nurbs<1, 2>> natural_trim(const Nurbs<2, 3>& patch) {
  const Interval u = domain(patch, 0), v = domain(patch, 1);
  return polygon({{u.lower, v.lower}, {u.upper, v.lower}, {u.upper, v.upper}, {u.lower, v.upper}});
}

/// z = height + a (x^2 + y^2) over the square [-1, 1]^2, biquadratic; u = x, v = y.
inline Nurbs<2, 3> paraboloid(double a, double height = 0) {
  Nurbs<2, 3> patch;
  patch.degree = {2, 2};
  patch.knots.fill({-1, -1, -1, 1, 1, 1});
  patch.control_points.resize(3, 9);
  patch.weights = Eigen::VectorXd::Ones(9);
  const double square[3] = {1, -1, 1};  // Bernstein coefficients of t^2 on [-1, 1]
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      patch.control_points.col(i + 3 * j) =
          Vec<3>(i - 1, j - 1, height + a * (square[i] + square[j]));
  return patch;
}

/// Quarters of a cylinder along z about an axis, u around, v up.
inline Parts<3> cylinder(const Vec<2>& center, double radius, double lower, double upper) {
  Parts<3> parts;
  for (const auto& quarter : circle(center, radius)) {
    Nurbs<2, 3> patch;
    patch.degree = {2, 1};
    patch.knots = {std::vector<double>{0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}};
    patch.control_points.resize(3, 6);
    patch.control_points.topRows<2>() << quarter.control_points, quarter.control_points;
    patch.control_points.row(2) << lower, lower, lower, upper, upper, upper;
    patch.weights.resize(6);
    patch.weights << quarter.weights, quarter.weights;
    parts.push_back(patch);
  }
  return parts;
}

/// A solid of trimmed parts: one loop list a part.
struct TrimmedSolid {
  Parts<3> parts;
  std::vector<TrimLoops> trims;
};

/// The rectangle [lower, upper] at height z, u = x, v = y.
inline Nurbs<2, 3> rectangle(const Vec<2>& lower, const Vec<2>& upper, double z) {
  Nurbs<2, 3> patch = bilinear({lower[0], lower[1], z}, {upper[0], lower[1], z},
                               {lower[0], upper[1], z}, {upper[0], upper[1], z});
  patch.knots = {std::vector<double>{lower[0], lower[0], upper[0], upper[0]},
                 {lower[1], lower[1], upper[1], upper[1]}};
  return patch;
}

/// Unit box with a cylinder of the radius about (0.5, 0.5): standing on the top up to height 1 +
/// rise if rise > 0, a blind hole from the top down if rise < 0. Top and lid are trimmed planes.
inline TrimmedSolid box_with_cylinder(double radius, double rise) {
  TrimmedSolid solid;
  const auto ring = circle({0.5, 0.5}, radius);
  for (const auto& face : unit_box<3>()) {
    const bool top = face.control_points.row(2).minCoeff() == 1;
    solid.parts.push_back(top ? rectangle({0, 0}, {1, 1}, 1) : face);
    solid.trims.emplace_back();
    if (top) solid.trims.back() = {natural_trim(solid.parts.back()), ring};
  }
  for (const auto& patch : cylinder({0.5, 0.5}, radius, 1, 1 + rise)) {
    solid.parts.push_back(patch);
    solid.trims.emplace_back();
  }
  solid.parts.push_back(rectangle({0, 0}, {1, 1}, 1 + rise));
  solid.trims.push_back({ring});
  return solid;
}

}  // namespace sem::test
