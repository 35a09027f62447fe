#include "tests/hard_cases/body_checks.h"

#include <cmath>

#include "sem/scene/analysis.h"

namespace sem::stability {

using Eigen::VectorXd;

namespace {

constexpr double strain = 1e-4;  // of a body under its weight: rho g size / E

template <int Dim>
double closed_form_energy(const Material& material, const Mat<Dim>& F) {
  const Mat<Dim> E = (F.transpose() * F - Mat<Dim>::Identity()) / 2;
  return material.lame_lambda() / 2 * E.trace() * E.trace() + material.lame_mu() * E.squaredNorm();
}

// Largest |x(X) - X| / size and |F - I| of the map at z = rest.
template <int Dim>
double identity_error(const Model<Dim>& model, double size) {
  const auto& d = model.discretization;
  const Points<Dim> x = evaluate(d.interior, model.system.rest);
  double error = (x - d.quadrature.position).cwiseAbs().maxCoeff() / size;
  const Points<Dim> y = coefficients(d.interior, model.system.rest);
  for (const auto& block : d.interior.blocks) {
    const Points<Dim> nodes = y(Eigen::all, block.columns);
    for (int a = 0; a < Dim; ++a) {
      const Points<Dim> column = nodes * block.gradient[a].transpose();
      error = std::max(error, (column.colwise() - Vec<Dim>::Unit(a)).cwiseAbs().maxCoeff());
    }
  }
  return error;
}

// Stored energy with the stability term about the rest shape: as a form in z it is all rounding where
// displacements are small.
template <int Dim>
double stored_energy(const Model<Dim>& model, const VectorXd& z) {
  const VectorXd u = z - model.system.rest;
  const double elastic = model.energy->energy(z) - model.energy->stability_energy(z);
  if (model.discretization.unknowns.S.size() > 0) return elastic;  // condensed: no such term
  return elastic + model.stability_stiffness / 2 * u.dot(model.stability * u);
}

double volume_bound(const InteriorOptions& options, const Bounds& bounds) {
  const bool resolved = options.rule == InteriorRule::resolved;
  return bounds.volume + (resolved ? options.weight_tolerance : 10 * options.tolerance);
}

}  // namespace

template <int Dim>
std::string variant(Formulation formulation) {
  return std::string(DimTraits<Dim>::name) + (formulation == Formulation::projected ? " projected" : " condensed");
}

template <int Dim>
Scene<Dim> scene_of(const Body<Dim>& body, Formulation formulation) {
  Scene<Dim> scene;
  scene.name = "hard case";
  int number = 0;
  for (const auto& solid : body.solids) {
    auto& made = scene.solids.emplace_back();
    made.name = "solid" + std::to_string(scene.solids.size());
    made.material = {MaterialModel::stvk, 1e5, 0.3, 1000};
    for (const auto& shape : solid) made.parts.push_back({"part." + std::to_string(++number), shape, {}});
  }
  auto& method = scene.method;
  method.formulation = formulation;
  method.n_threads = 1;
  method.projection.degree = 4 - Dim;
  method.weights.cutoff = body.size;
  method.interior_rule.rule = InteriorRule::split_rays;
  if (Dim == 3) method.interior_rule.tolerance = 1e-6;
  if (formulation == Formulation::condensed) {
    method.weights.variant = DistanceWeight::sided;
    if (Dim == 2) method.interior_rule.rule = InteriorRule::resolved;
  }
  scene.analysis.kind = AnalysisKind::statics;
  scene.output.error_estimate = false;
  scene.output.frame_rate = 0;
  return scene;
}

template <int Dim>
Pin<Dim> pin_on(const std::string& part) {
  Pin<Dim> pin;
  pin.where.part = part;
  pin.axes.fill(true);
  return pin;
}

void require(Status status, const std::string& what) {
  if (status != Status::converged) throw Refusal{what + ": " + describe(status)};
}

template <int Dim>
Mat<Dim> stretch() {
  Mat<Dim> F = Mat<Dim>::Identity();
  F(0, 0) = 1.2;
  F(0, 1) = 0.15;
  F(1, 0) = -0.05;
  F(1, 1) = 0.9;
  return F;
}

template <int Dim>
Mat<Dim> rotation(double angle) {
  Mat<Dim> R = Mat<Dim>::Identity();
  R(0, 0) = R(1, 1) = std::cos(angle);
  R(1, 0) = std::sin(angle);
  R(0, 1) = -R(1, 0);
  return R;
}

template <int Dim>
void check_model(const Scene<Dim>& scene, const Model<Dim>& model, const Body<Dim>& body, const Bounds& bounds,
                 Checks& checks) {
  const auto& d = model.discretization;
  const Material& material = scene.solids[0].material;
  const double of_volume = volume_bound(scene.method.interior_rule, bounds);
  checks.add(std::string(DimTraits<Dim>::volume_name) + " error", d.quadrature.weight.sum() / body.volume - 1,
             of_volume);
  checks.add("identity error", identity_error(model, body.size), bounds.identity);
  const auto energy = [&](const Mat<Dim>& F) {
    return model.energy->energy(affine_field<Dim>(d.unknowns, F, Vec<Dim>::Zero()));
  };
  const double stored = closed_form_energy<Dim>(material, stretch<Dim>()) * body.volume;
  checks.add("affine energy error", energy(stretch<Dim>()) / stored - 1, bounds.energy + of_volume);
  checks.add("energy of a rotation", energy(rotation<Dim>(2.1)) / stored, bounds.energy);
}

template <int Dim>
void check_fall(Scene<Dim> scene, const Body<Dim>& body, const Bounds& bounds, Checks& checks) {
  constexpr int n = 3;
  const double dt = 0.01 * body.size, way = strain * body.size;  // as long beside a wave's time at any size
  scene.pins.clear();
  scene.gravity[1] = -way / (dt * dt * n * (n + 1) / 2);
  scene.analysis = {AnalysisKind::dynamics, Integrator::linearly_implicit_euler, dt, n * dt};
  const auto model = build_model(scene, "");
  const auto& d = model->discretization;
  State state = model->initial;
  require(march(model->system, scene.analysis, state, [](const State&, const StepInfo&) {}).status, "fall");
  Points<Dim> x = evaluate(d.interior, state.z) - d.quadrature.position;
  x.row(1).array() += way;
  checks.add("error of free fall", x.cwiseAbs().maxCoeff() / body.size, bounds.fall);
}

template <int Dim>
double check_hanging(Scene<Dim> scene, const Body<Dim>& body, const Bounds& bounds, Checks& checks) {
  for (auto& solid : scene.solids) {
    solid.material.model = MaterialModel::linear;
    for (auto& part : solid.parts)
      if (part.material) part.material->model = MaterialModel::linear;
  }
  const Material& material = scene.solids[0].material;
  scene.gravity[1] = -strain * material.youngs_modulus / (material.density * body.size);
  scene.pins = {pin_on<Dim>("part.1")};
  const auto model = build_model(scene, "");
  State state = model->initial;
  require(equilibrium(model->system, scene.analysis, model->target, state).status, "statics");
  const VectorXd force = reaction(model->system, state.z);
  Vec<Dim> pin = Vec<Dim>::Zero();
  for (const int entry : model->held[0].entries) pin[entry % Dim] += force[entry];
  const double weight = -scene.gravity[1] * material.density * body.volume;
  pin[1] -= weight;
  checks.add("pin's force - weight", pin.norm() / weight, bounds.balance + volume_bound(scene.method.interior_rule, bounds));
  const double work = model->system.load.dot(state.z - model->system.rest);
  checks.add("work / energy - 2", work / stored_energy(*model, state.z) - 2, 1e-3);
  return work / (weight * body.size);
}

template <int Dim>
double check_body(const Body<Dim>& body, Formulation formulation, const Bounds& bounds,
                  const std::function<void(MethodOptions&)>& method, Checks& checks) {
  Scene<Dim> scene = scene_of(body, formulation);
  if (method) method(scene.method);
  check_model(scene, *build_model(scene, ""), body, bounds, checks);
  check_fall(scene, body, bounds, checks);
  return body.connected ? check_hanging(scene, body, bounds, checks) : 0;
}

#define SEM_INSTANTIATE(Dim)                                                                                \
  template std::string variant<Dim>(Formulation);                                                           \
  template Scene<Dim> scene_of<Dim>(const Body<Dim>&, Formulation);                                         \
  template Pin<Dim> pin_on<Dim>(const std::string&);                                                        \
  template Mat<Dim> stretch<Dim>();                                                                         \
  template Mat<Dim> rotation<Dim>(double);                                                                  \
  template void check_model<Dim>(const Scene<Dim>&, const Model<Dim>&, const Body<Dim>&, const Bounds&,     \
                                 Checks&);                                                                  \
  template void check_fall<Dim>(Scene<Dim>, const Body<Dim>&, const Bounds&, Checks&);                      \
  template double check_hanging<Dim>(Scene<Dim>, const Body<Dim>&, const Bounds&, Checks&);                 \
  template double check_body<Dim>(const Body<Dim>&, Formulation, const Bounds&,                             \
                                  const std::function<void(MethodOptions&)>&, Checks&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem::stability
