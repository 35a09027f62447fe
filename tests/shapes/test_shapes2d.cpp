// The 2D shape library against what is known of its shapes.
#include <doctest/doctest.h>

#include <cmath>

#include "sem/method/boundary_integrals.h"
#include "sem/nurbs/basis.h"
#include "src2d/shapes/shapes.h"

using namespace sem;
using namespace sem::shapes2d;

namespace {

Moments<2> moments(const Parts& parts) {
  std::vector<Nurbs<1, 2>> shapes;
  for (const auto& part : parts) shapes.push_back(part.shape);
  const Boundary<2> boundary = make_boundary<2>({shapes});
  return boundary_moments(boundary, find_loops(boundary));
}

Vec<2> at(const Nurbs<1, 2>& curve, double share) {
  const auto [lower, upper] = domain(curve, 0);
  return point(curve, Param<1>(share == 1 ? upper : lower + share * (upper - lower)));
}

// Ends meet: the control points bit for bit, the curve as evaluated to rounding.
void check_joined(const Parts& parts, size_t begin, size_t end) {
  for (size_t k = begin; k < end; ++k) {
    const auto& a = parts[k].shape;
    const auto& b = parts[k + 1 == end ? begin : k + 1].shape;
    CAPTURE(parts[k].name);
    CHECK(a.control_points.col(a.control_points.cols() - 1) == b.control_points.col(0));
    CHECK((at(a, 1) - at(b, 0)).norm() < 1e-15);
    CHECK_NOTHROW(check(a, "", parts[k].name));
  }
}

Points<2> loop_points() {
  Points<2> points(2, 7);
  points << 1.3, 0.7, -0.4, -1.1, -0.9, 0.2, 1.1,  //
      0.1, 1.2, 0.6, 0.7, -0.5, -0.9, -1.3;
  return points;
}

// Area within the closed polygon of points at all parts, a second-order estimate.
double polygon_area(const Parts& parts, int n) {
  double area = 0;
  for (const auto& part : parts)
    for (int k = 0; k < n; ++k) {
      const Vec<2> a = at(part.shape, double(k) / n), b = at(part.shape, double(k + 1) / n);
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  return area;
}

constexpr double tight = 1e-14;

}  // namespace

TEST_CASE("rectangle: sides in order, named, cut into equal parts, joined bit for bit") {
  Rectangle r;
  r.lower << -0.1, 0.3;
  r.upper << 0.7, 1.7;
  r.n_parts = {7, 3, 1, 2};
  r.degree = 3;
  const Parts parts = make_parts(r);
  REQUIRE(parts.size() == 13);
  CHECK(parts[0].name == "bottom.1");
  CHECK(parts[6].name == "bottom.7");
  CHECK(parts[7].name == "right.1");
  CHECK(parts[10].name == "top");
  CHECK(parts[12].name == "left.2");
  check_joined(parts, 0, parts.size());
  CHECK(at(parts[0].shape, 0) == r.lower);
  CHECK(at(parts[9].shape, 1) == r.upper);
  for (int k = 0; k < 7; ++k)  // exactly straight
    CHECK((parts[k].shape.control_points.row(1).array() == r.lower[1]).all());
  const Moments<2> m = moments(parts);
  CHECK(m.volume == doctest::Approx(0.8 * 1.4).epsilon(tight));
  CHECK(m.first[0] == doctest::Approx(0.8 * 1.4 * 0.3).epsilon(tight));
  CHECK(m.first[1] == doctest::Approx(0.8 * 1.4).epsilon(tight));
}

TEST_CASE("a straight part of any degree is run through at constant speed") {
  for (int degree = 1; degree <= 9; ++degree) {
    CAPTURE(degree);
    Rectangle r;
    r.degree = degree;
    r.n_parts = {2, 1, 1, 1};
    const auto side = make_parts(r)[1].shape;
    CHECK(side.degree[0] == degree);
    for (double u : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const auto d = derivatives(side, Param<1>(u));
      CHECK((d.point - Vec<2>(0.5 + 0.5 * u, 0)).norm() < 1e-15);
      CHECK((d.first - Vec<2>(0.5, 0)).norm() < 1e-14);
    }
  }
}

TEST_CASE("polygon: the square's parts are the reference's, in its order") {
  Polygon polygon;
  polygon.vertices.resize(2, 4);
  polygon.vertices << 0, 0, 2, 2, 0, 2, 2, 0;
  polygon.n_parts = {3, 3, 3, 3};
  const Parts parts = make_parts(polygon);
  REQUIRE(parts.size() == 12);
  check_joined(parts, 0, 12);
  const double third = 2.0 / 3;
  for (int k = 0; k < 3; ++k) {
    CHECK((at(parts[k].shape, 0) - Vec<2>(0, k * third)).norm() < 1e-15);
    CHECK((at(parts[3 + k].shape, 0) - Vec<2>(k * third, 2)).norm() < 1e-15);
    CHECK((at(parts[6 + k].shape, 0) - Vec<2>(2, 2 - k * third)).norm() < 1e-15);
    CHECK((at(parts[9 + k].shape, 0) - Vec<2>(2 - k * third, 0)).norm() < 1e-15);
  }
  CHECK(moments(parts).volume == doctest::Approx(4).epsilon(tight));
}

TEST_CASE("polygon: a re-entrant outline has its area, one part a side by default") {
  Polygon u;
  u.vertices.resize(2, 8);
  u.vertices << 0, 2.2, 2.2, 1.2, 1.2, 1, 1, 0,  //
      0, 0, 3, 3, 1, 1, 3, 3;
  const Parts parts = make_parts(u);
  REQUIRE(parts.size() == 8);
  CHECK(parts[6].name == "side7");
  check_joined(parts, 0, 8);
  CHECK(moments(parts).volume == doctest::Approx(2.2 * 3 - 0.2 * 2).epsilon(tight));
}

TEST_CASE("disc: every point at the radius to rounding, area and inertia exact") {
  for (int n_arcs : {3, 4, 5, 8, 13, 64}) {
    CAPTURE(n_arcs);
    Disc disc;
    disc.radius = 1.7;
    disc.n_arcs = n_arcs;
    const Parts parts = make_parts(disc);
    REQUIRE(int(parts.size()) == n_arcs);
    check_joined(parts, 0, parts.size());
    double worst = 0;
    for (const auto& part : parts)
      for (int k = 0; k <= 100; ++k)
        worst = std::max(worst, std::abs(at(part.shape, k / 100.0).norm() / 1.7 - 1));
    CHECK(worst < 1e-15);
    const Moments<2> m = moments(parts);
    const double area = M_PI * 1.7 * 1.7, inertia = area * 1.7 * 1.7 / 4;
    CHECK(m.volume == doctest::Approx(area).epsilon(1e-13));
    CHECK(m.second(0, 0) == doctest::Approx(inertia).epsilon(1e-13));
    CHECK(m.second(1, 1) == doctest::Approx(inertia).epsilon(1e-13));
    CHECK(std::abs(m.second(0, 1)) < 1e-13 * inertia);
  }
}

TEST_CASE("disc: the points on the axes are exact") {
  Disc disc;
  disc.center << 1, 2;
  disc.radius = 3;
  disc.n_arcs = 8;
  const Parts parts = make_parts(disc);
  CHECK(at(parts[0].shape, 0) == Vec<2>(4, 2));
  CHECK(at(parts[2].shape, 0) == Vec<2>(1, 5));
  CHECK(at(parts[4].shape, 0) == Vec<2>(-2, 2));
  CHECK(at(parts[6].shape, 0) == Vec<2>(1, -1));
}

TEST_CASE("ellipse: every point satisfies its equation to rounding, area and inertia exact") {
  Ellipse e;
  e.center << 0.3, -0.2;
  e.radii << 3, 0.5;
  e.rotation = 0.7;
  e.n_arcs = 6;
  const Parts parts = make_parts(e);
  check_joined(parts, 0, parts.size());
  const Vec<2> first(std::cos(0.7), std::sin(0.7)), second(-first[1], first[0]);
  CHECK((at(parts[0].shape, 0) - (e.center + 3 * first)).norm() < 1e-15);
  for (const auto& part : parts)
    for (int k = 0; k <= 50; ++k) {
      // Distance along the radius, relative to the size of the ellipse.
      const Vec<2> X = at(part.shape, k / 50.0) - e.center;
      const double level = std::hypot(X.dot(first) / 3, X.dot(second) / 0.5);
      CHECK(std::abs(1 - 1 / level) * X.norm() < 1e-15 * 3);
    }
  const Moments<2> m = moments(parts);
  const double area = M_PI * 1.5;
  CHECK(m.volume == doctest::Approx(area).epsilon(1e-13));
  const Mat<2> centered = m.second - m.first * m.first.transpose() / area;
  CHECK(first.dot(centered * first) == doctest::Approx(area * 9 / 4).epsilon(1e-13));
  CHECK(second.dot(centered * second) == doctest::Approx(area * 0.25 / 4).epsilon(1e-12));
}

TEST_CASE("annulus: circles in groups, arcs of a number face each other, hole subtracted") {
  Annulus a;
  a.center << 2, 1;
  a.n_arcs = 8;
  const Parts parts = make_parts(a);
  REQUIRE(parts.size() == 16);
  CHECK(parts[0].name == "inner.1");
  CHECK(parts[8].name == "outer.1");
  check_joined(parts, 0, 8);
  check_joined(parts, 8, 16);
  for (int k = 0; k < 8; ++k)
    for (double u : {0.0, 0.3, 1.0}) {
      const Vec<2> inner = at(parts[k].shape, u) - a.center,
                   outer = at(parts[8 + k].shape, u) - a.center;
      CHECK((2 * inner - outer).norm() < 1e-15 * 2);
      CHECK(std::abs(inner.norm() - 1) < 1e-15);
    }
  const Moments<2> m = moments(parts);
  CHECK(m.volume == doctest::Approx(3 * M_PI).epsilon(1e-13));
  CHECK(m.second(0, 0) - 4 * m.volume == doctest::Approx(15 * M_PI / 4).epsilon(1e-12));
}

TEST_CASE("closed curve: one part, closed and twice continuously differentiable at the seam") {
  const Parts parts = make_parts(ClosedCurve{loop_points()});
  REQUIRE(parts.size() == 1);
  const auto& curve = parts[0].shape;
  CHECK_NOTHROW(check(curve, "", "loop"));
  CHECK(is_closed(curve, 0));
  const auto [lower, upper] = domain(curve, 0);
  CHECK(lower == 0);
  CHECK(upper == 7);
  const auto start = derivatives(curve, Param<1>(lower)), end = derivatives(curve, Param<1>(upper));
  CHECK((start.point - end.point).norm() < 1e-15);
  CHECK((start.first - end.first).norm() < 1e-14);
  CHECK((start.second[0] - end.second[0]).norm() < 1e-14);
  // The uniform cubic at a knot: (1, 4, 1) / 6 of three neighbours.
  const Points<2> p = loop_points();
  CHECK((start.point - (p.col(0) + 4 * p.col(1) + p.col(2)) / 6).norm() < 1e-15);
  CHECK(moments(parts).volume == doctest::Approx(polygon_area(parts, 20000)).epsilon(1e-7));
}

TEST_CASE("spline loop: the closed curve, cut into clamped parts joined bit for bit") {
  const auto whole = make_parts(ClosedCurve{loop_points()})[0].shape;
  const double area = moments(make_parts(ClosedCurve{loop_points()})).volume;
  for (int n_parts : {1, 2, 4, 7, 20}) {
    CAPTURE(n_parts);
    const Parts parts = make_parts(SplineLoop{loop_points(), n_parts});
    REQUIRE(int(parts.size()) == n_parts);
    check_joined(parts, 0, parts.size());
    for (int k = 0; k < n_parts; ++k)
      for (double share : {0.0, 0.1, 0.6, 1.0})
        CHECK((at(parts[k].shape, share) - at(whole, (k + share) / n_parts)).norm() < 4e-15);
    CHECK(moments(parts).volume == doctest::Approx(area).epsilon(1e-13));
  }
}

TEST_CASE("path: an open B-spline from its first control point to the last, cut into parts joined bit for bit") {
  const auto whole = make_parts(Path{loop_points(), 3, 1})[0].shape;
  CHECK(at(whole, 0) == Vec<2>(loop_points().col(0)));
  CHECK(at(whole, 1) == Vec<2>(loop_points().col(6)));
  const Parts parts = make_parts(Path{loop_points(), 3, 3});
  REQUIRE(parts.size() == 3);
  CHECK(parts[2].name == "path.3");
  for (int k = 0; k < 3; ++k) {
    for (double share : {0.0, 0.4, 1.0}) CHECK((at(parts[k].shape, share) - at(whole, (k + share) / 3)).norm() < 4e-15);
    if (k > 0) CHECK(Vec<2>(parts[k - 1].shape.control_points.rightCols<1>()) == parts[k].shape.control_points.col(0));
  }
  const Parts straight = make_parts(Path{loop_points(), 1, 6});
  for (int k = 0; k < 6; ++k) CHECK((at(straight[k].shape, 1) - loop_points().col(k + 1)).norm() < 1e-15);
}
