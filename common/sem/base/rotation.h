#pragma once
// Turns of the plane and of space.

#include <algorithm>
#include <cmath>

#include "sem/base/dim.h"

namespace sem {

/// (cos, sin) of an angle in rad; exact at multiples of 90 degrees.
inline Vec<2> direction(double angle) {
  const double quarters = std::round(angle / (M_PI / 2));
  const double rest = angle - quarters * (M_PI / 2);
  const bool exact = std::abs(rest) < 1e-15 * std::max(1.0, std::abs(angle));
  const double c = exact ? 1 : std::cos(rest), s = exact ? 0 : std::sin(rest);
  switch (((int(std::fmod(quarters, 4)) + 4) % 4)) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

/// The turn by a rotation vector, angle in rad times axis (2D: the angle, anticlockwise):
/// Rodrigues' formula.
template <int Dim>
Mat<Dim> rotation(const Vec<DimTraits<Dim>::n_rotations>& vector);

template <>
inline Mat<2> rotation<2>(const Vec<1>& vector) {
  const Vec<2> e = direction(vector[0]);
  return (Mat<2>() << e[0], -e[1], e[1], e[0]).finished();
}

template <>
inline Mat<3> rotation<3>(const Vec<3>& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Mat<3>::Identity();
  const Vec<3> a = vector / angle;
  const Vec<2> e = direction(angle);
  const Mat<3> cross = (Mat<3>() << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0).finished();
  return e[0] * Mat<3>::Identity() + e[1] * cross + (1 - e[0]) * a * a.transpose();
}

}  // namespace sem
