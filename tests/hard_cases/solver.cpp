// Solvers made to fail: they have to say so, and to keep the last good state.
#include <cmath>
#include <limits>

#include "sem/scene/analysis.h"
#include "tests/hard_cases/body_checks.h"

namespace sem::stability {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Scene<2> hung_block(Formulation formulation) {
  Scene<2> scene = scene_of(body_of<2>(rectangle({0, 0}, {1, 1})), formulation);
  scene.solids[0].material.model = MaterialModel::neo_log;
  scene.pins = {pin_on<2>("part.4")};
  scene.gravity[1] = -10;
  return scene;
}

/// V = |z|^2 / 2 - z_0 about z = 0, with errors to order.
class Faulty : public Potential {
 public:
  enum class Fault { none, gradient_reversed, energy_nan, gradient_nan, hessian_nan, barrier_everywhere };
  explicit Faulty(Fault fault) : fault_(fault) {}
  int size() const override { return 2; }
  bool quadratic() const override { return false; }
  double energy(const VectorXd& z) override {
    if (fault_ == Fault::energy_nan) return std::nan("");
    if (fault_ == Fault::barrier_everywhere && z.norm() > 1e-30) return std::numeric_limits<double>::infinity();
    return z.squaredNorm() / 2 - z[0];
  }
  void gradient(const VectorXd& z, VectorXd& g) override {
    g = z - VectorXd::Unit(2, 0);
    if (fault_ == Fault::gradient_reversed) g = -g;
    if (fault_ == Fault::gradient_nan) g[1] = std::nan("");
  }
  void hessian(const VectorXd&, bool, SymmetricMatrix& H) override {
    H.set(MatrixXd::Identity(2, 2));
    if (fault_ == Fault::hessian_nan) H(1, 0) = std::nan("");
  }

 private:
  Fault fault_;
};

struct FaultySystem {
  Faulty potential;
  System system;
  State state;
  explicit FaultySystem(Faulty::Fault fault)
      : potential(fault), system{&potential, MatrixXd::Identity(2, 2), VectorXd::Zero(2), {0, 1}, VectorXd::Zero(2)},
        state{VectorXd::Zero(2), VectorXd::Ones(2)} {}
};

/// Refused with the status expected and the state where it was; else failed.
Result expect(Status status, Status expected, const State& state, const State& before) {
  if (status != expected)
    return {Outcome::failed, std::string("status ") + name(status) + ", not " + name(expected), 0};
  if (state.z != before.z || state.v != before.v || state.step != before.step)
    return {Outcome::failed, "the state was changed by what failed", 0};
  throw Refusal{describe(status)};
}

Result statics_of(Faulty::Fault fault, Status expected) {
  FaultySystem faulty(fault);
  const State before = faulty.state;
  const StaticReport report = solve_static(faulty.system, faulty.state);
  return expect(report.status, expected, faulty.state, before);
}

Result step_of(Faulty::Fault fault, Integrator integrator, Status expected) {
  FaultySystem faulty(fault);
  const State before = faulty.state;
  TimeStepper stepper(faulty.system, 0.1, integrator);
  return expect(stepper.step(faulty.state).status, expected, faulty.state, before);
}

Result too_few_iterations(Formulation formulation) {
  Scene<2> scene = hung_block(formulation);
  scene.analysis.max_iterations = 1;
  const auto model = build_model(scene, "");
  StaticOptions options;
  options.max_iterations = 1;
  options.max_halvings = 3;
  State state = model->initial;
  return expect(solve_static(model->system, state, options).status, Status::max_iterations, state, model->initial);
}

/// Statics without pins, or with a solid that no pin holds.
Result loose(Formulation formulation, bool second_solid) {
  Scene<2> scene = hung_block(formulation);
  if (second_solid) {
    Scene<2> other = scene_of(body_of<2>(rectangle({3, 0}, {4, 1})), formulation);
    for (auto& part : other.solids[0].parts) part.name = "loose" + part.name;
    scene.solids.push_back(other.solids[0]);
  } else {
    scene.pins.clear();
  }
  const auto model = build_model(scene, "");
  State state = model->initial;
  return expect(equilibrium(model->system, scene.analysis, model->target, state).status, Status::singular, state, model->initial);
}

/// No mass and no pin: dt^2 K alone leaves rigid motions open.
Result massless(Formulation formulation) {
  Scene<2> scene = hung_block(formulation);
  scene.solids[0].material.density = 0;
  scene.pins.clear();
  const auto model = build_model(scene, "");
  State state = model->initial;
  TimeStepper stepper(model->system, 0.01, Integrator::linearly_implicit_euler);
  return expect(stepper.step(state).status, Status::singular, state, model->initial);
}

/// A tolerance below rounding: the answer is that of an ordinary one.
Result tolerance_below_rounding(Formulation formulation) {
  Scene<2> scene = hung_block(formulation);
  const auto model = build_model(scene, "");
  State ordinary = model->initial, state = model->initial;
  require(equilibrium(model->system, scene.analysis, model->target, ordinary).status, "statics");
  scene.analysis.tolerance = 1e-30;
  require(equilibrium(model->system, scene.analysis, model->target, state).status, "statics, tolerance 1e-30");
  Checks checks;
  checks.add("difference", (state.z - ordinary.z).norm() / (ordinary.z - model->system.rest).norm(), 1e-6);
  return checks.result();
}

}  // namespace

std::vector<Case> solver_cases() {
  using Fault = Faulty::Fault;
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const std::string& variant, Rule rule, std::function<Result()> run) {
    cases.push_back({"solver", name, variant, rule, true, std::move(run)});
  };
  for (const Formulation f : both_formulations) {
    const std::string in_2d = variant<2>(f);
    add("one iteration allowed", in_2d, Rule::may_refuse, [=] { return too_few_iterations(f); });
    add("no pins", in_2d, Rule::may_refuse, [=] { return loose(f, false); });
    add("a loose solid", in_2d, Rule::may_refuse, [=] { return loose(f, true); });
    add("neither mass nor pins", in_2d, Rule::may_refuse, [=] { return massless(f); });
    add("tolerance below rounding", in_2d, Rule::must_solve, [=] { return tolerance_below_rounding(f); });
  }
  add("gradient points uphill", "", Rule::may_refuse, [] { return statics_of(Fault::gradient_reversed, Status::line_search_failed); });
  add("barrier on all sides", "", Rule::may_refuse, [] { return statics_of(Fault::barrier_everywhere, Status::line_search_failed); });
  add("energy not a number", "", Rule::may_refuse, [] { return statics_of(Fault::energy_nan, Status::not_finite); });
  add("gradient not a number", "", Rule::may_refuse, [] { return statics_of(Fault::gradient_nan, Status::not_finite); });
  add("Hessian not a number", "", Rule::may_refuse, [] { return statics_of(Fault::hessian_nan, Status::not_finite); });
  add("a step into a barrier", "", Rule::may_refuse, [] { return step_of(Fault::barrier_everywhere, Integrator::linearly_implicit_euler, Status::not_finite); });
  add("an implicit step into a barrier", "", Rule::may_refuse, [] { return step_of(Fault::barrier_everywhere, Integrator::implicit_euler, Status::line_search_failed); });
  return cases;
}

}  // namespace sem::stability
