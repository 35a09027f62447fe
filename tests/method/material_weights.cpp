// Weights where parts of a solid are of different materials.
#include <doctest/doctest.h>

#include <random>

#include "dims.h"
#include "sem/method/discretization.h"
#include "sem/method/material_weights.h"
#include "solids.h"

using namespace sem;

namespace {

// The unit box, sided weights that reach across it.
template <int Dim>
struct Box1 {
  Boundary<Dim> boundary = make_boundary<Dim>({test::unit_box<Dim>()});
  Loops<Dim> loops = find_loops(boundary);

  DistanceWeights<Dim> theta(const Points<Dim>& X, const std::vector<double>& stiffness) const {
    const WeightOptions options{.variant = DistanceWeight::sided, .cutoff = 1.5};
    const auto distances = measure_distances<Dim>(boundary, loops, X, options.variant, options.cutoff);
    auto theta = distance_weights(distances, options);
    distance_weight_gradients(boundary, X, distances, theta);
    keep_out_of_stiffer(stiffness, boundary, theta);
    return theta;
  }
  BlendingWeights<Dim> weights(const Points<Dim>& X, const std::vector<double>& stiffness) const {
    return blending_weights(theta(X, stiffness), boundary, X);
  }
  // Three moduli: part 0 is the stiffest, part 1 the next, all others alike.
  std::vector<double> stiffness() const {
    std::vector<double> all(size_t(boundary.n_parts()), 1.0);
    all[0] = 1e6;
    all[1] = 1e3;
    return all;
  }
};

template <int Dim>
Points<Dim> random_points(int n) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in_box(0.01, 0.99);
  Points<Dim> X(Dim, n);
  for (int k = 0; k < n; ++k)
    for (int a = 0; a < Dim; ++a) X(a, k) = in_box(random);
  return X;
}

template <int Dim>
Eigen::VectorXd dense(const BlendingWeights<Dim>& w, int point) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(w.n_parts);
  for (int e = w.begin[point]; e < w.begin[point + 1]; ++e) all[w.part[e]] = w.w[e];
  return all;
}

}  // namespace

TEST_CASE_TEMPLATE("a point is in the region of the part with the largest theta; softer parts have no weight there", T, D2, D3) {
  const Box1<T::value> box;
  const auto stiffness = box.stiffness();
  const Points<T::value> X = random_points<T::value>(200);
  const auto plain = box.theta(X, {});
  const auto w = box.weights(X, stiffness);
  CHECK(w.uncovered.empty());
  int n_stiff = 0;
  for (int k = 0; k < X.cols(); ++k) {
    int owner = plain.begin[k];
    for (int e = owner; e < plain.begin[k + 1]; ++e)
      if (plain.theta[e] > plain.theta[owner]) owner = e;
    const int part = plain.part[owner], begin = w.begin[k];
    CHECK(part_of_region(stiffness, box.boundary.solid, &w.part[begin], &w.w[begin], w.begin[k + 1] - begin) == part);
    const Eigen::VectorXd all = dense(w, k);
    CHECK(all.sum() == doctest::Approx(1));
    for (int i = 0; i < w.n_parts; ++i)
      if (stiffness[i] < stiffness[part]) CHECK(all[i] == 0);
    n_stiff += part == 0;
  }
  CHECK(n_stiff > 10);
}

TEST_CASE_TEMPLATE("weights of several materials are continuous, and their gradients finite differences", T, D2, D3) {
  constexpr int Dim = T::value;
  const Box1<Dim> box;
  const auto stiffness = box.stiffness();
  constexpr double h = 1e-6;
  for (int axis = 0; axis < Dim; ++axis) {
    const Points<Dim> X = random_points<Dim>(200);
    Points<Dim> before = X, after = X;
    before.row(axis).array() -= h;
    after.row(axis).array() += h;
    const auto w = box.weights(X, stiffness), w_before = box.weights(before, stiffness),
               w_after = box.weights(after, stiffness);
    for (int k = 0; k < X.cols(); ++k) {
      const Eigen::VectorXd difference = (dense(w_after, k) - dense(w_before, k)) / (2 * h);
      CHECK(difference.cwiseAbs().maxCoeff() < 1e3);  // a jump: 5e5
      for (int e = w.begin[k]; e < w.begin[k + 1]; ++e)
        CHECK(w.gradient[e][axis] == doctest::Approx(difference[w.part[e]]).epsilon(1e-5).scale(1));
    }
  }
}

TEST_CASE_TEMPLATE("parts of one material keep their theta", T, D2, D3) {
  const Box1<T::value> box;
  const Points<T::value> X = random_points<T::value>(20);
  const auto plain = box.theta(X, {}), alike = box.theta(X, std::vector<double>(size_t(box.boundary.n_parts()), 3.0));
  CHECK(alike.part == plain.part);
  CHECK(alike.theta == plain.theta);
}
