#pragma once
// Surfaces for the tests of pictures.

#include <cmath>
#include <vector>

#include "sem/nurbs/prepared.h"

namespace sem::test {

/// A quarter turn about the z axis of a rational quadratic arc in the x-z plane, given by its three
/// control points and the middle one's weight. u: turn, v: along the arc.
inline Nurbs<2, 3> quarter_turn(const std::array<Vec<2>, 3>& arc, double middle_weight,
                                int quarter) {
  Nurbs<2, 3> patch;
  patch.degree = {2, 2};
  patch.knots.fill({0, 0, 0, 1, 1, 1});
  patch.control_points.resize(3, 9);
  patch.weights.resize(9);
  const double half = std::sqrt(0.5);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const double angle = M_PI / 2 * quarter + M_PI / 4 * i, r = arc[j][0] / (i == 1 ? half : 1);
      patch.control_points.col(i + 3 * j) << r * std::cos(angle), r * std::sin(angle), arc[j][1];
      patch.weights[i + 3 * j] = (i == 1 ? half : 1) * (j == 1 ? middle_weight : 1);
    }
  return patch;
}

/// Eight octants, du x dv outward, collapsed edges at both poles.
inline std::vector<Nurbs<2, 3>> sphere(const Vec<3>& center, double radius) {
  std::vector<Nurbs<2, 3>> parts;
  for (const double side : {-1.0, 1.0})
    for (int quarter = 0; quarter < 4; ++quarter) {
      const Vec<2> equator(radius, 0), corner(radius, side * radius), pole(0, side * radius);
      auto patch = side < 0 ? quarter_turn({pole, corner, equator}, std::sqrt(0.5), quarter)
                            : quarter_turn({equator, corner, pole}, std::sqrt(0.5), quarter);
      patch.control_points.colwise() += center;
      parts.push_back(patch);
    }
  return parts;
}

/// Sixteen patches about the z axis, du x dv outward.
inline std::vector<Nurbs<2, 3>> torus(double radius, double tube) {
  std::vector<Nurbs<2, 3>> parts;
  const Vec<2> around[8] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  for (int k = 0; k < 4; ++k)
    for (int quarter = 0; quarter < 4; ++quarter) {
      std::array<Vec<2>, 3> arc;
      for (int j = 0; j < 3; ++j) arc[j] = Vec<2>(radius, 0) + tube * around[(2 * k + j) % 8];
      parts.push_back(quarter_turn(arc, std::sqrt(0.5), quarter));
    }
  return parts;
}

}  // namespace sem::test
