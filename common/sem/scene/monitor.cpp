#include "sem/scene/monitor.h"

namespace sem {

using Eigen::VectorXd;

namespace {

std::string axis(int a) { return std::string(1, "xyz"[a]); }

// Columns of a probe, with the units.
template <int Dim>
std::vector<std::string> columns_of(const Probe<Dim>& probe) {
  std::vector<std::string> columns;
  if (probe.kind == ProbeKind::stress) {
    for (int i = 0; i < Dim; ++i)
      for (int j = i; j < Dim; ++j) columns.push_back(probe.name + "_s" + axis(i) + axis(j) + "_Pa");
  } else {
    const char* unit = probe.kind == ProbeKind::reaction ? "_N" : "_m";
    for (int a = 0; a < Dim; ++a) columns.push_back(probe.name + "_" + axis(a) + unit);
  }
  return columns;
}

}  // namespace

template <int Dim>
Monitor<Dim>::Monitor(const Scene<Dim>& scene, const Model<Dim>& model) : scene_(scene), model_(model) {
  const auto& d = model.discretization;
  for (const auto& probe : scene.probes) {
    const auto columns = columns_of(probe);
    probe_columns_.insert(probe_columns_.end(), columns.begin(), columns.end());
    for (size_t c = 0; c < columns.size(); ++c)
      probe_truths_.push_back(probe.truth && probe.truth_axes[c] ? std::optional((*probe.truth)[c]) : std::nullopt);
    const bool at_point = probe.kind != ProbeKind::reaction;
    probe_maps_.push_back(at_point ? map_at<Dim>(d, probe.at, probe.kind == ProbeKind::stress)
                                   : Map<Dim>());
    int nearest = 0;
    if (at_point) (d.quadrature.position.colwise() - probe.at).colwise().squaredNorm().minCoeff(&nearest);
    probe_material_.push_back(model.materials.of_point[nearest]);
    const Material& material = model.materials.materials[probe_material_.back()];
    probe_pressure_.emplace_back();
    if (probe.kind == ProbeKind::stress && has_own_pressure(scene.method, material))
      probe_pressure_.back() = field_at<Dim>(d, model.pressure, probe.at).row(0);
  }
  const bool massless = model.total_mass() == 0;
  const VectorXd share = massless ? d.quadrature.weight : model.point_mass;
  centroid_ = evaluate_transposed<Dim>(d.interior, Vec<Dim>::Ones() * share.transpose() / share.sum()).row(0);
}

template <int Dim>
std::vector<std::string> Monitor<Dim>::columns() const {
  std::vector<std::string> columns = {"step",     "time_s",     "kinetic_J", "elastic_J", "stability_J",
                                      "load_J",   "total_J",    "iterations", "residual", "substeps"};
  for (int a = 0; a < Dim; ++a) columns.push_back("centroid_" + axis(a) + "_m");
  for (int a = 0; a < Dim; ++a) columns.push_back("momentum_" + axis(a) + "_kg_m_s");
  for (int a = 3 - DimTraits<Dim>::n_rotations; a < 3; ++a)
    columns.push_back("angular_momentum_" + axis(a) + "_kg_m2_s");
  columns.push_back("boundary_mismatch");
  columns.insert(columns.end(), probe_columns_.begin(), probe_columns_.end());
  return columns;
}

template <int Dim>
std::vector<double> Monitor<Dim>::probes(const State& state, const VectorXd& acceleration) const {
  VectorXd reactions, own_pressure;
  std::vector<double> values;
  for (size_t i = 0; i < scene_.probes.size(); ++i) {
    const auto& probe = scene_.probes[i];
    if (probe.kind == ProbeKind::displacement) {
      const Vec<Dim> u = evaluate(probe_maps_[i], state.z).col(0) - probe.at;
      values.insert(values.end(), u.begin(), u.end());
    } else if (probe.kind == ProbeKind::stress) {
      if (probe_pressure_[i].size() > 0 && own_pressure.size() == 0)
        own_pressure = model_.energy->pressure_coefficients(state.z);
      const double pressure = probe_pressure_[i].size() > 0 ? probe_pressure_[i].dot(own_pressure) : 0;
      const Mat<Dim> stress = cauchy_stress<Dim>(model_.materials.materials[probe_material_[i]],
                                                 deformation_gradient(probe_maps_[i].blocks[0], 0, coefficients(probe_maps_[i], state.z)),
                                                 probe_pressure_[i].size() > 0 ? &pressure : nullptr);
      for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) values.push_back(stress(a, b));
    } else {
      if (reactions.size() == 0) reactions = reaction(model_.system, state.z, acceleration);
      Vec<Dim> sum = Vec<Dim>::Zero();
      for (const int entry : model_.held[probe.pin].entries) sum[entry % Dim] += reactions[entry];
      values.insert(values.end(), sum.begin(), sum.end());
    }
  }
  return values;
}

// From the differences themselves: the quadratic form in z would cancel below 1e-8.
template <int Dim>
double Monitor<Dim>::boundary_mismatch(const State& state) const {
  const auto& d = model_.discretization;
  const Points<Dim> p = control_points(d.unknowns, state.z);
  Points<Dim> difference = evaluate(d.on_boundary, state.z);
  for (int s = 0; s < d.samples.size(); ++s)
    for (int e = d.samples.row[s]; e < d.samples.row[s + 1]; ++e)
      difference.col(s) -= d.samples.value[e] * p.col(d.samples.column[e]);
  const double integral = difference.colwise().squaredNorm().dot(d.samples.weight);
  return std::sqrt(integral / d.samples.weight.sum()) / d.boundary.box.diagonal();
}

template <int Dim>
std::vector<double> Monitor<Dim>::row(const State& state, const VectorXd& acceleration, int iterations,
                                      double residual, int n_substeps) const {
  const int n = model_.discretization.unknowns.size();
  const Eigen::Map<const Points<Dim>> nodes(state.z.data(), Dim, n), rates(state.v.data(), Dim, n);
  const Points<Dim> momenta = (model_.system.mass * state.v).reshaped(Dim, n);
  const double kinetic = rates.cwiseProduct(momenta).sum() / 2;
  const double elastic = model_.energy->elastic_energy(state.z);
  const double stability = model_.energy->stability_energy(state.z);
  const double load = -model_.system.load.dot(state.z);
  std::vector<double> row = {double(state.step), state.time, kinetic, elastic, stability, load,
                             kinetic + elastic + stability + load, double(iterations), residual,
                             double(n_substeps)};
  Vec<Dim> centroid = Vec<Dim>::Zero(), momentum = Vec<Dim>::Zero();
  auto angular = DimTraits<Dim>::cross(Vec<Dim>::Zero(), Vec<Dim>::Zero());
  for (int j = 0; j < n; ++j) {
    centroid += centroid_[j] * nodes.col(j);
    momentum += model_.discretization.unknowns.one[j] * momenta.col(j);
    angular += DimTraits<Dim>::cross(nodes.col(j), momenta.col(j));
  }
  row.insert(row.end(), centroid.begin(), centroid.end());
  row.insert(row.end(), momentum.begin(), momentum.end());
  row.insert(row.end(), angular.begin(), angular.end());
  row.push_back(boundary_mismatch(state));
  const auto values = probes(state, acceleration);
  row.insert(row.end(), values.begin(), values.end());
  return row;
}

template class Monitor<2>;
template class Monitor<3>;

}  // namespace sem
