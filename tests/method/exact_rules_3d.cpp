// Exact interior rules of solids: accuracy with few points against closed forms and boundary
// integrals.
#include <doctest/doctest.h>

#include <random>

#include "sem/method/boundary_integrals.h"
#include "sem/method/exact_rule.h"
#include "sem/method/moment_rules.h"
#include "sem/method/sweep_3d.h"
#include "sem/nurbs/refine.h"
#include "solids.h"

using namespace sem;
using test::Parts;

namespace {

struct ExactSolid {
  Boundary<3> boundary;
  Loops<3> loops;
  explicit ExactSolid(const Parts<3>& parts)
      : boundary(make_boundary<3>({parts})), loops(find_loops(boundary)) {}
  ExactRule<3> rule(InteriorRule kind = InteriorRule::exact, double tolerance = 1e-10) const {
    return exact_rule<3>(boundary, loops, {kind, tolerance});
  }
};

// Error of the moments to degree 6 against the boundary's, relative to the integral of |f|.
double error_of_moments(const ExactSolid& solid, const Quadrature<3>& rule) {
  const Vec<3> center = (solid.boundary.box.lower + solid.boundary.box.upper) / 2;
  const double size = (solid.boundary.box.upper - solid.boundary.box.lower).maxCoeff();
  const auto truth = boundary_moments_to_degree(solid.boundary, solid.loops, 6, center, size);
  REQUIRE(truth.has_value());
  return moment_error(rule, 6, center, size, *truth);
}

// The same for exp and cosines of two waves over the size, their primitives along x by the
// boundary.
double error_of_waves(const ExactSolid& solid, const Quadrature<3>& rule) {
  const Vec<3> center = (solid.boundary.box.lower + solid.boundary.box.upper) / 2;
  const double size = (solid.boundary.box.upper - solid.boundary.box.lower).maxCoeff();
  double worst = 0;
  for (const Vec<3>& direction : {Vec<3>(1, 0, 0), Vec<3>(0.6, 0.8, 0), Vec<3>(0.6, 0, -0.8)})
    for (const bool wave : {false, true}) {
      const Vec<3> k = (wave ? 4 * M_PI : 2) / size * direction;
      double truth = 0, found = 0, magnitude = 0;
      REQUIRE(
          visit_boundary_flux<3>(solid.boundary, solid.loops, [&](const Vec<3>& X, double flux) {
            const double phase = k.dot(X - center);
            truth += flux * (wave ? std::sin(phase + 0.3) : std::exp(phase)) / k[0];
          }));
      for (int p = 0; p < rule.size(); ++p) {
        const double phase = k.dot(rule.position.col(p) - center);
        const double value = rule.weight[p] * (wave ? std::cos(phase + 0.3) : std::exp(phase));
        found += value;
        magnitude += std::abs(value);
      }
      worst = std::max(worst, std::abs(found - truth) / magnitude);
    }
  return worst;
}

void check_points(const ExactSolid& solid, const Quadrature<3>& rule, int most_points) {
  CHECK(rule.size() <= most_points);
  CHECK(rule.weight.minCoeff() > 0);
  for (int k = 0; k < rule.size(); k += 7)
    CHECK(inside(solid.boundary, solid.loops, Vec<3>(rule.position.col(k))));
}

Parts<3> with_map(Parts<3> parts, const Mat<3>& A) {
  for (auto& part : parts) part.control_points = A * part.control_points;
  return parts;
}

Mat<3> some_turn() {
  return Eigen::AngleAxisd(0.7, Vec<3>(1, 2, 0.5).normalized()).toRotationMatrix();
}

// Twelve cubic spans around, wobbling rings of control points from pole to pole.
Parts<3> lofted_blob() {
  std::mt19937 random(1);
  Nurbs<2, 3> blob;
  blob.degree = {3, 3};
  for (int k = -3; k <= 15; ++k) blob.knots[0].push_back(k);
  blob.knots[1] = {0, 0, 0, 0, 1, 2, 3, 3, 3, 3};
  const double height[] = {-1, -1, -0.5, 0.5, 1, 1}, radius[] = {0, 0.5, 1.1, 1.1, 0.5, 0};
  blob.control_points.resize(3, 15 * 6);
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 15; ++i) {
      const double wobble = 1 + 0.1 * (2 * (random() / 4294967296.0) - 1);
      const double angle = 2 * M_PI * i / 12;
      blob.control_points.col(15 * j + i) =
          i < 12 ? Vec<3>(radius[j] * wobble * std::cos(angle),
                          radius[j] * wobble * std::sin(angle), height[j])
                 : Vec<3>(blob.control_points.col(15 * j + i - 12));
    }
  blob.weights.setOnes(90);
  return {blob};
}

}  // namespace

TEST_CASE("a ball and an ellipsoid by a fan: volume and moments to degree 6 to 1e-10") {
  const Mat<3> stretch = Vec<3>(2, 1, 0.7).asDiagonal();
  for (const Mat<3>& A : {Mat<3>(Mat<3>::Identity()), Mat<3>(some_turn() * stretch)}) {
    const ExactSolid solid(with_map(test::ball(), A));
    const auto rule = solid.rule(InteriorRule::fans);
    CHECK(rule.components.front().rule == "fan");
    CHECK(rule.error <= 1e-10);
    check_points(solid, rule.quadrature, 4000);
    CHECK(std::abs(rule.quadrature.weight.sum() / (4 * M_PI / 3 * A.determinant()) - 1) < 1e-11);
    CHECK(error_of_moments(solid, rule.quadrature) < 1e-10);
    CHECK(error_of_waves(solid, rule.quadrature) < 1e-10);
  }
}

TEST_CASE("a lofted cubic blob of 36 spans by a fan: volume and moments to degree 6 to 1e-10") {
  const ExactSolid solid(lofted_blob());
  const auto rule = solid.rule(InteriorRule::fans);
  CHECK(rule.components.front().rule == "fan");
  check_points(solid, rule.quadrature, 20000);
  CHECK(error_of_moments(solid, rule.quadrature) < 1e-10);
  CHECK(error_of_waves(solid, rule.quadrature) < 1e-10);
}

TEST_CASE("a surface with a gap has no fan, whatever its sides are") {
  Parts<3> open = test::ball();
  open.pop_back();
  const ExactSolid solid(open);
  for (const auto& component : solid.rule(InteriorRule::fans, 1e-2).components)
    CHECK(component.rule != "fan");
}

TEST_CASE(
    "a ball with poles and a turned cylinder by rays: volume and moments to degree 6 to 1e-10") {
  const ExactSolid ball(test::ball());
  const auto rule = ball.rule(InteriorRule::split_rays);
  check_points(ball, rule.quadrature, 1500);
  CHECK(std::abs(rule.quadrature.weight.sum() / (4 * M_PI / 3) - 1) < 1e-12);
  CHECK(error_of_moments(ball, rule.quadrature) < 1e-10);
  CHECK(error_of_waves(ball, rule.quadrature) < 1e-10);
  const ExactSolid cylinder(
      with_map(test::turned({segment<2>({0, 0}, {1, 0}), segment<2>({1, 0}, {1, 2}),
                             segment<2>({1, 2}, {0, 2})}),
               some_turn()));
  const auto turned = cylinder.rule(InteriorRule::split_rays);
  check_points(cylinder, turned.quadrature, 2500);
  CHECK(std::abs(turned.quadrature.weight.sum() / (2 * M_PI) - 1) < 1e-10);
  CHECK(error_of_moments(cylinder, turned.quadrature) < 1e-10);
}

TEST_CASE("a torus from any direction: volume and moments to degree 6 to 1e-8") {
  const Mat<3> across = Eigen::AngleAxisd(M_PI / 2, Vec<3>::UnitY()).toRotationMatrix();
  for (const Mat<3>& A : {across, some_turn()}) {
    const ExactSolid torus(with_map(test::torus(1, 0.45), A));
    const auto rule = torus.rule(InteriorRule::exact, 1e-8);
    CHECK(rule.error <= 1e-8);
    check_points(torus, rule.quadrature, 9200);
    CHECK(std::abs(rule.quadrature.weight.sum() / (2 * M_PI * M_PI * 0.45 * 0.45) - 1) < 1e-8);
    CHECK(error_of_moments(torus, rule.quadrature) < 1e-8);
    CHECK(error_of_waves(torus, rule.quadrature) < 1e-8);
  }
}

TEST_CASE(
    "a block with a round channel, upright and sheared: volume and moments to degree 6 to 1e-10") {
  // Four patches on each end, from the circle to the square.
  const double r = 0.4;
  std::vector<Vec<2>> corner, on_circle;
  for (int k = 0; k <= 4; ++k) {
    const double angle = M_PI / 4 + M_PI / 2 * k;
    corner.push_back({std::sqrt(2) * std::cos(angle), std::sqrt(2) * std::sin(angle)});
  }
  Parts<3> parts;
  for (int k = 0; k < 4; ++k) {
    const auto inner = test::arc({0, 0}, r, M_PI / 4 + M_PI / 2 * k, M_PI / 4 + M_PI / 2 * (k + 1));
    const auto outer = elevate_degree(segment<2>(corner[k], corner[k + 1]), 0, 1);
    const auto between = [&](const Nurbs<1, 2>& a, double z_a, const Nurbs<1, 2>& b, double z_b) {
      Nurbs<2, 3> patch;
      patch.degree = {2, 1};
      patch.knots = {a.knots[0], {0, 0, 1, 1}};
      patch.control_points.resize(3, 6);
      patch.control_points.leftCols(3) << a.control_points, Eigen::RowVector3d::Constant(z_a);
      patch.control_points.rightCols(3) << b.control_points, Eigen::RowVector3d::Constant(z_b);
      patch.weights.resize(6);
      patch.weights << a.weights, b.weights;
      return patch;
    };
    parts.push_back(between(inner, 0, outer, 0));
    parts.push_back(between(inner, 1, outer, 1));
    parts.push_back(between(inner, 0, inner, 1));
    parts.push_back(between(outer, 0, outer, 1));
  }
  Mat<3> shear = Mat<3>::Identity();
  shear(0, 2) = 0.3;
  for (const Mat<3>& A : {Mat<3>(Mat<3>::Identity()), shear}) {
    const ExactSolid block(with_map(parts, A));
    const auto rule = block.rule();
    check_points(block, rule.quadrature, 12000);
    CHECK(std::abs(rule.quadrature.weight.sum() / (4 - M_PI * r * r) - 1) < 1e-10);
    CHECK(error_of_moments(block, rule.quadrature) < 1e-10);
  }
}

TEST_CASE("split rays in space: edges at one height turn back nowhere, whatever the scale rounds") {
  for (const double factor : {1.0, 0.3, 0.7, 1e6}) {
    CAPTURE(factor);
    Parts<3> parts = test::unit_box<3>();
    for (auto& part : parts) {
      part = elevate_degree(elevate_degree(part, 0, 2), 1, 1);
      part.control_points *= factor;
    }
    const ExactSolid solid(parts);
    for (const auto& component : split_into_components(solid.boundary, solid.loops))
      for (int axis = 0; axis < 3; ++axis) {
        const Sweep sweep(component, axis, (axis + 1) % 3, (axis + 2) % 3);
        for (const auto& height : sweep.heights()) CHECK(height.kind == EndKind::smooth);
      }
  }
}

TEST_CASE("split rays in space: rays are split where faces cross") {
  // Over (0,0) (1,1) (1,0) (0,1): two wedges that meet in the line x = y = 1/2.
  const auto face = [](const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d) {  // or a floor: z = 0, 1
    Nurbs<2, 3> made;
    made.degree = {1, 1};
    made.knots = {std::vector<double>{0, 0, 1, 1}, {0, 0, 1, 1}};
    made.control_points.resize(3, 4);
    made.control_points << a[0], b[0], c[0], d[0], a[1], b[1], c[1], d[1], 0, 0, 0, 0;
    made.weights.setOnes(4);
    return made;
  };
  const auto lifted = [](Nurbs<2, 3> made, double first, double second) {
    made.control_points.row(2) << first, first, second, second;
    return made;
  };
  const Vec<2> corner[] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}}, middle(0.5, 0.5);
  Parts<3> parts;
  for (int k = 0; k < 4; ++k) parts.push_back(lifted(face(corner[k], corner[(k + 1) % 4], corner[k], corner[(k + 1) % 4]), 0, 1));
  for (const double z : {0.0, 1.0}) {
    parts.push_back(lifted(face(corner[0], middle, corner[3], middle), z, z));
    parts.push_back(lifted(face(corner[1], middle, corner[2], middle), z, z));
  }
  const auto rule = ExactSolid(parts).rule(InteriorRule::split_rays);
  CHECK(std::abs(rule.quadrature.weight.sum() - 0.5) < 1e-12);
  const auto x = rule.quadrature.position.row(0).array(), y = rule.quadrature.position.row(1).array();
  CHECK(((x - 0.5).abs() > (y - 0.5).abs() - 1e-12).all());  // left and right, not above and below
  CHECK(rule.error < 1e-10);
}
