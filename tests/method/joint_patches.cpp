// Patches at joints: where they stand, what they reach, and that their gradients are finite
// differences.
#include <random>

#include "dims.h"
#include "sem/method/discretization.h"
#include "solids.h"

using namespace sem;
using test::Parts;

namespace {

// An L of material: one re-entrant joint.
Parts<2> ell() { return test::polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}); }

// A U whose gap is 0.2 wide.
Parts<2> with_gap() {
  return test::polygon({{0, 0}, {2.2, 0}, {2.2, 3}, {1.2, 3}, {1.2, 1}, {1, 1}, {1, 3}, {0, 3}});
}

// A step in the plane of x and y, one thick along z: its inner edge is re-entrant.
template <int Dim>
Parts<Dim> step();
template <>
Parts<2> step<2>() {
  return ell();
}
template <>
Parts<3> step<3>() {
  Parts<3> parts;
  const auto at = [](const Vec<2>& X, double z) { return Vec<3>(X[0], X[1], z); };
  for (const auto& side : ell()) {
    const Vec<2> a = side.control_points.col(0), b = side.control_points.col(1);
    parts.push_back(test::bilinear(at(a, 0), at(b, 0), at(a, 1), at(b, 1)));
  }
  const std::vector<std::array<Vec<2>, 4>> squares = {
      {Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(0, 1), Vec<2>(1, 1)},
      {Vec<2>(1, 0), Vec<2>(2, 0), Vec<2>(1, 1), Vec<2>(2, 1)},
      {Vec<2>(0, 1), Vec<2>(1, 1), Vec<2>(0, 2), Vec<2>(1, 2)}};
  for (const double z : {0.0, 1.0})
    for (const auto& s : squares)
      parts.push_back(test::bilinear(at(s[0], z), at(s[1], z), at(s[2], z), at(s[3], z)));
  return parts;
}

template <int Dim>
struct AtPoints {
  Distances<Dim> distances;
  DistanceWeights<Dim> theta;
};

template <int Dim>
AtPoints<Dim> weights_at(const Boundary<Dim>& boundary, const std::vector<JointPatch>& patches,
                         const Points<Dim>& X, bool gradients, double cutoff = 0.8) {
  const auto loops = find_loops(boundary);
  WeightOptions options;
  options.variant = DistanceWeight::sided;
  options.cutoff = cutoff;
  AtPoints<Dim> at;
  at.distances = measure_distances(boundary, loops, X, options.variant, cutoff);
  at.theta = distance_weights(at.distances, options);
  if (gradients) distance_weight_gradients(boundary, X, at.distances, at.theta);
  add_joint_patches(patches, boundary, at.distances, X, at.theta);
  return at;
}

// theta of the patches at the only point.
template <int Dim>
std::vector<double> of_patches(const DistanceWeights<Dim>& theta, int n_parts) {
  std::vector<double> values(theta.n_parts - n_parts, 0);
  for (size_t e = 0; e < theta.part.size(); ++e)
    if (theta.part[e] >= n_parts) values[theta.part[e] - n_parts] = theta.theta[e];
  return values;
}

template <int Dim>
std::vector<JointPatch> find(const Parts<Dim>& parts, const std::vector<int>& condition,
                             double cutoff, int n_levels) {
  const auto boundary = make_boundary<Dim>({parts});
  return find_joint_patches(boundary, find_loops(boundary), condition, cutoff, n_levels);
}

}  // namespace

TEST_CASE_TEMPLATE("patches stand at the re-entrant joint of a step alone, each half as large, half as many more than asked for", T,
                   D2, D3) {
  constexpr int Dim = T::value;
  const auto patches = find<Dim>(step<Dim>(), {}, 0.8, 2);
  REQUIRE(patches.size() == 3);
  for (int level = 0; level < 3; ++level) {
    CHECK(patches[level].a == 2);
    CHECK(patches[level].b == 3);
    CHECK(patches[level].level == level);
    CHECK(patches[level].reentrant);
    CHECK(patches[level].radius == doctest::Approx(0.8 * std::pow(0.5, level)));
  }
  CHECK(find<Dim>(step<Dim>(), {}, 5, 1)[0].radius ==
        doctest::Approx(2));  // twice the parts' extent
  CHECK(find<Dim>(step<Dim>(), {}, 0.8, 0).empty());
  CHECK(find<Dim>(test::unit_box<Dim>(), {}, 0.8, 2).empty());
}

TEST_CASE_TEMPLATE("patches stand where one part is held and the next is not", T, D2, D3) {
  constexpr int Dim = T::value;
  std::vector<int> condition(2 * Dim, 0);
  condition[1] = 1;  // one side of the box
  const auto patches = find<Dim>(test::unit_box<Dim>(), condition, 0.8, 1);
  CHECK(patches.size() == (Dim == 2 ? 2 : 4));
  for (const auto& patch : patches) {
    CHECK((patch.a == 1 || patch.b == 1));
    CHECK_FALSE(patch.reentrant);
  }
}

TEST_CASE_TEMPLATE("theta of patches: its value at right angles, its gradient by differences", T,
                   D2, D3) {
  constexpr int Dim = T::value;
  const auto parts = step<Dim>();
  const auto boundary = make_boundary<Dim>({parts});
  std::vector<int> condition(parts.size(), 0);
  condition[5] = 1;
  const auto patches = find_joint_patches(boundary, find_loops(boundary), condition, 0.8, 2);
  const double h = 1e-6;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> from_0_to_2(0, 2);
  int n_checked = 0, n_on_ramp = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Vec<Dim> X;
    for (int a = 0; a < Dim; ++a) X[a] = a < 2 ? from_0_to_2(random) : from_0_to_2(random) / 2;
    if (X[0] > 1 && X[1] > 1) continue;
    const auto here = weights_at<Dim>(boundary, patches, X, true).theta;
    const auto values = of_patches(here, boundary.n_parts());
    for (size_t p = 0; p < patches.size(); ++p) {
      // Parts 5 and 0 meet at a right angle in the origin.
      if (patches[p].a == 0 && patches[p].b == 5) {
        const double t = X.template head<2>().norm() / patches[p].radius;
        CHECK(values[p] == doctest::Approx(t < 1 ? std::pow(1 - t, 4) / (t * t) : 0));
      }
      if (values[p] == 0) continue;
      const int entry =
          int(std::find(here.part.begin(), here.part.end(), boundary.n_parts() + int(p)) -
              here.part.begin());
      ++n_checked;
      n_on_ramp += patches[p].reentrant && X[0] + X[1] > 2;
      for (int a = 0; a < Dim; ++a) {
        const Vec<Dim> e = Vec<Dim>::Unit(a);
        const auto after = of_patches(weights_at<Dim>(boundary, patches, X + h * e, false).theta,
                                      boundary.n_parts());
        const auto before = of_patches(weights_at<Dim>(boundary, patches, X - h * e, false).theta,
                                       boundary.n_parts());
        const double difference = (after[p] - before[p]) / (2 * h);
        CHECK(std::abs(here.gradient[entry][a] - difference) <=
              1e-5 * (std::abs(difference) + values[p] / patches[p].radius));
      }
    }
  }
  CHECK(n_checked > 100);
  CHECK(n_on_ramp > 5);
}

TEST_CASE(
    "a patch does not reach across a gap, and at its joint all levels weigh as they do beside it") {
  const auto boundary = make_boundary<2>({with_gap()});
  const auto patches = find_joint_patches(boundary, find_loops(boundary), {}, 0.8, 2);
  REQUIRE(patches.size() == 6);  // at both corners of the gap's bottom
  const auto right_only =
      of_patches(weights_at<2>(boundary, patches, Vec<2>(1.3, 1.1), false).theta, 8);
  for (size_t p = 0; p < patches.size(); ++p) {
    const bool right = patches[p].a == 3;  // (1.2, 3) to (1.2, 1)
    if (right && patches[p].level < 2) CHECK(right_only[p] > 0);
    if (!right) CHECK(right_only[p] == 0);
  }
  const auto near =
      of_patches(weights_at<2>(boundary, patches, Vec<2>(1.2 + 1e-5, 0.999999), false).theta, 8);
  const auto at = of_patches(weights_at<2>(boundary, patches, Vec<2>(1.2, 1), false).theta, 8);
  for (int level = 1; level < 3; ++level)
    CHECK(at[level] / at[0] == doctest::Approx(near[level] / near[0]).epsilon(1e-3));
}

TEST_CASE(
    "boundary rules follow patches: spans are cut towards the ends, and integrate what grows "
    "there") {
  const auto boundary = make_boundary<2>({test::unit_box<2>()});
  const auto integral = [&](int halvings) {
    const auto samples =
        sample_boundary(boundary, {6, SampleWeight::measure, SampleRule::gauss, halvings});
    double sum = 0;
    for (int s = samples.first[0]; s < samples.first[1]; ++s)
      sum += samples.weight[s] *
             (std::sqrt(samples.position(0, s)) + std::sqrt(1 - samples.position(0, s)));
    return sum;
  };
  CHECK(std::abs(integral(0) / (4. / 3) - 1) > 5e-4);
  CHECK(std::abs(integral(8) / (4. / 3) - 1) < 1e-6);
}
