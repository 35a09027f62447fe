#pragma once
// Internal: curves on a surface as curves in space, for closest points.

#include "sem/nurbs/closest.h"

namespace sem::detail {

/// The images of plane curves under a surface: polynomials in space that follow them to 1e-13 of
/// the surface's size, cut where the curves cross knot lines.
class BorderCurves {
 public:
  BorderCurves() = default;
  BorderCurves(const PreparedNurbs<2, 3>& surface,
               const std::vector<const PreparedNurbs<1, 2>*>& curves);

  /// The closest point of all curves: all roots of (C - X) . C' on every piece that may be closer
  /// than the best one, then polished on the surface itself. Conventions of closest_point.
  ClosestPoint<3> closest(const PreparedNurbs<2, 3>& surface,
                          const std::vector<const PreparedNurbs<1, 2>*>& curves, const Vec<3>& X,
                          double cutoff) const;
  const Box<3>& box() const { return box_; }

 private:
  static constexpr int degree = 7;
  struct Piece {
    int curve;
    double lower, upper;  // of the curve's parameter
    Box<3> box;
    Vec<3> center;
    Eigen::Matrix<double, 3, degree + 1> points;  // less the center, Bernstein form
    Eigen::Matrix<double, 1, 2 * degree> foot;    // C . C'
    Eigen::Matrix<double, 3, 2 * degree> slope;   // C', raised to the same degree
  };

  void add(const PreparedNurbs<2, 3>& surface, const PreparedNurbs<1, 2>& curve, int index,
           double lower, double upper, int halvings);

  std::vector<Piece> pieces_;
  Box<3> box_;
};

}  // namespace sem::detail
