// Rules that resolve kinks, and what the condensed formulation's unknowns represent.
#include <random>

#include "dims.h"
#include "linear_algebra.h"
#include "sem/method/discretization.h"
#include "sem/method/resolved_rule.h"
#include "solids.h"

using namespace sem;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

template <int Dim>
MethodOptions condensed(int degree, double cutoff = 0.8) {
  MethodOptions options;
  options.formulation = Formulation::condensed;
  options.weights.variant = DistanceWeight::sided;
  options.weights.cutoff = cutoff;
  options.interior_rule.rule = InteriorRule::resolved;
  options.interior_rule.weight_tolerance = Dim == 2 ? 1e-2 : 5e-2;
  options.projection.degree = degree;
  return options;
}

// An L: re-entrant at (1, 1).
test::Parts<2> ell() { return test::polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}); }

}  // namespace

TEST_CASE_TEMPLATE("a resolved rule integrates a kink that a grid of the same size misses", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto boundary = make_boundary<Dim>({test::unit_box<Dim>()});
  const auto loops = find_loops(boundary);
  // |x - 0.3| over the unit box, and the constant 1.
  const double truth = (0.09 + 0.49) / 2;
  const IndicatorsAt<Dim> kink = [](const Points<Dim>& X) {
    Indicators values;
    values.n = 1;
    values.begin.push_back(0);
    for (int k = 0; k < X.cols(); ++k) {
      values.index.push_back(0);
      values.value.push_back(std::abs(X(0, k) - 0.3));
      values.begin.push_back(k + 1);
    }
    return values;
  };
  ResolvedOptions options;
  options.axis = 1;
  options.points = 3;
  double previous = 1;
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    options.tolerance = tolerance;
    const auto rule = resolved_rule<Dim>(boundary, loops, kink, options);
    double sum = 0;
    for (int k = 0; k < rule.quadrature.size(); ++k)
      sum += rule.quadrature.weight[k] * std::abs(rule.quadrature.position(0, k) - 0.3);
    CHECK(rule.reached);
    CHECK(rule.error <= tolerance);
    CHECK(std::abs(sum - truth) < 2 * tolerance * truth);
    CHECK(std::abs(rule.quadrature.weight.sum() - 1) < 1e-12);
    CHECK(rule.quadrature.weight.minCoeff() > 0);
    CHECK(std::abs(sum - truth) <= previous);
    previous = std::abs(sum - truth);
    // Halved across the kink only: the count grows with the logarithm of the tolerance.
    CHECK(rule.n_cells < 60);
  }
}

TEST_CASE_TEMPLATE("a resolved rule keeps its points inside and its volume exact on curved bodies", T, D2, D3) {
  constexpr int Dim = T::value;
  const IndicatorsAt<Dim> one = [](const Points<Dim>& X) {
    Indicators values;
    values.n = 1;
    for (int k = 0; k <= X.cols(); ++k) values.begin.push_back(k);
    values.index.assign(X.cols(), 0);
    values.value.assign(X.cols(), 1);
    return values;
  };
  // A disc (ball) with a hole, and another one that stands beside it.
  const auto round = [](double radius, const Vec<Dim>& center) {
    test::Parts<Dim> parts;
    if constexpr (Dim == 2) parts = test::circle({0, 0}, radius, 5);
    else parts = test::ball();
    for (auto& part : parts)
      part.control_points = ((Dim == 2 ? 1 : radius) * part.control_points).colwise() + center;
    return parts;
  };
  test::Parts<Dim> parts = round(1.5, Vec<Dim>::Constant(0.1));
  for (const auto& hole : round(0.7, Vec<Dim>::Constant(0.2))) parts.push_back(hole);
  const auto boundary = make_boundary<Dim>({parts, round(0.5, 2.1 * Vec<Dim>::Unit(0))});
  const auto loops = find_loops(boundary);
  const auto volume = [](double r) { return Dim == 2 ? M_PI * r * r : 4 * M_PI / 3 * r * r * r; };
  const double truth = volume(1.5) - volume(0.7) + volume(0.5);
  const double tolerance = Dim == 2 ? 1e-10 : 1e-6;
  const auto rule = resolved_rule<Dim>(boundary, loops, one, {0, Dim == 2 ? 6 : 4, tolerance});
  CHECK(rule.reached);
  CHECK(std::abs(rule.quadrature.weight.sum() / truth - 1) < 10 * tolerance);
  CHECK(rule.quadrature.weight.minCoeff() > 0);
  for (int k = 0; k < rule.quadrature.size(); ++k)
    CHECK(inside<Dim>(boundary, loops, rule.quadrature.position.col(k)));
  // 173; with blocks whose borders do not move 4827 cells (200 000 points) are not enough.
  if (Dim == 3) CHECK(rule.n_cells < 300);
}

TEST_CASE_TEMPLATE("the condensed map contains every polynomial of its degree", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const int degree : {1, 2}) {
    const auto d = discretize<Dim>({test::unit_box<Dim>()}, condensed<Dim>(degree));
    // The map itself: the gradients of d.interior are corrected by the rule's error.
    const Map<Dim> at_points = map_at(d, d.quadrature.position, true);
    const MatrixXd value = dense_value(at_points);
    const Monomials<Dim> monomials(degree);
    // Values and exact gradients together, by one set of coefficients per monomial.
    const int n = d.quadrature.size();
    MatrixXd field((Dim + 1) * n, monomials.size()), map((Dim + 1) * n, value.cols());
    map.topRows(n) = value;
    for (int axis = 0; axis < Dim; ++axis) map.middleRows((1 + axis) * n, n) = dense_gradient(at_points, axis);
    for (int k = 0; k < n; ++k) {
      monomials.values(d.quadrature.position.col(k), field.row(k));
      for (int axis = 0; axis < Dim; ++axis)
        monomials.derivatives(d.quadrature.position.col(k), axis, field.row((1 + axis) * n + k));
    }
    const MatrixXd z = test::least_squares(map, field);
    CHECK((map * z - field).cwiseAbs().maxCoeff() < 1e-6);
    // Affine fields need no fit: they are unknowns, exact to rounding.
    const VectorXd rest = affine_field<Dim>(d.unknowns, Mat<Dim>::Identity(), Vec<Dim>::Zero());
    CHECK((evaluate(d.interior, rest) - d.quadrature.position).cwiseAbs().maxCoeff() < 1e-13);
    CHECK((value * d.unknowns.one - VectorXd::Ones(value.rows())).cwiseAbs().maxCoeff() < 1e-13);
  }
}

TEST_CASE_TEMPLATE("control points follow the condensed map: affine fields to rounding", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto d = discretize<Dim>({test::unit_box<Dim>()}, condensed<Dim>(2));
  Mat<Dim> A = Mat<Dim>::Identity();
  A(0, 1) = 0.3;
  A(1, 0) = -0.2;
  const Vec<Dim> b = Vec<Dim>::Constant(0.7);
  const Points<Dim> p = control_points<Dim>(d.unknowns, affine_field<Dim>(d.unknowns, A, b));
  CHECK((p - ((A * rest_controls(d.boundary)).colwise() + b)).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("sided weights are continuous up to the boundary and around a re-entrant corner") {
  const auto d = discretize<2>({ell()}, condensed<2>(1));
  // Along a circle around the corner, from wall to wall through the material: small steps, small changes.
  const int n = 2000;
  Points<2> X(2, n);
  for (int k = 0; k < n; ++k) {
    const double angle = M_PI / 2 + 1.5 * M_PI * k / (n - 1);
    X.col(k) = Vec<2>(1, 1) + 0.4 * Vec<2>(std::cos(angle), std::sin(angle));
  }
  WeightOptions options = d.options.weights;
  const auto weights = blending_weights(
      distance_weights(measure_distances(d.boundary, d.loops, X, options.variant, options.cutoff), options), d.boundary, X);
  MatrixXd w = MatrixXd::Zero(n, d.boundary.n_parts());
  for (int k = 0; k < n; ++k)
    for (int e = weights.begin[k]; e < weights.begin[k + 1]; ++e) w(k, weights.part[e]) = weights.w[e];
  CHECK((w.bottomRows(n - 1) - w.topRows(n - 1)).cwiseAbs().maxCoeff() < 0.02);
  CHECK(w.colwise().maxCoeff().maxCoeff() > 0.4);
}

TEST_CASE("limbs that a gap separates do not share sided weights, but see each other by distance alone") {
  const auto u = make_boundary<2>(
      {test::polygon({{0, 0}, {2.2, 0}, {2.2, 3}, {1.2, 3}, {1.2, 1}, {1, 1}, {1, 3}, {0, 3}})});
  const auto loops = find_loops(u);
  const Vec<2> X(1.3, 2);  // in the right leg
  const int left_wall = 5, right_wall = 3;
  for (const auto variant : {DistanceWeight::sided, DistanceWeight::distance_only}) {
    WeightOptions options;
    options.variant = variant;
    options.cutoff = 1;
    const auto theta = distance_weights(measure_distances<2>(u, loops, X, variant, 1), options);
    bool left = false, right = false;
    for (const int part : theta.part) {
      left |= part == left_wall;
      right |= part == right_wall;
    }
    CHECK(right);
    CHECK(left == (variant == DistanceWeight::distance_only));
  }
}
