#pragma once
// What stands around the body in every frame, and colours that all frames share.

#include <string>

#include "sem/draw/canvas.h"
#include "sem/scene/scene.h"

namespace sem::picture {

constexpr Color ink{0.13, 0.14, 0.18}, label_ink{0.35, 0.36, 0.4};
constexpr Color pin_color = colors::okabe_ito[1];

/// Tint of a solid: far from viridis, so that stress stays readable on it.
Color tint(int solid);

/// Lengths in frames are in units of a canvas of 800 x 600: pixels of this canvas per unit.
double unit(const Canvas& canvas);

/// Name of the scene at the left, what moment it is at the right, above the area; between them how
/// many points are inverted, if any.
void draw_titles(Canvas& canvas, const Box<2>& area, const std::string& name,
                 const Analysis& analysis, const OutputOptions& output, const State& state,
                 int n_inverted);

/// The colour bar of stresses from 0 to the limit (Pa), right of the area, with the largest stress
/// of this frame below.
void draw_stress_bar(Canvas& canvas, const Box<2>& area, double limit, double largest,
                     const Analysis& analysis);

}  // namespace sem::picture
