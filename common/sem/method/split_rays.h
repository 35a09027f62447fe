#pragma once
// Exact interior rules by rays: the transverse range is split at its critical values.

#include "sem/method/cells.h"
#include "sem/method/components.h"

namespace sem {

/// Cells whose strands are stretches of rays along the axis.
/// 2D: a cell for every interval between two critical values, with the rule for its ends (root
/// where a curve turns back). Cells that continue each other are joined where the joint part needs
/// fewer rays, so smooth joints and knots cost nothing; cells that need too many are halved.
/// 3D: a plane sweeps the solid; between two of its critical heights (sweep_3d.h) n sections, in each the
/// columns between the values critical there, n rays a column. In the coordinates of the body's
/// principal axes unless parts are trimmed or face along the axes (a torus then has no saddle
/// heights); `axis` counts there. Slabs that need too many rays have their columns cut in two, or are
/// halved. Empty for an axis for which all sweeps have more slabs than one for another axis.
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
