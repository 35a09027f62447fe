// Hard materials, loads, steps and starts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include <Eigen/LU>

#include "sem/mechanics/loads.h"
#include "sem/scene/accuracy.h"
#include "sem/scene/analysis.h"
#include "sem/solve/modes.h"
#include "tests/hard_cases/body_checks.h"

namespace sem::stability {
namespace {

using Eigen::VectorXd;

constexpr Integrator all_integrators[] = {Integrator::linearly_implicit_euler, Integrator::implicit_euler,
                                          Integrator::implicit_midpoint};

const char* short_name(Integrator integrator) {
  return integrator == Integrator::linearly_implicit_euler ? "lin. Euler"
         : integrator == Integrator::implicit_euler        ? "Euler"
                                                           : "midpoint";
}

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// Cases of one function of the formulation, in 2D, and in 3D where it is a template of both.
struct Group {
  std::vector<Case> cases;
  void add(const std::string& name, const std::string& variant, Rule rule, bool fast, std::function<Result()> run) {
    cases.push_back({"mechanics", name, variant, rule, fast, std::move(run)});
  }
};

/// Gauss points on rays: exact for polynomials on a block, few enough for many steps.
template <int Dim>
void use_few_points(Scene<Dim>& scene) {
  scene.method.interior_rule.rule = InteriorRule::rays;
  scene.method.rays = {.axis = 0, .n_rays = 5, .grid = RayGrid::gauss};
  scene.method.interval = {IntervalRule::gauss, 5};
}

/// The unit square (cube) with parts bottom, right, top, left = "part.1" to "part.4" (and the ends).
template <int Dim>
Scene<Dim> block(Formulation formulation, MaterialModel model, int n_parts = 1) {
  Scene<Dim> scene = scene_of(body_of<Dim>(rectangle({0, 0}, {1, 1}, n_parts)), formulation);
  scene.solids[0].material.model = model;
  if (Dim == 3 || formulation == Formulation::projected) use_few_points(scene);
  return scene;
}

template <int Dim>
Points<Dim> positions(const Model<Dim>& model, const State& state) {
  return evaluate(model.discretization.interior, state.z);
}

template <int Dim>
Vec<Dim> centroid(const Model<Dim>& model, const State& state) {
  return positions(model, state) * model.point_mass / model.total_mass();
}

/// v = P x M u summed over the points: total linear and angular momentum (about the coordinate origin).
template <int Dim>
struct Momentum {
  Vec<Dim> linear;
  Eigen::Matrix<double, DimTraits<Dim>::n_rotations, 1> angular;
};
template <int Dim>
Momentum<Dim> momentum(const Model<Dim>& model, const State& state) {
  Momentum<Dim> sum;
  sum.linear.setZero();
  sum.angular.setZero();
  const Points<Dim> x = positions(model, state);
  const Points<Dim> v = evaluate(model.discretization.interior, state.v);
  for (int k = 0; k < x.cols(); ++k) {
    const Vec<Dim> p = model.point_mass[k] * v.col(k);
    sum.linear += p;
    sum.angular += DimTraits<Dim>::cross(Vec<Dim>(x.col(k)), p);
  }
  return sum;
}

State solved(const System& system, const Analysis& analysis, const VectorXd& target, State state) {
  require(equilibrium(system, analysis, target, state).status, "statics");
  return state;
}

State marched(const System& system, const Analysis& analysis, State state, const StepCallback& on_step = {}) {
  const auto nothing = [](const State&, const StepInfo&) {};
  require(march(system, analysis, state, on_step ? on_step : nothing).status, "dynamics");
  return state;
}

// ---- nearly incompressible, stiff beside soft ----

template <int Dim>
Result body_of_material(Formulation formulation, double nu) {
  const Body<Dim> body = body_of<Dim>(rectangle({0, 0}, {1, 1}, 2));
  Scene<Dim> scene = block<Dim>(formulation, MaterialModel::stvk, 2);
  scene.solids[0].material.poisson_ratio = nu;
  Bounds bounds;
  bounds.energy = 1e-7;
  bounds.balance = 1e-5;
  Checks checks;
  check_model(scene, *build_model(scene, ""), body, bounds, checks);
  check_fall(scene, body, bounds, checks);
  check_hanging(scene, body, bounds, checks);
  return checks.result();
}

/// Pure bending of a plane strain block in linear elasticity: with k the curvature, nu' = nu / (1 - nu),
///   u_x = k x (y - 1/2), u_y = -k/2 (x^2 + nu' (y - 1/2)^2) + const; sigma_xx = E / (1 - nu^2) k (y - 1/2).
Result bending(double nu) {
  Scene<2> scene = block<2>(Formulation::condensed, MaterialModel::linear, 2);
  Material& material = scene.solids[0].material;
  material.poisson_ratio = nu;
  Pin<2> left = pin_on<2>("part.7"), more = pin_on<2>("part.8"), corner = pin_on<2>("part.1");
  left.axes = more.axes = {true, false};
  corner.axes = {false, true};
  corner.where.control_points = {0};
  scene.pins = {left, more, corner};
  const auto model = build_model(scene, "");
  const double k = 1e-3, stress = material.youngs_modulus / (1 - nu * nu) * k;
  add_traction<2>(model->discretization, [&](int, const Vec<2>& X, const Vec<2>& normal) -> Vec<2> {
    return normal[0] > 0.5 ? Vec<2>(stress * (X[1] - 0.5), 0) : Vec<2>(0, 0);
  }, model->system.load);
  const State state = solved(model->system, scene.analysis, model->target, model->initial);
  const Points<2>& X = model->discretization.quadrature.position;
  const Points<2> u = positions(*model, state) - X;
  const double ratio = nu / (1 - nu);
  double error = 0;
  for (int j = 0; j < X.cols(); ++j) {
    const double x = X(0, j), y = X(1, j) - 0.5;
    const Vec<2> exact(k * x * y, -k / 2 * (x * x + ratio * (y * y - 0.25)));
    error = std::max(error, (u.col(j) - exact).norm());
  }
  Checks checks;
  checks.add("displacement of pure bending, error", error / (k / 2), 1e-3);
  return checks.result();
}

/// Cook's membrane with cubic parts, four a side, against converged graded finite elements: u_y of (48, 60).
/// 0.49999 differs from 0.4999 by less than the bound.
Result cook(double nu) {
  const Vec<2> corners[] = {{0, 0}, {48, 44}, {48, 60}, {0, 44}};
  std::vector<Vec<2>> points;
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < 4; ++k) points.push_back(corners[side] + k / 4.0 * (corners[(side + 1) % 4] - corners[side]));
  Body<2> body = elevated(body_of<2>({{{polygon(points), {}}}, 1440}), 2);
  body.size = 22;  // covers the solid
  Scene<2> scene = scene_of(body, Formulation::condensed);
  scene.method.projection.degree = 3;
  scene.solids[0].material = {MaterialModel::neo_log, 240.565, nu, 0};
  for (const char* part : {"part.13", "part.14", "part.15", "part.16"}) scene.pins.push_back(pin_on<2>(part));
  for (const char* part : {"part.5", "part.6", "part.7", "part.8"}) {
    BoundaryLoad<2> load;
    load.where.part = part;
    load.traction = {0, 20.0 / 16};
    scene.boundary_loads.push_back(load);
  }
  scene.analysis.load_steps = 4;
  const auto model = build_model(scene, "");
  const State state = solved(model->system, scene.analysis, model->target, model->initial);
  const Points<2> corner = Vec<2>(48, 60);
  const Points<2> x = evaluate(map_at(model->discretization, corner, false), state.z);
  Checks checks;
  checks.add("Cook's membrane, error of the corner", (x(1, 0) - 60) / 1.56823 - 1, 0.03);
  return checks.result();
}

/// A block whose right part is `ratio` times as stiff as the rest: two compliances side by side or in a row,
/// u = (a + b r) / (1 + c r). From ratios 1e2, 1e3 and 1e4 the law foretells the displacement.
template <int Dim>
Result stiffness_ratio(Formulation formulation, double ratio) {
  const Body<Dim> body = body_of<Dim>(rectangle({0, 0}, {1, 1}));
  const auto lowered = [&](double r, Checks& checks) {
    Scene<Dim> scene = scene_of(body, formulation);
    scene.solids[0].parts[1].material = scene.solids[0].material;
    scene.solids[0].parts[1].material->youngs_modulus *= r;
    Bounds bounds;
    bounds.balance = std::max(bounds.balance, 1e-13 * r);  // forces are sums of terms r times their size
    return check_hanging(scene, body, bounds, checks);
  };
  Checks checks, ordinary;
  Eigen::Matrix3d A;
  Eigen::Vector3d u;
  for (int k = 0; k < 3; ++k) {
    const double r = std::pow(10, k + 2);
    u[k] = lowered(r, ordinary);
    A.row(k) << 1, r, -r * u[k];
  }
  const Eigen::Vector3d law = A.inverse() * u;
  const double expected = (law[0] + law[1] * ratio) / (1 + law[2] * ratio);
  checks.add("displacement against its law", (lowered(ratio, checks) - expected) / u[0], 1e-3);
  return checks.result();
}

// ---- large deformations ----

/// A block confined at the sides is compressed to a share of its height: F = diag(1, share) exactly.
template <int Dim>
Result confined_compression(Formulation formulation, MaterialModel material, double share) {
  Scene<Dim> scene = block<Dim>(formulation, material, 2);
  const int n = int(scene.solids[0].parts.size());
  for (int i = 1; i <= n; ++i) {
    Pin<Dim> pin = pin_on<Dim>("part." + std::to_string(i));
    const bool top = i == 5 || i == 6, bottom = i <= 2, end = i > 8;
    pin.axes.fill(false);
    for (int a = 0; a < Dim; ++a) pin.axes[a] = (top || bottom) || (end ? a == Dim - 1 : a == 0);
    if (top) pin.displacement[1] = share - 1;
    scene.pins.push_back(pin);
  }
  scene.analysis.load_steps = 20;
  const auto model = build_model(scene, "");
  const State state = solved(model->system, scene.analysis, model->target, model->initial);
  // The neo-Hookean ones follow stable equilibria in which, without grad w in F, the free joints of the sides pass
  // through the bottom: the energy does not resist, but the program says so.
  if (folded_share(*model, state.z) > 0) throw Refusal{"the map is folded"};
  Points<Dim> x = model->discretization.quadrature.position;
  x.row(1) *= share;
  Checks checks;
  // The paper's map keeps no affine equilibrium (its patch test fails): a tenth of the size.
  const double bound = formulation == Formulation::condensed ? 1e-6 : 0.1;
  checks.add("position error", (positions(*model, state) - x).cwiseAbs().maxCoeff(), bound);
  Mat<Dim> F = Mat<Dim>::Identity();
  F(1, 1) = share;
  const double stress = first_piola<Dim>(scene.solids[0].material, F)(1, 1);
  const VectorXd force = reaction(model->system, state.z);
  double top = 0;
  for (const int pin : {4, 5})
    for (const int entry : model->held[size_t(pin)].entries)
      if (entry % Dim == 1) top += force[entry];
  if (formulation == Formulation::condensed) checks.add("force on the top, error", top / stress - 1, 1e-5);
  return checks.result();
}

/// Rotates what the pin on the left holds through 720 degrees in steps: the body follows rigidly.
template <int Dim>
Result turned_by_pins() {
  Scene<Dim> scene = block<Dim>(Formulation::projected, MaterialModel::neo_log);
  scene.pins = {pin_on<Dim>("part.4")};
  const auto model = build_model(scene, "");
  const Points<Dim> rest = rest_controls(model->discretization.boundary);
  State state = model->initial;
  constexpr int n = 96;
  for (int k = 1; k <= n; ++k) {
    const Points<Dim> turned = rotation<Dim>(4 * M_PI * k / n) * rest;
    state = solved(model->system, scene.analysis, Eigen::Map<const VectorXd>(turned.data(), turned.size()), state);
  }
  Checks checks;
  checks.add("position after two turns", (state.z - model->system.rest).cwiseAbs().maxCoeff(), 1e-8);
  return checks.result();
}

/// A stiff block spins freely through 720 degrees; a midpoint step turns a rigid body by 2 atan(omega dt / 2).
/// Its rest shape grows by the centrifugal strain, rho omega^2 / E = 1.6e-4, and a midpoint step
/// sees it smaller by (omega dt / 2)^2 / 2 = 2e-5.
template <int Dim>
Result spin(Formulation formulation) {
  Scene<Dim> scene = block<Dim>(formulation, MaterialModel::neo_log);
  scene.solids[0].material.youngs_modulus = 1e9;
  scene.angular_velocity = 4 * M_PI;
  const double dt = 0.001;
  scene.analysis = {AnalysisKind::dynamics, Integrator::implicit_midpoint, dt, 1};
  const auto model = build_model(scene, "");
  const State state = marched(model->system, scene.analysis, model->initial);
  const Points<Dim>& X = model->discretization.quadrature.position;
  const Vec<Dim> center = X * model->point_mass / model->total_mass();
  const Mat<Dim> R = rotation<Dim>(1000 * 2 * std::atan(scene.angular_velocity * dt / 2));
  const Points<Dim> expected = (R * (X.colwise() - center)).colwise() + center;
  Checks checks;
  checks.add("position after two turns", (positions(*model, state) - expected).cwiseAbs().maxCoeff(), 2e-3);
  return checks.result();
}

// Reflected, or flattened, about the left side, with 1 % of noise (seeded) off symmetry.
template <int Dim>
VectorXd crushed(const Model<Dim>& model, double factor) {
  Mat<Dim> F = Mat<Dim>::Identity();
  F(0, 0) = factor;
  VectorXd z = affine_field<Dim>(model.discretization.unknowns, F, Vec<Dim>::Zero());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-0.01, 0.01);
  for (const int i : model.system.free) z[i] += noise(random);
  return z;
}

/// Released from there in large implicit steps it comes to rest undeformed, or is refused.
template <int Dim>
Result start(Formulation formulation, MaterialModel material, double factor) {
  Scene<Dim> scene = block<Dim>(formulation, material);
  scene.pins = {pin_on<Dim>("part.4")};
  scene.analysis = {AnalysisKind::dynamics, Integrator::implicit_euler, 0.1, 20};
  const auto model = build_model(scene, "");
  State state = model->initial;
  const VectorXd z = crushed(*model, factor);
  for (const int i : model->system.free) state.z[i] = z[i];
  state = marched(model->system, scene.analysis, state);
  Checks checks;
  checks.add("displacement left", (positions(*model, state) - model->discretization.quadrature.position).cwiseAbs().maxCoeff(), 1e-3);
  return checks.result();
}

// ---- time ----

/// A linear block swings in its lowest mode. The scheme acts on the mode's amplitude q as on one oscillator:
///   Euler: v := (v - dt w^2 q) / (1 + dt^2 w^2), q += dt v;  midpoint: a turn by 2 atan(w dt / 2).
template <int Dim>
Result one_mode(Formulation formulation, Integrator integrator, double dt) {
  Scene<Dim> scene = block<Dim>(formulation, MaterialModel::linear);
  scene.pins = {pin_on<Dim>("part.4")};
  constexpr int n = 50;
  scene.analysis = {AnalysisKind::dynamics, integrator, dt, n * dt};
  const auto model = build_model(scene, "");
  const Modes modes = vibration_modes(model->system, model->system.rest, 1);
  require(modes.status, "modes");
  const VectorXd shape = modes.shapes.col(0);
  const double w = modes.omega[0];
  State state = model->initial;
  state.z += shape;
  state = marched(model->system, scene.analysis, state);
  double q = 1, v = 0;
  for (int k = 0; k < n; ++k) {
    if (integrator == Integrator::implicit_midpoint) {
      const double turn = 2 * std::atan(w * dt / 2), q0 = q;
      q = std::cos(turn) * q + std::sin(turn) * v / w;
      v = -w * std::sin(turn) * q0 + std::cos(turn) * v;
    } else {
      v = (v - dt * w * w * q) / (1 + dt * dt * w * w);
      q += dt * v;
    }
  }
  const double size = shape.norm();
  Checks checks;
  checks.add("amplitude error", (state.z - model->system.rest - q * shape).norm() / size, 1e-7);
  checks.add("velocity error", (state.v - v * shape).norm() / (w * size), 1e-6);
  return checks.result();
}

/// A step of 1 s, long beside every period: implicit Euler ends in the static answer.
template <int Dim>
Result long_step(Formulation formulation, Integrator integrator) {
  Scene<Dim> scene = block<Dim>(formulation, MaterialModel::neo_log);
  scene.pins = {pin_on<Dim>("part.4")};
  scene.gravity[1] = -10;
  const auto model = build_model(scene, "");
  const State still = solved(model->system, scene.analysis, model->target, model->initial);
  scene.analysis = {AnalysisKind::dynamics, integrator, 1, 100};
  const State state = marched(model->system, scene.analysis, model->initial);
  Checks checks;
  checks.add("end against the static answer", (state.z - still.z).norm() / (still.z - model->system.rest).norm(), 1e-6);
  return checks.result();
}

/// Flies into its pin at 10 m/s, about its speed of sound; the centroid against steps a quarter as long.
template <int Dim>
Result impact(Formulation formulation, Integrator integrator) {
  const auto fly = [&](double dt) {
    Scene<Dim> scene = block<Dim>(formulation, MaterialModel::neo_log);
    scene.pins = {pin_on<Dim>("part.4")};
    scene.velocity[0] = -10;
    scene.analysis = {AnalysisKind::dynamics, integrator, dt, 0.05};
    const auto model = build_model(scene, "");
    return centroid(*model, marched(model->system, scene.analysis, model->initial));
  };
  Checks checks;
  checks.add("way of the centroid, change by dt / 4", (fly(1e-3) - fly(2.5e-4)).norm() / 0.5, 0.05);
  return checks.result();
}

/// Hung at one corner a stiff square swings as a rigid pendulum: theta'' = -(m g d / I) sin theta with
/// d = sqrt(1/2), I / m = 2/3; from 135 degrees, by classical Runge-Kutta steps.
Result pendulum(Formulation formulation) {
  Scene<2> scene = block<2>(formulation, MaterialModel::neo_log);
  scene.solids[0].material.youngs_modulus = 1e8;
  scene.pins = {pin_on<2>("part.1")};
  scene.pins[0].where.control_points = {0};
  scene.gravity = {0, -10};
  const double dt = 0.002, end = 1;
  scene.analysis = {AnalysisKind::dynamics, Integrator::implicit_midpoint, dt, end};
  const auto model = build_model(scene, "");
  const State state = marched(model->system, scene.analysis, model->initial);
  const double d = std::sqrt(0.5), rate = 10 * d / (2.0 / 3);
  Vec<2> y(0.75 * M_PI, 0);  // angle from the lowest place, anticlockwise, and its rate
  const auto slope = [&](const Vec<2>& at) { return Vec<2>(at[1], -rate * std::sin(at[0])); };
  for (int k = 0; k < 1000; ++k) {
    const double h = end / 1000;
    const Vec<2> a = slope(y), b = slope(y + h / 2 * a), c = slope(y + h / 2 * b), e = slope(y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + e);
  }
  Checks checks;
  checks.add("centroid after 1 s", (centroid(*model, state) - d * Vec<2>(std::sin(y[0]), -std::cos(y[0]))).norm() / d, 0.01);
  return checks.result();
}

/// Held at one point, at rest: turns about it without resistance.
template <int Dim>
Result one_point_static(Formulation formulation) {
  Scene<Dim> scene = block<Dim>(formulation, MaterialModel::neo_log);
  scene.pins = {pin_on<Dim>("part.1")};
  scene.pins[0].where.control_points = {0};
  scene.gravity[1] = -10;
  const auto model = build_model(scene, "");
  solved(model->system, scene.analysis, model->target, model->initial);
  return {Outcome::failed, "called an equilibrium what can fall", 0};
}

/// No pin, many midpoint steps: linear and angular momentum stay, the energy neither grows nor decays (means
/// over the first and last thousand steps).
template <int Dim>
Result free_flight(Formulation formulation, long n) {
  Scene<Dim> scene = block<Dim>(formulation, MaterialModel::neo_ref);
  scene.method.projection.degree = 1;
  use_few_points(scene);
  scene.velocity[0] = 1;
  scene.angular_velocity = 2;
  scene.analysis = {AnalysisKind::dynamics, Integrator::implicit_midpoint, 0.01, 0.01 * double(n)};
  const auto model = build_model(scene, "");
  double first = 0, last = 0;
  const State state = marched(model->system, scene.analysis, model->initial, [&](const State& now, const StepInfo&) {
    if (now.step > 1000 && now.step <= n - 1000) return;
    (now.step <= 1000 ? first : last) += energies(model->system, now).total / 1000;
  });
  const auto before = momentum(*model, model->initial), after = momentum(*model, state);
  Checks checks;
  checks.add("linear momentum, change", (after.linear - before.linear).norm() / before.linear.norm(), 1e-8);
  checks.add("angular momentum, change", (after.angular - before.angular).norm() / before.angular.norm(), 1e-6);
  checks.add("energy, drift", last / first - 1, 1e-4);
  return checks.result();
}

/// A steel beam under its weight with dt = 0.01 s, some hundred periods of its fast modes: Euler's steps
/// end in the static answer; midpoint steps keep the energy and swing about it, no further than twice.
template <int Dim>
Result steel(Formulation formulation, Integrator integrator) {
  PlaneShape shape{{{polygon({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 1}, {3, 1}, {2, 1}, {1, 1}, {0, 1}}),
                     {quad({0, 0}, {4, 0}, {4, 1}, {0, 1})}}}, 4};
  Body<Dim> body = body_of<Dim>(shape);
  body.size = 1;
  Scene<Dim> scene = scene_of(body, formulation);
  scene.solids[0].material = {MaterialModel::neo_log, 2.1e11, 0.3, 7850};
  scene.gravity[1] = -9.81;
  scene.pins = {pin_on<Dim>("part.10")};
  const auto model = build_model(scene, "");
  const State still = solved(model->system, scene.analysis, model->target, model->initial);
  const double lowered = (still.z - model->system.rest).dot(model->system.load);
  scene.analysis = {AnalysisKind::dynamics, integrator, 0.01, 2};
  double lowest = 0, total = 0;
  const State state = marched(model->system, scene.analysis, model->initial, [&](const State& now, const StepInfo&) {
    lowest = std::max(lowest, (now.z - model->system.rest).dot(model->system.load) / lowered);
    total = energies(model->system, now).total;
  });
  Checks checks;
  const double end = (state.z - model->system.rest).dot(model->system.load) / lowered;
  if (integrator == Integrator::implicit_midpoint) {
    const double start = energies(model->system, model->initial).total;
    checks.add("swing beyond twice the static answer", std::max(0.0, lowest - 2), 0.01);
    checks.add("energy, change by the load's work", (total - start) / lowered, 1e-3);
  } else {
    checks.add("end against the static answer", end - 1, 1e-4);
  }
  return checks.result();
}

}  // namespace

std::vector<Case> mechanics_cases() {
  Group group;
  for (const Formulation f : both_formulations) {
    const std::string in_2d = variant<2>(f), in_3d = variant<3>(f);
    for (const double nu : {0.4999, 0.49999}) {
      const Rule rule = nu > 0.4999 ? Rule::may_refuse : Rule::must_solve;
      group.add(text("nu = %g", nu), in_2d, rule, true, [=] { return body_of_material<2>(f, nu); });
      group.add(text("nu = %g", nu), in_3d, rule, false, [=] { return body_of_material<3>(f, nu); });
    }
    for (const double ratio : {1e6, 1e8}) {
      const Rule rule = ratio > 1e6 ? Rule::may_refuse : Rule::must_solve;
      group.add(text("stiffness ratio %.0e", ratio), in_2d, rule, ratio == 1e6, [=] { return stiffness_ratio<2>(f, ratio); });
      group.add(text("stiffness ratio %.0e", ratio), in_3d, rule, false, [=] { return stiffness_ratio<3>(f, ratio); });
    }
    for (const MaterialModel material : {MaterialModel::neo_log, MaterialModel::neo_ref, MaterialModel::corotated}) {
      const std::string label = std::string("compression to 5 % ") + name(material);
      group.add(label, in_2d, Rule::may_refuse, f == Formulation::condensed && material == MaterialModel::neo_log, [=] { return confined_compression<2>(f, material, 0.05); });
      if (material == MaterialModel::neo_log)
        group.add(label, in_3d, Rule::may_refuse, false, [=] { return confined_compression<3>(f, material, 0.05); });
    }
    for (const MaterialModel material : {MaterialModel::corotated, MaterialModel::neo_log}) {
      group.add(std::string("starts inverted ") + name(material), in_2d, Rule::may_refuse, true, [=] { return start<2>(f, material, -1); });
      group.add(std::string("starts flat ") + name(material), in_2d, Rule::may_refuse, true, [=] { return start<2>(f, material, 0); });
    }
    group.add("starts inverted corotated", in_3d, Rule::may_refuse, false, [=] { return start<3>(f, MaterialModel::corotated, -1); });
    group.add("starts flat corotated", in_3d, Rule::may_refuse, false, [=] { return start<3>(f, MaterialModel::corotated, 0); });
    group.add("free spin by 720 degrees", in_2d, Rule::must_solve, true, [=] { return spin<2>(f); });
    group.add("free spin by 720 degrees", in_3d, Rule::must_solve, false, [=] { return spin<3>(f); });
    for (const Integrator integrator : all_integrators) {
      const std::string by = std::string(" ") + short_name(integrator);
      group.add("10 m/s into a pin" + by, in_2d, Rule::must_solve, true, [=] { return impact<2>(f, integrator); });
      if (integrator != Integrator::linearly_implicit_euler)
        for (const double dt : {1e-6, 1e-3, 1.0})
          group.add(text("dt = %g s", dt) + by, in_2d, Rule::must_solve, dt == 1, [=] { return one_mode<2>(f, integrator, dt); });
      if (integrator != Integrator::implicit_midpoint)
        group.add("dt = 1 s to rest" + by, in_2d, Rule::must_solve, true, [=] { return long_step<2>(f, integrator); });
      group.add("steel with dt = 0.01 s" + by, in_2d, Rule::must_solve, false, [=] { return steel<2>(f, integrator); });
    }
    group.add("10 m/s into a pin Euler", in_3d, Rule::must_solve, true, [=] { return impact<3>(f, Integrator::implicit_euler); });
    group.add("dt = 1 s midpoint", in_3d, Rule::must_solve, false, [=] { return one_mode<3>(f, Integrator::implicit_midpoint, 1); });
    group.add("steel with dt = 0.01 s Euler", in_3d, Rule::must_solve, false, [=] { return steel<3>(f, Integrator::implicit_euler); });
    group.add("one pinned point: pendulum", in_2d, Rule::must_solve, false, [=] { return pendulum(f); });
    group.add("one pinned point: statics", in_2d, Rule::may_refuse, true, [=] { return one_point_static<2>(f); });
    group.add("one pinned point: statics", in_3d, Rule::may_refuse, false, [=] { return one_point_static<3>(f); });
    group.add("no pin for 1e5 steps", in_2d, Rule::must_solve, false, [=] { return free_flight<2>(f, 100000); });
    group.add("no pin for 3e3 steps", in_2d, Rule::must_solve, true, [=] { return free_flight<2>(f, 3000); });
    group.add("no pin for 3e3 steps", in_3d, Rule::must_solve, false, [=] { return free_flight<3>(f, 3000); });
  }
  for (const double nu : {0.4999, 0.49999}) {
    const Rule rule = nu > 0.4999 ? Rule::may_refuse : Rule::must_solve;
    group.add(text("bending with nu = %g", nu), variant<2>(Formulation::condensed), rule, true, [=] { return bending(nu); });
    group.add(text("Cook's membrane nu = %g", nu), variant<2>(Formulation::condensed), rule, false, [=] { return cook(nu); });
  }
  group.add("pins turned by 720 degrees", variant<2>(Formulation::projected), Rule::must_solve, true, [] { return turned_by_pins<2>(); });
  group.add("pins turned by 720 degrees", variant<3>(Formulation::projected), Rule::must_solve, false, [] { return turned_by_pins<3>(); });
  return group.cases;
}

}  // namespace sem::stability
