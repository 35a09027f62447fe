#include <doctest/doctest.h>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/hits.h"
#include "sem/nurbs/refine.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {

std::vector<Hit<2>> all_hits(const Nurbs<1, 2>& curve, const Line<2>& line) {
  std::vector<Hit<2>> hits;
  append_hits<2>(prepare(curve), line, -infinity, infinity, hits);
  return hits;
}

int n_crossings(const std::vector<Hit<2>>& hits) {
  return int(std::count_if(hits.begin(), hits.end(), [](const auto& hit) { return hit.crosses; }));
}

bool positive_side(const Line<2>& line, const Vec<2>& X) {
  const Vec<2> d = X - line.origin;
  if (line.direction[1] == 0) return line.direction[0] > 0 ? d[1] >= 0 : -d[1] >= 0;
  if (line.direction[0] == 0) return line.direction[1] > 0 ? -d[0] >= 0 : d[0] >= 0;
  return line.direction[0] * d[1] - line.direction[1] * d[0] >= 0;
}

Nurbs<1, 2> random_curve(std::mt19937& random) {
  const int degree = 1 + random() % 6, n_spans = 1 + random() % 6;
  const bool rational = random() % 2;
  if (random() % 3 == 0) return random_closed(random, degree, n_spans + 1, rational);
  return random_nurbs<1, 2>(random, degree, n_spans, random() % 4 != 0, rational);
}

Line<2> random_line(std::mt19937& random) {
  const int kind = random() % 3;
  const Vec<2> origin(uniform(random, -1, 1), uniform(random, -1, 1));
  const double sign = random() % 2 ? 1 : -1;
  if (kind == 0) return {origin, {sign, 0}};
  if (kind == 1) return {origin, {0, sign * 2}};
  return {origin, {uniform(random, -1, 1), uniform(random, -1, 1)}};
}

// Sign changes of the distance to the line at n parameters.
int sampled_crossings(const Nurbs<1, 2>& curve, const Line<2>& line, int n) {
  const auto [lower, upper] = domain(curve, 0);
  int count = 0;
  bool last = false;
  for (int k = 0; k <= n; ++k) {
    const Param<1> u(lower + (upper - lower) * k / n);
    const bool now = positive_side(line, point(curve, u));
    count += k > 0 && now != last;
    last = now;
  }
  return count;
}

}  // namespace

TEST_CASE("hits of random lines and curves: as many crossings as sampling finds, never fewer") {
  std::mt19937 random(1);
  int n_differ = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const auto curve = random_curve(random);
    const auto line = random_line(random);
    const int found = n_crossings(all_hits(curve, line));
    const int sampled = sampled_crossings(curve, line, 1000);
    CHECK(found >= sampled);
    CHECK((found - sampled) % 2 == 0);
    n_differ += found != sampled;
  }
  CHECK(n_differ <= 5);  // two roots between two samples
}

TEST_CASE("hits lie on line and curve to 1e-14 of the size") {
  std::mt19937 random(2);
  for (int trial = 0; trial < 3000; ++trial) {
    const auto curve = random_curve(random);
    const auto line = random_line(random);
    for (const auto& hit : all_hits(curve, line)) {
      const Vec<2> X = line.origin + hit.t * line.direction;
      // The parameter's own rounding moves the point with the speed of the curve.
      const double last_bit = 2.3e-16 * std::abs(hit.u[0]);
      const auto at = derivatives(curve, hit.u);
      CHECK((X - at.point).norm() <= 1e-14 + last_bit * at.first.norm());
    }
  }
}

TEST_CASE("hits are sorted by t and limited to [t_min, t_max]") {
  std::mt19937 random(3);
  std::vector<Hit<2>> part;
  for (int trial = 0; trial < 300; ++trial) {
    const auto curve = random_curve(random);
    const auto line = random_line(random);
    const auto all = all_hits(curve, line);
    CHECK(std::is_sorted(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return a.t < b.t; }));
    part.clear();
    append_hits<2>(prepare(curve), line, 0, 0.5, part);
    const auto inside = std::count_if(all.begin(), all.end(),
                                      [](const auto& hit) { return hit.t >= 0 && hit.t <= 0.5; });
    CHECK(long(part.size()) == inside);
  }
}

TEST_CASE("parity of crossings is that of the end points' sides, also through end points") {
  std::mt19937 random(4);
  for (int trial = 0; trial < 4000; ++trial) {
    const auto curve = random_curve(random);
    const auto prepared = prepare(curve);
    auto line = random_line(random);
    // Through an end point or joint of pieces, or a control point.
    const auto& piece = prepared.pieces[random() % prepared.pieces.size()];
    if (trial % 3 != 0) line.origin = piece.points.col(random() % piece.points.cols());
    if (trial % 5 == 0) line.origin = piece.points.col(random() % 2 ? 0 : curve.degree[0]);
    const Vec<2> first = prepared.pieces.front().points.col(0);
    const Vec<2> last = prepared.pieces.back().points.rightCols<1>();
    const bool odd = positive_side(line, first) != positive_side(line, last);
    CHECK(n_crossings(all_hits(curve, line)) % 2 == int(odd));
  }
}

TEST_CASE("parity holds along polylines on a coarse grid with lines on grid points") {
  std::mt19937 random(5);
  const auto grid = [&] { return Vec<2>(int(random() % 4), int(random() % 4)); };
  for (int trial = 0; trial < 4000; ++trial) {
    // A closed loop of several parts that share end points; many stretches
    // run along the line, many joints touch it.
    Line<2> line{grid(), {0, 0}};
    while (line.direction.isZero()) line.direction = grid() - grid();
    const int n_parts = 1 + random() % 3;
    Vec<2> start = grid(), at = start;
    int total = 0;
    for (int part = 0; part < n_parts; ++part) {
      const int n = 2 + random() % 4;
      Points<2> points(2, n);
      points.col(0) = at;
      for (int k = 1; k < n; ++k) points.col(k) = grid();
      if (part + 1 == n_parts) points.col(n - 1) = start;
      at = points.col(n - 1);
      const auto curve = random() % 2 ? polyline(points) : bezier(points);
      const auto hits = all_hits(curve, line);
      const int crossings = n_crossings(hits);
      CHECK(crossings % 2 == int(positive_side(line, points.col(0)) != positive_side(line, at)));
      total += crossings;
    }
    CHECK(total % 2 == 0);
  }
}

TEST_CASE("points between hits are inside or outside as parity says: random polygons") {
  std::mt19937 random(6);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 5 + random() % 5;
    Points<2> points(2, n + 1);
    for (int k = 0; k < n; ++k) points.col(k) = Vec<2>(int(random() % 6), int(random() % 6));
    points.col(n) = points.col(0);
    const double y = int(random() % 6);
    const auto hits = all_hits(polyline(points), {{-1, y}, {1, 0}});
    // Parity just below the line, where no vertex is met: 0 counts as +.
    const auto below_line = all_hits(polyline(points), {{-1, y - 1e-7}, {1, 0}});
    for (double x = -0.5; x < 6; x += 0.5) {
      int a = 0, b = 0;
      for (const auto& hit : hits) a += hit.crosses && hit.t < x + 1 - 1e-5;
      for (const auto& hit : below_line) b += hit.crosses && hit.t < x + 1 - 1e-5;
      bool near_hit = false;
      for (const auto& hit : hits) near_hit = near_hit || std::abs(hit.t - x - 1) < 1e-4;
      if (!near_hit) CHECK(a % 2 == b % 2);
    }
  }
}

TEST_CASE("a tangent to a circle touches once and does not cross") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec<2> centre(uniform(random, -1, 1), uniform(random, -1, 1));
    const double angle = trial < 8 ? trial * 0.25 * M_PI : uniform(random, 0, 7);
    const double r = uniform(random, 0.5, 2);
    const Vec<2> normal(std::cos(angle), std::sin(angle));
    const Vec<2> along(-normal[1], normal[0]);
    const auto hits = all_hits(circle(centre, r), {centre + r * normal - along, along});
    REQUIRE(hits.size() >= 1);
    // To rounding the line may also cut: then both hits are at the same place.
    for (const auto& hit : hits) {
      CHECK(hit.tangent);
      CHECK(std::abs(hit.t - 1) < 2e-7);
    }
    CHECK(n_crossings(hits) % 2 == 0);
    CHECK(hits.size() <= 2);
  }
  for (double r : {1.0, 2.5}) {
    const auto top = all_hits(circle({0, 0}, r), {{-3, r}, {1, 0}});
    REQUIRE(top.size() == 1);
    CHECK(top[0].t == doctest::Approx(3).epsilon(1e-15));
    CHECK(top[0].u[0] == 1);
    CHECK(!top[0].crosses);
    CHECK(top[0].tangent);
  }
}

TEST_CASE("a double root inside a piece is found once, at the tangent point") {
  Points<2> points(2, 3);
  points << 0, 1, 2.5, 1, -1, 1;  // y = (1 - 2s)^2 at s = 1/2
  for (double shift : {0.0, 0.3, 1e5}) {
    Points<2> moved = points;
    moved.row(1).array() += shift;
    const auto hits = all_hits(bezier(moved), {{0, shift}, {1, 0}});
    REQUIRE(hits.size() == 1);
    CHECK(hits[0].tangent);
    CHECK(!hits[0].crosses);
    CHECK(std::abs(hits[0].u[0] - 0.5) < 1e-7);
  }
  // The same where halving never meets the root.
  std::mt19937 random(8);
  for (int trial = 0; trial < 100; ++trial) {
    const double root = uniform(random, 0.05, 0.95);
    Points<2> p(2, 4);
    for (int k = 0; k < 4; ++k) p(0, k) = k;
    const double c[3] = {root * root, -root * (1 - root), (1 - root) * (1 - root)};
    p(1, 0) = c[0];
    p(1, 3) = c[2];
    p(1, 1) = (c[0] + 2 * c[1]) / 3;
    p(1, 2) = (2 * c[1] + c[2]) / 3;
    const auto hits = all_hits(bezier(p), {{0, 0}, {1, 0}});
    CHECK(n_crossings(hits) % 2 == 0);
    REQUIRE(hits.size() >= 1);
    CHECK(hits.size() <= 2);
    for (const auto& hit : hits) {
      CHECK(hit.tangent);
      CHECK(std::abs(hit.u[0] - root) < 1e-7);
    }
  }
}

TEST_CASE("a line through the joint of two parts crosses the pair once, or touches a peak") {
  Points<2> up(2, 2), on(2, 2), down(2, 2);
  up << 0, 1, -1, 0;
  on << 1, 2, 0, 1;
  down << 1, 2, 0, -1;
  const Line<2> line{{-1, 0}, {1, 0}};
  const auto a = all_hits(polyline(up), line), b = all_hits(polyline(on), line);
  REQUIRE(a.size() == 1);
  REQUIRE(b.size() == 1);
  CHECK(a[0].t == 2);
  CHECK(b[0].t == 2);
  CHECK(a[0].crosses != b[0].crosses);
  const auto c = all_hits(polyline(down), line);
  REQUIRE(c.size() == 1);
  CHECK(a[0].crosses == c[0].crosses);
}

TEST_CASE("a straight part along the line gives both its ends, along, without crossing") {
  Points<2> points(2, 4);
  points << 0, 1, 2, 2, 0, 0, 0, 1;
  const auto hits = all_hits(polyline(points), {{-1, 0}, {1, 0}});
  REQUIRE(hits.size() == 3);
  for (int k = 0; k < 3; ++k) {
    CHECK(hits[k].t == k + 1);
    CHECK(hits[k].u[0] == k);
    CHECK(hits[k].along);
    CHECK(!hits[k].crosses);
  }
  const auto below = all_hits(polyline(points), {{3, 0}, {-1, 0}});  // the other side is positive
  CHECK(n_crossings(below) == 1);
  // Exactly straight edges stay so under insertion, elevation and unequal weights.
  auto edge = polyline(Points<2>{{0.1, 0.7}, {0.3, 0.3}});
  edge.weights << 0.3, 1.7;
  edge = elevate_degree(insert_knot(edge, 0, 0.3), 0, 3);
  for (const auto& hit : all_hits(edge, {{0, 0.3}, {1, 0}})) {
    CHECK(hit.along);
    CHECK(!hit.crosses);
  }
}

TEST_CASE("a hit on an inner joint or on the closing joint is reported once") {
  const auto disc = circle({0, 0}, 1);
  const auto hits = all_hits(disc, {{-2, 0}, {1, 0}});
  REQUIRE(hits.size() == 2);
  CHECK(hits[0].t == 1);
  CHECK(hits[1].t == 3);
  CHECK(hits[0].crosses);
  CHECK(hits[1].crosses);
  CHECK(hits[0].u[0] == 2);
  CHECK(hits[1].u[0] == 0);
}

TEST_CASE("degree 24 works") {
  std::mt19937 random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const auto curve = random_nurbs<1, 2>(random, 24, 2, true, true);
    const auto line = random_line(random);
    CHECK(n_crossings(all_hits(curve, line)) == sampled_crossings(curve, line, 2000));
  }
}
