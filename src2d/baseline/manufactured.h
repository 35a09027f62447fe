#pragma once
// Bodies in the plane for the manufactured solution.

#include "sem/scene/manufactured.h"

namespace sem::baseline {

/// Cubic parts: the unit square with m parts a side; the L that is left without its upper right
/// quarter, m parts on sides of 0.5 m, 2m on the two long ones.
std::vector<ScenePart<2>> manufactured_body(bool convex, int m);

}  // namespace sem::baseline
