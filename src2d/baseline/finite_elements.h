#pragma once
// What the method is measured against: a finite-element solver of our own. Quadratic triangles with
// straight edges on a grid of a quadrilateral, plane strain, static, any material; sparse Cholesky.
// It shares nothing with the method but the materials. One thread.

#include <array>
#include <functional>
#include <vector>

#include "sem/base/dim.h"
#include "sem/mechanics/material.h"

namespace sem::baseline {

/// Sides of a quadrilateral with corners 0 to 3 anticlockwise: from corner 0 to 1, 1 to 2, 2 to 3,
/// 3 to 0.
enum Side { bottom, right, top, left };
using Corners = std::array<Vec<2>, 4>;

/// Place of division k of n in [0, 1]: (k / n)^grading, or so from both ends to the middle.
double graded_place(int k, int n, double grading, bool from_both_ends);

/// n_x by n_y cells, each halved into two triangles by the diagonal from its lower left corner.
struct Mesh {
  int n_x = 0, n_y = 0;
  Points<2> nodes;  ///< m; (2 n_x + 1) (2 n_y + 1): corners of cells and middles of edges
  std::vector<std::array<int, 6>>
      elements;  ///< three corners anticlockwise, middles of edges 01, 12, 20

  /// The node of column i (0 on the left, 2 n_x on the right) and row j (0 at the bottom).
  int node(int i, int j) const { return i + (2 * n_x + 1) * j; }
  std::vector<int> nodes_on(Side side) const;  ///< 2 n_x + 1 or 2 n_y + 1, from left or bottom
};

/// The bilinear image of a grid on the unit square with graded rows and columns, the rows from both
/// ends. With grading > 1 cells are small at the corners of the left side, `to_both_sides`: at all
/// corners.
Mesh quadrilateral_mesh(const Corners& corners, int n_x, int n_y, double grading = 1,
                        bool to_both_sides = false);

struct Problem {
  Material material;
  Vec<2> gravity = Vec<2>::Zero();  ///< m/s^2
  std::array<Vec<2>, 4> traction = {Vec<2>::Zero(), Vec<2>::Zero(), Vec<2>::Zero(),
                                    Vec<2>::Zero()};       ///< Pa, dead
  std::array<bool, 4> held = {false, false, false, true};  ///< sides whose displacement is given
  std::function<Vec<2>(const Vec<2>& X)> held_displacement = {};  ///< m; none: 0
};

struct Solution {
  Points<2> displacement;  ///< m, of each node
  double energy = 0;       ///< strain energy, J
  int n_unknowns = 0;      ///< components of all nodes, held ones included
  int iterations = 0;      ///< of Newton's method
  bool converged = false;  ///< residual <= 1e-10 of the largest force, reactions included
  double preparation_seconds = 0,
         solve_seconds = 0;  ///< processor time: pattern and ordering; Newton
};

/// Minimises sum_e int Psi(F) dA - load . u by Newton's method with line search, from u = 0, in one
/// load step. Three quadrature points an element. A Hessian that is not positive definite is
/// assembled anew from the nearest positive semi-definite dP/dF.
Solution solve_static(const Mesh& mesh, const Problem& problem);

}  // namespace sem::baseline
