#pragma once
// Stage 3, second half: points and weights inside the body.

#include <vector>

#include "sem/method/rays.h"

namespace sem {

enum class IntervalRule {
  midpoint,  ///< n equal cells, their middles (the paper's)
  gauss,     ///< Gauss-Legendre
};

struct IntervalOptions {
  IntervalRule rule = IntervalRule::midpoint;
  int points = 8;       ///< points in each interval, if spacing = 0
  double spacing = 0;   ///< m; > 0: ceil(length / spacing) points instead, at least one
};

/// Interior quadrature rule: integral of f = sum_k weight_k f(position_k).
template <int Dim>
struct Quadrature {
  Points<Dim> position;     ///< Dim by #points, all inside
  Eigen::VectorXd weight;   ///< #points, m^2 (2D), m^3 (3D), all > 0
  std::vector<int> solid;   ///< #points: the first solid that contains the point

  int size() const { return int(weight.size()); }
};

/// Points in every interval of every ray.
/// Throws InputError if the body has no interior (field `solids`) or more than 1e7
/// points are asked for (`method.quadrature`).
template <int Dim>
Quadrature<Dim> quadrature_on_rays(const Rays<Dim>& rays, const IntervalOptions& options);

}  // namespace sem
