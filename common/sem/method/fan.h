#pragma once
// Exact interior rules by a fan: an ellipse (ellipsoid) inside, and segments from it to the boundary.

#include "sem/method/cells.h"
#include "sem/method/components.h"

namespace sem {

/// Cells of a body that is star-shaped about a center: an ellipsoid inside (the core: chords at
/// Gauss-Chebyshev points, Gauss-Legendre from section to section in 3D, which needs few points
/// whatever the boundary's knots), and for every Bezier piece, or trimmed part, the strands from the
/// core to it, along lines from the center. Axes of the ellipsoid from the body's second moments;
/// center where it can be largest; positive weights because the center sees all of the boundary.
/// Empty where no fan applies: more than one loop, a side that is not known, a boundary that is not
/// closed, or not star-shaped about that center.
template <int Dim>
std::vector<Cell<Dim>> fan_cells(const Component<Dim>& component, const Yardstick<Dim>& yardstick);

}  // namespace sem
