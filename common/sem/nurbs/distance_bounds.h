#pragma once
// Internal: bounds over a rational patch of the squared distance from a point, q / v in Bernstein
// form.

#include <array>
#include <vector>

#include "sem/base/dim.h"

namespace sem::detail {

using Vec4 = Eigen::Vector4d;  // w (P - X), w of a control point P

/// Bounds of the second derivatives of f = q - m v in a patch's own parameters, and of v.
struct DistanceCurvature {
  double uu, vv, uv;  ///< at least; at least; |f_uv| at most
  double least_v, largest_v;
};

/// q = |w (C - X)|^2 and v = w^2 of a patch.
class DistanceBounds {
 public:
  /// From the patch's coefficients, u fastest. Returns the least q_i / v_i, a lower bound of the
  /// squared distance, and where it is, among the coefficients of degree (2p, 2q). `kernel`:
  /// degrees of at most 12.
  double set(const Vec4* c, const std::array<int, 2>& degree, bool kernel, int& where);

  DistanceCurvature curvature(double m);

  /// True if the patch has at most one stationary point of q / v with a value from m to `most`.
  /// With the value M it is one of q - M v, whose coefficients are linear in M.
  bool at_most_one_stationary(double m, double most);

 private:
  std::array<int, 2> degree_{};
  std::vector<Vec4> scaled_, square_;
  std::vector<double> q_, v_, f_;  // q and v times the binomials
};

}  // namespace sem::detail
