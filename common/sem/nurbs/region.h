#pragma once
// The region of its parameter domain that a part is trimmed to, as hits and closest points see it.

#include <vector>

#include "sem/nurbs/nurbs.h"

namespace sem {

template <int Dim>
struct ClosestPoint;

/// What a box of parameters has in common with a region.
enum class Overlap { none, some, all };

/// Closed loops of curves in the (u, v) plane of a surface, any order and orientation, nested by
/// parity: what a part is trimmed to. None: all of its domain. Curves have no plane and no trims.
using TrimLoops = std::vector<std::vector<Nurbs<1, 2>>>;

/// Points and weights on the parameter domain.
template <int ParamDim>
struct ParameterRule {
  std::vector<Param<ParamDim>> u;
  std::vector<double> weight;  ///< > 0, sum to the measure of what is integrated over
};

/// A point of the region's border with the derivatives of the curve that runs there.
template <int ParamDim>
struct BorderPoint {
  Param<ParamDim> u, first, second;
};

/// The closed region of a part's parameter domain that belongs to it. Its border is that of the
/// part in space: no other ends count. Lengths below 1e-9 of the domain's diagonal are rounding.
template <int ParamDim, int Dim>
class Region {
 public:
  virtual ~Region() = default;
  /// Whether the part has a point at u; also true within rounding of the border.
  virtual bool contains(const Param<ParamDim>& u) const = 0;
  /// Whether u is as close to the border as this share of the domain's diagonal.
  virtual bool near_border(const Param<ParamDim>& u, double share) const = 0;
  /// What the box has in common with the region; `some` is also the answer where that is not known.
  virtual Overlap overlap(const Param<ParamDim>& lower, const Param<ParamDim>& upper) const = 0;
  /// The closest point of the border in space, as closest_point.
  virtual ClosestPoint<Dim> closest_on_border(const Vec<Dim>& X, double cutoff) const = 0;
  /// The border's point closest to u in the parameter plane.
  virtual BorderPoint<ParamDim> border_near(const Param<ParamDim>& u) const = 0;
  /// Holds the trimmed part: tight where it is flat, else by some percent of its size.
  virtual const Box<Dim>& box() const = 0;
  /// Points in space along every curve of the border, equally spaced in its parameter, ends included.
  virtual const std::vector<std::vector<Vec<Dim>>>& borders() const = 0;
  /// Rule over the region with n points (n >= 1) in every direction of every piece on which the
  /// part is smooth; exact on straight borders for polynomials as Gauss' rule, converging fast on
  /// curved ones.
  virtual ParameterRule<ParamDim> rule(int n) const = 0;
};

}  // namespace sem
