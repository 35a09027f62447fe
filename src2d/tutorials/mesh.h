#pragma once
// A triangle mesh for tutorials on finite elements.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "src2d/tutorials/drawing.h"

namespace sem::tutorial {

struct Mesh {
  Points<2> node;
  int n_boundary;                           ///< the last nodes lie on the boundary
  std::vector<std::array<int, 3>> element;  ///< nodes anticlockwise
};

/// Rings around a middle that sees the whole boundary: node 0, then ring after ring, the last one
/// on the curves, which run clockwise over [0, 1] and meet end to end.
Mesh ring_mesh(const Curves& curves, const Vec<2>& middle, int rings);

/// The edges with the nodes at x.
void draw_mesh(Picture& picture, const Mesh& mesh, const Points<2>& x, const Color& color);

/// The mouse reads a text of the element that it is in, with the nodes at x.
void read_elements(Picture& picture, const Mesh& mesh, const Points<2>& x,
                   const std::function<std::string(int element)>& text);

}  // namespace sem::tutorial
