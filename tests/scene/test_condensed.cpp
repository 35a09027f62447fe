// The condensed formulation: unknowns are coefficients, pins act on the map (Nitsche).
#include <random>

#include "bodies.h"
#include "dims.h"
#include "sem/base/error.h"
#include "sem/nurbs/kernels.h"
#include "sem/base/rotation.h"
#include "sem/scene/accuracy.h"
#include "sem/scene/analysis.h"
#include "sem/scene/monitor.h"
#include "sem/solve/modes.h"

using namespace sem;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

template <int Dim>
Scene<Dim> condensed_box(MaterialModel model, int degree = 2) {
  Scene<Dim> scene = test::box_scene<Dim>(model);
  scene.method.formulation = Formulation::condensed;
  scene.method.weights.variant = DistanceWeight::sided;
  scene.method.weights.cutoff = 0.8;
  scene.method.interior_rule.rule = InteriorRule::resolved;
  scene.method.interior_rule.weight_tolerance = 1e-2;
  scene.method.projection.degree = degree;
  scene.analysis.kind = AnalysisKind::statics;
  return scene;
}

template <int Dim>
Pin<Dim> part_pin(const std::string& part) {
  Pin<Dim> pin;
  pin.where.part = part;
  pin.axes.fill(true);
  return pin;
}

// The part of the unit box on X_0 = side.
template <int Dim>
std::string face(int side) {
  return "part." + std::to_string(Dim == 2 ? (side == 0 ? 4 : 2) : side + 1);
}

// A 4 x 1 beam of cubic parts, clamped on the left, under its weight.
Scene<2> beam(double density, double cutoff, int degree = 3) {
  Scene<2> scene;
  scene.name = "beam";
  SceneSolid<2> solid{"beam", {MaterialModel::neo_log, 1e5, 0.3, density}, {}};
  std::vector<Vec<2>> corners = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 1}, {3, 1}, {2, 1}, {1, 1}, {0, 1}};
  for (auto shape : test::polygon(corners))
    solid.parts.push_back({"part." + std::to_string(solid.parts.size() + 1), elevate_degree(shape, 0, 2), {}});
  scene.solids.push_back(solid);
  scene.method.formulation = Formulation::condensed;
  scene.method.weights.variant = DistanceWeight::sided;
  scene.method.weights.cutoff = cutoff;
  scene.method.interior_rule.rule = InteriorRule::resolved;
  scene.method.projection.degree = degree;
  scene.gravity = {0, -10};
  scene.pins.push_back(part_pin<2>("part.10"));
  scene.probes.push_back({"tip", ProbeKind::displacement, {4, 0.5}});
  scene.probes.push_back({"clamp", ProbeKind::reaction, {0, 0}, 0});
  scene.analysis.kind = AnalysisKind::statics;
  scene.analysis.load_steps = density > 20 ? 4 : 1;
  return scene;
}

template <int Dim>
std::vector<double> probes_at_rest(const Scene<Dim>& scene) {
  const auto model = build_model(scene, "");
  State state = model->initial;
  REQUIRE(equilibrium(model->system, scene.analysis, model->target, state).status == Status::converged);
  return Monitor<Dim>(scene, *model).probes(state, {});
}

}  // namespace

namespace {

// Uniaxial tension and a moved clamp: (0.024, 0.02), 100 Pa, -100 N.
template <int Dim>
void check_uniform_tension(double poisson_ratio, OwnPressure own_pressure) {
  Scene<Dim> scene = condensed_box<Dim>(MaterialModel::linear);
  scene.method.own_pressure = own_pressure;
  scene.solids[0].material.poisson_ratio = poisson_ratio;
  scene.pins.push_back(part_pin<Dim>(face<Dim>(0)));
  scene.pins[0].displacement = Vec<Dim>::Constant(0.02);
  BoundaryLoad<Dim> pull;
  pull.where.part = face<Dim>(1);
  pull.traction[0] = 100;  // E = 1e4: a strain of 1 %
  scene.boundary_loads.push_back(pull);
  scene.probes.push_back({"middle", ProbeKind::displacement, Vec<Dim>::Constant(0.4)});
  scene.probes.push_back({"stress", ProbeKind::stress, Vec<Dim>::Constant(0.3)});
  scene.probes.push_back({"clamp", ProbeKind::reaction, Vec<Dim>::Zero(), 0});
  const auto values = probes_at_rest(scene);
  CHECK(values[0] == doctest::Approx(0.024).epsilon(1e-8));
  CHECK(values[1] == doctest::Approx(0.02).epsilon(1e-8));
  CHECK(values[Dim] == doctest::Approx(100).epsilon(1e-7));     // sigma_xx
  CHECK(std::abs(values[Dim + 1]) < 1e-5);                      // sigma_xy
  const size_t reaction = Dim + Dim * (Dim + 1) / 2;
  CHECK(values[reaction] == doctest::Approx(-100).epsilon(1e-8));  // the clamp holds against the pull
}

}  // namespace

// Poisson's ratio 0, so that the clamp does not disturb the state of uniform stress.
TEST_CASE_TEMPLATE("patch test: uniaxial tension and a moved clamp are exact", T, D2, D3) {
  check_uniform_tension<T::value>(0, OwnPressure::automatic);
}

// Poisson's ratio 0 again: else the clamp's ends are singular, and the exact state is not uniform.
TEST_CASE_TEMPLATE("patch test: tension of a clamped body stays exact with patches at the joints", T, D2, D3) {
  constexpr int Dim = T::value;
  Scene<Dim> scene = condensed_box<Dim>(MaterialModel::linear);
  scene.method.patch_levels = 2;
  if (Dim == 3) scene.method.interior_rule.weight_tolerance = 1e-3;
  scene.solids[0].material.poisson_ratio = 0;
  scene.pins.push_back(part_pin<Dim>(face<Dim>(0)));
  BoundaryLoad<Dim> pull;
  pull.where.part = face<Dim>(1);
  pull.traction[0] = 100;
  scene.boundary_loads.push_back(pull);
  scene.probes.push_back({"middle", ProbeKind::displacement, Vec<Dim>::Constant(0.4)});
  const auto model = build_model(scene, "");
  CHECK(model->discretization.patches.size() >= 8);
  State state = model->initial;
  REQUIRE(equilibrium(model->system, scene.analysis, model->target, state).status == Status::converged);
  const auto values = Monitor<Dim>(scene, *model).probes(state, {});
  CHECK(values[0] == doctest::Approx(0.004).epsilon(1e-8));
  CHECK(std::abs(values[1]) < 1e-10);
}

TEST_CASE_TEMPLATE("patch test: a confined, nearly incompressible body has the exact uniform pressure", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const double nu : {0.3, 0.4999}) {
    Scene<Dim> scene = condensed_box<Dim>(MaterialModel::linear);
    scene.method.own_pressure = OwnPressure::always;
    auto& material = scene.solids[0].material;
    material.poisson_ratio = nu;
    scene.pins.push_back(part_pin<Dim>(face<Dim>(0)));
    for (int axis = 1; axis < Dim; ++axis)  // rollers on all sides
      for (const int side : {0, 1}) {
        Pin<Dim> roller = part_pin<Dim>("part." + std::to_string(Dim == 2 ? (side == 0 ? 1 : 3) : 2 * axis + side + 1));
        roller.axes.fill(false);
        roller.axes[axis] = true;
        scene.pins.push_back(roller);
      }
    BoundaryLoad<Dim> push;
    push.where.part = face<Dim>(1);
    push.traction[0] = -50;
    scene.boundary_loads.push_back(push);
    scene.probes.push_back({"middle", ProbeKind::displacement, Vec<Dim>::Constant(0.5)});
    scene.probes.push_back({"stress", ProbeKind::stress, Vec<Dim>::Constant(0.3)});
    const auto values = probes_at_rest(scene);
    const double strain = -50 / (material.lame_lambda() + 2 * material.lame_mu());
    CHECK(values[0] == doctest::Approx(strain / 2).epsilon(1e-7));
    CHECK(values[Dim] == doctest::Approx(-50).epsilon(1e-6));
    // sigma_yy follows sigma_xx (2D: xx, xy, yy; 3D: xx, xy, xz, yy).
    CHECK(values[2 * Dim] == doctest::Approx(material.lame_lambda() * strain).epsilon(1e-6));
  }
}

TEST_CASE("own pressure: Cook's membrane within 1.5 % at nu = 0.3, 2.5 % at nu = 0.4999") {
  const auto error = [](double nu, OwnPressure own_pressure) {
    Scene<2> scene;
    SceneSolid<2> solid{"membrane", {MaterialModel::neo_log, 240.565, nu, 0}, {}};
    const std::vector<Vec<2>> corners = {{0, 0}, {48, 44}, {48, 60}, {0, 44}};
    std::vector<Vec<2>> points;
    for (int side = 0; side < 4; ++side)
      for (int k = 0; k < 4; ++k) points.push_back(corners[side] + k / 4. * (corners[(side + 1) % 4] - corners[side]));
    for (auto shape : test::polygon(points))
      solid.parts.push_back({"side" + std::to_string(solid.parts.size() / 4) + "." + std::to_string(solid.parts.size() % 4),
                             elevate_degree(shape, 0, 2), {}});
    scene.solids.push_back(solid);
    scene.method = condensed_box<2>(MaterialModel::linear, 3).method;
    scene.method.interior_rule.weight_tolerance = 3e-4;
    scene.method.weights.cutoff = 30;
    scene.method.own_pressure = own_pressure;
    scene.pins.push_back(part_pin<2>("side3"));
    BoundaryLoad<2> shear;
    shear.where.part = "side1";
    shear.traction = {0, 20. / 16};
    scene.boundary_loads.push_back(shear);
    scene.probes.push_back({"tip", ProbeKind::displacement, {48, 60}});
    scene.analysis.kind = AnalysisKind::statics;
    const auto u = probes_at_rest(scene);
    const Vec<2> truth = nu > 0.4 ? Vec<2>(-1.17473, 1.56823) : Vec<2>(-1.438027, 1.840498);
    return (Vec<2>(u[0], u[1]) - truth).cwiseQuotient(truth).cwiseAbs().maxCoeff();
  };
  CHECK(error(0.3, OwnPressure::automatic) < 0.015);
  CHECK(error(0.3, OwnPressure::always) < 0.015);
  CHECK(error(0.4999, OwnPressure::automatic) < 0.025);
}

TEST_CASE("a symmetric beam: the last bits of closest points and hits do not choose cells or functions") {
  const auto* const best = detail::kernels;
  for (const int degree : {2, 3})
    for (const double cutoff : {0.55, 0.75}) {
      const Scene<2> scene = beam(10, cutoff, degree);
      const auto fast = probes_at_rest(scene);
      detail::kernels = &detail::portable_kernels;
      const auto portable = probes_at_rest(scene);
      detail::kernels = best;
      CHECK(fast[1] == doctest::Approx(portable[1]).epsilon(1e-10));
    }
}

TEST_CASE_TEMPLATE("energy with clamps: gradient and Hessian are finite differences", T, D2, D3) {
  constexpr int Dim = T::value;
  using enum MaterialModel;
  for (const auto& [material, own_pressure] :
       {std::pair(linear, OwnPressure::never), std::pair(neo_log, OwnPressure::never),
        std::pair(corotated, OwnPressure::never), std::pair(linear, OwnPressure::always),
        std::pair(stvk, OwnPressure::always), std::pair(corotated, OwnPressure::always),
        std::pair(neo_log, OwnPressure::always), std::pair(neo_ref, OwnPressure::always),
        std::pair(neo_iso, OwnPressure::always)}) {
    CAPTURE(name(material));
    CAPTURE(int(own_pressure));
    Scene<Dim> scene = condensed_box<Dim>(material, 1);
    scene.method.own_pressure = own_pressure;
    scene.pins.push_back(part_pin<Dim>(face<Dim>(0)));
    scene.pins[0].axes[1] = false;
    Pin<Dim> corner = part_pin<Dim>(face<Dim>(1));  // a single control point: a spring
    corner.where.control_points = {0};
    scene.pins.push_back(corner);
    const auto model = build_model(scene, "");
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-0.05, 0.05);
    // Near the rest shape; and with the layer at the pin crushed, where the penalty stiffens.
    for (const double height : {1.0, 0.3}) {
      CAPTURE(height);
      Mat<Dim> crushed = Mat<Dim>::Identity();
      crushed(0, 0) = height;
      VectorXd z = affine_field<Dim>(model->discretization.unknowns, crushed, Vec<Dim>::Zero()), direction(z.size());
      for (int i = 0; i < z.size(); ++i) {
        z[i] += height * number(random);
        direction[i] = height * number(random);
      }
      auto& V = *model->energy;
      VectorXd g(z.size()), plus(z.size()), minus(z.size());
      V.gradient(z, g);
      const MatrixXd H = V.dense_hessian(z);
      CHECK((H - H.transpose()).norm() < 1e-9 * H.norm());
      const double h = 1e-4;
      const double slope = (V.energy(z + h * direction) - V.energy(z - h * direction)) / (2 * h);
      CHECK(slope == doctest::Approx(g.dot(direction)).epsilon(1e-5));
      V.gradient(z + h * direction, plus);
      V.gradient(z - h * direction, minus);
      CHECK(((plus - minus) / (2 * h) - H * direction).norm() < 1e-5 * (H * direction).norm());
    }
  }
}

TEST_CASE_TEMPLATE("a free body turned by any angle stores no energy and vibrates with the rigid motions alone at zero",
                   T, D2, D3) {
  constexpr int Dim = T::value;
  const Scene<Dim> scene = condensed_box<Dim>(MaterialModel::neo_log);
  const auto model = build_model(scene, "");
  Mat<Dim> R = Mat<Dim>::Identity();
  R(0, 0) = R(1, 1) = std::cos(2.1);
  R(1, 0) = std::sin(2.1);
  R(0, 1) = -R(1, 0);
  const VectorXd z = affine_field<Dim>(model->discretization.unknowns, R, Vec<Dim>::Constant(3));
  CHECK(std::abs(model->energy->energy(z)) < 1e-8);
  VectorXd g(z.size());
  model->energy->gradient(z, g);
  CHECK(g.norm() < 1e-8 * 1e4);
  const int n_rigid = Dim + DimTraits<Dim>::n_rotations;
  const Modes modes = vibration_modes(model->system, model->system.rest, n_rigid + 1);
  REQUIRE(modes.status == Status::converged);
  for (int m = 0; m < n_rigid; ++m) CHECK(std::abs(modes.omega[m]) < 1e-3 * modes.omega[n_rigid]);
}

TEST_CASE("cantilever: within 1 % of the truth for every load and cutoff, and the clamp carries the weight") {
  const std::pair<double, double> truths[] = {{1, -0.03703440}, {10, -0.3684452}, {40, -1.37317}};
  for (const auto& [density, truth] : truths)
    for (const double cutoff : {0.55, 0.75, 1.5}) {
      CAPTURE(density);
      CAPTURE(cutoff);
      const auto values = probes_at_rest(beam(density, cutoff));
      CHECK(std::abs(values[1] / truth - 1) < 0.01);
      CHECK(values[3] == doctest::Approx(density * 40).epsilon(1e-6));
    }
}

TEST_CASE("cantilever with patches at the clamp's ends: within 0.05 % of the truth for every cutoff") {
  for (const double cutoff : {0.55, 0.75, 1.0, 2.0}) {
    Scene<2> scene = beam(10, cutoff);
    scene.method.patch_levels = 4;
    CAPTURE(cutoff);
    CHECK(probes_at_rest(scene)[1] == doctest::Approx(-0.3684452).epsilon(5e-4));
  }
}

TEST_CASE("cantilever: doubling the clamps' penalty changes the tip by less than 0.15 %, degree 4 has two thirds of the error") {
  Scene<2> scene = beam(10, 0.75);
  const double truth = -0.3684452, error = std::abs(probes_at_rest(scene)[1] / truth - 1);
  scene.clamp_penalty *= 2;
  CHECK(std::abs(probes_at_rest(scene)[1] / truth - 1) - error < 0.0015);
  CHECK(std::abs(probes_at_rest(beam(10, 0.75, 4))[1] / truth - 1) < 0.7 * error);
  CHECK(std::abs(probes_at_rest(beam(10, 0.75, 2))[1] / truth - 1) > 2 * error);
}

TEST_CASE("release from rest: the tip falls freely until the clamp's wave arrives, then as the truth does") {
  Scene<2> scene = beam(400, 0.75);
  scene.analysis = {AnalysisKind::dynamics, Integrator::implicit_midpoint, 0.01, 0.3};
  scene.analysis.kind = AnalysisKind::dynamics;
  const auto model = build_model(scene, "");
  const Monitor<2> monitor(scene, *model);
  State state = model->initial;
  std::vector<double> uy;
  const auto report = march(model->system, scene.analysis, state, [&](const State& now, const StepInfo& info) {
    if (now.step % 10 == 0) uy.push_back(monitor.probes(now, info.acceleration)[1]);
  });
  REQUIRE(report.status == Status::converged);
  REQUIRE(uy.size() == 3);
  CHECK(uy[0] == doctest::Approx(-0.05).epsilon(2e-3));
  CHECK(uy[1] == doctest::Approx(-0.20).epsilon(2e-3));
  CHECK(uy[2] == doctest::Approx(-0.4505).epsilon(5e-3));
}

TEST_CASE_TEMPLATE("weights satisfy the divergence theorem for every function, and keep every part's sum", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto model = build_model(condensed_box<Dim>(MaterialModel::linear), "");
  auto& d = model->discretization;
  const auto defect = [&] {
    const BoundaryRule<Dim> rule = boundary_rule(d);
    Points<Dim> missing = evaluate_transposed<Dim>(map_at(d, rule.samples.position, false), rule.normal * rule.samples.weight.asDiagonal());
    missing.conservativeResize(Dim, d.interior.n_columns);  // without the pins' own columns
    const double size = missing.cwiseAbs().maxCoeff();
    for (const auto& block : d.interior.blocks)
      for (size_t j = 0; j < block.columns.size(); ++j)
        for (int a = 0; a < Dim; ++a) missing(a, block.columns[j]) -= block.gradient[a].col(j).dot(d.quadrature.weight(block.points));
    return missing.cwiseAbs().maxCoeff() / size;
  };
  CHECK(std::isfinite(model->divergence_defect));
  CHECK(defect() < 1e-8);
  CHECK(d.quadrature.weight.minCoeff() > 0);
  CHECK(d.quadrature.weight.sum() == doctest::Approx(1).epsilon(1e-8));
  VectorXd sums = VectorXd::Zero(2 * Dim);
  const Samples<Dim> samples = boundary_rule(d).samples;
  for (int s = 0; s < samples.size(); ++s) sums[samples.part[s]] += samples.weight[s];
  CHECK((sums.array() - 1).abs().maxCoeff() < 1e-8);
  CHECK((d.boundary_factor.array() - 1).abs().maxCoeff() > 1e-6);
  // The rule by itself does not.
  d.boundary_factor.resize(0);
  CHECK(defect() > 1e-6);
}

TEST_CASE_TEMPLATE("the report of a condensed model: identity exact, corrections small and stated", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto model = build_model(condensed_box<Dim>(MaterialModel::linear), "");
  const Accuracy<Dim> accuracy = measure_accuracy(*model);
  CHECK(accuracy.identity_error < 1e-13);
  CHECK(accuracy.identity_gradient_error < 1e-12);
  CHECK(accuracy.divergence_defect > 0);
  CHECK(accuracy.divergence_defect < 0.5);
}

TEST_CASE("resolved rules refuse moment fitting and compression, which know no kinks") {
  Scene<2> scene = condensed_box<2>(MaterialModel::linear);
  scene.method.interior_rule.compress = 4;
  CHECK_THROWS_AS(build_model(scene, ""), InputError);
}

TEST_CASE("condensed: a body turned by its pin sags as the one that is not turned does under turned gravity") {
  const auto solved = [](const Scene<2>& scene) {
    const auto model = build_model(scene, "");
    State state = model->initial;
    CHECK(equilibrium(model->system, scene.analysis, model->target, state, model->path).status == Status::converged);
    return Points<2>(evaluate(model->discretization.interior, state.z));
  };
  const double angle = 2 * M_PI + 1.2;
  const Mat<2> R = rotation<2>(Vec<1>(angle));
  auto scene = condensed_box<2>(MaterialModel::neo_log, 3);
  scene.analysis.load_steps = 24;
  scene.gravity = {0, -5};
  auto pin = test::face_pin<2>(0);
  pin.rotation[0] = angle;
  pin.center = {0.25, 0.25};
  pin.displacement = {0.3, 0};
  scene.pins = {pin};
  const Points<2> turned = solved(scene);
  scene.gravity = R.transpose() * scene.gravity;
  scene.pins = {test::face_pin<2>(0)};
  const Points<2> still = solved(scene);
  const Points<2> expected = (R * (still.colwise() - pin.center)).colwise() + (pin.center + pin.displacement);
  // Not to rounding: the clamps' penalty has the normal of the rest shape in it (clamps.h).
  const double sag = (turned - ((R * (build_model(scene, "")->discretization.quadrature.position.colwise() - pin.center)).colwise() +
                                (pin.center + pin.displacement))).cwiseAbs().maxCoeff();
  CAPTURE(sag);
  CHECK(sag > 0.05);
  CHECK((turned - expected).cwiseAbs().maxCoeff() < 0.01 * sag);
}
