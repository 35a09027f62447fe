#pragma once
// Internal: a patch of a rational Bezier piece, for the search of closest points.

#include <array>

#include "sem/nurbs/prepared.h"

namespace sem::detail {

using Vec4 = Eigen::Vector4d;  // w P, w of a control point P (whichever origin)

/// A box of the piece's parameters s in [0, 1]^2. Along each axis the patch runs in the parameter t
/// in [0, 1] that makes the weights of its ends equal (Moebius),
///   s = lower + (upper - lower) r t / (1 - t + r t):
/// halved there, weights of 1, w, 1 become those of 1, about sqrt(w / 2), 1.
struct SurfacePatch {
  Vec<2> lower = Vec<2>::Zero(), upper = Vec<2>::Ones();
  Vec<2> ratio = Vec<2>::Ones();  ///< r of each axis
  int halvings = 0;

  /// s at t.
  Vec<2> parameter(const Vec<2>& t) const {
    const Vec<2> along = ratio.cwiseProduct(t);
    return lower + (upper - lower).cwiseProduct(along.cwiseQuotient(Vec<2>::Ones() - t + along));
  }
  /// t at s.
  Vec<2> place(const Vec<2>& s) const {
    const Vec<2> share = (s - lower).cwiseQuotient(upper - lower);
    return share.cwiseQuotient(share + ratio.cwiseProduct(Vec<2>::Ones() - share));
  }
  /// ds/dt at s.
  Vec<2> speed(const Vec<2>& s) const;
};

/// Makes the products of the weights at both ends of each axis equal.
void balance(SurfacePatch& patch, Vec4* c, const std::array<int, 2>& degree);

/// The quarters of a patch about t, its coefficients in c[0] on entry, theirs in c[0] to c[3]
/// after. `rational`: balanced.
void split(const SurfacePatch& patch, const Vec<2>& t, const std::array<int, 2>& degree,
           bool rational, const std::array<Vec4*, 4>& c, std::array<SurfacePatch, 4>& quarters);

}  // namespace sem::detail
