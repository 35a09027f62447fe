#pragma once
// Internal: a surface cut into cells with boxes along their tangents, for the search of closest
// points.

#include <vector>

#include "sem/nurbs/distance_bounds.h"
#include "sem/nurbs/surface_patch.h"

namespace sem::detail {

/// A piece, a quarter of one, or a quarter of that.
struct SurfaceCell {
  SurfacePatch patch;
  int piece = 0;
  int first_child = -1;        ///< of four; -1: none
  long first_coefficient = 0;  ///< of a cell without children
  Vec<3> centre, half;  ///< of a box that holds its control points, about SurfaceCells::origin
  Mat<3> axes;          ///< rows: of the box, the last one across the cell

  /// |N - w X|^2 - m w^2 = |N|^2 - 2 X.(w N) + (X^2 - m) w^2, N = w C and X about the centre: least
  /// and largest second derivative uu, vv, uv, in the patch's parameters, of |N|^2, the three w N
  /// and w^2.
  struct Range {
    double lower, upper;
  };
  Range second[3][5];
  double least_v, largest_v;  ///< of w^2

  /// Bounds for X, given about the origin, and m.
  DistanceCurvature curvature(const Vec<3>& X, double m) const;
  /// From X, given about the origin, to the box.
  double distance(const Vec<3>& X) const {
    return ((axes * (X - centre)).cwiseAbs() - half).cwiseMax(0.0).norm();
  }
};

struct SurfaceCells {
  Vec<3> origin;
  std::vector<SurfaceCell> cells;  ///< those of whole pieces first, in their order
  std::vector<Vec4> coefficients;  ///< w (P - origin), w; balanced
  std::vector<char> rational;      ///< #pieces: its weights differ
};

/// At most two levels of quarters a piece, none where it is flat.
std::shared_ptr<const SurfaceCells> make_surface_cells(const PreparedNurbs<2, 3>& part);

}  // namespace sem::detail
