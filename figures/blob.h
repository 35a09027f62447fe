#pragma once
// The three-curve blob of the draft's figures 4 and 5, from the built-in scene.

#include "figures/panel.h"
#include "sem/method/discretization.h"

namespace sem::figures {

/// The discretised body of a built-in scene.
Discretization<2> builtin_body(const std::string& name, const std::vector<std::string>& overrides = {});

/// Points along every part, rows (part, x, y); part from 0.
std::vector<std::array<double, 3>> part_points(const Boundary<2>& boundary, int per_piece = 40);

/// Colours of the draft's sketch: red, blue, green.
Color part_color(int part);

}  // namespace sem::figures
