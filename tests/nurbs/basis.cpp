#include "sem/nurbs/basis.h"

#include <doctest/doctest.h>

#include <type_traits>

#include "shapes.h"

using namespace sem;
using namespace sem::test;

template <int ParamDim, int Dim>
struct Kind {
  static constexpr int param_dim = ParamDim, dim = Dim;
};
using PlaneCurve = Kind<1, 2>;
using Surface = Kind<2, 3>;
using SpaceCurve = Kind<1, 3>;
TYPE_TO_STRING_AS("plane curve", PlaneCurve);
TYPE_TO_STRING_AS("surface", Surface);
TYPE_TO_STRING_AS("space curve", SpaceCurve);

namespace {

template <class T>
auto random_of(std::mt19937& random, int trial, bool jumps = false) {
  return random_nurbs<T::param_dim, T::dim>(random, 1 + trial % 5, 1 + random() % 4,
                                            random() % 3 != 0, random() % 2, jumps);
}

double sum(const std::vector<double>& values) {
  double result = 0;
  for (double value : values) result += value;
  return result;
}

}  // namespace

TEST_CASE_TEMPLATE("basis: partition of unity, derivatives sum to zero", T, PlaneCurve, Surface,
                   SpaceCurve) {
  std::mt19937 random(31);
  BasisValues<T::param_dim> basis;
  for (int trial = 0; trial < 300; ++trial) {
    const auto nurbs = random_of<T>(random, trial, true);
    const auto u = random_parameter(random, nurbs);
    evaluate_basis(nurbs, u, 2, basis);
    CHECK(sum(basis.value) == doctest::Approx(1).epsilon(1e-13));
    for (double value : basis.value) CHECK(value >= 0);
    for (const auto& row : basis.first) CHECK(std::abs(sum(row)) < 1e-11);
    for (const auto& row : basis.second) CHECK(std::abs(sum(row)) < 1e-9);
  }
}

TEST_CASE_TEMPLATE("basis times control points is the point and its derivatives", T, PlaneCurve,
                   Surface, SpaceCurve) {
  std::mt19937 random(32);
  BasisValues<T::param_dim> basis;
  for (int trial = 0; trial < 300; ++trial) {
    const auto nurbs = random_of<T>(random, trial);
    const auto u = random_parameter(random, nurbs);
    evaluate_basis(nurbs, u, 2, basis);
    const auto combine = [&](const std::vector<double>& row) {
      Vec<T::dim> result = Vec<T::dim>::Zero();
      for (size_t k = 0; k < row.size(); ++k)
        result += row[k] * nurbs.control_points.col(basis.column[k]);
      return result;
    };
    const auto jet = derivatives(nurbs, u);
    CHECK((combine(basis.value) - point(nurbs, u)).norm() < 1e-13);
    CHECK((jet.point - point(nurbs, u)).norm() < 1e-13);
    for (int a = 0; a < T::param_dim; ++a)
      CHECK((combine(basis.first[a]) - jet.first.col(a)).norm() < 1e-12 * (1 + jet.first.norm()));
    for (int p = 0; p < n_second<T::param_dim>; ++p)
      CHECK((combine(basis.second[p]) - jet.second[p]).norm() < 1e-11 * (1 + jet.second[p].norm()));
  }
}

TEST_CASE_TEMPLATE("a lower order gives the same values and nothing above it", T, PlaneCurve,
                   Surface, SpaceCurve) {
  std::mt19937 random(35);
  BasisValues<T::param_dim> all, some;
  for (int trial = 0; trial < 100; ++trial) {
    const auto nurbs = random_of<T>(random, trial, true);
    const auto u = random_parameter(random, nurbs);
    const auto jet = derivatives(nurbs, u);
    evaluate_basis(nurbs, u, 2, all);
    for (int order = 0; order < 2; ++order) {
      const auto low = derivatives(nurbs, u, order);
      CHECK((low.point - jet.point).norm() < 1e-14);
      if (order == 1) CHECK((low.first - jet.first).norm() <= 1e-13 * jet.first.norm());
      if (order == 0) CHECK(low.first.norm() == 0);
      for (const auto& second : low.second) CHECK(second.norm() == 0);
      evaluate_basis(nurbs, u, order, some);
      CHECK(some.column == all.column);
      for (size_t k = 0; k < all.value.size(); ++k)
        CHECK(some.value[k] == doctest::Approx(all.value[k]).epsilon(1e-14));
      for (int a = 0; a < T::param_dim; ++a) {
        CHECK(some.first[a].size() == (order == 1 ? all.value.size() : 0));
        for (size_t k = 0; k < some.first[a].size(); ++k)
          CHECK(std::abs(some.first[a][k] - all.first[a][k]) < 1e-12);
      }
      for (const auto& second : some.second) CHECK(second.empty());
    }
  }
}

TEST_CASE_TEMPLATE("first and second derivatives match finite differences", T, PlaneCurve, Surface,
                   SpaceCurve) {
  std::mt19937 random(33);
  for (int trial = 0; trial < 200; ++trial) {
    const auto nurbs = random_of<T>(random, trial);
    auto u = random_parameter(random, nurbs);
    const double h = 1e-5;
    bool near_knot = false;
    for (int a = 0; a < T::param_dim; ++a)
      for (double knot : nurbs.knots[a]) near_knot = near_knot || std::abs(knot - u[a]) < 2 * h;
    if (near_knot) continue;
    const auto jet = derivatives(nurbs, u);
    int p = 0;
    for (int a = 0; a < T::param_dim; ++a) {
      auto plus = u, minus = u;
      plus[a] += h;
      minus[a] -= h;
      const auto up = derivatives(nurbs, plus), down = derivatives(nurbs, minus);
      const double scale = 1 + jet.first.norm() + jet.second[0].norm();
      CHECK(((up.point - down.point) / (2 * h) - jet.first.col(a)).norm() < 1e-4 * scale);
      for (int b = a; b < T::param_dim; ++b, ++p)
        CHECK(((up.first.col(b) - down.first.col(b)) / (2 * h) - jet.second[p]).norm() <
              1e-3 * scale);
    }
  }
}

TEST_CASE("derivatives converge to second order in the step of a central difference") {
  std::mt19937 random(34);
  auto curve = random_nurbs<1, 2>(random, 4, 3, true, true);
  const Param<1> u(0.4 * domain(curve, 0).lower + 0.6 * domain(curve, 0).upper);
  const auto exact = derivatives(curve, u);
  double last_first = 0, last_second = 0;
  for (double h : {4e-3, 2e-3}) {
    const Vec<2> up = point(curve, Param<1>(u[0] + h)), down = point(curve, Param<1>(u[0] - h));
    const double first = ((up - down) / (2 * h) - exact.first).norm();
    const double second = ((up - 2 * exact.point + down) / (h * h) - exact.second[0]).norm();
    if (last_first > 0) {
      CHECK(std::log2(last_first / first) == doctest::Approx(2).epsilon(0.05));
      CHECK(std::log2(last_second / second) == doctest::Approx(2).epsilon(0.05));
    }
    last_first = first;
    last_second = second;
  }
}

TEST_CASE("four rational arcs are a circle to rounding") {
  const auto disc = circle({1, 2}, 3);
  for (int k = 0; k <= 400; ++k) {
    const auto jet = derivatives(disc, Param<1>(k / 100.0));
    CHECK((jet.point - Vec<2>(1, 2)).norm() == doctest::Approx(3).epsilon(1e-15));
    CHECK(std::abs((jet.point - Vec<2>(1, 2)).dot(jet.first.col(0))) < 1e-13);
  }
  CHECK(is_closed(disc, 0));
}

TEST_CASE("at a knot evaluation takes the right limit, at the end the left one") {
  Nurbs<1, 2> jump;  // two segments with a gap at u = 1
  jump.degree[0] = 1;
  jump.knots[0] = {0, 0, 1, 1, 2, 2};
  jump.control_points.resize(2, 4);
  jump.control_points << 0, 1, 5, 6, 0, 0, 1, 1;
  jump.weights.setOnes(4);
  CHECK_NOTHROW(check(jump, "", ""));
  CHECK(point(jump, Param<1>(1.0)) == Vec<2>(5, 1));
  CHECK(point(jump, Param<1>(2.0)) == Vec<2>(6, 1));
  CHECK(point(jump, Param<1>(7.0)) == Vec<2>(6, 1));
  CHECK(point(jump, Param<1>(-7.0)) == Vec<2>(0, 0));
  CHECK(spans(jump, 0).size() == 2);
  CHECK(!is_closed(jump, 0));
}

TEST_CASE("an unclamped periodic curve is closed with continuous derivatives") {
  Nurbs<1, 2> curve;
  curve.degree[0] = 3;
  const int n = 7;
  curve.control_points.resize(2, n + 3);
  curve.weights.resize(n + 3);
  for (int k = 0; k < n + 7; ++k) curve.knots[0].push_back(k);
  for (int i = 0; i < n + 3; ++i) {
    const double angle = 2 * M_PI * (i % n) / n;
    curve.control_points.col(i) = Vec<2>(std::cos(angle), std::sin(2 * angle));
    curve.weights[i] = 1 + 0.3 * (i % n);
  }
  CHECK(is_closed(curve, 0));
  const auto start = derivatives(curve, Param<1>(domain(curve, 0).lower));
  const auto end = derivatives(curve, Param<1>(domain(curve, 0).upper));
  CHECK((start.point - end.point).norm() < 1e-14);
  CHECK((start.first - end.first).norm() < 1e-13);
  CHECK((start.second[0] - end.second[0]).norm() < 1e-12);
}
