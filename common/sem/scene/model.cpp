#include "sem/scene/model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "sem/base/error.h"
#include "sem/base/stopwatch.h"
#include "sem/mechanics/consistent_weights.h"
#include "sem/mechanics/loads.h"
#include "sem/mechanics/quadratic_forms.h"
#include "sem/method/material_weights.h"
#include "sem/nurbs/closest.h"

namespace sem {

using Eigen::VectorXd;

bool has_own_pressure(const MethodOptions& options, const Material& material) {
  if (options.formulation != Formulation::condensed || options.own_pressure == OwnPressure::never) return false;
  return material.poisson_ratio >= 0.4 || (options.own_pressure == OwnPressure::always && material.poisson_ratio > 0);
}

namespace {

template <int Dim>
class Builder {
 public:
  Builder(const Scene<Dim>& scene, const std::string& file)
      : scene_(scene), file_(file), parts_(part_infos(scene)) {}

  std::unique_ptr<Model<Dim>> build() {
    model_ = std::make_unique<Model<Dim>>();
    discretize_parts();
    if (condensed()) timed("divergence theorem", [&] { balance_weights(); });
    timed("materials", [&] { assign_materials(); });
    pins_.emplace(scene_, parts_, file_, model_->discretization);
    timed("operators", [&] { make_operators(); });
    timed("pins", [&] { set_pins(); });
    timed("loads", [&] { make_loads(); });
    check_probes();
    return std::move(model_);
  }

 private:
  template <class Stage>
  void timed(const char* name, const Stage& stage) {
    const Stopwatch watch;
    stage();
    model_->cost.push_back({name, watch.seconds()});
  }

  void discretize_parts() {
    std::vector<std::vector<Nurbs<Dim - 1, Dim>>> solids;
    std::vector<TrimLoops> trims;
    for (const auto& solid : scene_.solids) {
      solids.emplace_back();
      for (const auto& part : solid.parts) {
        solids.back().push_back(part.shape);
        trims.push_back(part.trims);
      }
    }
    MethodOptions options = scene_.method;
    options.stiffness = part_stiffness();
    for (const PartInfo& part : parts_)
      options.volume_stiffness =
          std::max(options.volume_stiffness, part.material->lame_lambda() / part.material->lame_mu());
    options.condition = boundary_conditions();
    options.near_differences = scene_.pins.empty();  // pins take control points out of the system one by one
    model_->discretization = discretize<Dim>(solids, options, trims);
    model_->cost = model_->discretization.cost;
  }

  void balance_weights() {
    auto& d = model_->discretization;
    const ConsistentWeights weights = consistent_weights(d);
    model_->divergence_defect = weights.reached ? weights.defect : std::numeric_limits<double>::infinity();
    if (!weights.reached) return;
    d.boundary_factor = weights.boundary.cwiseQuotient(boundary_rule(d).samples.weight);
    d.quadrature.weight = weights.interior;
  }

  // Young's modulus at every part; empty if they are alike within each solid.
  std::vector<double> part_stiffness() const {
    std::vector<double> stiffness;
    bool alike = true;
    for (size_t i = 0; i < parts_.size(); ++i) {
      stiffness.push_back(parts_[i].material->youngs_modulus);
      alike &= i == 0 || parts_[i].solid != parts_[i - 1].solid || stiffness[i] == stiffness[i - 1];
    }
    return alike ? std::vector<double>() : stiffness;
  }

  // What pins and boundary loads do to a part that they act on as a whole: parts with the same number are held, led
  // and loaded alike.
  std::vector<int> boundary_conditions() const {
    Box<Dim> box;
    for (const auto& solid : scene_.solids)
      for (const auto& part : solid.parts)
        for (const auto& p : part.shape.control_points.colwise()) box.include(Vec<Dim>(p));
    const double tolerance = 1e-9 * box.diagonal();
    std::map<std::vector<double>, int> number;
    std::vector<int> condition;
    for (const auto& solid : scene_.solids)
      for (const auto& part : solid.parts) {
        const PartInfo& info = parts_[condition.size()];
        std::vector<double> acting;
        for (int a = 0; a < Dim; ++a)
          for (const auto& pin : scene_.pins)
            if (pin.axes[a] && selects_all(pin.where, info, part.shape, tolerance)) {
              acting.push_back(a);
              for (const auto& list : {pin.displacement, pin.center}) acting.insert(acting.end(), list.begin(), list.end());
              acting.insert(acting.end(), pin.rotation.begin(), pin.rotation.end());
            }
        Vec<Dim + 1> load = Vec<Dim + 1>::Zero(), swing = load;
        for (const auto& one : scene_.boundary_loads)
          if (selects_all(one.where, info, part.shape, tolerance)) {
            Vec<Dim + 1> both;
            both << one.traction, one.pressure;
            load += both;
            swing += one.oscillation.amplitude * both;
          }
        acting.insert(acting.end(), load.begin(), load.end());
        acting.insert(acting.end(), swing.begin(), swing.end());
        condition.push_back(number.emplace(acting, int(number.size())).first->second);
      }
    return condition;
  }

  // The solid's material, unless the part in whose region the point lies has its own.
  void assign_materials() {
    const auto& d = model_->discretization;
    auto& field = model_->materials;
    for (const auto& solid : scene_.solids) field.materials.push_back(solid.material);
    std::vector<int> own(parts_.size(), -1);
    for (size_t i = 0; i < own.size(); ++i)
      if (parts_[i].own) {
        own[i] = int(field.materials.size());
        field.materials.push_back(*parts_[i].own);
      }
    model_->point_mass.resize(d.quadrature.size());
    for (int k = 0; k < d.quadrature.size(); ++k) {
      const int begin = d.weights.begin[k];
      int n = d.weights.begin[k + 1] - begin;
      // Patches at joints have no material of their own; they come last.
      while (n > 0 && d.weights.part[begin + n - 1] >= d.boundary.n_parts()) --n;
      const int part = n == 0 ? -1 : part_of_region(d.options.stiffness, d.boundary.solid, &d.weights.part[begin], &d.weights.w[begin], n);
      const int m = part >= 0 && own[part] >= 0 ? own[part] : d.quadrature.solid[k];
      field.of_point.push_back(m);
      model_->point_mass[k] = field.materials[m].density * d.quadrature.weight[k];
    }
  }

  void make_operators() {
    const auto& d = model_->discretization;
    System& system = model_->system;
    model_->stability_stiffness =
        scene_.stability_stiffness > 0 ? scene_.stability_stiffness : default_stiffness();
    Clamps<Dim> clamps = pins_->clamps();
    Pressure<Dim> pressure;
    if (condensed()) pressure = make_pressure(clamps.points());
    const bool mismatch_counts = !condensed() || scene_.kinetic_length > 0;
    const Map<Dim> mismatch = mismatch_counts ? mismatch_map(d.on_boundary, d.samples, d.unknowns) : Map<Dim>();
    const auto plan = plan_of_system(mismatch, clamps, pressure);
    system.mass = mass_matrix(d.interior, model_->point_mass, plan);
    if (scene_.kinetic_length > 0) {
      VectorXd mass = d.samples.weight;
      for (int s = 0; s < d.samples.size(); ++s) mass[s] *= parts_[d.samples.part[s]].material->density;
      system.mass.add(scene_.kinetic_length, mass_matrix(mismatch, mass, plan));
    }
    SymmetricMatrix stability;
    if (!condensed()) {
      model_->stability = stability = mass_matrix(mismatch, d.samples.weight, plan);
      stability *= model_->stability_stiffness;
    }
    system.rest = affine_field<Dim>(d.unknowns, Mat<Dim>::Identity(), Vec<Dim>::Zero());
    model_->energy = std::make_unique<InternalEnergy<Dim>>(d.interior, d.quadrature.weight, model_->materials, stability,
                                                           std::move(clamps), std::move(pressure), plan, unresisted(stability));
    system.potential = model_->energy.get();
  }

  // The rest shape is among them unless the fit loses it (the draft's), beyond rounding.
  Unresisted unresisted(const SymmetricMatrix& stability) const {
    Unresisted fields{model_->discretization.unknowns.one, {}};
    if (condensed()) return fields;
    const VectorXd &rest = model_->system.rest, force = stability * rest;
    VectorXd terms = rest;
    stability.absolute_product(rest, terms);
    if (force.norm() <= 1e-10 * terms.norm()) fields.rest = rest;
    return fields;
  }

  // The order in which the unknowns are eliminated; those that pins hold in all components never are.
  std::shared_ptr<const Elimination> plan_of_system(const Map<Dim>& mismatch, const Clamps<Dim>& clamps,
                                                    const Pressure<Dim>& pressure) const {
    const auto& d = model_->discretization;
    const int n = d.unknowns.size();
    std::vector<std::vector<int>> cliques = couplings(d.interior);
    for (const auto& more : {couplings(mismatch), clamps.couplings()}) cliques.insert(cliques.end(), more.begin(), more.end());
    if (!pressure.empty()) {
      cliques.emplace_back(n);
      std::iota(cliques.back().begin(), cliques.back().end(), 0);
    }
    return plan_elimination(n, cliques, pins_->held_nodes());
  }

  // 10 n^2 E / h with the mean size h of a part and E of the first solid: the
  // scaling of a penalty, stiff enough that the boundary follows the map.
  double default_stiffness() const {
    const auto& d = model_->discretization;
    const double h = std::pow(d.samples.weight.sum() / d.boundary.n_parts(), 1.0 / (Dim - 1));
    const double n = d.projection.monomials.degree();
    return 10 * n * n * scene_.solids[0].material.youngs_modulus / h;
  }

  bool condensed() const { return scene_.method.formulation == Formulation::condensed; }

  // The pressure of the materials that have one of their own, a degree below the map's; empty if none has.
  Pressure<Dim> make_pressure(const ClampedPoints<Dim>& clamps) {
    const auto& d = model_->discretization;
    const auto& field = model_->materials;
    PressureFunctions<Dim> functions;
    functions.lambda = VectorXd::Zero(d.quadrature.size());
    VectorXd volume = VectorXd::Zero(d.quadrature.size());
    for (int k = 0; k < d.quadrature.size(); ++k) {
      const Material& material = field.materials[field.of_point[k]];
      if (!has_own_pressure(scene_.method, material)) continue;
      functions.lambda[k] = material.lame_lambda();
      volume[k] = d.quadrature.weight[k];
    }
    if (volume.isZero(0)) return {};
    if (scene_.method.kept_columns > 0)
      throw InputError(file_, "method.kept_columns", std::to_string(scene_.method.kept_columns),
                       "0 with a material that has a pressure of its own (method.own_pressure)");
    model_->pressure = blended_field(d.quadrature.position, volume, d.weights, scene_.method.projection.degree - 1);
    const auto& basis = model_->pressure;
    functions.interior = blended_map(d.quadrature.position, d.weights, basis.origins, basis.projection,
                                     basis.n_functions, false);
    functions.on_clamps = Eigen::MatrixXd::Zero(clamps.size(), basis.n_functions);
    if (clamps.size() > 0) functions.on_clamps = field_at(d, basis, clamps.position);
    for (int s = 0; s < clamps.size(); ++s) {
      functions.clamp_mixed.push_back(has_own_pressure(scene_.method, clamps.material[s]));
      if (!functions.clamp_mixed[s]) functions.on_clamps.row(s).setZero();
    }
    return Pressure<Dim>(std::move(functions), d.quadrature.weight);
  }

  // What the pins hold and lead, and how the rest starts.
  void set_pins() {
    System& system = model_->system;
    system.free = pins_->free_entries();
    model_->held = pins_->held();
    model_->target = pins_->target(system.rest);
    model_->path = pins_->path(system.rest);
    system.motion = pins_->motion(system.rest);

    const auto& d = model_->discretization;
    const double mass = model_->total_mass();
    const Vec<Dim> center = mass > 0 ? Vec<Dim>(d.quadrature.position * model_->point_mass / mass)
                                     : Vec<Dim>(quadrature_center());
    model_->initial.z = system.rest;
    // v(X) = velocity + W (X - center), W the spin about z; pinned entries do not move.
    Mat<Dim> W = Mat<Dim>::Zero();
    W(1, 0) = scene_.angular_velocity;
    W(0, 1) = -scene_.angular_velocity;
    const VectorXd v = affine_field<Dim>(d.unknowns, W, scene_.velocity - W * center);
    model_->initial.v = VectorXd::Zero(system.size());
    model_->initial.v(system.free) = v(system.free);
  }

  Vec<Dim> quadrature_center() const {
    const auto& q = model_->discretization.quadrature;
    return q.position * q.weight / q.weight.sum();
  }

  void make_loads() {
    const auto& d = model_->discretization;
    model_->load.constant = VectorXd::Zero(model_->system.size());
    if (!scene_.gravity.isZero(0)) add_body_force<Dim>(d.interior, model_->point_mass, scene_.gravity, model_->load.constant);
    for (const auto& load : scene_.body_loads) {
      VectorXd volume = d.quadrature.weight;
      if (!load.solid.empty())
        for (int k = 0; k < d.quadrature.size(); ++k)
          if (scene_.solids[d.quadrature.solid[k]].name != load.solid) volume[k] = 0;
      add_body_force<Dim>(d.interior, volume, load.force, force_of(load.oscillation));
    }
    for (const auto& load : scene_.point_loads) {
      require_in_body(load.at, "loads[" + std::to_string(load.index) + "].at");
      add_point_force<Dim>(d, load.at, load.force, force_of(load.oscillation));
    }
    for (const auto& load : scene_.boundary_loads) {
      const Traction<Dim> traction = [&](int part, const Vec<Dim>& X, const Vec<Dim>& normal) -> Vec<Dim> {
        const bool here = (load.where.part.empty() || matches_part(load.where.part, parts_[part])) &&
                          (!load.where.box || in_box(*load.where.box, X, d.boundary.tolerance()));
        if (!here) return Vec<Dim>::Zero();
        return load.traction - load.pressure * normal;
      };
      if (add_traction<Dim>(d, traction, force_of(load.oscillation)) == 0 && (load.pressure != 0 || !load.traction.isZero(0)))
        throw InputError(file_, "loads[" + std::to_string(load.index) + "]",
                         "no boundary", "a part or box that matches some of it");
    }
    model_->system.load = model_->load.mean();
  }

  // Where a load's force is added up.
  VectorXd& force_of(const Oscillation& oscillation) {
    auto& load = model_->load;
    if (oscillation.amplitude == 0) return load.constant;
    load.periodic.push_back({VectorXd::Zero(load.constant.size()), oscillation});
    return load.periodic.back().force;
  }

  void require_in_body(const Vec<Dim>& X, const std::string& field) const {
    const auto& d = model_->discretization;
    if (inside(d.boundary, d.loops, X)) return;
    const double near = 1e-6 * d.boundary.box.diagonal();
    for (const auto& part : d.boundary.parts)
      if (closest_point(part, X, 2 * near).distance <= near) return;
    std::string text;
    for (int a = 0; a < Dim; ++a) text += (a ? ", " : "[") + std::to_string(X[a]);
    throw InputError(file_, field, text + "] outside of the body", "a rest point in or on it");
  }

  void check_probes() const {
    for (size_t i = 0; i < scene_.probes.size(); ++i)
      if (scene_.probes[i].kind != ProbeKind::reaction)
        require_in_body(scene_.probes[i].at, "probes[" + std::to_string(i) + "].at");
  }

  const Scene<Dim>& scene_;
  const std::string& file_;
  const std::vector<PartInfo> parts_;
  std::optional<Pins<Dim>> pins_;
  std::unique_ptr<Model<Dim>> model_;
};

}  // namespace

template <int Dim>
double Model<Dim>::megabytes() const {
  const auto& d = discretization;
  double numbers = 0;
  for (const auto& block : d.interior.blocks)
    numbers += double(block.points.size()) * double(block.columns.size()) * (Dim + 1);
  for (const auto& block : d.on_boundary.blocks) numbers += double(block.value.size());
  for (const auto& fit : d.projection.parts) numbers += double(fit.coefficients.size());
  const double entries = double(system.mass.plan()->n_entries);
  numbers += (2 + 3 * Dim * Dim) * entries;  // mass, stability; Hessian, system matrix, factor
  return 8e-6 * numbers;
}

template <int Dim>
std::unique_ptr<Model<Dim>> build_model(const Scene<Dim>& scene, const std::string& file) {
  try {
    return Builder<Dim>(scene, file).build();
  } catch (const InputError& error) {
    // Stages know the field, not the file.
    if (file.empty() || std::string(error.what()).starts_with(file)) throw;
    throw InputError(file, error);
  }
}

template double Model<2>::megabytes() const;
template double Model<3>::megabytes() const;
template std::unique_ptr<Model<2>> build_model<2>(const Scene<2>&, const std::string&);
template std::unique_ptr<Model<3>> build_model<3>(const Scene<3>&, const std::string&);

}  // namespace sem
