// The manufactured solution, and what the condensed formulation makes of it.
#include <doctest/doctest.h>

#include "src2d/baseline/manufactured.h"
#include "src2d/shapes/shapes.h"

using namespace sem;
using namespace sem::baseline;

TEST_CASE("the body force balances the stress: finite differences") {
  const Manufactured exact;
  const double h = 1e-4;
  for (const Vec<2>& X : {Vec<2>(0.1, 0.7), Vec<2>(0.9, -0.4)}) {
    Vec<2> divergence = Vec<2>::Zero();
    for (int b = 0; b < 2; ++b) {
      const Vec<2> step = h * Vec<2>::Unit(b);
      divergence += (exact.stress(X + step) - exact.stress(X - step)).col(b) / (2 * h);
    }
    CHECK((divergence + exact.body_force(X)).norm() < 1e-6 * exact.body_force(X).norm());
  }
}

TEST_CASE("sided weights: a degree more has less than half of the energy error, on a convex and a non-convex body") {
  shapes2d::Polygon L;
  L.vertices.resize(2, 6);
  L.vertices << 0, 1, 1, 0.5, 0.5, 0,  //
      0, 0, 0.5, 0.5, 1, 1;
  L.n_parts = {2, 1, 1, 1, 1, 2};
  L.degree = 3;
  MethodOptions method;
  method.formulation = Formulation::condensed;
  method.weights.variant = DistanceWeight::sided;
  method.weights.cutoff = 0.75;
  method.interior_rule.rule = InteriorRule::resolved;
  method.interior_rule.weight_tolerance = 1e-4;
  for (const auto& parts : {shapes2d::make_parts(shapes2d::Rectangle{{0, 0}, {1, 1}, {1, 1, 1, 1}, 3}),
                            shapes2d::make_parts(L)}) {
    double before = 1;
    for (const int degree : {1, 2, 3}) {
      method.projection.degree = degree;
      const double error = solve_manufactured(parts, method).energy;
      CAPTURE(degree);
      CHECK(error < before / (degree == 1 ? 2 : 2.2));
      before = error;
    }
    CHECK(before < 6e-3);
  }
}

TEST_CASE("published weights jump inside: the energy error is larger than the solution itself") {
  MethodOptions method;
  method.formulation = Formulation::condensed;
  method.weights.cutoff = 0.75;
  method.projection.degree = 2;
  method.interior_rule.rule = InteriorRule::resolved;
  method.interior_rule.weight_tolerance = 1e-2;
  const auto square = shapes2d::make_parts(shapes2d::Rectangle{{0, 0}, {1, 1}, {2, 2, 2, 2}, 3});
  CHECK(solve_manufactured(square, method).energy > 1);
}
