#include "sem/nurbs/prepared.h"

#include <doctest/doctest.h>

#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"
#include "sem/nurbs/kernels.h"
#include "sem/nurbs/power_form.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {

// Runs a check with every set of kernels that this processor has.
template <class Check>
void with_all_kernels(const Check& check) {
  const detail::Kernels* const best = detail::kernels;
  for (const detail::Kernels* set : {best, &detail::portable_kernels}) {
    detail::kernels = set;
    check();
  }
  detail::kernels = best;
}

// Weights from 0.1 to 10, and all else as random_nurbs.
template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> uneven_nurbs(std::mt19937& random, int degree, bool jumps) {
  auto nurbs = random_nurbs<ParamDim, Dim>(random, degree, 1 + random() % 5, random() % 3 != 0,
                                           false, jumps);
  for (double& w : nurbs.weights) w = std::pow(10, uniform(random, -1, 1));
  return nurbs;
}

// The largest difference of prepared and direct evaluation over the part's size; also at knots and
// outside the domain.
template <int ParamDim, int Dim>
void compare(std::mt19937& random, int degree, double& point_error, double& slope_error,
             int& n_power) {
  const auto nurbs = uneven_nurbs<ParamDim, Dim>(random, degree, random() % 4 == 0);
  const auto part = prepare(nurbs);
  n_power += part.power != nullptr;
  for (int k = 0; k < 30; ++k) {
    auto u = random_parameter(random, nurbs);
    const int a = random() % ParamDim;
    if (k % 3 == 0) u[a] = nurbs.knots[a][random() % nurbs.knots[a].size()];
    if (k == 1) u[a] = domain(nurbs, a).upper + 1;
    const auto direct = derivatives(nurbs, u, 1);
    const auto at = point_slopes(part, u);
    const double size = part.box.diagonal();
    point_error = std::max(point_error, (at.point - direct.point).norm() / size);
    CHECK((at.point - point(part, u)).norm() <= 1e-14 * size);
    double steepest = std::max(size, direct.first.norm());
    for (const auto& span : part.spans[0])
      steepest = std::max(steepest, size / (span.upper - span.lower));
    slope_error = std::max(slope_error, (at.first - direct.first).norm() / steepest);
  }
}

}  // namespace

TEST_CASE(
    "prepared evaluation agrees with direct evaluation to 1e-14 of the size, up to degree 5") {
  with_all_kernels([] {
    std::mt19937 random(71);
    double curve = 0, surface = 0, space = 0, slope = 0;
    int n_power = 0;
    for (int trial = 0; trial < 600; ++trial) {
      compare<1, 2>(random, 1 + trial % 5, curve, slope, n_power);
      compare<1, 3>(random, 1 + trial % 5, space, slope, n_power);
      if (trial % 4 == 0) compare<2, 3>(random, 1 + trial / 4 % 5, surface, slope, n_power);
    }
    CHECK(curve < 1e-14);
    CHECK(space < 1e-14);
    CHECK(surface < 1e-14);
    CHECK(slope < 1e-12);
    CHECK(n_power > 600);   // of 1350: the kernels are used
    CHECK(n_power < 1350);  // and not where weights are too uneven for powers
  });
}

TEST_CASE("prepared evaluation of high degrees is the direct one") {
  std::mt19937 random(72);
  for (int degree : {13, 24}) {
    const auto nurbs = random_nurbs<1, 2>(random, degree, 3, true, true);
    const auto part = prepare(nurbs);
    CHECK(part.power == nullptr);
    const auto u = random_parameter(random, nurbs);
    CHECK(point(part, u) == point(nurbs, u));
  }
}

TEST_CASE("prepared evaluation finds the span of very unequal knots, NaN gives NaN") {
  auto curve = bezier(Points<2>{{0, 1, 3, 2}, {0, 2, -1, 1}});
  curve.knots[0] = {0, 0, 1e-7, 1, 1, 1.5, 1.5};
  curve.degree[0] = 1;
  curve.control_points = Points<2>{{0, 1, 3, 2, 5}, {0, 2, -1, 1, 1}};
  curve.weights.setOnes(5);
  const auto part = prepare(curve);
  for (double u : {0.0, 5e-8, 1e-7, 2e-7, 0.3, std::nextafter(1.0, 0.0), 1.0, 1.2, 1.5, 7.0, -1.0})
    CHECK((point(part, Param<1>(u)) - point(curve, Param<1>(u))).norm() < 1e-14);
  CHECK(std::isnan(point(part, Param<1>(std::nan("")))[0]));
}

TEST_CASE("the offset to a foot inside a piece is normal there to rounding, not to its root") {
  std::mt19937 random(73);
  int n_inside = 0;
  const auto check = [&](const auto& part, const auto& X) {
    const auto found = closest_point(part, X);
    const auto at = point_slopes(part, found.u);
    bool inside = true;
    for (int a = 0; a < int(found.u.size()); ++a)
      for (const auto& span : part.spans[a])
        inside = inside && found.u[a] != span.lower && found.u[a] != span.upper;
    if (!inside) return;
    ++n_inside;
    for (int a = 0; a < int(found.u.size()); ++a) {
      const double last_bit = 1e-15 * std::abs(found.u[a]) * at.first.squaredNorm();
      CHECK(std::abs((at.point - X).dot(at.first.col(a))) <=
            2e-13 * at.first.col(a).norm() * (found.distance + part.box.diagonal()) + last_bit);
    }
  };
  for (int trial = 0; trial < 400; ++trial) {
    const auto curve = prepare(random_nurbs<1, 2>(random, 2 + trial % 3, 3, true, trial % 2));
    check(curve, Vec<2>(uniform(random, -2, 2), uniform(random, -2, 2)));
    if (trial % 4) continue;
    const auto surface = prepare(random_nurbs<2, 3>(random, 2 + trial % 2, 2, true, trial % 8));
    check(surface, Vec<3>(uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2)));
  }
  CHECK(n_inside > 100);
}

TEST_CASE(
    "closest points of curves with weights from 0.1 to 10 and cusps: none farther than samples") {
  with_all_kernels([] {
    std::mt19937 random(74);
    for (int trial = 0; trial < 1500; ++trial) {
      auto curve = uneven_nurbs<1, 2>(random, 1 + trial % 6, random() % 5 == 0);
      const int n = n_control(curve, 0);
      if (trial % 3 == 0) curve.control_points.col(1) = curve.control_points.col(0);
      if (trial % 4 == 0 && n >= 4) {  // crossed control points
        const Vec<2> a = curve.control_points.col(n - 3);
        curve.control_points.col(n - 3) = curve.control_points.col(n - 2);
        curve.control_points.col(n - 2) = a;
      }
      const auto part = prepare(curve);
      Vec<2> X(uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5));
      if (trial % 5 == 0) X = point(curve, random_parameter(random, curve));
      if (trial % 7 == 0) X = part.pieces.back().points.rightCols<1>();
      const double found = closest_point<2>(part, X).distance;
      const auto [lower, upper] = domain(curve, 0);
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= 1000; ++k)
        least = std::min(least,
                         (point(curve, Param<1>(lower + (upper - lower) * k / 1000)) - X).norm());
      CHECK(found <= least + 1e-13);
      if (trial % 5 == 0 || trial % 7 == 0) CHECK(found <= 1e-13);
    }
  });
}

TEST_CASE("a line through a point of a curve hits it there, also as a tangent and at an end") {
  with_all_kernels([] {
    std::mt19937 random(75);
    std::vector<Hit<2>> hits;
    for (int trial = 0; trial < 4000; ++trial) {
      const auto curve = uneven_nurbs<1, 2>(random, 1 + trial % 6, false);
      const auto part = prepare(curve);
      auto u = random_parameter(random, curve);
      if (trial % 5 == 0) u[0] = part.spans[0][random() % part.spans[0].size()].lower;
      const auto at = derivatives(curve, u, 1);
      const bool tangent = trial % 4 == 0 && curve.degree[0] > 1;  // degree 1: all along the line
      const double angle = uniform(random, 0, 7);
      const Vec<2> d = tangent ? Vec<2>(at.first) : Vec<2>(std::cos(angle), std::sin(angle));
      hits.clear();
      append_hits<2>(part, {at.point, d}, -1e9, 1e9, hits);
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& hit : hits) {
        nearest = std::min(nearest, std::abs(hit.t) * d.norm());
        const auto there = derivatives(curve, hit.u, 1);
        CHECK((at.point + hit.t * d - there.point).norm() <=
              1e-13 + 4e-16 * there.first.norm() * (1 + std::abs(hit.u[0])));
      }
      const double sine =
          std::abs(at.first[0] * d[1] - at.first[1] * d[0]) / (at.first.norm() * d.norm());
      CHECK(nearest <= (sine > 1e-3 ? 1e-10 : 1e-3));
    }
  });
}

TEST_CASE(
    "surfaces with weights from 0.1 to 10: no hit missed, no closest point farther than samples") {
  with_all_kernels([] {
    std::mt19937 random(76);
    std::vector<Hit<3>> hits;
    for (int trial = 0; trial < 150; ++trial) {
      const auto surface = uneven_nurbs<2, 3>(random, 1 + trial % 3, false);
      const auto part = prepare(surface);
      const Vec<3> X = point(surface, random_parameter(random, surface));
      const Vec<3> d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
      hits.clear();
      append_hits<3>(part, {X, d}, -1e9, 1e9, hits);
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& hit : hits) nearest = std::min(nearest, std::abs(hit.t) * d.norm());
      CHECK(nearest <= 1e-9);
      const double found = closest_point<3>(part, Vec<3>(X + d)).distance;
      double least = d.norm();
      for (int k = 0; k < 900; ++k)
        least = std::min(least, (point(surface, random_parameter(random, surface)) - X - d).norm());
      CHECK(found <= least + 1e-13);
    }
  });
}
