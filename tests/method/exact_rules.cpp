// Exact interior rules: accuracy with few points against boundary integrals and closed forms.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "sem/base/error.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/exact_rule.h"
#include "sem/method/line_rules.h"
#include "solids.h"

using namespace sem;
using test::Parts;

namespace {

struct ExactBody {
  Boundary<2> boundary;
  Loops<2> loops;
  explicit ExactBody(const std::vector<Parts<2>>& solids)
      : boundary(make_boundary<2>(solids)), loops(find_loops(boundary)) {}
  Quadrature<2> rule(InteriorRule kind = InteriorRule::exact) const {
    return exact_rule(boundary, loops, {kind}).quadrature;
  }
};

// A function and its primitive along x.
struct Integrand {
  std::function<double(const Vec<2>&)> value, primitive;
};

// Moments to degree 6 about the center of the box; exp and cos with waves of half the size.
std::vector<Integrand> smooth_integrands_of(const Box<2>& box) {
  const Vec<2> c = (box.lower + box.upper) / 2;
  const double h = (box.upper - box.lower).maxCoeff() / 2, k = 2 * M_PI / h;
  std::vector<Integrand> all;
  for (int a = 0; a <= 6; ++a)
    for (int b = 0; a + b <= 6; ++b)
      all.push_back({[=](const Vec<2>& X) {
                       return std::pow((X[0] - c[0]) / h, a) * std::pow((X[1] - c[1]) / h, b);
                     },
                     [=](const Vec<2>& X) {
                       return h * std::pow((X[0] - c[0]) / h, a + 1) / (a + 1) *
                              std::pow((X[1] - c[1]) / h, b);
                     }});
  all.push_back({[=](const Vec<2>& X) { return std::exp((X - c).sum() / h); },
                 [=](const Vec<2>& X) { return h * std::exp((X - c).sum() / h); }});
  for (const double phase : {0.0, 0.7}) {
    all.push_back({[=](const Vec<2>& X) { return std::cos(k * X[0] + phase); },
                   [=](const Vec<2>& X) { return std::sin(k * X[0] + phase) / k; }});
    all.push_back({[=](const Vec<2>& X) { return std::cos(k * X[1] + phase); },
                   [=](const Vec<2>& X) { return X[0] * std::cos(k * X[1] + phase); }});
    all.push_back(
        {[=](const Vec<2>& X) { return std::cos(0.6 * k * X[0] + 0.8 * k * X[1] + phase); },
         [=](const Vec<2>& X) {
           return std::sin(0.6 * k * X[0] + 0.8 * k * X[1] + phase) / (0.6 * k);
         }});
  }
  return all;
}

// Largest error, relative to the integral of |f|.
double worst_error(const ExactBody& body, const Quadrature<2>& rule) {
  double worst = 0;
  for (const auto& f : smooth_integrands_of(body.boundary.box)) {
    double truth = 0, found = 0, magnitude = 0;
    REQUIRE(visit_boundary_flux<2>(body.boundary, body.loops, [&](const Vec<2>& X, double flux) {
      truth += flux * f.primitive(X);
    }));
    for (int k = 0; k < rule.size(); ++k) {
      const double v = rule.weight[k] * f.value(rule.position.col(k));
      found += v;
      magnitude += std::abs(v);
    }
    worst = std::max(worst, std::abs(found - truth) / magnitude);
  }
  return worst;
}

void check_rule(const ExactBody& body, int most_points, double tolerance = 1e-10) {
  const auto rule = body.rule();
  CHECK(rule.size() <= most_points);
  CHECK(rule.weight.minCoeff() > 0);
  for (int k = 0; k < rule.size(); ++k)
    CHECK(inside(body.boundary, body.loops, Vec<2>(rule.position.col(k))));
  CHECK(worst_error(body, rule) <= tolerance);
}

Parts<2> with_map(Parts<2> parts, const Mat<2>& A, const Vec<2>& shift = Vec<2>::Zero()) {
  for (auto& part : parts) part.control_points = (A * part.control_points).colwise() + shift;
  return parts;
}

Parts<2> both(Parts<2> a, const Parts<2>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The uniform cubic B-spline of a closed polygon with 12 corners near the unit circle.
Nurbs<1, 2> spline_blob(unsigned seed, double wobble) {
  std::mt19937 random(seed);
  Nurbs<1, 2> curve;
  curve.degree = {3};
  for (int k = -3; k <= 15; ++k) curve.knots[0].push_back(k);
  curve.control_points.resize(2, 15);
  for (int k = 0; k < 12; ++k) {
    const double radius = 1 + wobble * (2 * (random() / 4294967296.0) - 1),
                 angle = 2 * M_PI * k / 12;
    curve.control_points.col(k) = radius * Vec<2>(std::cos(angle), std::sin(angle));
  }
  curve.control_points.rightCols(3) = curve.control_points.leftCols(3);
  curve.weights.setOnes(15);
  return curve;
}

}  // namespace

TEST_CASE("rules for root ends converge fast: a chord closes like a root, or does not") {
  // Integrals over (-1, 1).
  const auto integral = [](EndKind a, EndKind b, int n, const std::function<double(double)>& f) {
    const LineRule rule = rule_between(a, b, n);
    double sum = 0;
    for (int k = 0; k < n; ++k) sum += rule.weight[k] * f(rule.node[k]);
    return sum;
  };
  const auto closing = [](double x) { return std::sqrt(1 - x * x) * std::pow(x, 6); };
  CHECK(integral(EndKind::closing, EndKind::closing, 4, closing) ==
        doctest::Approx(5 * M_PI / 128).epsilon(1e-14));
  const auto root = [](double x) { return std::sqrt(1 + x) + x * x; };
  CHECK(integral(EndKind::root, EndKind::smooth, 4, root) ==
        doctest::Approx(std::sqrt(32) / 3 + 2 / 3.0).epsilon(1e-14));
  const auto upper = [](double x) { return std::sqrt(1 - x) * x; };
  CHECK(integral(EndKind::smooth, EndKind::closing, 2, upper) ==
        doctest::Approx(-std::sqrt(32) / 15).epsilon(1e-14));
  const auto roots = [](double x) { return std::sqrt(1 - x * x) + 1; };
  CHECK(integral(EndKind::root, EndKind::root, 14, roots) ==
        doctest::Approx(M_PI / 2 + 2).epsilon(1e-13));
}

TEST_CASE(
    "disc: 1e-10 with 150 points for any number and place of arcs; Bessel's value of a wave") {
  for (const int n_arcs : {3, 4, 7, 16})
    check_rule(ExactBody({test::circle({0.3, -0.2}, 2, n_arcs)}), 150);
  const ExactBody body({test::circle({0, 0}, 1)});
  const auto rule = body.rule();
  double wave = 0;
  for (int k = 0; k < rule.size(); ++k)
    wave += rule.weight[k] * std::cos(2 * M_PI * rule.position(0, k));
  const double truth = std::cyl_bessel_j(1, 2 * M_PI);  // integral of cos(k x) = 2 pi J_1(k) / k
  CHECK(std::abs(wave / truth - 1) < 1e-10);
  CHECK(std::abs(rule.weight.sum() / M_PI - 1) < 1e-13);
}

TEST_CASE("ellipse: 1e-10 with 150 points, also turned") {
  Mat<2> stretch = Vec<2>(2, 1).asDiagonal(), thin = Vec<2>(1, 5).asDiagonal();
  const Mat<2> turn = Eigen::Rotation2Dd(0.5).toRotationMatrix();
  check_rule(ExactBody({with_map(test::circle({0, 0}, 1), stretch)}), 150);
  check_rule(ExactBody({with_map(test::circle({0, 0}, 1), thin)}), 150);
  check_rule(ExactBody({with_map(test::circle({0, 0}, 1, 5), turn * stretch)}), 150);
}

TEST_CASE("eccentric annulus: 1e-10 with 600 points") {
  check_rule(ExactBody({both(test::circle({0, 0}, 2), test::circle({0, 0}, 1))}), 600);
  check_rule(ExactBody({both(test::circle({0, 0}, 2), test::circle({0.5, 0.3}, 1))}), 600);
  check_rule(ExactBody({both(test::circle({0, 0}, 2, 8), test::circle({0.6, 0.1}, 1, 8))}), 600);
}

TEST_CASE("closed cubic B-spline with 12 spans: 1e-10 with 400 points by a fan about an ellipse") {
  for (const unsigned seed : {1u, 2u, 3u, 4u})
    check_rule(ExactBody({{spline_blob(seed, 0.1)}}), 400);
}

TEST_CASE("not star-shaped: split rays take over") {
  Parts<2> u =
      test::polygon({{0, 0}, {2.2, 0}, {2.2, 3}, {1.2, 3}, {1.2, 1}, {1, 1}, {1, 3}, {0, 3}});
  const ExactBody body({u});
  check_rule(body, 300);
  const auto rule = exact_rule(body.boundary, body.loops, {InteriorRule::fans});
  CHECK(rule.components.front().rule == "rays along y");
  CHECK(std::abs(rule.quadrature.weight.sum() - 6.2) < 1e-12);
}

TEST_CASE(
    "the rule does not depend on orientation, and components that lie apart have rules of their "
    "own") {
  Parts<2> discs = both(test::circle({0, 0}, 1), test::circle({5, 1}, 1));
  for (size_t i = 0; i < discs.size(); i += 3) discs[i] = reversed(discs[i], 0);
  const ExactBody body({discs});
  const auto rule = exact_rule(body.boundary, body.loops, {InteriorRule::exact});
  CHECK(rule.components.size() == 2);
  CHECK(worst_error(body, rule.quadrature) < 1e-10);
}

TEST_CASE("overlapping solids: the union's area to 1e-12, points belong to the first solid") {
  const double d = 1.3;
  const ExactBody body({test::circle({0, 0}, 1), test::circle({d, 0}, 1)});
  const auto rule = body.rule();
  const double lens = 2 * std::acos(d / 2) - d / 2 * std::sqrt(4 - d * d);
  CHECK(std::abs(rule.weight.sum() / (2 * M_PI - lens) - 1) < 1e-11);
  double first = 0;
  for (int k = 0; k < rule.size(); ++k) first += rule.solid[k] == 0 ? rule.weight[k] : 0;
  CHECK(std::abs(first / M_PI - 1) < 1e-11);
}

TEST_CASE(
    "loops of one solid that cross are united, a curve that crosses itself counts by parity") {
  const double d = 1.1, lens = 2 * std::acos(d / 2) - d / 2 * std::sqrt(4 - d * d);
  const ExactBody united({both(test::circle({0, 0}, 1), test::circle({0.6 * d, 0.8 * d}, 1, 3))});
  CHECK(std::abs(united.rule().weight.sum() / (2 * M_PI - lens) - 1) < 1e-10);
  // A bow tie of two triangles with area 1/2 each, and its mirror image within a quadratic curve.
  const ExactBody bow({test::polygon({{0, 0}, {2, 1}, {2, 0}, {0, 1}})});
  CHECK(std::abs(bow.rule().weight.sum() - 1) < 1e-12);
}

TEST_CASE("gaps are closed by straight caps, as rays close them") {
  auto parts = test::polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  parts[1] = segment<2>({2, 0.1}, {2, 0.8});
  const ExactBody body({parts});
  CHECK(std::abs(body.rule().weight.sum() - 2) < 1e-12);
}

TEST_CASE("slivers and cusps: the area is right down to a width of 1e-9") {
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    const ExactBody sliver({test::polygon({{0, 0}, {1, 0.3}, {1, 0.3 + width}, {0, width}})});
    CHECK(sliver.rule().weight.sum() == doctest::Approx(width).epsilon(1e-6));
  }
  // y between 0 and x^2 (1 - x): a cusp at 0 with both sides tangent to the x axis.
  Points<2> top(2, 4);
  top << 0, 1 / 3.0, 2 / 3.0, 1, 0, 0, 1 / 3.0, 0;
  const ExactBody cusp(
      {{bezier_curve<2>(top, Eigen::Vector4d::Ones()), segment<2>({1, 0}, {0, 0})}});
  CHECK(std::abs(cusp.rule().weight.sum() * 12 - 1) < 1e-9);
}

TEST_CASE("scale and place of the model do not change the number of points") {
  const auto size_of = [](double scale, const Vec<2>& shift) {
    const ExactBody body({with_map({spline_blob(1, 0.1)}, scale * Mat<2>::Identity(), shift)});
    return body.rule().size();
  };
  const int n = size_of(1, {0, 0});
  CHECK(std::abs(size_of(1e-6, {0, 0}) - n) < 10);
  CHECK(std::abs(size_of(1e6, {0, 0}) - n) < 10);
  CHECK(std::abs(size_of(1, {1e3, -1e3}) - n) < 60);
}

TEST_CASE("more waves or a smaller tolerance make more points") {
  const ExactBody body({test::circle({0, 0}, 1)});
  const auto n = [&](double tolerance, double waves) {
    return exact_rule(body.boundary, body.loops, {InteriorRule::exact, tolerance, waves})
        .quadrature.size();
  };
  CHECK(n(1e-4, 2) < n(1e-10, 2));
  CHECK(n(1e-10, 2) < n(1e-10, 4));
  CHECK(n(1e-10, 4) < 450);
  CHECK_THROWS_AS(n(0, 2), InputError);
  CHECK_THROWS_AS(n(1e-10, 0), InputError);
}

TEST_CASE("3D: a box of patches is integrated exactly by a product of Gauss rules") {
  const auto boundary = make_boundary<3>({test::box<3>({0, 0, 0}, {1, 2, 1.5}, 2)});
  const auto loops = find_loops(boundary);
  const auto rule = exact_rule<3>(boundary, loops, {InteriorRule::exact, 1e-8, 1});
  CHECK(rule.error < 1e-8);
  CHECK(rule.quadrature.weight.minCoeff() > 0);
  CHECK(std::abs(rule.quadrature.weight.sum() / 3 - 1) < 1e-12);
  const Vec<3> centroid = rule.quadrature.position * rule.quadrature.weight / 3;
  CHECK((centroid - Vec<3>(0.5, 1, 0.75)).norm() < 1e-12);
}
