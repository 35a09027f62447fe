// Rules of the distance weights, the closed-form blending weights, origins.
#include <doctest/doctest.h>

#include <random>

#include "dims.h"
#include "sem/method/discretization.h"
#include "sem/method/line_rules.h"
#include "solids.h"

using namespace sem;
using test::Parts;

namespace {

template <int Dim>
struct BodyIn {
  Boundary<Dim> boundary;
  Loops<Dim> loops;
  explicit BodyIn(const Parts<Dim>& parts) : boundary(make_boundary<Dim>({parts})), loops(find_loops(boundary)) {}

  DistanceWeights<Dim> weights(const Vec<Dim>& X, DistanceWeight variant, double cutoff) const {
    WeightOptions options;
    options.cutoff = cutoff;
    const auto distances = measure_distances<Dim>(boundary, loops, X, variant, cutoff);
    auto theta = distance_weights(distances, options);
    distance_weight_gradients<Dim>(boundary, X, distances, theta);
    return theta;
  }
  // theta of all parts at X.
  Eigen::VectorXd theta(const Vec<Dim>& X, DistanceWeight variant, double cutoff) const {
    const auto found = weights(X, variant, cutoff);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(boundary.n_parts());
    for (size_t e = 0; e < found.part.size(); ++e) result[found.part[e]] = found.theta[e];
    return result;
  }
  // Its gradients, a row each.
  Eigen::Matrix<double, Eigen::Dynamic, Dim> gradients(const Vec<Dim>& X, DistanceWeight variant, double cutoff) const {
    const auto found = weights(X, variant, cutoff);
    Eigen::Matrix<double, Eigen::Dynamic, Dim> result(boundary.n_parts(), Dim);
    result.setZero();
    for (size_t e = 0; e < found.part.size(); ++e) result.row(found.part[e]) = found.gradient[e];
    return result;
  }
};
using Body = BodyIn<2>;

constexpr auto published = DistanceWeight::published;
constexpr auto draft = DistanceWeight::draft;
constexpr auto distance_only = DistanceWeight::distance_only;

}  // namespace

TEST_CASE("published theta is 1 - d / min(d_total, alpha); the draft takes the rest of the ray") {
  const Body box(test::box<2>({0, 0}, {4, 1}));  // bottom, right, top, left
  const Vec<2> X(2, 0.25);
  CHECK(box.theta(X, published, 10)[0] == doctest::Approx(0.75));
  CHECK(box.theta(X, published, 0.5)[0] == doctest::Approx(0.5));
  CHECK(box.theta(X, published, 10)[2] == doctest::Approx(0.25));
  CHECK(box.theta(X, draft, 10)[0] == doctest::Approx(1 - 0.25 / 0.75));
  CHECK(box.theta(X, draft, 10)[2] == 0);
  CHECK(box.theta(X, distance_only, 0.5)[0] == doctest::Approx(0.5));
  CHECK(box.theta(X, distance_only, 10)[1] == doctest::Approx(0.8));
}

TEST_CASE("draft: opposite sides never blend, and all vanish midway, whatever alpha") {
  const Body box(test::box<2>({0, 0}, {40, 1}));
  for (const double alpha : {0.6, 2.0, 10.0}) {
    for (double y = 0.05; y < 1; y += 0.1) {
      const auto theta = box.theta({20, y}, draft, alpha);
      CHECK(theta[0] * theta[2] == 0);
    }
    CHECK(box.theta({20, 0.5}, draft, alpha).isZero(1e-12));
  }
}

TEST_CASE("on a part its theta is 1 and all others vanish; at a joint both parts have 1") {
  const Body box(test::unit_box<2>(3));
  for (const auto variant : {published, draft}) {
    const auto on_edge = box.theta({0.5, 0}, variant, 5);
    CHECK(on_edge[1] == 1);
    CHECK(on_edge.sum() == 1);
    const auto at_joint = box.theta({1.0 / 3, 0}, variant, 5);
    CHECK(at_joint[0] == 1);
    CHECK(at_joint[1] == 1);
    CHECK(at_joint.sum() == 2);
    // Near a joint on a straight edge the neighbour is in line with X: still 0.
    CHECK(box.theta({1.0 / 3 + 1e-3, 0}, variant, 5).sum() == 1);
  }
}

TEST_CASE_TEMPLATE("weights without rays and their gradients are continuous up to the boundary", T, D2, D3) {
  constexpr int Dim = T::value;
  const BodyIn<Dim> box(test::unit_box<Dim>(2));
  Vec<Dim> X = Vec<Dim>::Constant(0.3);
  X[Dim - 1] = 0;
  const Vec<Dim> inside = X + 1e-6 * Vec<Dim>::Unit(Dim - 1);
  for (const auto variant : {distance_only, DistanceWeight::sided}) {
    const auto on = box.gradients(X, variant, 2), beside = box.gradients(inside, variant, 2);
    CHECK((on - beside).cwiseAbs().maxCoeff() < 1e-4);
    CHECK(beside.cwiseAbs().maxCoeff() > 0.1);
    CHECK((box.theta(X, variant, 2) - box.theta(inside, variant, 2)).cwiseAbs().maxCoeff() < 1e-5);
  }
}

TEST_CASE("a part hidden behind another has no weight: limbs do not see each other through a gap") {
  // A U: legs 0..1 and 1.2..2.2 wide, joined below y = 1.
  const Body u(test::polygon({{0, 0}, {2.2, 0}, {2.2, 3}, {1.2, 3}, {1.2, 1}, {1, 1}, {1, 3}, {0, 3}}));
  const Vec<2> X(0.9, 2);  // in the left leg, near the gap
  // Parts: bottom, right, top right, inner right, gap floor, inner left, top left, left.
  CHECK(u.theta(X, published, 1.05)[3] == 0);
  CHECK(u.theta(X, distance_only, 1.05)[3] == doctest::Approx(1 - 0.3 / 1.05));
  CHECK(u.theta(X, published, 1.05)[5] == doctest::Approx(1 - 0.1 / 1.0));
}

TEST_CASE("inside a single closed part theta is 1 whatever the cutoff, for the variants with a ray") {
  Nurbs<1, 2> curve;
  curve.degree = {2};
  const int n = 8;
  curve.control_points.resize(2, n + 2);
  curve.weights = Eigen::VectorXd::Ones(n + 2);
  for (int i = 0; i < n + 5; ++i) curve.knots[0].push_back(i);
  for (int i = 0; i < n + 2; ++i)
    curve.control_points.col(i) << std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n);
  const Body body({curve});
  CHECK(body.theta({0.1, 0.2}, published, 0.01)[0] == 1);
  CHECK(body.theta({0.1, 0.2}, draft, 0.01)[0] == 1);
  CHECK(body.theta({0.1, 0.2}, distance_only, 0.01)[0] == 0);
  CHECK(body.theta({3, 0.2}, published, 0.01)[0] == 0);
}

TEST_CASE("alpha from a sparsity target gives that share of non-zero weights") {
  const Body box(test::unit_box<2>(4));
  const auto q = quadrature_on_rays(cast_rays(box.boundary, box.loops, {0, 12, RayGrid::midpoint}), {});
  for (const auto variant : {published, distance_only})
    for (const double target : {0.1, 0.25, 0.5}) {
      WeightOptions options;
      options.sparsity = target;
      const auto distances = measure_distances(box.boundary, box.loops, q.position, variant,
                                               std::numeric_limits<double>::infinity());
      const auto theta = distance_weights(distances, options);
      const double all = q.size() * 16.0;
      CHECK(theta.part.size() / all == doctest::Approx(target).epsilon(0.05));
      CHECK(theta.cutoff > 0);
    }
}

TEST_CASE("the closed form solves the quadratic program min w^T diag(1/theta) w, sum w = 1, 0 <= w <= 1") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.02, 1);
  const Body box(test::unit_box<2>(1));
  for (int trial = 0; trial < 50; ++trial) {
    const int n = 2 + int(random() % 5);
    DistanceWeights<2> theta;
    theta.n_parts = n;
    theta.begin = {0, n};
    for (int i = 0; i < n; ++i) {
      theta.part.push_back(i);
      theta.theta.push_back(uniform(random));
    }
    const auto w = blending_weights(theta, box.boundary, Points<2>(Points<2>::Zero(2, 1)));
    // Projected gradient on the simplex, an independent solver.
    Eigen::VectorXd x = Eigen::VectorXd::Constant(n, 1.0 / n);
    const Eigen::VectorXd t = Eigen::Map<const Eigen::VectorXd>(theta.theta.data(), n);
    const double step = t.minCoeff() / 2;
    for (int iteration = 0; iteration < 20000; ++iteration) {
      Eigen::VectorXd y = x - step * x.cwiseQuotient(t);
      // Euclidean projection onto {sum = 1, 0 <= w <= 1} by bisection on the shift.
      double lower = -2, upper = 2;
      for (int bisection = 0; bisection < 60; ++bisection) {
        const double shift = (lower + upper) / 2;
        ((y.array() + shift).max(0).min(1).sum() < 1 ? lower : upper) = shift;
      }
      x = (y.array() + lower).max(0).min(1);
    }
    for (int i = 0; i < n; ++i) CHECK(std::abs(w.w[i] - x[i]) < 1e-7);
  }
}

TEST_CASE("where all theta vanish the point follows its closest part and is listed") {
  const Body box(test::box<2>({0, 0}, {4, 1}));
  const Points<2> X = Vec<2>(2, 0.4);
  WeightOptions options;
  options.cutoff = 0.1;
  const auto theta = distance_weights(measure_distances(box.boundary, box.loops, X, published, 0.1), options);
  const auto w = blending_weights(theta, box.boundary, X);
  REQUIRE(w.uncovered.size() == 1);
  REQUIRE(w.part.size() == 1);
  CHECK(w.part[0] == 0);
  CHECK(w.w[0] == 1);
}

TEST_CASE("origins: ties go to the larger set, flat sets do not count, lone parts take the mean of all") {
  const Body box(test::unit_box<2>(1));
  const auto samples = sample_boundary(box.boundary, {});
  BlendingWeights<2> w;
  w.n_parts = 4;
  const auto add = [&](std::vector<int> parts) {
    for (const int i : parts) {
      w.part.push_back(i);
      w.w.push_back(1.0 / parts.size());
    }
    w.begin.push_back(int(w.part.size()));
  };
  w.begin = {0};
  add({0, 1});     // sum 1/2 for part 0
  add({0, 1, 2});  // with weight 1.5: also 1/2 for part 0
  const Eigen::Vector2d volume(1, 1.5);
  const auto origins = choose_origins<2>(OriginChoice::shared_parts, w, volume, samples);
  CHECK(origins.members[origins.of_part[0]] == std::vector<int>{0, 1, 2});
  CHECK(origins.ties == std::vector<int>{0, 1});
  CHECK(origins.fallback == std::vector<int>{3});
  CHECK(origins.members[origins.of_part[3]] == std::vector<int>{0, 1, 2, 3});
  CHECK((origins.position.col(origins.of_part[3]) - Vec<2>(0.5, 0.5)).norm() < 1e-15);
  CHECK((origins.position.col(origins.of_part[0]) - Vec<2>(2.0 / 3, 0.5)).norm() < 1e-15);

  // Two parts in a row on one line: flat.
  const Body fine(test::unit_box<2>(2));
  const auto fine_samples = sample_boundary(fine.boundary, {});
  w = {};
  w.n_parts = 8;
  w.begin = {0};
  add({0, 1});
  add({0, 7});
  const auto chosen = choose_origins<2>(OriginChoice::shared_parts, w, Eigen::Vector2d(5, 1), fine_samples);
  CHECK(chosen.members[chosen.of_part[0]] == std::vector<int>{0, 7});
  CHECK(chosen.fallback.size() == 6);
}

TEST_CASE("Gauss rules are exact to their degree, and not beyond") {
  const auto integrate = [](const LineRule& rule, int power) {
    double sum = 0;
    for (size_t k = 0; k < rule.node.size(); ++k) sum += rule.weight[k] * std::pow(rule.node[k], power);
    return sum;
  };
  const auto exact = [](int power) { return power % 2 ? 0.0 : 2.0 / (power + 1); };
  for (int n = 1; n <= 33; n += 4) {
    for (int power = 0; power < 2 * n; ++power)
      CHECK(std::abs(integrate(gauss_legendre(n), power) - exact(power)) < 1e-14);
    if (n < 8) CHECK(std::abs(integrate(gauss_legendre(n), 2 * n) - exact(2 * n)) > 1e-6);
  }
  for (int n = 2; n <= 12; ++n) {
    for (int power = 0; power < 2 * n - 2; ++power)
      CHECK(std::abs(integrate(gauss_lobatto(n), power) - exact(power)) < 1e-14);
    if (n < 8) CHECK(std::abs(integrate(gauss_lobatto(n), 2 * n - 2) - exact(2 * n - 2)) > 1e-6);
  }
  CHECK(std::abs(integrate(midpoint_rule(10), 2) - 2.0 / 3) < 1e-2);
}

TEST_CASE("a neighbour that misses the joint by 1e-9 does not cut the ray that starts there") {
  // The bottom is split at (0.5, 0); the second half starts a little before and above that point.
  const auto theta_of_first = [](double error) {
    Parts<2> parts = test::polygon({{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}});
    parts[1].control_points.col(0) = Vec<2>(0.5 - error, error);
    return Body(parts).theta({0.8, 0.3}, published, 2)[0];
  };
  const double exact = 1 - 0.3 / 0.5;  // the ray leaves (0.5, 0) along the diagonal and meets x = 1
  CHECK(theta_of_first(0) == doctest::Approx(exact));
  CHECK(theta_of_first(1e-9) == doctest::Approx(exact));
  CHECK(theta_of_first(1e-3) == 0);  // a part that far off does stand in between
}
