// The chains of points that stand for the parts in pictures, and the stress they are coloured by.
#include <doctest/doctest.h>

#include "builtin.h"
#include "sem/picture/scales.h"
#include "solids.h"
#include "src2d/picture/outline.h"

using namespace sem;
using sem::test::Body;

namespace {

Discretization<2> discretized(const std::vector<test::Parts<2>>& solids) {
  MethodOptions options;
  options.weights.cutoff = 3;
  return discretize<2>(solids, options);
}

Points<2> rest(const Discretization<2>& d) { return rest_controls(d.boundary); }

// Signed area of a closed polygon.
double area(const Polyline& line) {
  double sum = 0;
  for (size_t i = 0; i < line.size(); ++i) {
    const Vec<2>&a = line[i], &b = line[(i + 1) % line.size()];
    sum += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("the chain of points of an arc keeps to it within a thousandth of the radius") {
  const auto d = discretized({test::circle({1, 2}, 0.5)});
  const Outline outline(d);
  for (int i = 0; i < 4; ++i) {
    const Polyline line = outline.part(i, rest(d));
    for (size_t k = 0; k + 1 < line.size(); ++k) {
      CHECK((line[k] - Vec<2>(1, 2)).norm() == doctest::Approx(0.5));
      CHECK(((line[k] + line[k + 1]) / 2 - Vec<2>(1, 2)).norm() > 0.5 * 0.999);
    }
  }
}

TEST_CASE("an island in a hole is a region of its own") {
  auto rings = test::circle({0, 0}, 3);
  for (const double radius : {2.0, 1.0})
    for (const auto& part : test::circle({0, 0}, radius)) rings.push_back(part);
  const auto d = discretized({rings});
  const auto regions = Outline(d).regions(rest(d));
  REQUIRE(regions.size() == 2);
  CHECK(regions[0].loops.size() == 2);
  CHECK(regions[1].loops.size() == 1);
}

TEST_CASE("loops are walked through whatever the order and direction of the parts") {
  auto parts = test::box<2>({0, 0}, {2, 1});
  std::swap(parts[1], parts[3]);
  for (const int i : {0, 2, 3}) parts[i] = reversed(parts[i], 0);
  const auto d = discretized({parts});
  const auto regions = Outline(d).regions(rest(d));
  REQUIRE(regions.size() == 1);
  CHECK(std::abs(area(regions[0].loops[0])) == doctest::Approx(2));
}

TEST_CASE("a gap is closed by a straight line in what is filled") {
  auto parts = test::polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  parts[2] = segment<2>({1.9, 1}, {0.1, 1});  // two gaps of 0.1 at its ends
  const auto d = discretized({parts});
  const auto regions = Outline(d).regions(rest(d));
  REQUIRE(regions.size() == 1);
  CHECK(std::abs(area(regions[0].loops[0])) == doctest::Approx(2));
}

TEST_CASE("von Mises stress: a shear gives sqrt(3) mu gamma, a rotation nothing") {
  const Body shorn("square", {"solids[0].material.model=linear"});
  const double mu = shorn.scene.solids[0].material.lame_mu();
  Mat<2> shear = Mat<2>::Identity();
  shear(0, 1) = 0.02;
  const Eigen::VectorXd stress = von_mises(*shorn.model, shorn.moved(shear, {1, 2}).z);
  CHECK((stress.array() / (std::sqrt(3.0) * mu * 0.02) - 1).abs().maxCoeff() < 1e-10);
  const Body turned("square");
  const Mat<2> rotation = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  const double young = turned.scene.solids[0].material.youngs_modulus;
  CHECK(von_mises(*turned.model, turned.moved(rotation, {1, 2}).z).maxCoeff() < 1e-10 * young);
}
