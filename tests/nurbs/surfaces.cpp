#include <doctest/doctest.h>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"
#include "sem/nurbs/refine.h"
#include "sem/nurbs/search_counts.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {

std::vector<Hit<3>> all_hits(const PreparedNurbs<2, 3>& part, const Line<3>& line) {
  std::vector<Hit<3>> hits;
  append_hits<3>(part, line, -infinity, infinity, hits);
  return hits;
}

Vec<3> random_vector(std::mt19937& random, double reach = 1) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach),
          uniform(random, -reach, reach)};
}

// A bumpy sheet over the unit square, or free control points.
Nurbs<2, 3> random_surface(std::mt19937& random, int degree, int n_spans, bool free) {
  auto surface = random_nurbs<2, 3>(random, degree, n_spans, random() % 3 != 0, random() % 2);
  const int n = n_control(surface, 0);
  for (int i = 0; !free && i < n * n; ++i)
    surface.control_points.col(i) =
        Vec<3>(double(i % n) / (n - 1), double(i / n) / (n - 1), 0.4 * uniform(random, -1, 1));
  return surface;
}

/// Bilinear patch with corners at (u, v) = (0,0), (1,0), (0,1), (1,1).
Nurbs<2, 3> bilinear(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& d) {
  Nurbs<2, 3> patch;
  patch.degree = {1, 1};
  patch.knots = {std::vector<double>{0, 0, 1, 1}, {0, 0, 1, 1}};
  patch.control_points.resize(3, 4);
  patch.control_points << a, b, c, d;
  patch.weights.setOnes(4);
  return patch;
}

/// Surface of revolution of a half circle: the unit sphere, poles included.
Nurbs<2, 3> sphere() {
  const auto around = circle({0, 0}, 1);
  Nurbs<2, 3> surface;
  surface.degree = {2, 2};
  surface.knots = {around.knots[0], {0, 0, 0, 1, 1, 2, 2, 2}};
  const double r[5] = {0, 1, 1, 1, 0}, z[5] = {-1, -1, 0, 1, 1};
  surface.control_points.resize(3, 45);
  surface.weights.resize(45);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 9; ++i) {
      surface.control_points.col(i + 9 * j) << r[j] * around.control_points.col(i), z[j];
      surface.weights[i + 9 * j] = around.weights[i] * (j % 2 == 0 ? 1 : std::sqrt(0.5));
    }
  return surface;
}

// Intersections of the line with a fine triangulation.
int triangulated_hits(const Nurbs<2, 3>& surface, const Line<3>& line, int n) {
  std::vector<Vec<2>> plane;
  const Vec<3> d = line.direction.normalized();
  const Vec<3> a = d.unitOrthogonal(), b = d.cross(a);
  const Interval U = domain(surface, 0), V = domain(surface, 1);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Param<2> u(U.lower + (U.upper - U.lower) * i / n,
                       V.lower + (V.upper - V.lower) * j / n);
      const Vec<3> X = point(surface, u) - line.origin;
      plane.push_back({a.dot(X), b.dot(X)});
    }
  const auto contains = [](const Vec<2>& p, const Vec<2>& q, const Vec<2>& r) {
    const auto cross = [](const Vec<2>& x, const Vec<2>& y) {
      return x[0] * y[1] - x[1] * y[0] >= 0;
    };
    return cross(p, q) == cross(q, r) && cross(q, r) == cross(r, p);
  };
  int count = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int k = j * (n + 1) + i;
      count += contains(plane[k], plane[k + 1], plane[k + n + 2]);
      count += contains(plane[k], plane[k + n + 2], plane[k + n + 1]);
    }
  return count;
}

// Samples, then a compass search from the best few.
double brute_force_distance(const Nurbs<2, 3>& surface, const Vec<3>& X) {
  const Interval U = domain(surface, 0), V = domain(surface, 1);
  const auto distance = [&](double s, double t) {
    const Param<2> u(U.lower + std::clamp(s, 0.0, 1.0) * (U.upper - U.lower),
                     V.lower + std::clamp(t, 0.0, 1.0) * (V.upper - V.lower));
    return (point(surface, u) - X).norm();
  };
  const int n = 60;
  std::vector<std::array<double, 3>> samples;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      samples.push_back({distance(double(i) / n, double(j) / n), double(i) / n, double(j) / n});
  std::partial_sort(samples.begin(), samples.begin() + 5, samples.end());
  double best = infinity;
  for (int k = 0; k < 5; ++k) {
    auto [d, s, t] = samples[k];
    for (double h = 1.0 / n; h > 1e-8;) {
      const double old = d;
      for (const auto& [ds, dt] : {std::pair{h, 0.0},
                                   {-h, 0.0},
                                   {0.0, h},
                                   {0.0, -h},
                                   {h, h},
                                   {h, -h},
                                   {-h, h},
                                   {-h, -h}}) {
        const double trial = distance(s + ds, t + dt);
        if (trial < d) {
          d = trial;
          s += ds;
          t += dt;
          break;
        }
      }
      if (d == old) h *= 0.5;
    }
    best = std::min(best, d);
  }
  return best;
}

}  // namespace

TEST_CASE("a line through a point of a surface hits it there: none is missed") {
  std::mt19937 random(21);
  for (int trial = 0; trial < 1500; ++trial) {
    const auto surface = random_surface(random, 1 + trial % 3, 1 + random() % 3, random() % 2);
    const auto part = prepare(surface);
    auto u = random_parameter(random, surface);
    if (trial % 4 == 0)  // on an edge or knot line
      u[random() % 2] = part.pieces[random() % part.pieces.size()].lower[random() % 2];
    for (int a = 0; a < 2; ++a)
      u[a] = std::clamp(u[a], domain(surface, a).lower, domain(surface, a).upper);
    const Vec<3> X = point(surface, u);
    const Line<3> line{X, random_vector(random)};
    bool found = false;
    for (const auto& hit : all_hits(part, line)) {
      CHECK((line.origin + hit.t * line.direction - point(surface, hit.u)).norm() <= 5e-14);
      found = found || std::abs(hit.t) * line.direction.norm() < 1e-10;
    }
    CHECK(found);
  }
}

TEST_CASE("hits of random surfaces are as many as a triangulation has") {
  std::mt19937 random(22);
  int n_differ = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto surface = random_surface(random, 1 + trial % 3, 1 + random() % 2, trial % 2);
    const Line<3> line{0.7 * random_vector(random), random_vector(random)};
    const int found = int(all_hits(prepare(surface), line).size());
    n_differ += found != triangulated_hits(surface, line, 80);
  }
  CHECK(n_differ <= 4);  // nearly tangent ones
}

TEST_CASE("a line meets the sphere where it should, touches it once, or misses it") {
  std::mt19937 random(23);
  const auto part = prepare(sphere());
  for (int trial = 0; trial < 300; ++trial) {
    const Vec<3> d = random_vector(random).normalized();
    const Vec<3> normal = d.cross(random_vector(random)).normalized();
    const double height = uniform(random, 0, 1.2);
    const auto hits = all_hits(part, {height * normal - 3 * d, d});
    REQUIRE(hits.size() == (height < 1 ? 2 : 0));
    if (height >= 1) continue;
    const double half = std::sqrt(1 - height * height);
    CHECK(hits[0].t == doctest::Approx(3 - half).epsilon(1e-12));
    CHECK(hits[1].t == doctest::Approx(3 + half).epsilon(1e-12));
    CHECK(hits[0].crosses);
  }
  for (int trial = 0; trial < 40; ++trial) {
    const Vec<3> d = random_vector(random).normalized();
    const Vec<3> normal = d.cross(random_vector(random)).normalized();
    const auto hits = all_hits(part, {normal - d, d});
    CHECK(hits.size() >= 1);
    CHECK(hits.size() <= 2);
    for (const auto& hit : hits) CHECK(std::abs(hit.t - 1) < 1e-6);
  }
}

TEST_CASE("a line in the plane of a flat patch gives the two ends of the stretch, along") {
  const auto part = prepare(bilinear({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}));
  const auto hits = all_hits(part, {{-1, 0.25, 0}, {1, 0.125, 0}});
  REQUIRE(hits.size() == 2);
  CHECK(hits[0].t == doctest::Approx(1).epsilon(1e-12));
  CHECK(hits[1].t == doctest::Approx(3).epsilon(1e-12));
  CHECK(hits[0].along);
  CHECK(!hits[1].crosses);
  CHECK(all_hits(part, {{-1, 1.25, 0}, {1, 0, 0}}).empty());
}

TEST_CASE("a ray through a box of six patches enters and leaves once") {
  std::mt19937 random(24);
  std::vector<PreparedNurbs<2, 3>> box;
  const auto corner = [](int k) { return Vec<3>(k & 1, (k >> 1) & 1, (k >> 2) & 1); };
  for (const auto& [a, b, c, d] : {std::array{0, 1, 2, 3},
                                   {4, 5, 6, 7},
                                   {0, 1, 4, 5},
                                   {2, 3, 6, 7},
                                   {0, 2, 4, 6},
                                   {1, 3, 5, 7}})
    box.push_back(prepare(bilinear(corner(a), corner(b), corner(c), corner(d))));
  for (int trial = 0; trial < 200; ++trial) {
    const Vec<3> inside(uniform(random), uniform(random), uniform(random));
    Line<3> line{inside, random_vector(random)};
    if (trial % 2) line.direction = Vec<3>::Unit(trial % 3);
    std::vector<Hit<3>> hits;
    for (const auto& face : box) append_hits<3>(face, line, -infinity, infinity, hits);
    REQUIRE(hits.size() == 2);
    CHECK(hits[0].t * hits[1].t < 0);
  }
}

TEST_CASE("closest point on random surfaces is never farther than brute force finds") {
  std::mt19937 random(25);
  for (int trial = 0; trial < 60; ++trial) {
    const auto surface = random_surface(random, 1 + trial % 3, 1 + random() % 3, trial % 2);
    const Vec<3> X = random_vector(random, 1.3);
    const auto found = closest_point<3>(prepare(surface), X);
    CHECK(found.distance <= brute_force_distance(surface, X) + 1e-13);
    CHECK((point(surface, found.u) - found.point).norm() < 1e-13);
    CHECK(found.distance == doctest::Approx((found.point - X).norm()).epsilon(1e-13));
  }
}

TEST_CASE("closest point of a point on a surface is that point") {
  std::mt19937 random(26);
  for (int trial = 0; trial < 200; ++trial) {
    const auto surface = random_surface(random, 1 + trial % 3, 1 + random() % 3, trial % 2);
    const Vec<3> X = point(surface, random_parameter(random, surface));
    CHECK(closest_point<3>(prepare(surface), X).distance <= 1e-13);
  }
}

TEST_CASE("closest point of a point at any height over a surface is at most as far") {
  std::mt19937 random(28);
  for (int trial = 0; trial < 150; ++trial) {
    const auto surface = random_surface(random, 1 + trial % 3, 1 + random() % 3, trial % 2);
    const auto u = random_parameter(random, surface);
    const Vec<3> normal = DimTraits<3>::area_normal(derivatives(surface, u, 1).first).normalized();
    const auto part = prepare(surface);
    for (double height = 1e-13; height < 1e-3; height *= 10) {
      const double distance = closest_point<3>(part, point(surface, u) + height * normal).distance;
      CHECK(distance <= height + 1e-14);
    }
    const Vec<3> X = point(surface, u) + 1e-4 * normal;
    CHECK(closest_point<3>(part, X).distance <= brute_force_distance(surface, X) + 1e-13);
  }
}

TEST_CASE("closest point of sphere and flat patch is exact, also where many points tie") {
  std::mt19937 random(27);
  const auto ball = prepare(sphere());
  const auto flat = prepare(bilinear({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}));
  for (int trial = 0; trial < 100; ++trial) {
    const Vec<3> X = random_vector(random, 2);
    CHECK(closest_point<3>(ball, X).distance ==
          doctest::Approx(std::abs(X.norm() - 1)).epsilon(1e-12));
    const Vec<3> foot(std::clamp(X[0], 0.0, 2.0), std::clamp(X[1], 0.0, 1.0), 0);
    CHECK((closest_point<3>(flat, X).point - foot).norm() < 1e-12);
  }
  CHECK(closest_point<3>(ball, Vec<3>(0, 0, 0)).distance == doctest::Approx(1).epsilon(1e-14));
  CHECK(closest_point<3>(ball, Vec<3>(0, 0, 0.5)).distance == doctest::Approx(0.5).epsilon(1e-14));
  CHECK(closest_point<3>(flat, Vec<3>(0.5, 0.5, 9), 1.0).distance == infinity);
}

namespace {

/// The conic with control points (0, 0), (1/2, 1), (1, 0) and weights 1, w, 1, and the surface that it
/// sweeps along z.
struct Conic {
  PreparedNurbs<1, 2> curve;
  PreparedNurbs<2, 3> surface;
};
Conic conic(double w) {
  Nurbs<1, 2> curve;
  curve.degree = {2};
  curve.knots[0] = {0, 0, 0, 1, 1, 1};
  curve.control_points.resize(2, 3);
  curve.control_points << 0, 0.5, 1, 0, 1, 0;
  curve.weights = Eigen::Vector3d(1, w, 1);
  Nurbs<2, 3> surface;
  surface.degree = {2, 1};
  surface.knots = {curve.knots[0], {0, 0, 1, 1}};
  surface.control_points.resize(3, 6);
  surface.control_points.topRows(2) << curve.control_points, curve.control_points;
  surface.control_points.row(2) << 0, 0, 0, 1, 1, 1;
  surface.weights.resize(6);
  surface.weights << curve.weights, curve.weights;
  return {prepare(curve), prepare(surface)};
}

/// Patches looked at by some queries near and below the surface.
long patches_of_queries(const PreparedNurbs<2, 3>& surface) {
  std::mt19937 random(8);
  const long before = detail::search_counts().closest_patches;
  for (int k = 0; k < 50; ++k)
    REQUIRE(closest_point<3>(surface, 0.5 * (Vec<3>::Ones() + random_vector(random))).distance < 2);
  return detail::search_counts().closest_patches - before;
}

}  // namespace

TEST_CASE("closest point with weights from 1e-6 to 1e6: a swept conic is as far as the conic itself") {
  std::mt19937 random(7);
  for (const double w : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    CAPTURE(w);
    const Conic c = conic(w);
    for (int k = 0; k < 100; ++k) {
      const Vec<3> X = 0.5 * (Vec<3>::Ones() + random_vector(random));
      const double flat = closest_point<2>(c.curve, X.head<2>()).distance;
      CHECK(std::abs(closest_point<3>(c.surface, X).distance - flat) < 1e-12);
    }
  }
}

TEST_CASE("closest point with a weight of 1e6 looks at no more than 150 times the patches of 1") {
  const long ordinary = patches_of_queries(conic(1).surface), uneven = patches_of_queries(conic(1e6).surface);
  MESSAGE("patches of 50 queries: ", ordinary, " and ", uneven);
  CHECK(ordinary < 50 * 20);
  CHECK(uneven < 150 * ordinary);
}

TEST_CASE("hits with weights from 1e-6 to 1e6: a line across a swept conic meets both its branches") {
  std::mt19937 random(9);
  for (const double w : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (int k = 0; k < 100; ++k) {
      // The conic is y^2 = w^2 ((1 - y)^2 - (2 x - 1)^2).
      const double y = w / (1 + w) * uniform(random), z = uniform(random);
      const double half = std::sqrt((1 - y) * (1 - y) - y * y / (w * w)) / 2;
      const auto hits = all_hits(conic(w).surface, {Vec<3>(0, y, z), Vec<3>::UnitX()});
      CAPTURE(w);
      CAPTURE(y);
      REQUIRE(hits.size() == 2);
      CHECK(std::abs(hits[0].t - (0.5 - half)) < 1e-9);
      CHECK(std::abs(hits[1].t - (0.5 + half)) < 1e-9);
    }
}

TEST_CASE("lines through and past a pole: a fan over a quarter disc is hit once where the disc is, at ordinary cost") {
  Nurbs<2, 3> quarter;  // edge u = 0 collapsed at the centre
  quarter.degree = {1, 2};
  quarter.knots = {std::vector<double>{0, 0, 1, 1}, std::vector<double>{0, 0, 0, 1, 1, 1}};
  quarter.control_points.resize(3, 6);
  quarter.control_points << 0, 1, 0, 1, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0;
  quarter.weights = Eigen::VectorXd::Ones(6);
  quarter.weights[2] = quarter.weights[3] = std::sqrt(0.5);
  const auto fan = prepare(quarter);
  std::mt19937 random(11);
  const auto queries = [&](double distance) {
    const long before = detail::search_counts().hit_patches;
    for (int k = 0; k < 200; ++k) {
      const Vec<3> from_pole = distance * random_vector(random).cwiseProduct(Vec<3>(1, 1, 0));
      Vec<3> direction = random_vector(random);
      direction[2] += 1.5;
      const size_t expected = distance == 0 || (from_pole[0] > 0 && from_pole[1] > 0 && from_pole.norm() < 1);
      CAPTURE(from_pole);
      REQUIRE(all_hits(fan, {from_pole, direction}).size() == expected);
    }
    return detail::search_counts().hit_patches - before;
  };
  const long ordinary = queries(0.5);
  for (const double distance : {1e-3, 1e-6, 0.0}) {
    const long near = queries(distance);
    MESSAGE("patches of 200 lines: ", ordinary, " and ", near);
    CHECK(near < 30 * ordinary);
  }
}

TEST_CASE("closest points from the axis of a cylinder: all as far as its radius, at ordinary cost") {
  std::mt19937 random(12);
  const Mat<3> R = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized().toRotationMatrix();
  const Vec<3> center(0.4, -1.2, 2.3);
  Nurbs<2, 3> quarter;
  quarter.degree = {2, 1};
  quarter.knots = {std::vector<double>{0, 0, 0, 1, 1, 1}, std::vector<double>{0, 0, 1, 1}};
  quarter.control_points.resize(3, 6);
  quarter.control_points << 1, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0, 0, 1, 1, 1;
  quarter.control_points = ((R * quarter.control_points).colwise() + center).eval();
  quarter.weights = Eigen::VectorXd::Ones(6);
  quarter.weights[1] = quarter.weights[4] = std::sqrt(0.5);
  const auto cylinder = prepare(quarter);
  const auto queries = [&](double radius) {
    const long before = detail::search_counts().closest_patches;
    for (int k = 0; k < 50; ++k) {
      const double z = 0.5 * (1 + uniform(random)), angle = M_PI / 4;
      const Vec<3> X = center + R * Vec<3>(radius * std::cos(angle), radius * std::sin(angle), z);
      REQUIRE(std::abs(closest_point<3>(cylinder, X).distance - (1 - radius)) < 1e-14);
    }
    return detail::search_counts().closest_patches - before;
  };
  const long ordinary = queries(0.5), axis = queries(0);
  MESSAGE("patches of 50 queries: ", ordinary, " and ", axis);
  CHECK(axis < 30 * ordinary);
}
