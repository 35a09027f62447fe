#pragma once
// Internal: control points along one axis as combinations of others, which
// is all that refinement, elevation and Bezier extraction do.

#include <utility>
#include <vector>

#include "sem/nurbs/nurbs.h"

namespace sem::detail {

/// New control point i along the axis = sum_k coefficient[i * width + k] *
/// old control point first[i] + k. The coefficients of a row sum to 1.
struct AxisMap {
  int width = 0;           ///< old degree + 1
  std::vector<int> first;  ///< one per new control point
  std::vector<double> coefficient;
};

/// Index k of the knot span [knots[k], knots[k+1]) of the domain that holds
/// u; u outside is moved to the end, the end belongs to the last span.
int find_span(const std::vector<double>& knots, int degree, double u);

/// Appends the row that gives the polar form of span k at `arguments`
/// (#degree): the control points of span k weighted by the de Boor scheme
/// with a different parameter in each step (Ramshaw). Coefficients at a
/// knot of full multiplicity are exactly 0 and 1.
void append_polar_form(const std::vector<double>& knots, int degree, int k, const double* arguments,
                       AxisMap& map);

/// The map to a finer knot vector of the same degree (Oslo algorithm).
AxisMap map_to_knots(const std::vector<double>& knots, int degree,
                     const std::vector<double>& finer);

/// Applies the map along an axis: new Cartesian control points and weights.
template <int ParamDim, int Dim>
void apply(const AxisMap& map, int axis, Nurbs<ParamDim, Dim>& nurbs);

}  // namespace sem::detail
