#pragma once
// The three-curve blob of the draft's figures 4 and 5, from the built-in scene.

#include "figures/panel.h"
#include "sem/draw/view.h"
#include "sem/method/discretization.h"

namespace sem::figures {

/// The discretised body of a built-in scene.
Discretization<2> builtin_body(const std::string& name,
                               const std::vector<std::string>& overrides = {});

/// Points along every part, rows (part, x, y); part from 0.
std::vector<std::array<double, 3>> part_points(const Boundary<2>& boundary, int per_piece = 40);

/// Colours of the draft's sketch: red, blue, green.
Color part_color(int part);

/// The parts' curves from rows with columns x, y and `part_column`; one of them thicker (-1: none).
void draw_parts(Canvas& canvas, const View2& view, const Data& curves,
                const std::string& part_column, int highlighted);

}  // namespace sem::figures
