#pragma once
// Internal: a plane curve cut into cells that are nearly straight, for the
// search of closest points.

#include <vector>

#include "sem/nurbs/kernels.h"
#include "sem/nurbs/prepared.h"

namespace sem::detail {

/// The stretch [a, b] of [0, 1] of a piece.
struct FootCell {
  int piece;
  double a, b;
  /// Bernstein coefficients (k, 0..2) on the stretch of a polynomial that has the sign of
  /// (C(s) - X).C'(s): foot(0, k) - foot(1..2, k).(X - centre of the piece's box), for any X.
  /// Closest points are among its roots.
  Eigen::Matrix<double, 3, Eigen::Dynamic> foot;
  double largest, largest_slope;  ///< of |foot(0, k)|, of |foot(1, k)| + |foot(2, k)|
  FootForm form;                  ///< the same for the kernels; rows null above degree 15
};

struct FootCells {
  std::vector<FootCell> cells;  ///< along the curve
  ChordForm chords;             ///< of the cells
  struct alignas(32) Lanes {
    double value[4];
  };
  std::vector<Lanes> chord_storage, form_storage;
};

/// Halves the pieces until each cell is within 1e-3 of the part's size of its chord, at most
/// thrice.
std::shared_ptr<const FootCells> make_foot_cells(const PreparedNurbs<1, 2>& part);

}  // namespace sem::detail
