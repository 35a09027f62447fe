#pragma once
// Surfaces as triangles and lines, for drawing only.

#include "sem/nurbs/prepared.h"
#include "src3d/render/render_scene.h"

namespace sem::render {

struct Flatness {
  double distance;         ///< m: how far triangles and lines may be from the surface
  int least_cells = 1;     ///< a power of two: along u and v of every piece, for colours
  double max_turn = 0.35;  ///< radians between the normals of neighbouring vertices
};

/// A grid of triangles on every Bezier piece, as fine along u and v as the tolerance asks for, in
/// powers of two up to 128. Vertices inside a piece lie on the surface; those on a piece's edge lie
/// on the chain of points that the edge by itself asks for, so that pieces and parts that share an
/// edge (as the same curve, run either way) leave no crack. Normals are du x dv, exact; at a
/// collapsed edge their limit. Of a trimmed surface what its trims leave, cut straight in cells of 1/64 of a piece
/// or less, with corners of its own for every triangle.
Mesh tessellate(const PreparedNurbs<2, 3>& surface, const Flatness& flatness);

/// Unit normal along du x dv. Where the derivatives vanish or are parallel (poles, collapsed edges)
/// its limit from inside the piece.
Vec<3> unit_normal(const PreparedNurbs<2, 3>& surface, const Param<2>& u);

using Chain = std::vector<Vec<3>>;

/// Isoparametric lines: the four sides of the domain and `between` lines inside every knot span,
/// both directions; with knots, lines along the knots in between as well.
std::vector<Chain> isoparametric_lines(const PreparedNurbs<2, 3>& surface, int between, bool knots,
                                       const Flatness& flatness);
/// The sides of the domain alone, or of a trimmed surface its trims, in segments.
std::vector<Chain> outline(const PreparedNurbs<2, 3>& surface, const Flatness& flatness);
/// Rows and columns of control points.
std::vector<Chain> control_net(const Nurbs<2, 3>& surface);

}  // namespace sem::render
