// What a scene does not contain costs nothing.
#include <algorithm>

#include "bodies.h"
#include "dims.h"
#include "sem/scene/estimate.h"
#include "sem/scene/monitor.h"
#include "solve/allocations.h"

using namespace sem;

TEST_CASE_TEMPLATE("steps of a linear body allocate nothing", T, D2, D3) {
  if (!sem_test::can_count_allocations()) return;
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>(MaterialModel::linear);
  scene.gravity[1] = -10;
  scene.pins.push_back(test::face_pin<Dim>(0));
  const auto model = build_model(scene, "");
  for (const auto integrator :
       {Integrator::linearly_implicit_euler, Integrator::implicit_midpoint}) {
    TimeStepper stepper(model->system, 0.01, integrator);
    State state = model->initial;
    CHECK(stepper.step(state).status == Status::converged);  // factorises
    const long before = sem_test::n_allocations();
    for (int i = 0; i < 20; ++i) stepper.step(state);
    CHECK(sem_test::n_allocations() == before);
    CHECK(stepper.counters().factorizations.n == 1);
    CHECK(stepper.counters().hessians.n == 1);
  }
}

TEST_CASE_TEMPLATE("steps of a nonlinear body allocate nothing", T, D2, D3) {
  if (!sem_test::can_count_allocations()) return;
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>(MaterialModel::neo_log);
  scene.gravity[1] = -10;
  scene.pins.push_back(test::face_pin<Dim>(0));
  const auto model = build_model(scene, "");
  TimeStepper stepper(model->system, 0.01, Integrator::linearly_implicit_euler);
  State state = model->initial;
  CHECK(stepper.step(state).status == Status::converged);
  const long before = sem_test::n_allocations();
  for (int i = 0; i < 20; ++i) stepper.step(state);
  CHECK(sem_test::n_allocations() == before);
  CHECK(stepper.counters().factorizations.n == 21);
  CHECK(stepper.counters().hessians.n == 21);
}

TEST_CASE_TEMPLATE("without probes none are evaluated and no error is estimated", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  scene.output.error_estimate = true;
  const auto model = build_model(scene, "");
  const Monitor<Dim> monitor(scene, *model);
  CHECK(monitor.probe_columns().empty());
  const Eigen::VectorXd none;
  const long before = sem_test::n_allocations();
  CHECK(monitor.probes(model->initial, none).empty());
  if (sem_test::can_count_allocations()) CHECK(sem_test::n_allocations() == before);
  const ErrorEstimate estimate = estimate_error(scene, "");
  CHECK(estimate.columns.empty());
  CHECK(estimate.variations.empty());
}

TEST_CASE_TEMPLATE("stages and forces that a scene does not ask for are not there", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  const auto has_stage = [](const Model<Dim>& model, const std::string& name) {
    return std::any_of(model.cost.begin(), model.cost.end(),
                       [&](const StageCost& stage) { return stage.stage == name; });
  };
  const auto plain = build_model(scene, "");
  CHECK(!has_stage(*plain, "pruning"));
  CHECK(plain->system.load.isZero(0));
  CHECK(plain->initial.v.isZero(0));
  CHECK(plain->held.empty());
  scene.method.kept_columns = 3;
  CHECK(has_stage(*build_model(scene, ""), "pruning"));
}
