#pragma once
// Exact interior rules by rays: the transverse range is split at its critical values.

#include "sem/method/cells.h"
#include "sem/method/components.h"

namespace sem {

/// Cells whose strands are stretches of rays along the axis.
/// 2D: a cell for every interval between two critical values, with the rule for its ends (root
/// where a curve turns back). Cells that continue each other are joined where the joint part needs
/// fewer rays, so smooth joints and knots cost nothing; cells that need too many are halved.
/// 3D: all intervals over a product of transverse ranges between critical values, rays at Gauss
/// points of both: exact for solids bounded by planes across the axes, of finite order elsewhere.
template <int Dim>
std::vector<Cell<Dim>> ray_cells(const Component<Dim>& component, int axis,
                                 const Yardstick<Dim>& yardstick);
template <>
std::vector<Cell<2>> ray_cells<2>(const Component<2>& component, int axis,
                                  const Yardstick<2>& yardstick);
template <>
std::vector<Cell<3>> ray_cells<3>(const Component<3>& component, int axis,
                                  const Yardstick<3>& yardstick);

}  // namespace sem
