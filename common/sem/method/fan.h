#pragma once
// Exact interior rules by a fan: an ellipse inside, and segments from it to the boundary.

#include "sem/method/cells.h"
#include "sem/method/components.h"

namespace sem {

/// Cells of a body that is star-shaped about a center: an ellipse inside (the core: chords at
/// Gauss-Chebyshev points, which needs few points whatever the boundary's knots), and for every
/// Bezier piece the strands from the core to it, along lines from the center. Axes of the ellipse
/// from the body's second moments; center where it can be largest; positive weights because the
/// center sees all of the boundary. Empty where no fan applies: more than one loop, or a boundary
/// that is not star-shaped about that center. 3D: always empty.
template <int Dim>
std::vector<Cell<Dim>> fan_cells(const Component<Dim>& component, const Yardstick<Dim>& yardstick);
template <>
std::vector<Cell<2>> fan_cells<2>(const Component<2>& component, const Yardstick<2>& yardstick);
template <>
std::vector<Cell<3>> fan_cells<3>(const Component<3>& component, const Yardstick<3>& yardstick);

}  // namespace sem
