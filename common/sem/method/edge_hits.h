#pragma once
// Hits on the border of a part, where other parts may meet it.

#include "sem/nurbs/hits.h"

namespace sem {

/// True if the parts that meet at the hit may count it differently: then parity tells nothing.
/// 2D: never, crossings at the ends of curves are consistent (hits.h).
/// 3D: on the border of the patch's domain, to 1e-9 of it.
template <int Dim>
bool is_in_doubt(const PreparedNurbs<Dim - 1, Dim>& part, const Hit<Dim>& hit);

template <>
inline bool is_in_doubt<2>(const PreparedNurbs<1, 2>&, const Hit<2>&) {
  return false;
}

template <>
inline bool is_in_doubt<3>(const PreparedNurbs<2, 3>& part, const Hit<3>& hit) {
  for (int axis = 0; axis < 2; ++axis) {
    const Interval range = domain(part.nurbs, axis);
    const double near = 1e-9 * (range.upper - range.lower);
    if (hit.u[axis] - range.lower <= near || range.upper - hit.u[axis] <= near) return true;
  }
  return false;
}

}  // namespace sem
