#pragma once
// The simplest NURBS: one Bezier piece on [0, 1].

#include "sem/nurbs/nurbs.h"

namespace sem {

/// Curve of degree #points - 1 with these control points and weights.
template <int Dim>
Nurbs<1, Dim> bezier_curve(const Points<Dim>& points, const Eigen::VectorXd& weights) {
  const int order = int(points.cols());
  Nurbs<1, Dim> curve;
  curve.degree = {order - 1};
  curve.knots[0].assign(order, 0.0);
  curve.knots[0].insert(curve.knots[0].end(), order, 1.0);
  curve.control_points = points;
  curve.weights = weights;
  return curve;
}

/// The straight segment from a to b.
template <int Dim>
Nurbs<1, Dim> segment(const Vec<Dim>& a, const Vec<Dim>& b) {
  Points<Dim> ends(Dim, 2);
  ends << a, b;
  return bezier_curve<Dim>(ends, Eigen::VectorXd::Ones(2));
}

}  // namespace sem
