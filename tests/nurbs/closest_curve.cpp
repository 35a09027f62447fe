#include <doctest/doctest.h>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/closest.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {

// Dense samples, then golden section around the best three: an upper bound
// of the distance that shares nothing with the code under test.
double brute_force_distance(const Nurbs<1, 2>& curve, const Vec<2>& X) {
  const auto [lower, upper] = domain(curve, 0);
  const int n = 2000;
  const double h = (upper - lower) / n;
  const auto distance = [&](double u) {
    return (point(curve, Param<1>(std::clamp(u, lower, upper))) - X).norm();
  };
  std::vector<std::pair<double, double>> samples;
  for (int k = 0; k <= n; ++k) samples.push_back({distance(lower + k * h), lower + k * h});
  std::partial_sort(samples.begin(), samples.begin() + 6, samples.end());
  double best = samples[0].first;
  for (int k = 0; k < 6; ++k) {
    double a = samples[k].second - h, b = samples[k].second + h;
    while (b - a > 1e-11 * (upper - lower)) {
      const double c = b - 0.6180339887498949 * (b - a), d = a + 0.6180339887498949 * (b - a);
      (distance(c) < distance(d) ? b : a) = distance(c) < distance(d) ? d : c;
    }
    best = std::min(best, distance(0.5 * (a + b)));
  }
  return best;
}

}  // namespace

TEST_CASE("closest point on random curves is never farther than brute force finds") {
  std::mt19937 random(11);
  for (int trial = 0; trial < 1200; ++trial) {
    const int degree = 1 + trial % 6;
    const bool rational = random() % 2;
    const int n_spans = 1 + random() % 5;
    const bool jumps = random() % 5 == 0;
    const auto curve = random() % 3 == 0 ? random_closed(random, degree, n_spans + 1, rational)
                                         : random_nurbs<1, 2>(random, degree, n_spans,
                                                              random() % 4 != 0, rational, jumps);
    const double reach = trial % 10 == 0 ? 100 : 1.5;
    const Vec<2> X(uniform(random, -reach, reach), uniform(random, -reach, reach));
    const auto found = closest_point<2>(prepare(curve), X);
    const double truth = brute_force_distance(curve, X);
    CHECK(found.distance <= truth + 1e-13 * (1 + truth));
    CHECK(found.distance == doctest::Approx((found.point - X).norm()).epsilon(1e-15));
    if (!jumps) CHECK((point(curve, found.u) - found.point).norm() <= 1e-13);
  }
}

TEST_CASE("closest point of a point on the curve is that point") {
  std::mt19937 random(12);
  for (int trial = 0; trial < 500; ++trial) {
    const auto curve =
        random_nurbs<1, 2>(random, 1 + trial % 5, 1 + random() % 5, random() % 2, random() % 2);
    const Vec<2> X = point(curve, random_parameter(random, curve));
    CHECK(closest_point<2>(prepare(curve), X).distance <= 1e-14);
  }
}

TEST_CASE("closest point of a circle is exact, its centre gives the first parameter") {
  std::mt19937 random(13);
  const Vec<2> centre(0.3, -0.2);
  const auto disc = prepare(circle(centre, 1.5));
  for (int trial = 0; trial < 500; ++trial) {
    const Vec<2> X(uniform(random, -3, 3), uniform(random, -3, 3));
    const auto found = closest_point<2>(disc, X);
    CHECK(found.distance == doctest::Approx(std::abs((X - centre).norm() - 1.5)).epsilon(1e-13));
    CHECK((found.point - centre - 1.5 * (X - centre).normalized()).norm() <
          1e-13 / (X - centre).norm());
  }
  const auto middle = closest_point<2>(disc, centre);
  CHECK(middle.u[0] == 0);
  CHECK(middle.distance == doctest::Approx(1.5).epsilon(1e-15));
}

TEST_CASE("among equally close points the smallest parameter is returned") {
  Points<2> square(2, 5);
  square << 0, 1, 1, 0, 0, 0, 0, 1, 1, 0;
  const auto prepared = prepare(polyline(square));
  CHECK(closest_point<2>(prepared, Vec<2>(0.5, 0.5)).u[0] == doctest::Approx(0.5));
  CHECK(closest_point<2>(prepared, Vec<2>(-1, -1)).u[0] == 0);
  CHECK(closest_point<2>(prepared, Vec<2>(0.25, 0.25)).u[0] == doctest::Approx(0.25));
}

TEST_CASE("beyond the cutoff the distance is right or infinite, within it right") {
  std::mt19937 random(14);
  int n_infinite = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const auto curve = prepare(random_nurbs<1, 2>(random, 3, 4, true, true));
    const Vec<2> X(uniform(random, -2, 2), uniform(random, -2, 2));
    const double truth = closest_point<2>(curve, X).distance;
    const double cutoff = uniform(random, 0, 2);
    const auto found = closest_point<2>(curve, X, cutoff);
    if (truth <= cutoff)
      CHECK(found.distance == truth);
    else
      CHECK((std::isinf(found.distance) || found.distance == truth));
    n_infinite += std::isinf(found.distance);
  }
  CHECK(n_infinite > 0);
}

TEST_CASE("closest point with degree 24 and with coincident control points") {
  std::mt19937 random(15);
  for (int trial = 0; trial < 60; ++trial) {
    auto curve = random_nurbs<1, 2>(random, trial % 2 ? 24 : 3, 2, true, true);
    if (trial % 2 == 0) curve.control_points.col(1) = curve.control_points.col(0);  // speed 0
    if (trial % 4 == 0) curve.control_points.col(3) = curve.control_points.col(2);
    const Vec<2> X(uniform(random, -1, 1), uniform(random, -1, 1));
    const double truth = brute_force_distance(curve, X);
    CHECK(closest_point<2>(prepare(curve), X).distance <= truth + 1e-12);
  }
}

TEST_CASE("closest point whose parameter is where the search splits") {
  std::mt19937 random(17);
  for (int trial = 0; trial < 400; ++trial) {
    const int degree = 2 + trial % 4;
    const auto curve = random_nurbs<1, 2>(random, degree, 1, true, trial % 2 == 0, false);
    const auto [lower, upper] = domain(curve, 0);
    for (const double s : {0.5, 0.25, 0.75, 0.125, 0.625, 0.9375}) {
      const auto at = derivatives(curve, Param<1>(lower + s * (upper - lower)), 1);
      const Vec<2> normal = Vec<2>(-at.first(1), at.first(0)).normalized();
      for (const double height : {0., 1e-3, -0.05}) {
        const auto found = closest_point<2>(prepare(curve), Vec<2>(at.point + height * normal));
        CHECK(found.distance <= std::abs(height) + 1e-14);
      }
    }
  }
  // Symmetric, so that the foot is exactly in the middle.
  Points<2> points(2, 3);
  points << -1, 0, 1, 0, 1, 0;
  const auto found = closest_point<2>(prepare(test::bezier(points)), Vec<2>(0, 0.5 - 0.25));
  CHECK(found.u[0] == 0.5);
  CHECK(found.distance == doctest::Approx(0.25).epsilon(1e-14));
}
