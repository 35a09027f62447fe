// Non-negative least squares, moment fitting and compression.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "sem/method/boundary_integrals.h"
#include "sem/method/interior_rule.h"
#include "sem/method/nnls.h"
#include "solids.h"

using namespace sem;

namespace {

double uniform_in(std::mt19937& random, double lower, double upper) {
  return lower + (upper - lower) * (random() / 4294967296.0);
}

struct DiscWithHole {
  Boundary<2> boundary;
  Loops<2> loops;
  Vec<2> center;
  double size;
  DiscWithHole() {
    auto parts = test::circle({0.2, 0}, 1);
    for (const auto& arc : test::circle({0.3, 0.2}, 0.4)) parts.push_back(arc);
    boundary = make_boundary<2>({parts});
    loops = find_loops(boundary);
    center = (boundary.box.lower + boundary.box.upper) / 2;
    size = (boundary.box.upper - boundary.box.lower).maxCoeff();
  }
  Quadrature<2> midpoints(int n) const {
    return quadrature_on_rays(cast_rays(boundary, loops, {.n_rays = n}), {.points = n / 2});
  }
};

}  // namespace

TEST_CASE("non-negative least squares: Kuhn-Tucker conditions hold for random problems") {
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const int m = 3 + trial % 8, n = 2 + trial;
    Eigen::MatrixXd A(m, n);
    Eigen::VectorXd b(m);
    for (double& a : A.reshaped()) a = uniform_in(random, -1, 1);
    for (double& value : b) value = uniform_in(random, -1, 1);
    const auto found = solve_non_negative(A, b);
    CHECK(found.converged);
    CHECK(found.x.minCoeff() >= 0);
    const Eigen::VectorXd gradient = A.transpose() * (A * found.x - b);
    CHECK(gradient.minCoeff() > -1e-12);
    CHECK(std::abs(gradient.dot(found.x)) < 1e-12);
    CHECK(found.residual == doctest::Approx((A * found.x - b).norm()));
  }
}

TEST_CASE(
    "non-negative least squares: finds the sparse solution that is there, and 0 for a hopeless "
    "one") {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 3) << 1, 1, 2, 0, 1, 0).finished();
  const auto exact = solve_non_negative(A, Eigen::Vector2d(3, 1));
  CHECK(exact.residual < 1e-14);
  CHECK((exact.x.array() > 0).count() == 2);
  const auto hopeless = solve_non_negative(A, Eigen::Vector2d(-1, -1));
  CHECK(hopeless.x.isZero(0));
  CHECK(hopeless.residual == doctest::Approx(std::sqrt(2.0)));
}

TEST_CASE("moment fitting: the boundary's moments to rounding, weights stay positive") {
  const DiscWithHole body;
  auto rule = body.midpoints(32);
  const auto truth =
      boundary_moments_to_degree<2>(body.boundary, body.loops, 6, body.center, body.size);
  REQUIRE(truth);
  const auto before = rule;
  const auto report = fit_moments<2>(rule, 6, body.center, body.size, *truth);
  CHECK(report.error_before > 1e-4);
  CHECK(report.error_after < 1e-12);
  CHECK(rule.weight.minCoeff() > 0);
  CHECK((moments_to_degree<2>(rule, 6, body.center, body.size) - *truth).norm() <
        1e-12 * truth->norm());
  CHECK((rule.weight - before.weight).cwiseAbs().maxCoeff() < 0.1 * before.weight.maxCoeff());
}

TEST_CASE(
    "moment fitting with weights that have to vanish: still non-negative, moments still met") {
  // Mass is asked for near one end: the equality solution has negative weights.
  Quadrature<2> rule;
  rule.position.resize(2, 400);
  rule.weight.setConstant(400, 1.0 / 400);
  rule.solid.assign(400, 0);
  for (int k = 0; k < 400; ++k)
    rule.position.col(k) = Vec<2>((k % 20 + 0.5) / 20, (k / 20 + 0.5) / 20);
  Eigen::VectorXd target(3);
  const Vec<2> center(0.5, 0.5);
  target << 1, 0.7, 0;  // in (X - center) / (1/2): the centroid at x = 0.85
  const auto report = fit_moments<2>(rule, 1, center, 1, target);
  CHECK(report.error_after < 1e-11);
  CHECK(report.points_after < 400);
  CHECK(rule.size() == report.points_after);
  CHECK(rule.weight.minCoeff() > 0);
  CHECK((moments_to_degree<2>(rule, 1, center, 1) - target).norm() < 1e-11);
  // Out of reach (centroid outside): the rule stays as it is.
  target[1] = 1.3;
  const auto refused = fit_moments<2>(rule, 1, center, 1, target);
  CHECK(refused.error_after == refused.error_before);
  CHECK(rule.size() == report.points_after);
}

TEST_CASE_TEMPLATE("compression keeps the moments with at most as many points as there are moments",
                   T, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = T::value;
  const auto boundary = make_boundary<Dim>({test::box<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Ones(), 1)});
  const auto loops = find_loops(boundary);
  auto rule = quadrature_on_rays(cast_rays(boundary, loops, {.n_rays = 10}), {.points = 10});
  const Vec<Dim> center = Vec<Dim>::Constant(0.4);
  for (const int degree : {4, 2}) {
    const auto target = moments_to_degree<Dim>(rule, degree, center, 1);
    const auto report = compress<Dim>(rule, degree, center, 1);
    CHECK(rule.size() <= target.size());
    CHECK(report.points_after == rule.size());
    CHECK(report.error_after < 1e-12);
    CHECK(rule.weight.minCoeff() > 0);
    CHECK((moments_to_degree<Dim>(rule, degree, center, 1) - target).norm() < 1e-12);
  }
}

TEST_CASE("compression works solid by solid") {
  const auto boundary = make_boundary<2>({test::circle({0, 0}, 1), test::circle({3, 0}, 1)});
  const auto loops = find_loops(boundary);
  InteriorReport<2> report;
  const auto rule =
      interior_rule<2>(boundary, loops, {}, {}, {.rule = InteriorRule::exact, .compress = 5}, report);
  CHECK(report.compression.points_before == report.original.size());
  CHECK(rule.size() <= 2 * 21);
  for (const int solid : {0, 1}) {
    double area = 0;
    for (int k = 0; k < rule.size(); ++k) area += rule.solid[k] == solid ? rule.weight[k] : 0;
    CHECK(std::abs(area / M_PI - 1) < 1e-11);
  }
}

TEST_CASE(
    "the paper's midpoints, fitted and compressed to degree 6: 28 points with the moments of the "
    "boundary") {
  const DiscWithHole body;
  const auto rays = cast_rays(body.boundary, body.loops, {.n_rays = 32});
  InteriorReport<2> report;
  const auto rule = interior_rule<2>(body.boundary, body.loops, rays, {.points = 16},
                                     {.fit = 6, .compress = 6}, report);
  CHECK(rule.size() <= 28);
  const auto truth =
      boundary_moments_to_degree<2>(body.boundary, body.loops, 6, body.center, body.size);
  CHECK((moments_to_degree<2>(rule, 6, body.center, body.size) - *truth).norm() <
        1e-11 * truth->norm());
  CHECK(rule.weight.sum() == doctest::Approx(M_PI * (1 - 0.16)).epsilon(1e-11));
}
