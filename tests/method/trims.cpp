// Trimmed surfaces.
#include <doctest/doctest.h>

#include <random>

#include "sem/base/error.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/distance_weights.h"
#include "sem/method/followers.h"
#include "sem/method/quadrature.h"
#include "sem/method/samples.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"
#include "trimmed.h"

using namespace sem;

namespace {

Boundary<3> trimmed_boundary(const test::TrimmedSolid& solid) {
  return make_boundary<3>({solid.parts}, solid.trims);
}

PreparedNurbs<2, 3> trimmed_part(const Nurbs<2, 3>& shape, const TrimLoops& trims) {
  return make_boundary<3>({{shape}}, {trims}).parts[0];
}

double area(const Nurbs<2, 3>& shape, const TrimLoops& trims, int points = 0) {
  SamplingOptions options;
  options.points_per_span = points;
  return sample_boundary(make_boundary<3>({{shape}}, {trims}), options).weight.sum();
}

double uniform(std::mt19937& random, double lower, double upper) {
  return lower + (upper - lower) * (double(random() >> 5) / double(1u << 27));
}

// A wavy bicubic patch over [0, 2] x [0, 1], knots inside.
Nurbs<2, 3> wavy(unsigned seed, bool rational) {
  std::mt19937 random(seed);
  Nurbs<2, 3> patch;
  patch.degree = {3, 3};
  patch.knots = {std::vector<double>{0, 0, 0, 0, 0.7, 1.2, 2, 2, 2, 2},
                 {0, 0, 0, 0, 0.6, 1, 1, 1, 1}};
  const int n_u = 6, n_v = 5;
  patch.control_points.resize(3, n_u * n_v);
  patch.weights = Eigen::VectorXd::Ones(n_u * n_v);
  for (int i = 0; i < n_u * n_v; ++i) {
    const Vec<3> shift(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    patch.control_points.col(i) =
        Vec<3>(2.0 * (i % n_u) / (n_u - 1), double(i / n_u) / (n_v - 1), 0) + 0.25 * shift;
    if (rational) patch.weights[i] = std::exp(uniform(random, -1, 1));
  }
  return patch;
}

TrimLoops ring_of(double radius) {
  return {test::circle({1, 0.5}, radius), test::circle({1.05, 0.45}, radius / 2, 3)};
}

}  // namespace

TEST_CASE("trims: the area of a disc cut out of a plane is pi r^2, of a ring the difference") {
  const auto plane =
      test::bilinear({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0});  // area 4 of the domain's 1
  CHECK(area(plane, {test::circle({0.5, 0.5}, 0.3)}) ==
        doctest::Approx(4 * M_PI * 0.09).epsilon(1e-10));
  CHECK(area(plane, {test::circle({0.5, 0.5}, 0.3, 5)}) ==
        doctest::Approx(4 * M_PI * 0.09).epsilon(1e-8));
  CHECK(area(plane, {test::circle({0.5, 0.5}, 0.3), test::circle({0.55, 0.5}, 0.1)}, 20) ==
        doctest::Approx(4 * M_PI * 0.08).epsilon(1e-12));
}

TEST_CASE("trims: orientation and order of loops do not matter, an island in a hole counts") {
  const auto plane = test::bilinear({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0});
  auto hole = test::circle({0.5, 0.5}, 0.2, 3);
  for (auto& arc : hole) arc = reversed(arc, 0);
  const auto island = test::polygon({{0.45, 0.45}, {0.55, 0.45}, {0.55, 0.55}, {0.45, 0.55}});
  CHECK(area(plane, {island, hole, test::natural_trim(plane)}, 12) ==
        doctest::Approx(1 - M_PI * 0.04 + 0.01).epsilon(1e-11));
}

TEST_CASE("trims: the area of a trimmed paraboloid converges to the closed form") {
  const auto patch = test::paraboloid(0.5);
  const double r = 0.8, exact = 2 * M_PI / 3 * (std::pow(1 + r * r, 1.5) - 1);
  const TrimLoops disc = {test::circle({0, 0}, r)};
  CHECK(area(patch, disc) == doctest::Approx(exact).epsilon(2e-4));
  CHECK(area(patch, disc, 6) == doctest::Approx(exact).epsilon(1e-7));
  CHECK(area(patch, disc, 16) == doctest::Approx(exact).epsilon(1e-13));
}

TEST_CASE("trims: knots of the surface cut the rule") {
  auto patch = test::paraboloid(0.5);
  for (const double u : {-0.3, 0.1, 0.2}) patch = insert_knot(insert_knot(patch, 0, u), 1, u);
  const double r = 0.8, exact = 2 * M_PI / 3 * (std::pow(1 + r * r, 1.5) - 1);
  CHECK(area(patch, {test::circle({0, 0}, r)}, 14) == doctest::Approx(exact).epsilon(1e-10));
  // Polynomials of degree 7 in each parameter and span: Gauss' rule with 4 points is exact.
  const TrimLoops square = {test::polygon({{-0.5, -0.6}, {0.7, -0.6}, {0.7, 0.9}, {-0.5, 0.9}})};
  const auto rule = trimmed_part(patch, square).region->rule(4);
  double sum = 0;
  for (size_t k = 0; k < rule.u.size(); ++k)
    sum +=
        rule.weight[k] * std::pow(rule.u[k][0], 6) * std::pow(std::max(0.0, rule.u[k][1] - 0.1), 7);
  CHECK(sum == doctest::Approx((std::pow(0.7, 7) + std::pow(0.5, 7)) / 7 * std::pow(0.8, 8) / 8)
                   .epsilon(1e-12));
}

TEST_CASE("trims: loops along the domain's border give the same as none") {
  const auto patch = wavy(3, true);
  const auto whole = make_boundary<3>({{patch}}),
             cut = make_boundary<3>({{patch}}, {{test::natural_trim(patch)}});
  SamplingOptions options{6, SampleWeight::measure, SampleRule::gauss};
  const auto a = sample_boundary(whole, options), b = sample_boundary(cut, options);
  REQUIRE(a.size() == b.size());
  const Eigen::MatrixXd Ja = sample_jacobian(a, whole.n_controls()),
                        Jb = sample_jacobian(b, cut.n_controls());
  CHECK((Ja.transpose() * a.weight.asDiagonal() * Ja - Jb.transpose() * b.weight.asDiagonal() * Jb)
            .norm() < 1e-14);
  CHECK((whole.box.upper - cut.box.upper).norm() + (whole.box.lower - cut.box.lower).norm() < 0.2);
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec<3> X(uniform(random, -0.5, 2.5), uniform(random, -0.5, 1.5), uniform(random, -1, 1));
    const auto p = closest_point(whole.parts[0], X), q = closest_point(cut.parts[0], X);
    CHECK(std::abs(p.distance - q.distance) < 1e-14);
    CHECK((p.point - q.point).norm() < 1e-7);
    const Line<3> line{X, Vec<3>(uniform(random, -1, 1), uniform(random, -1, 1), 1)};
    std::vector<Hit<3>> hits_whole, hits_cut;
    append_hits(whole.parts[0], line, -5, 5, hits_whole);
    append_hits(cut.parts[0], line, -5, 5, hits_cut);
    CHECK(hits_whole.size() == hits_cut.size());
  }
}

TEST_CASE("trims: hits outside of the loops are no hits") {
  const auto part = trimmed_part(test::paraboloid(0.3),
                                 {test::circle({0, 0}, 0.8), test::circle({0, 0.1}, 0.3, 3)});
  std::mt19937 random(1);
  int n_inside = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double x = uniform(random, -1, 1), y = uniform(random, -1, 1);
    std::vector<Hit<3>> hits;
    append_hits<3>(part, {Vec<3>(x, y, -3), Vec<3>::UnitZ()}, 0, 10, hits);
    const bool in = std::hypot(x, y) < 0.8 && std::hypot(x, y - 0.1) > 0.3;
    CHECK(hits.size() == size_t(in));
    n_inside += in;
  }
  CHECK(n_inside > 50);
}

TEST_CASE("trims: the closest point is that of the trimmed surface") {
  for (const bool rational : {false, true})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const auto patch = wavy(seed, rational);
      const auto part = trimmed_part(patch, ring_of(0.4));
      // Dense samples: of the inside, and of the border, much denser.
      std::vector<Vec<3>> samples;
      for (int i = 0; i <= 300; ++i)
        for (int j = 0; j <= 150; ++j) {
          const Param<2> u(2.0 * i / 300, j / 150.0);
          const bool in =
              (u - Vec<2>(1, 0.5)).norm() <= 0.4 && (u - Vec<2>(1.05, 0.45)).norm() >= 0.2;
          if (in) samples.push_back(point(part, u));
        }
      for (const double r : {0.4, 0.2})
        for (int k = 0; k < 4000; ++k) {
          const double angle = 2 * M_PI * k / 4000;
          const Vec<2> center = r == 0.4 ? Vec<2>(1, 0.5) : Vec<2>(1.05, 0.45);
          samples.push_back(
              point(part, Param<2>(center + r * Vec<2>(std::cos(angle), std::sin(angle)))));
        }
      std::mt19937 random(seed);
      for (int trial = 0; trial < 60; ++trial) {
        const Vec<3> X(uniform(random, -0.5, 2.5), uniform(random, -0.5, 1.5),
                       uniform(random, -0.8, 0.8));
        double least = std::numeric_limits<double>::infinity();
        for (const auto& sample : samples) least = std::min(least, (sample - X).norm());
        const auto found = closest_point(part, X);
        CAPTURE(X.transpose());
        CHECK(found.distance <= least + 1e-13);
        CHECK(found.distance >= least - 2e-4 / std::max(0.02, least));
        CHECK(part.region->contains(found.u));
        CHECK((point(patch, found.u) - found.point).norm() < 1e-13);
        CHECK(std::abs((found.point - X).norm() - found.distance) < 1e-14);
        // With a cutoff: the same or nothing.
        const double cutoff = uniform(random, 0, 1);
        const auto cut = closest_point(part, X, cutoff);
        if (found.distance < cutoff) CHECK(std::abs(cut.distance - found.distance) < 1e-14);
        if (found.distance > cutoff) CHECK(cut.distance > cutoff);
      }
    }
}

TEST_CASE("trims: a second valley inside the loops is found when the first lies outside") {
  // z = 1 + 8 (u^2 - 1/4)^2 + tilt u, x = u / 10, y = v: seen from the origin's line the valleys u
  // = -1/2 and 1/2.
  for (const double tilt : {0.02, 1e-4, -0.02}) {
    Nurbs<2, 3> patch;
    patch.degree = {4, 1};
    patch.knots = {std::vector<double>{-1, -1, -1, -1, -1, 1, 1, 1, 1, 1}, {0, 0, 1, 1}};
    patch.control_points.resize(3, 10);
    patch.weights = Eigen::VectorXd::Ones(10);
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 5; ++i) {
        const double sum = 2 * i - 4, u = sum / 4, square = (sum * sum - 4) / 12,
                     fourth = i % 2 == 0 ? 1 : -1;
        patch.control_points.col(i + 5 * j) =
            Vec<3>(u / 10, j, 1 + 8 * (fourth - square / 2 + 1 / 16.0) + tilt * u);
      }
    for (const int side : {-1, 1}) {
      const auto part = trimmed_part(
          patch,
          {test::polygon(
              {{0.2 * side, 0.2}, {0.9 * side, 0.3}, {0.8 * side, 0.8}, {0.3 * side, 0.9}})});
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= 4000; ++k)
        least = std::min(
            least, (point(patch, Param<2>(side * (0.4 + 0.2 * k / 4000), 0.5)) - Vec<3>(0, 0.5, 0))
                       .norm());
      const auto found = closest_point(part, Vec<3>(0, 0.5, 0));
      CHECK(found.distance == doctest::Approx(least).epsilon(1e-7));
      CHECK(found.u[0] == doctest::Approx(0.5 * side).epsilon(0.01));
    }
  }
}

TEST_CASE("trims: a foot on the border is the closest point of its curve in closed form") {
  const auto plane = test::rectangle({-1, -1}, {1, 1}, 0);
  const auto part = trimmed_part(plane, {test::circle({0, 0}, 0.8), test::circle({0, 0}, 0.3)});
  std::mt19937 random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec<3> X(uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5), uniform(random, -1, 1));
    const double r = X.head<2>().norm(), rho = std::clamp(r, 0.3, 0.8);
    const auto found = closest_point(part, X);
    CHECK(found.distance == doctest::Approx(std::hypot(X[2], r - rho)).epsilon(1e-13));
    CHECK((found.point.head<2>() - rho / r * X.head<2>()).norm() < 1e-12 / r);
  }
}

TEST_CASE("trims: boxes are tight where the part is flat") {
  const auto tilted = test::bilinear({0, 0, 0}, {3, 0, 1}, {0, 2, 2}, {3, 2, 3});
  const auto boundary = make_boundary<3>({{tilted}}, {{test::circle({0.4, 0.5}, 0.25)}});
  CHECK(boundary.box.lower[0] == doctest::Approx(3 * 0.15).epsilon(1e-12));
  CHECK(boundary.box.upper[1] == doctest::Approx(2 * 0.75).epsilon(1e-12));
  CHECK(boundary.box.upper[2] == doctest::Approx(0.4 + 1 + 0.25 * std::sqrt(5)).epsilon(1e-3));
}

TEST_CASE("trims: volume and moments of a box with a cylinder on it or a hole in it") {
  for (const double rise : {0.7, -0.6}) {
    CAPTURE(rise);
    const double r = 0.2, added = M_PI * r * r * rise;
    const auto boundary = trimmed_boundary(test::box_with_cylinder(r, rise));
    const auto loops = find_loops(boundary);
    CHECK(loops.loops.size() == 1);
    for (const int side : loops.orientation) CHECK(side != 0);
    const auto moments = boundary_moments(boundary, loops);
    REQUIRE(moments.available);
    CHECK(moments.volume == doctest::Approx(1 + added).epsilon(1e-12));
    CHECK(moments.first[0] == doctest::Approx(0.5 * (1 + added)).epsilon(1e-12));
    CHECK(moments.first[2] == doctest::Approx(0.5 + added * (1 + rise / 2)).epsilon(1e-12));
    CHECK(boundary.box.upper[2] == doctest::Approx(std::max(1.0, 1 + rise)).epsilon(1e-12));
    const auto rays = cast_rays(boundary, loops, {.axis = 2, .n_rays = 60});
    CHECK(rays.n_unpaired == 0);
    const auto rule = quadrature_on_rays(rays, {});
    CHECK(rule.weight.sum() == doctest::Approx(1 + added).epsilon(1e-3));
    for (int k = 0; k < rule.size(); k += 7) {
      const Vec<3> X = rule.position.col(k);
      const bool under = (X.head<2>() - Vec<2>(0.5, 0.5)).norm() < r;
      CHECK(X[2] < (under ? 1 + rise : 1.0));
      CHECK(inside(boundary, loops, X));
    }
  }
}

TEST_CASE(
    "trims: gradients of the distance weights agree with differences, also where feet lie on a "
    "trim") {
  const auto boundary = trimmed_boundary(test::box_with_cylinder(0.2, 0.7));
  const auto loops = find_loops(boundary);
  const double h = 1e-6;
  for (const auto variant : {DistanceWeight::sided, DistanceWeight::published}) {
    std::mt19937 random(4);
    const auto theta_at = [&](const Points<3>& X, bool with_gradient, Distances<3>& distances) {
      distances = measure_distances(boundary, loops, X, variant, 2.0);
      auto theta = distance_weights(distances, {.variant = variant, .cutoff = 0.9});
      if (with_gradient) distance_weight_gradients(boundary, X, distances, theta);
      return theta;
    };
    int n_checked = 0, n_on_border = 0;
    for (int trial = 0; trial < 60; ++trial) {
      Vec<3> X(uniform(random, 0.3, 0.7), uniform(random, 0.3, 0.7), uniform(random, 0.7, 1.5));
      if (!inside(boundary, loops, X)) continue;
      Distances<3> distances, near;
      const auto here = theta_at(X, true, distances);
      for (int axis = 0; axis < 3; ++axis) {
        const Vec<3> step = h * Vec<3>::Unit(axis);
        Points<3> around(3, 2);
        around << X - step, X + step;
        const auto there = theta_at(around, false, near);
        if (there.begin[1] != int(here.part.size()) || there.begin[2] != 2 * there.begin[1])
          continue;
        for (size_t e = 0; e < here.part.size(); ++e) {
          const size_t before = e, behind = e + there.begin[1];
          if (there.piece[before] != there.piece[behind]) continue;
          const double difference = (there.theta[behind] - there.theta[before]) / (2 * h);
          CAPTURE(X.transpose());
          CAPTURE(here.part[e]);
          CHECK(std::abs(here.gradient[e][axis] - difference) < 1e-5 * (1 + std::abs(difference)));
          ++n_checked;
          const auto& region = boundary.parts[here.part[e]].region;
          for (int pair = 0; region && pair < distances.begin[1]; ++pair)
            n_on_border += distances.part[pair] == here.part[e] &&
                           region->near_border(distances.foot_u[pair], 1e-9);
        }
      }
    }
    CHECK(n_checked > 100);
    CHECK(n_on_border > 30);
  }
}

TEST_CASE("trims: bad loops are refused by name") {
  const auto plane = test::rectangle({0, 0}, {1, 1}, 0);
  const auto message = [&](const TrimLoops& trims) -> std::string {
    try {
      check_trims<3>(plane, trims, "a.json", "parts[2].trims");
      make_region<3>(prepare(plane), trims);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message({test::circle({0.5, 0.5}, 0.5)}).empty());
  CHECK(message({}).empty());
  CHECK(message({{}}).find("parts[2].trims[0].curves: found no curve") != std::string::npos);
  CHECK(message({test::circle({0.5, 0.5}, 0.2), test::circle({0.5, 0.5}, 0.6)})
            .find("parts[2].trims[1].curves[0]: found a curve through (1.1") != std::string::npos);
  auto open = test::polygon({{0, 0}, {1, 0}, {1, 1}});
  open.pop_back();
  CHECK(message({open}).find("parts[2].trims[0]: found a gap of 1.414") != std::string::npos);
  const auto line = segment<2>({0, 0}, {1, 1});
  CHECK(message({{line, reversed(line, 0)}}).find("loops that enclose nothing") !=
        std::string::npos);
  auto wrong = test::circle({0.5, 0.5}, 0.2);
  wrong[3].weights[1] = -1;
  CHECK(message({wrong}).find("parts[2].trims[0].curves[3].weights[1]") != std::string::npos);
}

TEST_CASE("control points that show at a pole alone follow, others do not") {
  // A disc of an arc over its chord, whose ends are one point each; the middle control points weigh `w`.
  const auto followers = [](double w, double width_of_end) {
    Nurbs<2, 3> cap;
    cap.degree = {2, 1};
    cap.knots = {std::vector<double>{0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}};
    cap.control_points.resize(3, 6);
    cap.control_points << 0, 0.5, 1, 0, 0.5, 1, 0, 0, 0, width_of_end, 1, width_of_end, 0, 0, 0, 0, 0, 0;
    cap.weights = Eigen::VectorXd{{1, w, 1, 1, w, 1}};
    const auto boundary = make_boundary<3>({{cap}});
    return find_followers(boundary, sample_boundary(boundary, {}));
  };
  CHECK(followers(1e3, 0).empty());
  CHECK(followers(1e6, 0.1).empty());
  const auto found = followers(1e6, 0);
  CHECK(found.control == std::vector<int>{0, 2, 3, 5});
  for (size_t f = 0; f < found.control.size(); ++f) CHECK(found.share[f].sum() == doctest::Approx(1));
}
