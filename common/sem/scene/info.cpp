#include "sem/scene/info.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "sem/scene/accuracy.h"
#include "sem/scene/json_text.h"
#include "sem/scene/read_scene.h"
#include "sem/solve/cholesky.h"

namespace sem {
namespace {

using Json = nlohmann::ordered_json;
using Eigen::MatrixXd;

// Condition of what the analysis factorises, at rest; -1: singular (rigid motions left, say).
template <int Dim>
Json condition_json(const Scene<Dim>& scene, const Model<Dim>& model) {
  const System& system = model.system;
  MatrixXd K(system.size(), system.size());
  if (!std::isfinite(system.potential->energy(system.rest))) return "not available: the rest shape has infinite energy";
  system.potential->hessian(system.rest, false, K);
  const auto estimate = [&](const MatrixXd& full) -> Json {
    const MatrixXd free = full(system.free, system.free);
    Cholesky cholesky(int(free.rows()));
    return cholesky.compute(free) ? Json(cholesky.condition_estimate()) : Json("singular or indefinite");
  };
  Json json;
  json["stiffness"] = estimate(K);
  if (scene.analysis.kind == AnalysisKind::dynamics) {
    const double dt = scene.analysis.time_step;
    json["step_matrix"] = estimate(system.mass + dt * dt * K);
  }
  return json;
}

template <int Dim>
double megabytes(const Model<Dim>& model) {
  const auto& d = model.discretization;
  double numbers = 0;
  for (const auto& block : d.interior.blocks)
    numbers += double(block.points.size()) * double(block.columns.size()) * (Dim + 1);
  for (const auto& block : d.on_boundary.blocks) numbers += double(block.value.size());
  for (const auto& fit : d.projection.parts) numbers += double(fit.coefficients.size());
  const double n = model.system.size(), free = model.n_unknowns();
  numbers += 2 * double(model.mass.size());  // mass, stability
  numbers += 2 * n * n + 2 * free * free;    // expanded mass, Hessian, system matrix, factor
  return 8e-6 * numbers;
}

template <int Dim>
Json info_json(const Scene<Dim>& scene, const Model<Dim>& model) {
  const auto& d = model.discretization;
  Json json;
  json["name"] = scene.name;
  json["parts"] = d.boundary.n_parts();
  json["solids"] = d.boundary.n_solids;
  json["loops"] = d.loops.loops.size();
  json["gaps"] = d.loops.n_gaps;
  json["longest_gap_m"] = d.loops.longest_gap;
  json["parts_of_undecided_orientation"] = std::count(d.loops.orientation.begin(), d.loops.orientation.end(), 0);
  json["control_points"] = d.boundary.n_controls();
  json["unknowns"] = model.n_unknowns();
  json["pinned"] = model.system.size() - model.n_unknowns();
  json["boundary_samples"] = d.samples.size();
  json["rays"] = d.rays.rays.size();
  json["rays_unpaired"] = d.rays.n_unpaired;
  json["quadrature_points"] = d.quadrature.size();
  json["origins"] = d.origins.members.size();
  json["origin_ties"] = d.origins.ties.size();
  json["cutoff_m"] = d.theta.cutoff;
  json["weights_nonzero_share"] = double(d.weights.w.size()) / (double(d.weights.n_points()) * d.boundary.n_parts());
  json["map_fill"] = d.interior.fill();
  json["mass_kg"] = model.total_mass();
  json["stability_stiffness_Pa_per_m"] = model.stability_stiffness;
  json["accuracy"] = to_json(measure_accuracy(model));
  json["condition_estimate"] = condition_json(scene, model);
  json["memory_MB"] = megabytes(model);
  for (const auto& stage : model.cost) json["cost_s"][stage.stage] = stage.seconds;
  scene_to_json(scene, json["settings"]);
  return json;
}

// Lines "key: value", indented; items of a list as [0], [1], ... as --set names them.
void append_lines(const Json& json, int indent, std::string& text) {
  for (const auto& [key, value] : json.items()) {
    text += std::string(indent, ' ') + (json.is_array() ? "[" + key + "]" : key) + ":";
    const bool nested = value.is_object() || (value.is_array() && !value.empty() && value[0].is_structured());
    if (nested) {
      text += "\n";
      append_lines(value, indent + 2, text);
    } else if (value.is_number_float()) {
      char number[40];
      std::snprintf(number, sizeof number, " %.6g\n", value.get<double>());
      text += number;
    } else {
      text += ' ';
      text += value.is_string() ? value.get<std::string>() : value.dump();
      text += '\n';
    }
  }
}

}  // namespace

template <int Dim>
std::string model_info(const Scene<Dim>& scene, const Model<Dim>& model, bool json) {
  Json info = info_json(scene, model);
  if (json) return json_text(info);
  for (auto& solid : info["settings"]["solids"])  // the parts would hide all the rest
    solid["parts"] = std::to_string(solid["parts"].size()) + " parts (shown by --json)";
  std::string text;
  append_lines(info, 0, text);
  return text;
}

template std::string model_info<2>(const Scene<2>&, const Model<2>&, bool);
template std::string model_info<3>(const Scene<3>&, const Model<3>&, bool);

}  // namespace sem
