// Pins that move and turn in a dynamic analysis.
#include <nlohmann/json.hpp>

#include "bodies.h"
#include "dims.h"
#include "errors.h"
#include "sem/base/rotation.h"
#include "sem/scene/json_text.h"
#include "sem/scene/model.h"
#include "sem/scene/read_scene.h"

using namespace sem;
using Eigen::VectorXd;

namespace {

template <int Dim>
Scene<Dim> dynamic_box(Formulation formulation, Integrator integrator, MaterialModel model) {
  auto scene = test::box_scene<Dim>(model);
  scene.method.formulation = formulation;
  if (formulation == Formulation::condensed) {
    scene.method.weights.variant = DistanceWeight::sided;
    scene.method.rays.grid = RayGrid::gauss;
    scene.method.interval.rule = IntervalRule::gauss;
  }
  scene.pins = {test::face_pin<Dim>(0)};
  scene.analysis = {AnalysisKind::dynamics, integrator, 0.02, 1};
  return scene;
}

// Leads the scene's pin through a translation and a turn by `angle` about z in half a second.
template <int Dim>
void lead(Pin<Dim>& pin, double angle) {
  pin.displacement[0] = 0.4;
  pin.displacement[Dim - 1] = -0.2;
  pin.rotation[DimTraits<Dim>::n_rotations - 1] = angle;
  pin.center = Vec<Dim>::Constant(0.3);
  pin.duration = 0.5;
}

template <int Dim>
Points<Dim> positions(const Model<Dim>& model, const VectorXd& z) {
  return evaluate(model.discretization.interior, z);
}

}  // namespace

TEST_CASE_TEMPLATE("led pins: a body without weight follows their motion rigidly, free of stress",
                   T, D2, D3) {
  constexpr int Dim = T::value;
  for (const Formulation formulation : {Formulation::projected, Formulation::condensed}) {
    auto scene = dynamic_box<Dim>(formulation, Integrator::implicit_euler, MaterialModel::neo_log);
    scene.solids[0].material.density = 1e-7;  // centrifugal strains of 1e-10
    lead<Dim>(scene.pins[0], 1.1);
    const auto model = build_model(scene, "");
    const auto& pin = scene.pins[0];
    const Points<Dim>& X = model->discretization.quadrature.position;
    double farthest = 0, largest = 0;
    State state = model->initial;
    const auto report =
        march(model->system, scene.analysis, state, [&](const State& now, const StepInfo&) {
          const double r = std::min(1.0, now.time / pin.duration), s = r * r * (3 - 2 * r);
          const Points<Dim> turned = rotation<Dim>(s * pin.rotation) * (X.colwise() - pin.center);
          const Points<Dim> expected = turned.colwise() + (pin.center + s * pin.displacement);
          farthest =
              std::max(farthest, (positions(*model, now.z) - expected).cwiseAbs().maxCoeff());
          largest = std::max(largest, model->system.potential->energy(now.z));
        });
    REQUIRE(report.status == Status::converged);
    CHECK(farthest < 1e-8);
    CHECK(largest < 1e-14 * scene.solids[0].material.youngs_modulus);
  }
}

TEST_CASE_TEMPLATE("led pins: their work over a midpoint step is the energy it adds", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const Formulation formulation : {Formulation::projected, Formulation::condensed}) {
    auto scene =
        dynamic_box<Dim>(formulation, Integrator::implicit_midpoint, MaterialModel::linear);
    lead<Dim>(scene.pins[0], 0);
    scene.pins[0].duration = 0.33;  // not a multiple of the step
    scene.gravity[1] = -3;
    const auto model = build_model(scene, "");
    const System& system = model->system;
    State before = model->initial, state = before;
    double work = 0, most = 0;
    const double start = energies(system, before).total;
    const auto report =
        march(system, scene.analysis, state, [&](const State& now, const StepInfo& info) {
          const VectorXd force = reaction(system, (before.z + now.z) / 2, info.acceleration);
          work += force.dot(now.z - before.z);
          most = std::max(most, std::abs(work));
          const double added = energies(system, now).total - start;
          CHECK(std::abs(added - work) < 1e-9 * most);
          before = now;
        });
    REQUIRE(report.status == Status::converged);
    CHECK(report.n_retried == 0);
    CHECK(most > 1);
  }
}

TEST_CASE_TEMPLATE("led pins: the body comes to rest where the static analysis has it", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const Formulation formulation : {Formulation::projected, Formulation::condensed})
    for (const Integrator integrator :
         {Integrator::linearly_implicit_euler, Integrator::implicit_euler}) {
      auto scene = dynamic_box<Dim>(formulation, integrator, MaterialModel::neo_log);
      scene.gravity[1] = -5;
      lead<Dim>(scene.pins[0], 0.7);
      scene.analysis.time_step = 0.1;  // both damp
      scene.analysis.duration = 12;
      scene.pins[0].duration = 2;
      const auto model = build_model(scene, "");
      State moved = model->initial;
      REQUIRE(march(model->system, scene.analysis, moved, [](const State&, const StepInfo&) {
              }).status == Status::converged);
      State led = model->initial;
      scene.analysis.load_steps = 4;
      REQUIRE(equilibrium(model->system, scene.analysis, model->target, led, model->path).status ==
              Status::converged);
      CHECK((positions(*model, moved.z) - positions(*model, led.z)).cwiseAbs().maxCoeff() < 1e-3);
      const VectorXd force = reaction(model->system, moved.z);
      Vec<Dim> sum = Vec<Dim>::Zero();
      for (const int entry : model->held[0].entries) sum[entry % Dim] += force[entry];
      CHECK(sum[1] == doctest::Approx(5 * model->total_mass())
                          .epsilon(1e-3));  // also with the columns of a turn
    }
}

TEST_CASE("led pins: a scene says how long they take") {
  auto scene =
      dynamic_box<2>(Formulation::projected, Integrator::implicit_euler, MaterialModel::neo_log);
  lead<2>(scene.pins[0], 0.4);
  nlohmann::ordered_json json;
  scene_to_json(scene, json);
  CHECK(read_scene<2>(json.dump(), "scene.json", {}).pins[0].duration == 0.5);
  const auto rejects = [&](const char* type, double duration, const char* field) {
    auto changed = json;
    changed["analysis"] = {{"type", type}};
    if (duration > 0)
      changed["pins"][0]["duration"] = duration;
    else
      changed["pins"][0].erase("duration");
    test::check_names(test::error_of([&] { read_scene<2>(changed.dump(), "scene.json", {}); }),
                      "scene.json", {field});
  };
  rejects("dynamic", 0, "pins[0].duration");
  rejects("static", 0.5, "pins[0].duration");
  rejects("modes", 0, "pins[0].rotation");
}
