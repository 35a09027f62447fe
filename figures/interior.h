#pragma once
// Fields over the inside of a body: cells, and the weights in them.

#include "figures/figure.h"
#include "sem/method/discretization.h"

namespace sem::figures {

/// Centres of the square cells over the body's box that lie inside; n_cells along its longer side.
Points<2> cells_inside(const Discretization<2>& body, int n_cells);

/// theta of every part at every point by the variant, the body's cutoff: #points by #parts, 0 where
/// none.
Eigen::MatrixXd theta_field(const Discretization<2>& body, const Points<2>& position,
                            DistanceWeight variant);
/// w likewise; rows sum to 1. Needs the body's boundary, loops and weight options alone.
template <int Dim>
Eigen::MatrixXd weight_field(const Discretization<Dim>& body, const Points<Dim>& position,
                             DistanceWeight variant);

/// The inside of a body on the plane of constant z, as triangles: square cells, n_cells along the
/// longer side of the body's box, cut where they leave the body.
struct Slice {
  Points<3> position;
  std::vector<std::array<int, 3>> triangles;  ///< anticlockwise seen from above
};
Slice slice_inside(const Discretization<3>& body, double z, int n_cells);

/// Quadrilaterals that follow the boundary: corners of square cells of the size, those outside
/// moved to the closest point of a part.
struct Quads {
  Points<2> corner;                       ///< 2 by #corners, rest position, m
  std::vector<std::array<int, 4>> quads;  ///< corners anticlockwise
};
Quads fitted_quads(const Discretization<2>& body, double size);

}  // namespace sem::figures
