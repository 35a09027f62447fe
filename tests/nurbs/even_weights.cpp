// The same shape in a parameter that runs evenly.
#include "sem/nurbs/even_weights.h"

#include <doctest/doctest.h>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/bezier_curve.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {

// Weights that grow by the factor, as a whole, along an axis.
template <int ParamDim, int Dim>
void stretch(Nurbs<ParamDim, Dim>& nurbs, int axis, double factor) {
  int stride = 1;
  for (int a = 0; a < axis; ++a) stride *= n_control(nurbs, a);
  const int n = n_control(nurbs, axis);
  for (int i = 0; i < nurbs.weights.size(); ++i)
    nurbs.weights[i] *= std::pow(factor, double(i / stride % n) / (n - 1));
}

template <int ParamDim, int Dim>
void check_same_shape(std::mt19937& random, int degree, int n_spans, double factor) {
  CAPTURE(degree);
  CAPTURE(factor);
  auto uneven = random_nurbs<ParamDim, Dim>(random, degree, n_spans, true, true);
  for (int axis = 0; axis < ParamDim; ++axis)
    stretch(uneven, axis, axis == 0 ? factor : 1 / factor);
  const auto even = even_weights(uneven);
  CHECK(even.control_points == uneven.control_points);
  // t(u) per axis from where both put the ends' weights: u / (1 - u) and t / (1 - t) differ by m.
  for (int trial = 0; trial < 30; ++trial) {
    Param<ParamDim> t, u;
    for (int a = 0; a < ParamDim; ++a) {
      const int p = degree, n = n_control(uneven, a);
      int stride = 1;
      for (int b = 0; b < a; ++b) stride *= n_control(uneven, b);
      double ratio = 0;
      int n_rows = 0;
      for (int i = 0; i < uneven.weights.size(); ++i)
        if (i / stride % n == 0) {
          ratio += std::log(uneven.weights[i + (n - 1) * stride] / uneven.weights[i]);
          ++n_rows;
        }
      const double m = std::exp(ratio / n_rows / p), s = trial < 2 ? trial : uniform(random);
      const Interval range = domain(even, a);
      CHECK(range.lower == domain(uneven, a).lower);
      CHECK(range.upper == domain(uneven, a).upper);
      t[a] = range.lower + s * (range.upper - range.lower);
      u[a] = range.lower + s / (s + m * (1 - s)) * (range.upper - range.lower);
    }
    CHECK((point(even, t) - point(uneven, u)).norm() <
          1e-9);  // u is rounded where X runs 1e6 times as fast
  }
}

}  // namespace

TEST_CASE(
    "even weights: the same points, the ends' weights equal, random shapes of weights from 1 to "
    "1e6") {
  std::mt19937 random(5);
  for (const int degree : {1, 2, 3, 5})
    for (const double factor : {1e-6, 1e-3, 1e3, 1e6}) {
      check_same_shape<1, 2>(random, degree, 1, factor);
      check_same_shape<1, 2>(random, degree, 4, factor);
      check_same_shape<1, 3>(random, degree, 3, factor);
      check_same_shape<2, 3>(random, degree, 2, factor);
    }
}

TEST_CASE("even weights: an arc whose weights run from 1 to 1e6 becomes the usual one") {
  Points<2> corners(2, 3);
  corners << 1, 1, 0, 0, 1, 1;
  const double c = std::sqrt(0.5);
  for (const double w : {1e-3, 1e3}) {
    const auto even = even_weights(bezier_curve<2>(corners, Eigen::Vector3d(1, w * c, w * w)));
    CHECK((even.weights - Eigen::Vector3d(1, c, 1)).norm() < 1e-14);
  }
}

TEST_CASE("even weights: even ones and unclamped ends stay as they are, bit for bit") {
  std::mt19937 random(6);
  auto mild = random_nurbs<1, 2>(random, 3, 4, true, false);
  stretch(mild, 0, 3.9);
  CHECK(even_weights(mild).weights == mild.weights);
  CHECK(even_weights(mild).knots == mild.knots);
  auto unclamped = random_nurbs<1, 2>(random, 3, 4, false, true);
  stretch(unclamped, 0, 1e6);
  CHECK(even_weights(unclamped).weights == unclamped.weights);
  CHECK(even_weights(unclamped).knots == unclamped.knots);
}
