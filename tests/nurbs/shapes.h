#pragma once
// Curves and surfaces the tests of this folder share. Seeds are explicit.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sem/nurbs/nurbs.h"

namespace sem::test {

constexpr double infinity = std::numeric_limits<double>::infinity();

inline double uniform(std::mt19937& random, double lower = 0, double upper = 1) {
  return lower + (upper - lower) * (double(random() >> 5) / double(1u << 27));
}

/// Knots of n functions: clamped or not, interior knots random, some of
/// them repeated (up to `degree` times, or degree + 1 if jumps are allowed).
inline std::vector<double> random_knots(std::mt19937& random, int n, int degree, bool clamped,
                                        bool jumps = false) {
  std::vector<double> knots;
  double u = uniform(random, -1, 1);
  const int size = n + degree + 1;
  int repeated = 0;
  for (int k = 0; k < size; ++k) {
    const bool at_start = k <= degree, at_end = k >= n;
    const bool repeat = k > 0 && ((clamped && at_start) || (clamped && at_end && k > n) ||
                                  (uniform(random) < 0.25 && k > degree && k < n &&
                                   repeated < degree + (jumps && k + 1 < n ? 1 : 0)));
    if (k > 0 && !repeat) {
      u += uniform(random, 0.1, 1);
      repeated = 0;
    }
    ++repeated;
    knots.push_back(u);
  }
  return knots;
}

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> random_nurbs(std::mt19937& random, int degree, int n_spans, bool clamped,
                                  bool rational, bool jumps = false) {
  Nurbs<ParamDim, Dim> nurbs;
  int n_points = 1;
  for (int a = 0; a < ParamDim; ++a) {
    nurbs.degree[a] = degree;
    const int n = degree + n_spans;
    nurbs.knots[a] = random_knots(random, n, degree, clamped, jumps);
    n_points *= n;
  }
  nurbs.control_points.resize(Dim, n_points);
  nurbs.weights.setOnes(n_points);
  for (int i = 0; i < n_points; ++i) {
    for (int k = 0; k < Dim; ++k) nurbs.control_points(k, i) = uniform(random, -1, 1);
    if (rational) nurbs.weights[i] = std::exp(uniform(random, -1.5, 1.5));
  }
  return nurbs;
}

/// A random curve whose ends are the same point bit for bit.
inline Nurbs<1, 2> random_closed(std::mt19937& random, int degree, int n_spans, bool rational) {
  auto curve = random_nurbs<1, 2>(random, degree, n_spans, true, rational);
  curve.control_points.rightCols<1>() = curve.control_points.col(0);
  return curve;
}

/// Bezier curve through its control points' hull, domain [0, 1].
inline Nurbs<1, 2> bezier(const Points<2>& points) {
  Nurbs<1, 2> curve;
  const int degree = int(points.cols()) - 1;
  curve.degree[0] = degree;
  curve.knots[0].assign(degree + 1, 0.0);
  curve.knots[0].insert(curve.knots[0].end(), degree + 1, 1.0);
  curve.control_points = points;
  curve.weights.setOnes(degree + 1);
  return curve;
}

/// Degree 1 through the points, parameter = index.
inline Nurbs<1, 2> polyline(const Points<2>& points) {
  Nurbs<1, 2> curve;
  const int n = int(points.cols());
  curve.degree[0] = 1;
  for (int k = 0; k < n + 2; ++k) curve.knots[0].push_back(std::clamp(k - 1, 0, n - 1));
  curve.control_points = points;
  curve.weights.setOnes(n);
  return curve;
}

/// Circle of four rational quadratic arcs, anticlockwise from (r, 0), domain [0, 4].
inline Nurbs<1, 2> circle(const Vec<2>& centre, double r) {
  Nurbs<1, 2> curve;
  curve.degree[0] = 2;
  curve.knots[0] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  const double x[9] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[9] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  curve.control_points.resize(2, 9);
  curve.weights.resize(9);
  for (int i = 0; i < 9; ++i) {
    curve.control_points.col(i) = centre + r * Vec<2>(x[i], y[i]);
    curve.weights[i] = i % 2 == 0 ? 1 : std::sqrt(0.5);
  }
  return curve;
}

/// A parameter of the domain, each axis uniform.
template <int ParamDim, int Dim>
Param<ParamDim> random_parameter(std::mt19937& random, const Nurbs<ParamDim, Dim>& nurbs) {
  Param<ParamDim> u;
  for (int a = 0; a < ParamDim; ++a)
    u[a] = uniform(random, domain(nurbs, a).lower, domain(nurbs, a).upper);
  return u;
}

}  // namespace sem::test
