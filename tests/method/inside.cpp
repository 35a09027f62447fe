// The rule of the inside: gaps, overlaps, holes, orientation, joints.
#include <doctest/doctest.h>

#include <random>

#include "sem/base/error.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/quadrature.h"
#include "solids.h"

using namespace sem;
using test::Parts;

namespace {

struct Body {
  Boundary<2> boundary;
  Loops<2> loops;
  explicit Body(const std::vector<Parts<2>>& solids) : boundary(make_boundary<2>(solids)), loops(find_loops(boundary)) {}
  double truth() const { return boundary_moments(boundary, loops).volume; }
  double area(int n_rays, int axis = 0, RayGrid grid = RayGrid::midpoint) const {
    const auto rays = cast_rays(boundary, loops, {axis, n_rays, grid});
    return quadrature_on_rays(rays, {}).weight.sum();
  }
};

Parts<2> join(Parts<2> a, const Parts<2>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Circular segment areas of two unit discs whose centers are `distance` apart.
double union_area(double distance) {
  return 2 * M_PI - (2 * std::acos(distance / 2) - distance / 2 * std::sqrt(4 - distance * distance));
}

}  // namespace

TEST_CASE("disc: area and second moments from the boundary to rounding, from rays as their number grows") {
  const Body body({test::circle({0.3, -0.2}, 2)});
  const auto moments = boundary_moments(body.boundary, body.loops);
  CHECK(moments.volume == doctest::Approx(4 * M_PI).epsilon(1e-14));
  CHECK((moments.first - 4 * M_PI * Vec<2>(0.3, -0.2)).norm() < 1e-13);
  CHECK(moments.second(0, 0) == doctest::Approx(4 * M_PI * (1 + 0.09)).epsilon(1e-13));
  CHECK(moments.second(0, 1) == doctest::Approx(-4 * M_PI * 0.06).epsilon(1e-12));
  double previous = 1;
  for (const int n : {16, 64, 256, 1024}) {
    const double error = std::abs(body.area(n) / (4 * M_PI) - 1);
    CHECK(error < previous / 6);  // midpoint rays: order 3/2 at the tops
    previous = error;
  }
  CHECK(std::abs(body.area(64, 1, RayGrid::gauss) / (4 * M_PI) - 1) < 2e-5);
}

TEST_CASE("annulus and nested islands: even depth is material, odd depth is a hole") {
  Parts<2> rings = test::circle({0, 0}, 3, 5);
  rings = join(rings, test::circle({0, 0}, 2, 3));
  rings = join(rings, test::circle({0, 0}, 1, 4));
  for (size_t i = 0; i < rings.size(); i += 2) rings[i] = reversed(rings[i], 0);
  const Body body({rings});
  CHECK(body.loops.loops.size() == 3);
  CHECK(body.truth() == doctest::Approx((9 - 4 + 1) * M_PI).epsilon(1e-13));
  CHECK(body.area(400) == doctest::Approx((9 - 4 + 1) * M_PI).epsilon(1e-3));
  CHECK(inside(body.boundary, body.loops, Vec<2>(0.1, 0.2)));
  CHECK(!inside(body.boundary, body.loops, Vec<2>(1.5, 0.2)));
  CHECK(inside(body.boundary, body.loops, Vec<2>(0.1, -2.5)));
  CHECK(!inside(body.boundary, body.loops, Vec<2>(3.1, 0)));
}

TEST_CASE("ellipse: an affine image of the circle keeps its exact area") {
  Parts<2> ellipse = test::circle({0, 0}, 1, 4);
  for (auto& arc : ellipse) arc.control_points.row(0) *= 3;
  CHECK(Body({ellipse}).truth() == doctest::Approx(3 * M_PI).epsilon(1e-14));
}

TEST_CASE("solids that overlap are united; so are loops of one solid that cross") {
  const Parts<2> left = test::circle({0, 0}, 1), right = test::circle({1.1, 0}, 1);
  const double exact = union_area(1.1);
  const Body two({left, right}), one({join(left, right)});
  CHECK(two.truth() == doctest::Approx(exact).epsilon(1e-11));
  CHECK(one.truth() == doctest::Approx(exact).epsilon(1e-11));
  CHECK(two.area(500) == doctest::Approx(exact).epsilon(1e-3));
  CHECK(one.area(500) == doctest::Approx(exact).epsilon(1e-3));
}

TEST_CASE("rays count overlapping solids once and name the first of them") {
  const Body body({test::box<2>({0, 0}, {2, 1}), test::box<2>({1, 0}, {3, 1})});
  const auto rays = cast_rays(body.boundary, body.loops, {0, 1, RayGrid::midpoint});
  REQUIRE(rays.rays[0].intervals.size() == 2);
  CHECK(rays.rays[0].intervals[0].begin == 0);
  CHECK(rays.rays[0].intervals[0].end == 2);
  CHECK(rays.rays[0].intervals[0].solid == 0);
  CHECK(rays.rays[0].intervals[1].end == 3);
  CHECK(rays.rays[0].intervals[1].solid == 1);
}

TEST_CASE("order, orientation, gaps and overshoots of the parts do not matter beyond their size") {
  std::mt19937 random(7);
  for (const double gap : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1}) {
    CAPTURE(gap);
    for (int trial = 0; trial < 10; ++trial) {
      Parts<2> parts = test::unit_box<2>(3);
      for (auto& part : parts) {
        if (random() % 2) part = reversed(part, 0);
        // Each end moves along the part: out (overshoot) or in (gap).
        const Vec<2> along = (part.control_points.col(1) - part.control_points.col(0)).normalized();
        part.control_points.col(0) += gap * (int(random() % 3) - 1) / 2.0 * along;
        part.control_points.col(1) += gap * (int(random() % 3) - 1) / 2.0 * along;
      }
      std::shuffle(parts.begin(), parts.end(), random);
      const Body body({parts});
      CHECK(body.loops.loops.size() == 1);
      CHECK(body.truth() == doctest::Approx(1).epsilon(1e-13 + 2 * gap));
      CHECK(body.area(37) == doctest::Approx(1).epsilon(1e-13 + 4 * gap));
      if (gap > 1e-5) CHECK(body.loops.n_gaps > 0);
      if (gap < 1e-11) CHECK(body.loops.n_gaps == 0);
    }
  }
}

TEST_CASE("a gap is closed by a straight cap and reported, in the loops and on the rays") {
  Parts<2> parts = test::box<2>({0, 0}, {2, 1});
  parts[1].control_points.col(1) = Vec<2>(2, 0.5);  // the right side ends half way up
  const Body body({parts});
  CHECK(body.loops.n_gaps == 1);
  CHECK(body.loops.longest_gap == doctest::Approx(0.5));
  CHECK(body.truth() == doctest::Approx(2).epsilon(1e-14));
  const auto rays = cast_rays(body.boundary, body.loops, {0, 10, RayGrid::midpoint});
  CHECK(rays.n_unpaired == 0);
  CHECK(rays.capped_length == doctest::Approx(2 * 0.5));  // the upper half of the rays, length times width
}

TEST_CASE("rays through joints, along edges and touching tops are paired") {
  // A square standing on its corner, a disc touched at its top, and a box whose edges lie on rays.
  const Body diamond({test::polygon({{0, -1}, {1, 0}, {0, 1}, {-1, 0}})});
  const Body disc({test::circle({0, 0}, 1)});
  const Body box({test::unit_box<2>(2)});
  for (const Body* body : {&diamond, &disc, &box})
    for (const int n : {1, 2, 3, 4, 5, 7, 8})
      for (const int axis : {0, 1}) {
        const auto rays = cast_rays(body->boundary, body->loops, {axis, n, RayGrid::midpoint});
        CHECK(rays.n_unpaired == 0);
        for (const auto& ray : rays.rays) CHECK(ray.intervals.size() == 1);
      }
}

TEST_CASE("every quadrature point is inside and every weight positive, on random star-shaped splines") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> radius(0.5, 1.5);
  for (int trial = 0; trial < 20; ++trial) {
    // One closed curve: periodic cubic B-spline.
    const int n = 9;
    Nurbs<1, 2> curve;
    curve.degree = {3};
    curve.control_points.resize(2, n + 3);
    curve.weights = Eigen::VectorXd::Ones(n + 3);
    for (int i = 0; i < n + 7; ++i) curve.knots[0].push_back(i);
    std::vector<double> r(n);
    for (double& value : r) value = radius(random);
    for (int i = 0; i < n + 3; ++i)
      curve.control_points.col(i) = r[i % n] * Vec<2>(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n));
    const Body body({{curve}});
    CHECK(body.loops.n_gaps == 0);
    const auto q = quadrature_on_rays(cast_rays(body.boundary, body.loops, {0, 40, RayGrid::midpoint}), {});
    CHECK(q.weight.minCoeff() > 0);
    for (int k = 0; k < q.size(); k += 7) CHECK(inside(body.boundary, body.loops, Vec<2>(q.position.col(k))));
    CHECK(q.weight.sum() == doctest::Approx(body.truth()).epsilon(5e-3));
  }
}

TEST_CASE("orientation found: the normal times it points outward") {
  Parts<2> parts = test::circle({0, 0}, 2);
  const Parts<2> hole = test::circle({0, 0}, 1);
  parts.insert(parts.end(), hole.begin(), hole.end());
  parts[1] = reversed(parts[1], 0);
  const Body body({parts});
  const std::vector<int> expected = {1, -1, 1, 1, -1, -1, -1, -1};
  CHECK(body.loops.orientation == expected);
}

TEST_CASE("a spacing that asks for more points than memory holds is an error") {
  const Body body({test::unit_box<2>()});
  const auto rays = cast_rays(body.boundary, body.loops, {0, 4, RayGrid::midpoint});
  CHECK_THROWS_WITH_AS(quadrature_on_rays(rays, {IntervalRule::midpoint, 1, 1e-12}),
                       doctest::Contains("method.quadrature"), InputError);
}
