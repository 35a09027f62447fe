#pragma once
// What is known at quadrature points, shown on the surface.

#include <Eigen/Core>
#include <vector>

#include "sem/base/dim.h"

namespace sem {

/// For every place the mean of the values at the nearest of the points, weighted by (1/d - 1/r)^2
/// where r is the distance of the farthest of the `n_nearest` (Franke and Little): continuous, and
/// the value itself at a point. NaN where the nearest value is NaN; others that are NaN are left
/// out. 3 by #places, 3 by #points.
Eigen::VectorXd near_mean(const Points<3>& places, const Points<3>& points,
                          const Eigen::VectorXd& values, int n_nearest = 8);

}  // namespace sem
