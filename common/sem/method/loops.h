#pragma once
// What a solid's parts enclose, whatever their order, orientation and gaps.

#include <vector>

#include "sem/method/boundary.h"

namespace sem {

/// One closed boundary: parts that meet end to end.
template <int Dim>
struct Loop {
  int solid = 0;
  std::vector<int> parts;
  std::vector<int> caps;  ///< indices into Loops::caps: straight closures of the gaps
  int depth = 0;          ///< number of other loops of the solid that contain it
  double gap = 0;         ///< 3D, m: the widest gap between its patches, 0 if below Boundary::tolerance()
  int n_free_borders = 0;  ///< 3D: edges of patches that lie beside no other: an open shell
  bool closed() const { return n_free_borders == 0; }
};

/// All loops of all solids.
///
/// The rule of the inside. 2D: open parts of a solid are joined end to end, the
/// closest pair of ends first; where two joined ends differ, be it by
/// rounding, or a part jumps at a knot, a straight cap closes the loop (it bounds the inside, it carries
/// no unknowns). 3D: patches belong together if a corner of the one lies on an edge of the other, and shells
/// of which a free edge runs along those of the other as close as 0.05 of its length; gaps stay open. A point is inside
/// a loop by parity along a line, where there are gaps or free edges along most of nine; inside a solid if the
/// deepest of the solid's loops that contain it has even depth, so a hole is
/// empty, an island in a hole is full and loops that cross are united; inside
/// the body if inside any solid. Orientation is never used; it is found:
/// orientation[i] * (normal of part i) points out of the material.
///
/// Doubts, reported: caps (3D: gaps) longer than Boundary::tolerance(), and free edges.
template <int Dim>
struct Loops {
  std::vector<Loop<Dim>> loops;
  std::vector<PreparedNurbs<Dim - 1, Dim>> caps;
  std::vector<int> cap_orientation;   ///< #caps, +-1
  std::vector<double> cap_length;     ///< #caps
  std::vector<int> orientation;       ///< #parts, +-1, 0: not decided
  double longest_gap = 0;             ///< the longest cap, 0 if there is none; 3D: the widest gap
  int n_gaps = 0;                     ///< caps longer than the tolerance; 3D: edges of patches with such a gap
  int n_free_borders = 0;             ///< 3D: edges of patches that lie beside no other patch of their loop
};

/// Joins the parts of each solid into loops and nests them.
template <int Dim>
Loops<Dim> find_loops(const Boundary<Dim>& boundary);

/// True if X lies inside loop l of loops.loops, by parity.
template <int Dim>
bool inside_loop(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int l, const Vec<Dim>& X);

/// True if X lies inside solid (-1: inside any). A point on the boundary may go either way.
template <int Dim>
bool inside(const Boundary<Dim>& boundary, const Loops<Dim>& loops, const Vec<Dim>& X, int solid = -1);

}  // namespace sem
