#pragma once
// Bodies of the built-in scenes, and the three-curve blob of the draft's figures 4 and 5.

#include "figures/figure.h"
#include "sem/method/discretization.h"

namespace sem::figures {

/// The discretised body of a built-in scene.
Discretization<2> builtin_body(const std::string& name,
                               const std::vector<std::string>& overrides = {});

/// Adds the table `curves`: points along every part, columns part (from 0), x, y.
void add_curves(Data& data, const Boundary<2>& boundary, int per_piece = 40);

/// The points of the table `curves` in one loop, as the parts follow each other.
std::vector<Vec<2>> outline(const Data& data);

/// Colours of the draft's sketch: red, blue, green.
Color part_color(int part);

/// The parts of the table `curves`; one of them thicker (-1: none).
void draw_parts(Panel& panel, const Data& data, int highlighted = -1);

}  // namespace sem::figures
