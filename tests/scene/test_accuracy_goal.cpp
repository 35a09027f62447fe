// "accuracy": a scene refined until the estimated error of its probes is below a goal.
#include <nlohmann/json.hpp>

#include "bodies.h"
#include "dims.h"
#include "errors.h"
#include "sem/base/error.h"
#include "sem/scene/accuracy_goal.h"
#include "sem/scene/run.h"

using namespace sem;

namespace {

// A 4 x 1 beam of one cubic part a side, clamped on the left, under its weight: E_log, density 10.
Scene<2> coarse_beam() {
  Scene<2> scene;
  scene.name = "beam";
  SceneSolid<2> solid{"beam", {MaterialModel::neo_log, 1e5, 0.3, 10}, {}};
  const char* names[] = {"bottom", "right", "top", "left"};
  for (auto shape : test::polygon({{0, 0}, {4, 0}, {4, 1}, {0, 1}}))
    solid.parts.push_back({names[solid.parts.size()], elevate_degree(shape, 0, 2), {}});
  scene.solids.push_back(solid);
  scene.method.formulation = Formulation::condensed;
  scene.method.weights.variant = DistanceWeight::sided;
  scene.method.weights.cutoff = 0.75;
  scene.method.interior_rule.rule = InteriorRule::resolved;
  scene.method.projection.degree = 2;
  scene.gravity = {0, -10};
  Pin<2> pin;
  pin.where.part = "left";
  pin.axes.fill(true);
  scene.pins.push_back(pin);
  scene.probes.push_back({"tip", ProbeKind::displacement, {4, 0.5}});
  scene.analysis.kind = AnalysisKind::statics;
  return scene;
}

constexpr double truth_x = -0.01760132, truth_y = -0.3684452;

double true_error(const ErrorEstimate& estimate) {
  return std::hypot(estimate.value[0] - truth_x, estimate.value[1] - truth_y) / std::hypot(truth_x, truth_y);
}

}  // namespace

TEST_CASE("a coarse beam is refined until its goal is met, not before; the expected error is 0.2 to 5 times the true one") {
  Scene<2> scene = coarse_beam();
  scene.method.projection.degree = 1;
  scene.accuracy = 0.01;
  const auto refined = meet_accuracy(scene, "");
  CHECK(refined.reached);
  CHECK(refined.rounds.size() >= 3);
  for (const Round& round : refined.rounds) CHECK((round.expected <= scene.accuracy) == (&round == &refined.rounds.back()));
  const double error = true_error(refined.estimate);
  CHECK(error <= scene.accuracy);
  CHECK(refined.expected() > 0.2 * error);
  CHECK(refined.expected() < 5 * error);
}

TEST_CASE("a goal out of reach within the limit of unknowns says so and keeps the best scene") {
  Scene<2> scene = coarse_beam();
  scene.accuracy = 1e-6;
  const auto refined = meet_accuracy(scene, "", 150);
  CHECK(!refined.reached);
  CHECK(refined.expected() > 1e-6);
  CHECK(refined.expected() < refined.rounds.front().expected);
}

TEST_CASE("an estimate without one of the refinements is not complete") {
  ErrorEstimate estimate;
  estimate.variations.resize(2);
  estimate.variations[0].setting = "twice the clamps' penalty";
  estimate.variations[0].failure = "singular";
  estimate.variations[1].setting = "every part halved";
  estimate.variations[1].refinement = Refinement::parts;
  CHECK(estimate.complete());
  estimate.variations[1].failure = "singular";
  CHECK_FALSE(estimate.complete());
}

TEST_CASE("the halves of a part answer to its name") {
  Scene<2> scene = coarse_beam();
  REQUIRE(refine(scene, Refinement::parts));
  REQUIRE(refine(scene, Refinement::parts));
  CHECK(scene.solids[0].parts[0].name == "bottom~1~1");
  const auto model = build_model(scene, "");
  CHECK(model->held[0].controls.size() == 4 * 4 + 2);  // with the neighbours' two at the corners
}

TEST_CASE("a run reports its goal and what it chose") {
  Scene<2> scene = coarse_beam();
  scene.accuracy = 0.05;
  const RunResult result = run_scene<2>(scene, {}, {});
  CHECK(result.ok);
  CHECK(result.message.find("accuracy 0.05 met") != std::string::npos);
  const auto summary = nlohmann::json::parse(result.summary_json);
  CHECK(summary["accuracy"]["goal"]["met"] == true);
  CHECK(summary["accuracy"]["goal"]["rounds"].size() > 1);
  CHECK(summary["settings"]["solids"][0]["parts"].size() == summary["sizes"]["parts"]);
}

TEST_CASE("a goal needs the formulation that converges, and a probe") {
  Scene<2> scene = coarse_beam();
  scene.accuracy = 0.01;
  scene.method.formulation = Formulation::projected;
  CHECK_THROWS_AS(meet_accuracy(scene, ""), InputError);
  scene = coarse_beam();
  scene.accuracy = 0.01;
  scene.probes.clear();
  CHECK_THROWS_AS(meet_accuracy(scene, ""), InputError);
}

TEST_CASE("a goal does not begin what would end after accuracy_seconds, and says so") {
  Scene<2> scene = coarse_beam();
  scene.accuracy = 1e-6;
  scene.accuracy_seconds = 1e-3;
  const auto refined = meet_accuracy(scene, "");
  CHECK(!refined.reached);
  CHECK(refined.rounds.size() == 1);
  CHECK(refined.limit == "accuracy_seconds");
}

TEST_CASE("frequencies of rigid motions, which are rounding, have no error of their own size") {
  Scene<2> scene = coarse_beam();
  scene.pins.clear();
  scene.analysis.kind = AnalysisKind::modes;
  scene.analysis.n_modes = 5;
  const ErrorEstimate estimate = estimate_error(scene, "");
  REQUIRE(estimate.value.size() == 5);
  CHECK(std::abs(estimate.value[2]) < 1e-3 * estimate.value[3]);
  CHECK(relative_error(scene, estimate) > 1e-6);
  CHECK(relative_error(scene, estimate) < 0.3);
}

// Free fall in n steps of the linearly implicit Euler method is g dt^2 n (n + 1) / 2, off by g t dt / 2.
TEST_CASE("the error of a method of first order in time is twice what half the step changes") {
  Scene<2> scene = coarse_beam();
  scene.pins.clear();
  scene.analysis.kind = AnalysisKind::dynamics;
  scene.analysis.time_step = 0.01;
  scene.analysis.duration = 0.1;
  const ErrorEstimate estimate = estimate_error(scene, "");
  CHECK(estimate.variations.back().setting == "half the time step");
  CHECK(2 * estimate.variations.back().change[1] == doctest::Approx(10 * 0.1 * 0.01 / 2).epsilon(1e-6));
  CHECK(estimate.estimate[1] == doctest::Approx(10 * 0.1 * 0.01 / 2).epsilon(1e-3));
}
