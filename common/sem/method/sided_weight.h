#pragma once
// What the sided distance weight is made of: a smooth profile of the distance and a smooth step of
// the side of the part on which a point lies.

#include <algorithm>
#include <cmath>

#include "sem/nurbs/basis.h"

namespace sem {

/// A function and its derivative at one argument.
struct Slope {
  double value, derivative;
};

/// (1 - t)^4 e / (t + e), e = 0.3, of t = distance / alpha: 1 on the part, 0 from t = 1 on, smooth there, so
/// that rules that do not know where supports end converge faster, and steep near the part, so that parts
/// keep to themselves there. (Tried with the same unknowns on a beam: 1 - t, (1 - t)^2 and
/// (1 - t)^4 (1 + 4 t) have larger errors.)
inline Slope distance_profile(double t) {
  constexpr double e = 0.3;
  if (t >= 1) return {0, 0};
  const double s = 1 - t, cube = s * s * s, q = 1 / (t + e);
  return {cube * s * e * q, -e * cube * q * (4 + s * q)};
}

/// h(1 + side / ramp), h(x) = x^2 (3 - 2 x): 0 below -ramp, 1 above 0, once differentiable.
inline Slope side_step(double side, double ramp) {
  const double t = std::clamp(1 + side / ramp, 0.0, 1.0);
  return {t * t * (3 - 2 * t), 6 * t * (1 - t) / ramp};
}

/// u, or where the part has no normal, at a pole or an edge that is collapsed to a point, a parameter 1e-6
/// of the way to the domain's middle: what it has there is its limit.
template <int Dim>
Param<Dim - 1> regular_parameter(const Nurbs<Dim - 1, Dim>& shape, const Param<Dim - 1>& u) {
  double area = DimTraits<Dim>::area_normal(derivatives(shape, u, 1).first).norm();
  const auto& p = shape.control_points;
  const double size = (p.rowwise().maxCoeff() - p.rowwise().minCoeff()).norm();
  Param<Dim - 1> middle;
  for (int axis = 0; axis < Dim - 1; ++axis) {
    const Interval range = domain(shape, axis);
    middle[axis] = (range.lower + range.upper) / 2;
    area *= (range.upper - range.lower) / size;
  }
  return area > 1e-9 ? u : Param<Dim - 1>(u + 1e-6 * (middle - u));
}

/// Unit normal of a part, right of its direction of travel (2D) or along X_u x X_v (3D); its limit where the part
/// is collapsed.
template <int Dim>
Vec<Dim> unit_normal(const Nurbs<Dim - 1, Dim>& shape, const Param<Dim - 1>& u) {
  const Vec<Dim> normal = DimTraits<Dim>::area_normal(derivatives(shape, regular_parameter<Dim>(shape, u), 1).first);
  return normal / std::max(normal.norm(), std::numeric_limits<double>::min());
}

}  // namespace sem
