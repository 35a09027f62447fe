#pragma once
// NURBS of any parameter and space dimension: curves in the plane (parts in
// 2D, later trim curves), surfaces in space (parts in 3D).

#include <array>
#include <string>
#include <vector>

#include "sem/base/dim.h"

namespace sem {

/// A rational tensor-product B-spline, R^ParamDim -> R^Dim (draft eq. 7-8).
/// Any degree >= 1 and any non-decreasing knot vector: clamped or not,
/// repeated knots (also to discontinuity, multiplicity degree + 1).
/// Its domain along an axis is [knots[degree], knots[#control points]].
template <int ParamDim, int Dim>
struct Nurbs {
  std::array<int, ParamDim> degree{};
  std::array<std::vector<double>, ParamDim> knots;  ///< #control points along the axis + degree + 1
  Points<Dim> control_points;                       ///< Dim by n, first parameter fastest
  Eigen::VectorXd weights;                          ///< n, > 0
};

/// Largest degree of a NURBS; check() rejects higher ones. Evaluation, hits
/// and closest points keep their scratch on the stack because of it.
constexpr int max_nurbs_degree = 32, max_nurbs_functions = max_nurbs_degree + 1;  // functions that are not zero at a parameter

/// A closed interval of the parameter.
struct Interval {
  double lower, upper;
};

/// Throws InputError unless the NURBS is valid: degree 1 to max_nurbs_degree;
/// at least degree + 1 control points along each axis; knots finite,
/// non-decreasing, as many as needed, none repeated more than degree + 1
/// times; a domain that is not empty; coordinates finite; weights finite
/// and > 0. `field` names the NURBS in the file, e.g. "parts[2]"; the error
/// names what is wrong inside it, e.g. "parts[2].knots[4]" (surfaces:
/// "parts[2].knots_u[4]").
template <int ParamDim, int Dim>
void check(const Nurbs<ParamDim, Dim>& nurbs, const std::string& file, const std::string& field);

/// Number of control points along an axis.
template <int ParamDim, int Dim>
int n_control(const Nurbs<ParamDim, Dim>& nurbs, int axis) {
  return int(nurbs.knots[axis].size()) - nurbs.degree[axis] - 1;
}

/// Parameter interval along an axis.
template <int ParamDim, int Dim>
Interval domain(const Nurbs<ParamDim, Dim>& nurbs, int axis) {
  return {nurbs.knots[axis][nurbs.degree[axis]], nurbs.knots[axis][n_control(nurbs, axis)]};
}

/// The knot spans of positive length that make up the domain, in order.
template <int ParamDim, int Dim>
std::vector<Interval> spans(const Nurbs<ParamDim, Dim>& nurbs, int axis);

/// Whether both ends of the axis are the same point (curve) or the same
/// curve with the same parameter (surface), to 1e-12 of the largest
/// coordinate difference.
template <int ParamDim, int Dim>
bool is_closed(const Nurbs<ParamDim, Dim>& nurbs, int axis);

}  // namespace sem
