#pragma once
// Internal: polynomials of two variables on [0, 1]^2 in Bernstein form, and where two of them
// vanish.

#include <array>
#include <vector>

#include "sem/base/dim.h"

namespace sem::detail {

/// f(s, t) = sum c_ij B_i(s) B_j(t), i fastest.
struct Bivariate {
  std::array<int, 2> degree{};
  std::vector<double> c;  ///< (degree[0] + 1) (degree[1] + 1)
};

Bivariate product(const Bivariate& f, const Bivariate& g);
/// f + share * g of the same degrees.
Bivariate sum(const Bivariate& f, const Bivariate& g, double share = 1);
/// df/ds (axis 0) or df/dt; a degree of 0 stays 0.
Bivariate derivative(const Bivariate& f, int axis);
/// The same polynomial in higher degrees.
Bivariate raised(const Bivariate& f, const std::array<int, 2>& degree);

/// A common zero; regular: Newton's method converges there, the Jacobian is not singular.
struct CommonZero {
  Vec<2> s;
  bool regular;
};

/// Common zeros of f and g, of the same degrees, in [0, 1]^2 by subdivision: none that is regular
/// is missed. A zero on the border of two patches may be listed twice. Of a curve of common zeros
/// some points are listed, at distances of at most 1/16, not regular. None if one of the two is
/// zero to `rounding` (of f, of g) everywhere.
std::vector<CommonZero> common_zeros(const Bivariate& f, const Bivariate& g,
                                     const Vec<2>& rounding);

}  // namespace sem::detail
