// Whole bodies through the whole pipeline, in both dimensions.
#include "bodies.h"
#include "dims.h"
#include "sem/method/least_squares.h"
#include "sem/scene/accuracy.h"
#include "sem/scene/analysis.h"
#include "sem/scene/monitor.h"
#include "sem/solve/modes.h"

using namespace sem;
using Eigen::VectorXd;

namespace {

template <int Dim>
size_t column(const Monitor<Dim>& monitor, const std::string& name) {
  const auto columns = monitor.columns();
  const auto at = std::find(columns.begin(), columns.end(), name);
  REQUIRE(at != columns.end());
  return size_t(at - columns.begin());
}

const Integrator all_integrators[] = {Integrator::linearly_implicit_euler, Integrator::implicit_euler,
                                      Integrator::implicit_midpoint};

}  // namespace

TEST_CASE_TEMPLATE("free fall: the centroid follows the parabola of its integrator", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  scene.gravity[1] = -10;
  scene.analysis.duration = 0.2;
  for (const Integrator integrator : all_integrators) {
    CAPTURE(name(integrator));
    scene.analysis.integrator = integrator;
    const auto model = build_model(scene, "");
    const Monitor<Dim> monitor(scene, *model);
    State state = model->initial;
    const auto report = march(model->system, scene.analysis, state, [](const State&, const StepInfo&) {});
    CHECK(report.status == Status::converged);
    const auto row = monitor.row(state, VectorXd::Zero(state.z.size()), 0, 0, 1);
    // Euler: y_n = -g dt^2 n (n + 1) / 2; midpoint: exact.
    const double dt = 0.01, n = 20;
    const double fall = integrator == Integrator::implicit_midpoint ? 10 * 0.2 * 0.2 / 2 : 10 * dt * dt * n * (n + 1) / 2;
    CHECK(row[column(monitor, "centroid_y_m")] == doctest::Approx(0.5 - fall).epsilon(1e-9));
    CHECK(std::abs(row[column(monitor, "elastic_J")]) < 1e-12);
    CHECK(row[column(monitor, "boundary_mismatch")] < 1e-9);
  }
}

TEST_CASE_TEMPLATE("free flight: momentum to 1e-10 over 1000 steps; angular too for midpoint", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>(MaterialModel::neo_ref);
  scene.velocity[0] = 1;
  scene.angular_velocity = 2;
  scene.analysis.duration = 10;
  for (const Integrator integrator : all_integrators) {
    CAPTURE(name(integrator));
    scene.analysis.integrator = integrator;
    const auto model = build_model(scene, "");
    const Monitor<Dim> monitor(scene, *model);
    State state = model->initial;
    const auto row = [&] { return monitor.row(state, VectorXd::Zero(state.z.size()), 0, 0, 1); };
    const auto first = row();
    const auto report = march(model->system, scene.analysis, state, [](const State&, const StepInfo&) {});
    CHECK(report.n_steps == 1000);
    const auto last = row();
    const double scale = model->total_mass();
    for (const std::string axis : {"x", "y"}) {
      const size_t c = column(monitor, "momentum_" + axis + "_kg_m_s");
      CHECK(std::abs(last[c] - first[c]) < 1e-10 * scale);
    }
    const size_t turn = column(monitor, "angular_momentum_z_kg_m2_s");
    const double lost = std::abs(last[turn] - first[turn]) / std::abs(first[turn] - 50);
    if (integrator == Integrator::implicit_midpoint)
      CHECK(std::abs(last[turn] - first[turn]) < 1e-10 * scale);
    else
      CHECK(lost > 1e-6);  // Euler's methods do lose it
  }
}

TEST_CASE_TEMPLATE("a pinned swing keeps its pins, stays finite and exchanges energy", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  scene.gravity[1] = -10;
  scene.pins.push_back(test::face_pin<Dim>(0));
  scene.analysis.duration = 0.5;
  scene.analysis.integrator = Integrator::implicit_midpoint;
  const auto model = build_model(scene, "");
  const Monitor<Dim> monitor(scene, *model);
  State state = model->initial;
  double lowest = 1;
  const auto first = monitor.row(state, VectorXd::Zero(state.z.size()), 0, 0, 1);
  const size_t total = column(monitor, "total_J"), load = column(monitor, "load_J");
  double drift = 0, exchanged = 0;
  const auto report = march(model->system, scene.analysis, state, [&](const State& now, const StepInfo& info) {
    const auto row = monitor.row(now, info.acceleration, info.iterations, info.residual, 1);
    for (const double value : row) CHECK(std::isfinite(value));
    lowest = std::min(lowest, row[column(monitor, "centroid_y_m")]);
    drift = std::max(drift, std::abs(row[total] - first[total]));
    exchanged = std::max(exchanged, std::abs(row[load] - first[load]));
  });
  CHECK(report.status == Status::converged);
  CHECK(lowest < 0.5 - 1e-3);
  CHECK(drift < 0.05 * exchanged);
  for (const int entry : model->held[0].entries) CHECK(state.z[entry] == model->system.rest[entry]);
}

TEST_CASE_TEMPLATE("static: a body turned at two faces' control points follows rigidly", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>(MaterialModel::neo_log);
  scene.analysis.kind = AnalysisKind::statics;
  scene.analysis.load_steps = 4;
  scene.pins.push_back(test::face_pin<Dim>(0));
  const auto model = build_model(scene, "");
  Mat<Dim> R = Mat<Dim>::Identity();
  R(0, 0) = R(1, 1) = std::cos(0.7);
  R(1, 0) = std::sin(0.7);
  R(0, 1) = -R(1, 0);
  const Points<Dim> turned = R * rest_controls(model->discretization.boundary);
  State state = model->initial;
  const auto report = equilibrium(model->system, scene.analysis, test::stacked<Dim>(turned), state);
  CHECK(report.status == Status::converged);
  CHECK((state.z - test::stacked<Dim>(turned)).cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE_TEMPLATE("reactions of the pins balance the loads", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  scene.analysis.kind = AnalysisKind::statics;
  scene.gravity[1] = -1;
  scene.pins.push_back(test::face_pin<Dim>(0));
  scene.probes.push_back({"held", ProbeKind::reaction, Vec<Dim>::Zero(), 0});
  const auto model = build_model(scene, "");
  State state = model->initial;
  CHECK(equilibrium(model->system, scene.analysis, model->target, state).status == Status::converged);
  const auto force = Monitor<Dim>(scene, *model).probes(state, {});
  CHECK(force[1] == doctest::Approx(100.0).epsilon(1e-8));  // rho V g upward
  CHECK(std::abs(force[0]) < 1e-6);
}

TEST_CASE_TEMPLATE("a linear body marches with one factorisation and one Hessian", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>(MaterialModel::linear);
  scene.gravity[1] = -1;
  scene.pins.push_back(test::face_pin<Dim>(0));
  scene.analysis.duration = 1;
  const auto model = build_model(scene, "");
  State state = model->initial;
  const auto report = march(model->system, scene.analysis, state, [](const State&, const StepInfo&) {});
  CHECK(report.n_steps == 100);
  CHECK(report.counters.factorizations.n == 1);
  CHECK(report.counters.hessians.n == 1);
}

TEST_CASE_TEMPLATE("a free body has its rigid modes at zero frequency", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto scene = test::box_scene<Dim>(MaterialModel::linear);
  const auto model = build_model(scene, "");
  constexpr int n_rigid = Dim + DimTraits<Dim>::n_rotations;
  const Modes modes = vibration_modes(model->system, model->initial.z, n_rigid + 1);
  REQUIRE(modes.status == Status::converged);
  for (int m = 0; m < n_rigid; ++m) CHECK(std::abs(modes.omega[m]) < 1e-4 * modes.omega[n_rigid]);
}

TEST_CASE_TEMPLATE("a run has the same bits with 1 and 2 threads", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  scene.gravity[1] = -10;
  scene.pins.push_back(test::face_pin<Dim>(0));
  scene.analysis.duration = 0.1;
  VectorXd z[2];
  for (int t = 0; t < 2; ++t) {
    scene.method.n_threads = t + 1;
    const auto model = build_model(scene, "");
    State state = model->initial;
    march(model->system, scene.analysis, state, [](const State&, const StepInfo&) {});
    z[t] = state.z;
  }
  CHECK(z[0] == z[1]);
}

TEST_CASE_TEMPLATE("accuracy report: the same numbers for a model a million sizes away", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  const auto near = measure_accuracy(*build_model(scene, ""));
  for (auto& solid : scene.solids)
    for (auto& part : solid.parts) part.shape.control_points.array() += 1e6;
  const auto far = measure_accuracy(*build_model(scene, ""));
  CHECK(near.second_moment_error < 1e-2);
  CHECK(far.volume_error == doctest::Approx(near.volume_error).epsilon(1e-6));
  CHECK(std::abs(far.second_moment_error - near.second_moment_error) < 1e-8);
}

TEST_CASE_TEMPLATE("folds: a reflected body is folded, a turned one is not", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const Formulation formulation : {Formulation::projected, Formulation::condensed}) {
    auto scene = test::box_scene<Dim>(MaterialModel::stvk, 2);
    scene.method.formulation = formulation;
    const auto model = build_model(scene, "");
    Mat<Dim> reflected = Mat<Dim>::Identity(), turned = reflected;
    reflected(0, 0) = turned(0, 0) = turned(1, 1) = -1;
    const auto share = [&](const Mat<Dim>& F) {
      return folded_share(*model, affine_field<Dim>(model->discretization.unknowns, F, Vec<Dim>::Constant(0.3)));
    };
    CHECK(share(Mat<Dim>::Identity()) == 0);
    CHECK(share(turned) == 0);
    CHECK(share(reflected) == doctest::Approx(1));
  }
}

TEST_CASE_TEMPLATE("folds: half of a body whose height becomes the square of its distance from the middle", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>(MaterialModel::stvk, 2);
  scene.method.formulation = Formulation::condensed;
  scene.method.projection.degree = 2;
  const auto model = build_model(scene, "");
  const auto& d = model->discretization;
  Points<Dim> x = d.quadrature.position;
  x.row(1) = (x.row(1).array() - 0.5).square();
  const Points<Dim> z = least_squares(dense_value(d.interior), x.transpose()).transpose();
  REQUIRE((evaluate(d.interior, VectorXd(z.reshaped())) - x).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(folded_share(*model, z.reshaped()) == doctest::Approx(0.5));
}

TEST_CASE_TEMPLATE("static: a body turned by its pin sags as the one that is not turned does under turned gravity", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto solved = [](const Scene<Dim>& scene) {
    const auto model = build_model(scene, "");
    State state = model->initial;
    CHECK(equilibrium(model->system, scene.analysis, model->target, state, model->path).status == Status::converged);
    return Points<Dim>(evaluate(model->discretization.interior, state.z));
  };
  for (const double angle : {1.2, 2 * M_PI + 0.5}) {
      CAPTURE(angle);
      Mat<Dim> R = Mat<Dim>::Identity();
      R(0, 0) = R(1, 1) = std::cos(angle);
      R(1, 0) = std::sin(angle);
      R(0, 1) = -R(1, 0);
      auto scene = test::box_scene<Dim>(MaterialModel::neo_log);
      scene.analysis.kind = AnalysisKind::statics;
      scene.analysis.load_steps = angle > 2 ? 24 : 4;
      scene.gravity[1] = -5;
      auto pin = test::face_pin<Dim>(0);
      pin.rotation[DimTraits<Dim>::n_rotations - 1] = angle;  // about z
      pin.center = Vec<Dim>::Constant(0.25);
      pin.displacement[0] = 0.3;
      scene.pins = {pin};
      const Points<Dim> turned = solved(scene);
      scene.gravity = R.transpose() * scene.gravity;
      scene.pins = {test::face_pin<Dim>(0)};
      const Points<Dim> still = solved(scene);
      const Points<Dim> expected = (R * (still.colwise() - pin.center)).colwise() + (pin.center + pin.displacement);
      CHECK((turned - expected).cwiseAbs().maxCoeff() < 1e-6);
    }
}

TEST_CASE_TEMPLATE("dynamic: a load with an amplitude moves a free body as its sum over the steps says", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const Integrator integrator : {Integrator::linearly_implicit_euler, Integrator::implicit_midpoint}) {
    auto scene = test::box_scene<Dim>(MaterialModel::linear);
    scene.analysis.integrator = integrator;
    scene.analysis.duration = 0.37;
    BodyLoad<Dim> wind{"", Vec<Dim>::Unit(0) * 300, 0, {1.5, 0.2}};
    scene.body_loads.push_back(wind);
    scene.gravity[1] = -10;
    const auto model = build_model(scene, "");
    CHECK(model->system.load.sum() == doctest::Approx(300 - 1000).epsilon(1e-12));  // the mean
    State state = model->initial;
    march(model->system, scene.analysis, state, [](const State&, const StepInfo&) {}, model->set_load());
    const bool middle = integrator == Integrator::implicit_midpoint;
    double v = 0, x = 0;
    for (int k = 0; k < 37; ++k) {
      const double t = (k + (middle ? 0.5 : 1)) * 0.01, before = v;
      v += 0.01 * 3 * (1 + 1.5 * std::sin(2 * M_PI * t / 0.2));
      x += 0.01 * (middle ? (before + v) / 2 : v);
    }
    const auto& d = model->discretization;
    const Points<Dim> moved = evaluate(d.interior, state.z) - d.quadrature.position;
    CHECK((moved * d.quadrature.weight)[0] == doctest::Approx(x).epsilon(1e-10));
  }
}
