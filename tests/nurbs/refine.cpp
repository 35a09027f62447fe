#include "sem/nurbs/refine.h"

#include <doctest/doctest.h>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/prepared.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {

template <int ParamDim, int Dim>
double largest_difference(std::mt19937& random, const Nurbs<ParamDim, Dim>& a,
                          const Nurbs<ParamDim, Dim>& b) {
  double result = 0;
  for (int k = 0; k < 20; ++k) {
    const auto u = random_parameter(random, b);
    result = std::max(result, (point(a, u) - point(b, u)).norm());
  }
  return result;
}

template <int ParamDim, int Dim>
void check_refinement(std::mt19937& random, int trial) {
  const int degree = 1 + trial % 5;
  const auto nurbs = random_nurbs<ParamDim, Dim>(
      random, degree, 1 + random() % 4, random() % 3 != 0, random() % 2, random() % 3 == 0);
  const int axis = random() % ParamDim;
  const Interval range = domain(nurbs, axis);
  const double u = uniform(random, range.lower, range.upper);

  const auto inserted = insert_knot(nurbs, axis, u, 1 + random() % degree);
  CHECK_NOTHROW(check(inserted, "", ""));
  CHECK(largest_difference(random, nurbs, inserted) < 1e-13);

  const auto elevated = elevate_degree(nurbs, axis, 1 + random() % 2);
  CHECK_NOTHROW(check(elevated, "", ""));
  CHECK(domain(elevated, axis).lower == range.lower);
  CHECK(domain(elevated, axis).upper == range.upper);
  CHECK(largest_difference(random, nurbs, elevated) < 1e-13);

  const auto halves = split_at(nurbs, axis, u);
  CHECK(domain(halves[0], axis).upper == u);
  CHECK(domain(halves[1], axis).lower == u);
  for (const auto& half : halves) {
    CHECK_NOTHROW(check(half, "", ""));
    CHECK(largest_difference(random, nurbs, half) < 1e-13);
  }
  CHECK(largest_difference(random, nurbs, clamped(nurbs, axis)) < 1e-13);

  const auto back = reversed(nurbs, axis);
  CHECK_NOTHROW(check(back, "", ""));
  const auto moved = with_domain(nurbs, axis, {2, 7});
  for (int k = 0; k < 5; ++k) {
    const auto v = random_parameter(random, nurbs);
    auto w = v;
    w[axis] = range.lower + range.upper - v[axis];
    CHECK((point(nurbs, v) - point(back, w)).norm() < 1e-12);
    w[axis] = 2 + 5 * (v[axis] - range.lower) / (range.upper - range.lower);
    CHECK((point(nurbs, v) - point(moved, w)).norm() < 1e-12);
  }
}

template <int ParamDim, int Dim>
void check_pieces(std::mt19937& random, int trial) {
  const int degree = 1 + trial % 5;
  const auto nurbs = random_nurbs<ParamDim, Dim>(
      random, degree, 1 + random() % 4, random() % 3 != 0, random() % 2, random() % 3 == 0);
  const auto prepared = prepare(nurbs);
  size_t n_pieces = 1;
  for (int a = 0; a < ParamDim; ++a) n_pieces *= spans(nurbs, a).size();
  CHECK(prepared.pieces.size() == n_pieces);
  for (const auto& piece : prepared.pieces)
    for (int k = 0; k < 5; ++k) {
      Param<ParamDim> s, u;
      for (int a = 0; a < ParamDim; ++a) {
        s[a] = uniform(random);
        u[a] = piece.lower[a] + s[a] * (piece.upper[a] - piece.lower[a]);
      }
      const Vec<Dim> X = point(piece, s);
      CHECK((X - point(nurbs, u)).norm() < 1e-13);
      CHECK((X.array() >= piece.box.lower.array() - 1e-14).all());
      CHECK((X.array() <= piece.box.upper.array() + 1e-14).all());
    }
}

}  // namespace

TEST_CASE("insertion, elevation, clamping, splitting and reversal keep the map: curves") {
  std::mt19937 random(41);
  for (int trial = 0; trial < 300; ++trial) check_refinement<1, 2>(random, trial);
  for (int trial = 0; trial < 50; ++trial) check_refinement<1, 3>(random, trial);
}

TEST_CASE("insertion, elevation, clamping, splitting and reversal keep the map: surfaces") {
  std::mt19937 random(42);
  for (int trial = 0; trial < 100; ++trial) check_refinement<2, 3>(random, trial);
}

TEST_CASE("Bezier pieces agree with the NURBS and lie in their boxes") {
  std::mt19937 random(43);
  for (int trial = 0; trial < 200; ++trial) check_pieces<1, 2>(random, trial);
  for (int trial = 0; trial < 60; ++trial) check_pieces<2, 3>(random, trial);
}

TEST_CASE(
    "neighbouring pieces share end points, and clamped ends are control points, bit for bit") {
  std::mt19937 random(44);
  for (int trial = 0; trial < 200; ++trial) {
    const auto curve = random_nurbs<1, 2>(random, 1 + trial % 6, 1 + random() % 5, true, true);
    const auto pieces = prepare(curve).pieces;
    CHECK(pieces.front().points.col(0) == curve.control_points.col(0));
    CHECK(pieces.back().points.rightCols<1>() == curve.control_points.rightCols<1>());
    for (size_t k = 1; k < pieces.size(); ++k) {
      CHECK(pieces[k - 1].points.rightCols<1>() == pieces[k].points.col(0));
      CHECK(pieces[k - 1].weights[curve.degree[0]] == pieces[k].weights[0]);
      CHECK(pieces[k - 1].upper == pieces[k].lower);
    }
  }
}

TEST_CASE("the corners of a prepared clamped surface are its control points bit for bit") {
  std::mt19937 random(45);
  const auto surface = random_nurbs<2, 3>(random, 3, 3, true, true);
  const auto pieces = prepare(surface).pieces;
  CHECK(pieces.front().points.col(0) == surface.control_points.col(0));
  CHECK(pieces.back().points.rightCols<1>() == surface.control_points.rightCols<1>());
}

TEST_CASE("equal coordinates stay equal bit for bit under every refinement") {
  std::mt19937 random(46);
  for (int trial = 0; trial < 100; ++trial) {
    auto edge = random_nurbs<1, 2>(random, 1 + trial % 4, 3, random() % 2, true);
    edge.control_points.row(1).setConstant(0.1);
    edge = elevate_degree(insert_knot(edge, 0, random_parameter(random, edge)[0]), 0, 2);
    for (const auto& piece : prepare(edge).pieces)
      CHECK((piece.points.row(1).array() == 0.1).all());
  }
}

TEST_CASE("elevating a circle's degree to 8 keeps it round") {
  const auto disc = elevate_degree(circle({0, 0}, 1), 0, 6);
  CHECK(disc.degree[0] == 8);
  for (int k = 0; k <= 100; ++k)
    CHECK(point(disc, Param<1>(k / 25.0)).norm() == doctest::Approx(1).epsilon(1e-14));
}
