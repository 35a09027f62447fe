// grad theta, grad w and the exact gradient of the map against finite differences on their smooth pieces.
#include <array>
#include <random>

#include "dims.h"
#include "sem/method/discretization.h"
#include "sem/method/sided_weight.h"
#include "solids.h"

using namespace sem;
using test::Parts;

namespace {

// Curved and not convex: a ring of arcs; a box whose corner is pulled out, so that faces are curved.
template <int Dim>
Parts<Dim> curved_solid();
template <>
Parts<2> curved_solid<2>() {
  Parts<2> parts = test::circle({0, 0}, 2, 5);
  for (const auto& part : test::circle({0.2, 0.1}, 0.8, 4)) parts.push_back(part);
  return parts;
}
template <>
Parts<3> curved_solid<3>() {
  Parts<3> parts = test::unit_box<3>();
  for (auto& part : parts)
    for (int c = 0; c < part.control_points.cols(); ++c)
      if (part.control_points.col(c) == Vec<3>::Ones()) part.control_points.col(c) = Vec<3>(1.4, 1.3, 1.2);
  return parts;
}

template <int Dim>
struct Fields {
  DistanceWeights<Dim> theta;
  BlendingWeights<Dim> w;
};

template <int Dim>
Fields<Dim> fields_at(const Discretization<Dim>& d, const Points<Dim>& X, DistanceWeight variant, bool gradients) {
  WeightOptions options;
  options.variant = variant;
  options.cutoff = 3;
  const auto distances = measure_distances<Dim>(d.boundary, d.loops, X, variant, options.cutoff);
  Fields<Dim> f;
  f.theta = distance_weights(distances, options);
  if (gradients) distance_weight_gradients(d.boundary, X, distances, f.theta);
  f.w = blending_weights(f.theta, d.boundary, X);
  return f;
}

// Entries of one point, to tell whether two points lie in the same smooth piece.
template <int Dim>
std::vector<std::pair<int, int>> pieces(const DistanceWeights<Dim>& theta) {
  std::vector<std::pair<int, int>> result;
  for (size_t e = 0; e < theta.part.size(); ++e) result.push_back({theta.part[e], theta.piece[e]});
  return result;
}

}  // namespace

TEST_CASE_TEMPLATE("gradients of theta, w and the blended map are their finite differences", T, D2, D3) {
  constexpr int Dim = T::value;
  MethodOptions options;
  options.rays.n_rays = 4;
  options.weights.cutoff = 3;
  options.projection.degree = 2;
  const auto d = discretize<Dim>({curved_solid<Dim>()}, options);
  const double h = 1e-4;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> inside_box(0, 1);
  const Eigen::VectorXd z = affine_field<Dim>(d.unknowns, Mat<Dim>::Identity(), Vec<Dim>::Zero()).array().square();
  for (const auto variant : {DistanceWeight::published, DistanceWeight::draft, DistanceWeight::distance_only,
                              DistanceWeight::sided}) {
    int n_checked = 0, n_by_hit = 0;
    for (int trial = 0; trial < 150; ++trial) {
      Vec<Dim> X;
      for (int a = 0; a < Dim; ++a)
        X[a] = d.boundary.box.lower[a] + inside_box(random) * (d.boundary.box.upper - d.boundary.box.lower)[a];
      if (!inside(d.boundary, d.loops, X)) continue;
      const auto here = fields_at<Dim>(d, X, variant, true);
      if (here.w.uncovered.size() > 0) continue;
      const auto map = blended_map<Dim>(X, here.w, d.origins, d.projection, d.unknowns.size(), true);
      for (int axis = 0; axis < Dim; ++axis) {
        // Central differences with two steps: their difference bounds what the finer one lacks.
        const Vec<Dim> e_axis = Vec<Dim>::Unit(axis);
        std::array<Fields<Dim>, 4> f;
        const std::array<double, 4> at = {-h, -h / 2, h / 2, h};
        bool smooth = true;
        for (int i = 0; i < 4; ++i) {
          f[i] = fields_at<Dim>(d, Vec<Dim>(X + at[i] * e_axis), variant, false);
          smooth &= pieces(f[i].theta) == pieces(here.theta);
        }
        if (!smooth) continue;
        const auto check = [&](double value, const auto& field) {
          const double fine = (field(2) - field(1)) / h, coarse = (field(3) - field(0)) / (2 * h);
          if (std::abs(fine - coarse) > 1e-2 * (1 + std::abs(fine))) return;  // a jump of the foot in between
          // 1e-4: a closest point is certified in distance, so the foot is only good to about 1e-8.
          CHECK(std::abs(value - fine) < 1e-4 * (1 + std::abs(fine)) + std::abs(fine - coarse));
          ++n_checked;
        };
        for (size_t e = 0; e < here.theta.part.size(); ++e) {
          check(here.theta.gradient[e][axis], [&](int i) { return f[i].theta.theta[e]; });
          check(here.w.gradient[e][axis], [&](int i) { return f[i].w.w[e]; });
          n_by_hit += here.theta.piece[e] >= 0;
        }
        const Eigen::Map<const Points<Dim>> vectors(z.data(), Dim, d.unknowns.size());
        const Vec<Dim> F = vectors * dense_gradient(map, axis).transpose();
        for (int a = 0; a < Dim; ++a)
          check(F[a], [&](int i) {
            const Vec<Dim> Y = X + at[i] * e_axis;
            return evaluate(blended_map<Dim>(Y, f[i].w, d.origins, d.projection, d.unknowns.size(), false), z)(a, 0);
          });
      }
    }
    CHECK(n_checked > 100);
    const bool by_rays = variant == DistanceWeight::published || variant == DistanceWeight::draft;
    if (by_rays) CHECK(n_by_hit > 30);
  }
}

TEST_CASE_TEMPLATE("gradients of the blending weights sum to zero", T, D2, D3) {
  constexpr int Dim = T::value;
  MethodOptions options;
  options.rays.n_rays = 3;
  const auto d = discretize<Dim>({curved_solid<Dim>()}, options);
  const auto f = fields_at<Dim>(d, d.quadrature.position, DistanceWeight::published, true);
  for (int k = 0; k < f.w.n_points(); ++k) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (int e = f.w.begin[k]; e < f.w.begin[k + 1]; ++e) sum += f.w.gradient[e];
    CHECK(sum.norm() < 1e-12);
  }
}

TEST_CASE("sided weights at a pole: the normal is its limit, and the gradient is that of the weight") {
  // A quarter of a disc, or of a bowl, around a pole at 0 to which its edge u = 0 is collapsed.
  for (const double bowl : {0.0, 0.003}) {
    CAPTURE(bowl);
    const auto quarter = test::arc({0, 0}, 1, 0, M_PI / 2);
    Nurbs<2, 3> patch = test::biquadratic_patch();
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const Vec<2> X = 0.5 * i * quarter.control_points.col(j);
        patch.control_points.col(i + 3 * j) = Vec<3>(X[0], X[1], i == 2 ? bowl : 0);
        patch.weights[i + 3 * j] = quarter.weights[j];
      }
    const Boundary<3> boundary = make_boundary<3>({{patch}});
    for (const double along : {0.0, 0.4, 1.0})
      CHECK((unit_normal<3>(patch, Param<2>(0, along)) - Vec<3>(0, 0, 1)).norm() < 1e-4);
    Loops<3> loops;
    loops.loops.emplace_back().parts = {0};
    loops.orientation = {1};
    WeightOptions options;
    options.variant = DistanceWeight::sided;
    options.cutoff = 2;
    const auto theta_at = [&](const Vec<3>& X, bool gradient) {
      const auto distances = measure_distances<3>(boundary, loops, Points<3>(X), options.variant, options.cutoff);
      auto theta = distance_weights(distances, options);
      if (gradient) distance_weight_gradients(boundary, Points<3>(X), distances, theta);
      return theta;
    };
    // Beside the pole, where only it is close, and a little to the outside: on the ramp of the side.
    for (const Vec<3>& X : {Vec<3>(-0.5, -0.3, 0.03), Vec<3>(-0.2, -0.6, 0.01), Vec<3>(-0.5, -0.5, -0.1)}) {
      CAPTURE(X.transpose());
      const auto theta = theta_at(X, true);
      REQUIRE(theta.theta.size() == 1);
      CHECK(theta.theta[0] > 0.01);
      for (int a = 0; a < 3; ++a) {
        const double h = 1e-4;
        const double difference =
            (theta_at(X + h * Vec<3>::Unit(a), false).theta[0] - theta_at(X - h * Vec<3>::Unit(a), false).theta[0]) / (2 * h);
        CHECK(theta.gradient[0][a] == doctest::Approx(difference).epsilon(5e-3));
      }
    }
    CHECK(theta_at(Vec<3>(-0.5, -0.3, 0.5), false).theta.empty());  // far to the outside
  }
}
