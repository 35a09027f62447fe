// The manufactured solution, and what the condensed formulation makes of it.
#include <doctest/doctest.h>

#include <cmath>

#include "src2d/baseline/manufactured.h"

using namespace sem;
using namespace sem::baseline;

TEST_CASE("sided weights: a degree more has less than half of the energy error, on a convex and a non-convex body") {
  MethodOptions method;
  method.formulation = Formulation::condensed;
  method.weights.variant = DistanceWeight::sided;
  method.weights.cutoff = 0.75;
  method.interior_rule.rule = InteriorRule::resolved;
  method.interior_rule.weight_tolerance = 1e-4;
  for (const bool convex : {true, false}) {
    const auto parts = manufactured_body(convex, 1);
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
  CHECK(solve_manufactured(manufactured_body(true, 2), method).energy > 1);
}

TEST_CASE("loaded by the exact stress the answer is the nearest; body force and traction lead there unless weights jump") {
  const Manufactured<2> exact;
  for (const auto variant : {DistanceWeight::sided, DistanceWeight::published}) {
    Scene<2> scene;
    scene.solids.push_back({"body", exact.material, manufactured_body(true, 1)});
    scene.method.formulation = Formulation::condensed;
    scene.method.weights = {.variant = variant, .cutoff = 0.75};
    scene.method.projection.degree = 2;
    scene.method.interior_rule.rule = InteriorRule::resolved;
    const auto model = build_model(scene, "");
    const auto& body = model->discretization;
    const auto solve = [&](const Eigen::VectorXd& f) { return solve_manufactured(body, *model->energy, f, exact); };
    const auto nearest = solve(manufactured_stress(body, exact)), answer = solve(manufactured_load(body, exact));
    CAPTURE(int(variant));
    CHECK(nearest.energy < 0.1);
    CHECK(nearest.energy <= answer.energy);
    // Pythagoras: |answer - exact|^2 = |answer - nearest|^2 + |nearest - exact|^2.
    const auto halfway = [&](double t) {
      return solve((1 - t) * manufactured_stress(body, exact) + t * manufactured_load(body, exact)).energy;
    };
    const double gap = answer.energy * answer.energy - nearest.energy * nearest.energy;
    CHECK(std::pow(halfway(0.5), 2) == doctest::Approx(nearest.energy * nearest.energy + gap / 4).epsilon(1e-6));
    if (variant == DistanceWeight::sided)
      CHECK(answer.energy < 1.01 * nearest.energy);
    else
      CHECK(answer.energy > 10 * nearest.energy);
  }
}
