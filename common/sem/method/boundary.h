#pragma once
// Stage 1: the parts. All NURBS of all solids in one list, prepared for
// queries, with their control points stacked into one vector p.

#include <vector>

#include "sem/nurbs/prepared.h"

namespace sem {

/// The geometry that the method starts from.
template <int Dim>
struct Boundary {
  std::vector<PreparedNurbs<Dim - 1, Dim>> parts;  ///< in a parameter in which weights are even (even_weights.h) unless trimmed
  std::vector<int> solid;          ///< #parts: the solid that a part bounds, 0-based
  std::vector<int> first_control;  ///< #parts + 1: where a part's control points start in p
  int n_solids = 0;
  Box<Dim> box;

  int n_parts() const { return int(parts.size()); }
  int n_controls() const { return first_control.back(); }
  /// Lengths below this are rounding: 1e-9 of the size of the model.
  double tolerance() const { return 1e-9 * box.diagonal(); }
};

/// Stacks and prepares the parts of every solid. `trims`: the loops that each part is trimmed to, parts of all
/// solids in one list; empty: no part is trimmed (trims.h; surfaces only).
/// Throws InputError (field `solids`) if there is no part at all, and as make_region does.
template <int Dim>
Boundary<Dim> make_boundary(const std::vector<std::vector<Nurbs<Dim - 1, Dim>>>& solids,
                            const std::vector<TrimLoops>& trims = {});

/// Rest control points, Dim by n_controls().
template <int Dim>
Points<Dim> rest_controls(const Boundary<Dim>& boundary);

/// Groups of control points (indices into p) that coincide at rest: pinned
/// together where neighbouring parts meet. Only groups of two or more.
template <int Dim>
std::vector<std::vector<int>> coincident_controls(const Boundary<Dim>& boundary);

}  // namespace sem
