// What the hard cases of sem_stability asked of the stages.
#include "dims.h"
#include "linear_algebra.h"
#include "sem/method/rays.h"
#include "sem/method/samples.h"
#include "solids.h"

using namespace sem;

namespace {

// From (0, 1) to (1, 1 - step), with a jump in the middle; degree 1.
Nurbs<1, 2> torn(double step) {
  Nurbs<1, 2> curve;
  curve.degree = {1};
  curve.knots[0] = {0, 0, 0.5, 0.5, 1, 1};
  curve.control_points.resize(2, 4);
  curve.control_points << 0, 0.5, 0.5, 1, 1, 1, 1 - step, 1 - step;
  curve.weights.setOnes(4);
  return curve;
}

template <int Dim>
double ray_measure(const Boundary<Dim>& boundary, const RayOptions& options) {
  double sum = 0;
  for (const auto& ray : cast_rays(boundary, find_loops(boundary), options).rays)
    for (const auto& interval : ray.intervals) sum += ray.weight * (interval.end - interval.begin);
  return sum;
}

// All singular values of J on the samples with weight: control points that they do not determine are zeros.
template <int Dim>
double least_singular_value(const Boundary<Dim>& boundary) {
  const auto samples = sample_boundary(boundary, SamplingOptions{});
  const Eigen::VectorXd root = samples.weight.cwiseSqrt();
  const Eigen::MatrixXd J = root.asDiagonal() * sample_jacobian(samples, boundary.n_controls());
  return test::singular_values(J).minCoeff();
}

}  // namespace

TEST_CASE("a part that jumps: each side has its own end sample, and both determine the control points") {
  CHECK(least_singular_value(make_boundary<2>({{torn(0)}})) > 0.1);
  const auto samples = sample_boundary(make_boundary<2>({{torn(0.5)}}), SamplingOptions{});
  REQUIRE(samples.size() == 4);
  CHECK(samples.position(1, 1) == doctest::Approx(1));
  CHECK(samples.position(1, 2) == doctest::Approx(0.5));
}

TEST_CASE("a part that jumps is closed straight: a step encloses its area") {
  auto parts = test::Parts<2>{torn(0.5)};
  for (const auto& [a, b] : {std::pair<Vec<2>, Vec<2>>{{0, 0}, {0, 1}}, {{0, 0}, {1, 0}}, {{1, 0}, {1, 0.5}}})
    parts.push_back(segment<2>(a, b));
  const auto boundary = make_boundary<2>({parts});
  CHECK(ray_measure(boundary, {.n_rays = 40}) == doctest::Approx(0.75).epsilon(1e-12));
  CHECK(find_loops(boundary).n_gaps == 1);
}

TEST_CASE("a patch with a collapsed edge: its samples determine all its control points") {
  Nurbs<2, 3> patch = test::bilinear({0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 0});
  for (int degree = 1; degree <= 3; ++degree) {
    CHECK(least_singular_value(make_boundary<3>({{patch}})) > 1e-3);
    patch = elevate_degree(elevate_degree(patch, 0), 1);
  }
}

TEST_CASE("3D: rays through edges that patches share measure the body") {
  // A prism over a diamond: the middle ray enters and leaves by edges.
  const std::vector<Vec<2>> corners = {{0, 0.5}, {0.5, 0}, {1, 0.5}, {0.5, 1}};
  test::Parts<3> parts;
  const auto at = [&](int k, double z) { return Vec<3>(corners[k % 4][0], corners[k % 4][1], z); };
  for (int k = 0; k < 4; ++k) parts.push_back(test::bilinear(at(k, 0), at(k + 1, 0), at(k, 1), at(k + 1, 1)));
  for (const double z : {0.0, 1.0}) parts.push_back(test::bilinear(at(0, z), at(1, z), at(3, z), at(2, z)));
  const auto boundary = make_boundary<3>({parts});
  double chords = 0;
  for (int k = 0; k < 9; ++k) chords += (1 - std::abs(1 - 2 * (k + 0.5) / 9)) / 9;
  CHECK(ray_measure(boundary, {.n_rays = 9}) == doctest::Approx(chords).epsilon(1e-6));
  CHECK(cast_rays(boundary, find_loops(boundary), {.n_rays = 9}).n_unpaired == 0);
}

TEST_CASE("3D: boxes that overlap with faces in one plane are united, not subtracted") {
  auto parts = test::unit_box<3>();
  for (const auto& part : test::box<3>({0.5, 0.5, 0}, {1.5, 1.5, 1})) parts.push_back(part);
  const auto boundary = make_boundary<3>({parts});
  CHECK(find_loops(boundary).loops.size() == 2);
  CHECK(ray_measure(boundary, {.n_rays = 12}) == doctest::Approx(1.75).epsilon(1e-6));
}
