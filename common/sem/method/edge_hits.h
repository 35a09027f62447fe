#pragma once
// Hits on the border of a part, where other parts may meet it.

#include "sem/nurbs/hits.h"

namespace sem {

/// True if u lies on the border of the patch's domain, or of what it is trimmed to, to a share of its size.
inline bool on_border(const PreparedNurbs<2, 3>& patch, const Param<2>& u, double share) {
  if (patch.region) return patch.region->near_border(u, share);
  for (int axis = 0; axis < 2; ++axis) {
    const Interval range = domain(patch.nurbs, axis);
    const double near = share * (range.upper - range.lower);
    if (u[axis] - range.lower <= near || range.upper - u[axis] <= near) return true;
  }
  return false;
}

/// True if the parts that meet at the hit may count it differently: then parity tells nothing.
/// 2D: never, crossings at the ends of curves are consistent (hits.h).
/// 3D: on the patch's border, to 1e-9 of its domain.
template <int Dim>
bool is_in_doubt(const PreparedNurbs<Dim - 1, Dim>& part, const Hit<Dim>& hit);

template <>
inline bool is_in_doubt<2>(const PreparedNurbs<1, 2>&, const Hit<2>&) {
  return false;
}

template <>
inline bool is_in_doubt<3>(const PreparedNurbs<2, 3>& part, const Hit<3>& hit) {
  return on_border(part, hit.u, 1e-9);
}

}  // namespace sem
