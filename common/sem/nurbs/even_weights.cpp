#include "sem/nurbs/even_weights.h"

#include <algorithm>
#include <cmath>

namespace sem {
namespace {

constexpr double even_enough = 4;

// Calls visit(index along the axis, weight) for every control point.
template <int ParamDim, int Dim, class Visit>
void visit_weights(Nurbs<ParamDim, Dim>& nurbs, int axis, const Visit& visit) {
  int stride = 1;
  for (int a = 0; a < axis; ++a) stride *= n_control(nurbs, a);
  for (int i = 0; i < nurbs.weights.size(); ++i)
    visit(i / stride % n_control(nurbs, axis), nurbs.weights[i]);
}

template <int ParamDim, int Dim>
void even_axis(Nurbs<ParamDim, Dim>& nurbs, int axis) {
  const int degree = nurbs.degree[axis], last = n_control(nurbs, axis) - 1;
  auto& knots = nurbs.knots[axis];
  const auto [lower, upper] = domain(nurbs, axis);
  if (knots.front() < lower || knots.back() > upper) return;
  double growth = 0;  // log (W(1) / W(0)), mean
  visit_weights(nurbs, axis, [&](int i, double weight) {
    if (i == 0 || i == last) growth += (i == last ? 1 : -1) * std::log(weight);
  });
  growth *= double(last + 1) / double(nurbs.weights.size());
  if (std::abs(growth) <= std::log(even_enough)) return;
  const double m = std::exp(growth / degree);
  const auto place = [lower = lower, upper = upper](double knot) {
    return (knot - lower) / (upper - lower);
  };
  visit_weights(nurbs, axis, [&](int i, double& weight) {
    for (int k = i + 1; k <= i + degree; ++k) {
      const double u = place(knots[k]);
      weight /= 1 - u + m * u;
    }
  });
  for (double& knot : knots) {
    const double u = place(knot);
    if (u > 0 && u < 1) knot = lower + (upper - lower) * (m * u / (1 - u + m * u));
  }
}

}  // namespace

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> even_weights(Nurbs<ParamDim, Dim> nurbs) {
  for (int axis = 0; axis < ParamDim; ++axis) even_axis(nurbs, axis);
  return nurbs;
}

template Nurbs<1, 2> even_weights(Nurbs<1, 2>);
template Nurbs<1, 3> even_weights(Nurbs<1, 3>);
template Nurbs<2, 3> even_weights(Nurbs<2, 3>);

}  // namespace sem
