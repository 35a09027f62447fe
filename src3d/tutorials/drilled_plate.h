#pragma once
// The solid of the tutorials on trims and CAD files.

#include "sem/scene/scene.h"

namespace sem::tutorial {

/// The arcs of a circle as one closed loop.
std::vector<Nurbs<1, 2>> circle(const Vec<2>& center, double radius);
/// The sides of the unit square, as the border of a domain.
std::vector<Nurbs<1, 2>> square();

/// The rectangle [0, 1]^2 at height z with u = x, v = y; biquadratic, each direction cut at n - 1
/// knots.
Nurbs<2, 3> square_patch(double z, int n = 1);

/// The plate [0, 1] x [0, 1] x [0, height] with a hole along z: four sides, "bottom" and "top" as
/// square_patch() trimmed to what the hole leaves, the hole's wall in four patches. All of
/// degree 2.
std::vector<ScenePart<3>> drilled_plate(const Vec<2>& center, double radius, double height,
                                        int n = 1);

}  // namespace sem::tutorial
