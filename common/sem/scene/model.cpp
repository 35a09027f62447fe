#include "sem/scene/model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "sem/base/error.h"
#include "sem/base/rotation.h"
#include "sem/base/stopwatch.h"
#include "sem/mechanics/loads.h"
#include "sem/mechanics/quadratic_forms.h"
#include "sem/method/material_weights.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"

namespace sem {

using Eigen::VectorXd;

bool matches_part(const std::string& selected, const std::string& solid, const std::string& part) {
  // A half "top.2~1" answers to the name of the whole, "top.2".
  const std::string whole = part.substr(0, part.find('~'));
  const auto is_group = [&](const std::string& name) {
    return whole.starts_with(name) && (whole.size() == name.size() || whole[name.size()] == '.');
  };
  const bool in_solid = selected.starts_with(solid + "/");
  const std::string name = in_solid ? selected.substr(solid.size() + 1) : selected;
  return name == part || is_group(name) || selected == part || is_group(selected);
}

bool has_own_pressure(const MethodOptions& options, const Material& material) {
  if (options.formulation != Formulation::condensed || options.own_pressure == OwnPressure::never) return false;
  return material.poisson_ratio >= 0.4 || (options.own_pressure == OwnPressure::always && material.poisson_ratio > 0);
}

namespace {

// A column of z that a pin leads: moved by displaced * displacement + (R - I) arm.
template <int Dim>
struct LedColumn {
  int column;
  Pin<Dim> pin;
  Vec<Dim> arm;
  double displaced;
};

// Where the columns stand at load factor s.
template <int Dim>
VectorXd led_to(const VectorXd& rest, const std::vector<LedColumn<Dim>>& led, double s) {
  VectorXd z = rest;
  for (const auto& [column, pin, arm, displaced] : led) {
    const Vec<Dim> motion = displaced * s * pin.displacement + (rotation<Dim>(s * pin.rotation) * arm - arm);
    for (int a = 0; a < Dim; ++a)
      if (pin.axes[a]) z[Dim * column + a] += motion[a];
  }
  return z;
}

template <int Dim>
class Builder {
 public:
  Builder(const Scene<Dim>& scene, const std::string& file) : scene_(scene), file_(file) {
    for (const auto& solid : scene.solids)
      for (const auto& part : solid.parts) {
        part_names_.push_back({solid.name, part.name});
        part_materials_.push_back(part.material ? &*part.material : nullptr);
        part_densities_.push_back((part.material ? *part.material : solid.material).density);
      }
  }

  std::unique_ptr<Model<Dim>> build() {
    model_ = std::make_unique<Model<Dim>>();
    discretize_parts();
    timed("materials", [&] { assign_materials(); });
    select_pins();
    timed("operators", [&] { make_operators(); });
    timed("pins", [&] { make_pins(); });
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
    model_->discretization = discretize<Dim>(solids, options, trims);
    model_->cost = model_->discretization.cost;
  }

  // Young's modulus at every part; empty if they are alike within each solid.
  std::vector<double> part_stiffness() const {
    std::vector<double> stiffness;
    bool alike = true;
    for (const auto& solid : scene_.solids) {
      const size_t first = stiffness.size();
      for (const auto& part : solid.parts) {
        stiffness.push_back((part.material ? *part.material : solid.material).youngs_modulus);
        alike &= stiffness.back() == stiffness[first];
      }
    }
    return alike ? std::vector<double>() : stiffness;
  }

  // The solid's material, unless the part in whose region the point lies has its own.
  void assign_materials() {
    const auto& d = model_->discretization;
    auto& field = model_->materials;
    for (const auto& solid : scene_.solids) field.materials.push_back(solid.material);
    std::vector<int> own(part_materials_.size(), -1);
    for (size_t i = 0; i < own.size(); ++i)
      if (part_materials_[i]) {
        own[i] = int(field.materials.size());
        field.materials.push_back(*part_materials_[i]);
      }
    model_->point_mass.resize(d.quadrature.size());
    for (int k = 0; k < d.quadrature.size(); ++k) {
      const int begin = d.weights.begin[k];
      int n = d.weights.begin[k + 1] - begin;
      // Corner patches have no material of their own; they come last.
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
    Clamps<Dim> clamps;
    Pressure<Dim> pressure;
    if (condensed()) {
      clamps = make_clamps();
      pressure = make_pressure(clamps.points());
    }
    const bool mismatch_counts = !condensed() || scene_.kinetic_length > 0;
    const Map<Dim> mismatch = mismatch_counts ? mismatch_map(d.on_boundary, d.samples, d.unknowns) : Map<Dim>();
    const auto plan = plan_of_system(mismatch, clamps, pressure);
    system.mass = mass_matrix(d.interior, model_->point_mass, plan);
    if (scene_.kinetic_length > 0) {
      VectorXd mass = d.samples.weight;
      for (int s = 0; s < d.samples.size(); ++s) mass[s] *= part_densities_[d.samples.part[s]];
      system.mass.add(scene_.kinetic_length, mass_matrix(mismatch, mass, plan));
    }
    SymmetricMatrix stability;
    if (!condensed()) {
      model_->stability = stability = mass_matrix(mismatch, d.samples.weight, plan);
      stability *= model_->stability_stiffness;
    }
    model_->energy = std::make_unique<InternalEnergy<Dim>>(d.interior, d.quadrature.weight, model_->materials, stability,
                                                           std::move(clamps), std::move(pressure), plan);
    system.potential = model_->energy.get();
    system.rest = affine_field<Dim>(d.unknowns, Mat<Dim>::Identity(), Vec<Dim>::Zero());
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
    std::vector<int> components(n, 0), held;  // a bit for each component held
    for (size_t i = 0; i < scene_.pins.size(); ++i)
      for (const auto& pinned : held_columns(int(i)))
        for (int a = 0; a < Dim; ++a) components[pinned.column] |= pinned.axes[a] << a;
    for (int column = 0; column < n; ++column)
      if (components[column] == (1 << Dim) - 1) held.push_back(column);
    return plan_elimination(n, cliques, held);
  }

  // An unknown that a pin holds, and how it leads it (LedColumn).
  struct HeldColumn {
    int column;
    std::array<bool, Dim> axes;
    Vec<Dim> arm;
    double displaced;
  };

  // Condensed: all components of the pin's own columns.
  std::vector<HeldColumn> held_columns(int i) const {
    const auto& pin = scene_.pins[i];
    std::vector<HeldColumn> columns;
    if (condensed()) {
      std::array<bool, Dim> all;
      all.fill(true);
      columns.push_back({first_pin_column_[i], all, Vec<Dim>::Zero(), 1});
      for (int a = 0; a < Dim && !pin.rotation.isZero(0); ++a)
        columns.push_back({first_pin_column_[i] + 1 + a, all, Vec<Dim>::Unit(a), 0});
      return columns;
    }
    const Points<Dim> p = rest_controls(model_->discretization.boundary);
    const auto& d = model_->discretization;
    for (const int control : model_->held[i].controls)
      if (!d.followers.follows(control))
        columns.push_back({unknown_of_control(d.unknowns, control).value(), pin.axes, p.col(control) - pin.center, 1});
    return columns;
  }

  // 10 n^2 E / h with the mean size h of a part and E of the first solid: the
  // scaling of a penalty, stiff enough that the boundary follows the map.
  double default_stiffness() const {
    const auto& d = model_->discretization;
    const double h = std::pow(d.samples.weight.sum() / d.boundary.n_parts(), 1.0 / (Dim - 1));
    const double n = d.projection.monomials.degree();
    return 10 * n * n * scene_.solids[0].material.youngs_modulus / h;
  }

  // Control points selected by a pin, with all that coincide with them.
  std::vector<int> select_controls(const Selector<Dim>& where, const std::string& field) const {
    const auto& boundary = model_->discretization.boundary;
    const Points<Dim> p = rest_controls(boundary);
    std::set<int> controls;
    for (int i = 0; i < boundary.n_parts(); ++i) {
      if (!where.part.empty() && !matches_part(where.part, part_names_[i].first, part_names_[i].second))
        continue;
      const int n = boundary.first_control[i + 1] - boundary.first_control[i];
      for (const int index : where.control_points)
        if (index < 0 || index >= n)
          throw InputError(file_, field + ".control_points", std::to_string(index),
                           "0 to " + std::to_string(n - 1) + " for part '" + part_names_[i].second + "'");
      for (int c = 0; c < n; ++c) {
        const bool listed = where.control_points.empty() ||
                            std::count(where.control_points.begin(), where.control_points.end(), c);
        const int control = boundary.first_control[i] + c;
        if (listed && (!where.box || in_box(*where.box, p.col(control)))) controls.insert(control);
      }
    }
    for (const auto& group : coincident_controls(boundary))
      if (std::any_of(group.begin(), group.end(), [&](int c) { return controls.count(c) > 0; }))
        controls.insert(group.begin(), group.end());
    return {controls.begin(), controls.end()};
  }

  bool in_box(const Box<Dim>& box, const Vec<Dim>& X) const {
    const double tolerance = model_->discretization.boundary.tolerance();
    return ((X - box.lower).array() >= -tolerance).all() && ((box.upper - X).array() >= -tolerance).all();
  }

  bool condensed() const { return scene_.method.formulation == Formulation::condensed; }

  // Which control points the pins hold. Condensed: each pin's displacement becomes columns of z.
  void select_pins() {
    auto& d = model_->discretization;
    for (size_t i = 0; i < scene_.pins.size(); ++i) {
      const std::string field = "pins[" + std::to_string(i) + "]";
      model_->held.push_back({select_controls(scene_.pins[i].where, field), {}});
      const auto& controls = model_->held.back().controls;
      if (std::all_of(controls.begin(), controls.end(), [&](int c) { return d.followers.follows(c); }))
        throw InputError(file_, field, controls.empty() ? "no control point" : "only control points that are trimmed away",
                         "a part, box or index that matches at least one");
    }
    if (!condensed()) return;
    for (const auto& pin : scene_.pins) first_pin_column_.push_back(append_columns(d, pin.rotation.isZero(0) ? 1 : 1 + Dim));
  }

  // A pin holds the boundary where it holds all control points that it depends on, and by a spring
  // those of its control points that neither lie nor coincide with one there.
  Clamps<Dim> make_clamps() const {
    const auto& d = model_->discretization;
    const BoundaryRule<Dim> rule = boundary_rule(d);
    const auto coincident = coincident_controls(d.boundary);
    std::vector<HeldSample> held_samples;
    std::vector<HeldControl<Dim>> springs;
    for (size_t i = 0; i < scene_.pins.size(); ++i) {
      std::set<int> covered = hold_samples(rule.samples, int(i), held_samples);
      for (const auto& group : coincident)
        if (std::any_of(group.begin(), group.end(), [&](int c) { return covered.count(c) > 0; }))
          covered.insert(group.begin(), group.end());
      for (const int control : model_->held[i].controls)
        if (!covered.count(control) && !d.followers.follows(control)) springs.push_back(spring(control, int(i)));
    }
    return Clamps<Dim>(clamped_points(rule, held_samples), std::move(springs));
  }

  struct HeldSample {
    int sample, pin;
  };

  // Appends the samples that depend on held control points alone; returns these control points.
  std::set<int> hold_samples(const Samples<Dim>& samples, int pin, std::vector<HeldSample>& out) const {
    const auto& held = model_->held[pin].controls;
    std::set<int> covered;
    for (int s = 0; s < samples.size(); ++s) {
      const auto begin = samples.column.begin() + samples.row[s], end = samples.column.begin() + samples.row[s + 1];
      if (!std::all_of(begin, end, [&](int c) { return std::binary_search(held.begin(), held.end(), c); })) continue;
      covered.insert(begin, end);
      out.push_back({s, pin});
    }
    return covered;
  }

  ClampedPoints<Dim> clamped_points(const BoundaryRule<Dim>& rule, const std::vector<HeldSample>& held) const {
    const auto& d = model_->discretization;
    const Samples<Dim>& samples = rule.samples;
    const int n = int(held.size()), degree = d.projection.monomials.degree();
    ClampedPoints<Dim> points;
    for (Points<Dim>* list : {&points.position, &points.normal, &points.held}) list->resize(Dim, n);
    points.weight.resize(n);
    points.penalty.resize(n);
    for (int k = 0; k < n; ++k) {
      const int s = held[k].sample, part = samples.part[s], first = samples.first[part];
      const double measure = samples.weight.segment(first, samples.first[part + 1] - first).sum();
      points.position.col(k) = samples.position.col(s);
      points.normal.col(k) = rule.normal.col(s);
      points.held.col(k) = held_axes(held[k].pin);
      points.weight[k] = samples.weight[s];
      const double size = std::min(std::pow(measure, 1.0 / (Dim - 1)), depth_below(samples.position.col(s), rule.normal.col(s)));
      points.penalty[k] = scene_.clamp_penalty * degree * degree / size;
      points.material.push_back(material_of(part));
    }
    points.map = map_at(d, points.position, true);
    for (auto& block : points.map.blocks) subtract_pins(held, points.position, block);
    return points;
  }

  // The pins' displacement d0 + D (X - center) in their columns: d0, then the columns of D if the pin turns.
  Eigen::RowVectorXd pin_row(int pin, const Vec<Dim>& X) const {
    const bool turns = !scene_.pins[pin].rotation.isZero(0);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Ones(turns ? 1 + Dim : 1);
    if (turns) row.template tail<Dim>() = (X - scene_.pins[pin].center).transpose();
    return row;
  }

  // Appends the columns of the pins that hold points of the block: its value becomes that of x - d.
  void subtract_pins(const std::vector<HeldSample>& held, const Points<Dim>& position, MapBlock<Dim>& block) const {
    std::set<int> pins;
    for (const int s : block.points) pins.insert(held[s].pin);
    for (const int pin : pins) {
      const int first = int(block.columns.size()), n = int(pin_row(pin, position.col(0)).size());
      const int n_points = int(block.points.size());
      for (int j = 0; j < n; ++j) block.columns.push_back(first_pin_column_[pin] + j);
      block.value.conservativeResize(n_points, first + n);
      for (int k = 0; k < n_points; ++k) {
        const int s = block.points[k];
        block.value.row(k).tail(n) = held[s].pin == pin ? Eigen::RowVectorXd(-pin_row(pin, position.col(s))) : Eigen::RowVectorXd::Zero(n);
      }
      for (auto& gradient : block.gradient) {
        gradient.conservativeResize(n_points, first + n);
        gradient.rightCols(n).setZero();
      }
    }
  }

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

  // How far the solid reaches below a point of its boundary, m: the inverse inequality that the penalty
  // answers knows no length beyond that.
  double depth_below(const Vec<Dim>& X, const Vec<Dim>& normal) const {
    const auto& boundary = model_->discretization.boundary;
    const double infinity = std::numeric_limits<double>::infinity();
    double depth = infinity;
    std::vector<Hit<Dim>> hits;
    for (const auto& part : boundary.parts) {
      hits.clear();
      append_hits(part, Line<Dim>{X, -normal}, boundary.tolerance(), infinity, hits);
      for (const auto& hit : hits) depth = std::min(depth, hit.t);
    }
    return depth;
  }

  HeldControl<Dim> spring(int control, int pin) const {
    const auto& d = model_->discretization;
    const double size = std::pow(d.boundary.box.diagonal(), Dim - 2);
    const Vec<Dim> X = rest_controls(d.boundary).col(control);
    Eigen::RowVectorXd output = d.unknowns.S.row(control);
    const Eigen::RowVectorXd row = pin_row(pin, X);
    output.segment(first_pin_column_[pin], row.size()) -= row;
    return {output, X, held_axes(pin), 100 * size * material_of(part_of_control(control)).youngs_modulus};
  }

  Vec<Dim> held_axes(int pin) const {
    Vec<Dim> axes;
    for (int a = 0; a < Dim; ++a) axes[a] = scene_.pins[pin].axes[a];
    return axes;
  }

  const Material& material_of(int part) const {
    return part_materials_[part] ? *part_materials_[part]
                                 : scene_.solids[model_->discretization.boundary.solid[part]].material;
  }

  int part_of_control(int control) const {
    const auto& first = model_->discretization.boundary.first_control;
    return int(std::upper_bound(first.begin(), first.end(), control) - first.begin()) - 1;
  }

  void make_pins() {
    System& system = model_->system;
    std::vector<bool> held(system.size(), false);
    std::vector<LedColumn<Dim>> led;
    for (size_t i = 0; i < scene_.pins.size(); ++i) {
      const auto& pin = scene_.pins[i];
      for (const auto& held_column : held_columns(int(i))) {
        for (int a = 0; a < Dim; ++a) {
          const int entry = Dim * held_column.column + a;
          if (held_column.axes[a]) held[entry] = true;
          if (pin.axes[a]) model_->held[i].entries.push_back(entry);
        }
        if (pin.moves()) led.push_back({held_column.column, pin, held_column.arm, held_column.displaced});
      }
    }
    model_->target = led_to(system.rest, led, 1);
    if (std::any_of(led.begin(), led.end(), [](const auto& one) { return !one.pin.rotation.isZero(0); }))
      model_->path = [rest = system.rest, led](double s) { return led_to(rest, led, s); };
    for (int entry = 0; entry < system.size(); ++entry)
      if (!held[entry]) system.free.push_back(entry);
    if (system.free.empty())
      throw InputError(file_, "pins", "all " + std::to_string(system.size()) + " unknowns pinned",
                       "pins that leave something free");

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
        const auto& [solid, name] = part_names_[part];
        const bool here = (load.where.part.empty() || matches_part(load.where.part, solid, name)) &&
                          (!load.where.box || in_box(*load.where.box, X));
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
  std::vector<int> first_pin_column_;  // condensed, per pin
  std::vector<std::pair<std::string, std::string>> part_names_;  // solid, part
  std::vector<const Material*> part_materials_;
  std::vector<double> part_densities_;
  std::unique_ptr<Model<Dim>> model_;
};

}  // namespace

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

template std::unique_ptr<Model<2>> build_model<2>(const Scene<2>&, const std::string&);
template std::unique_ptr<Model<3>> build_model<3>(const Scene<3>&, const std::string&);

}  // namespace sem
