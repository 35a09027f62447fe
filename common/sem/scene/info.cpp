#include "sem/scene/info.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>

#include "sem/base/stopwatch.h"
#include "sem/scene/accuracy.h"
#include "sem/scene/accuracy_goal.h"
#include "sem/scene/info_text.h"
#include "sem/scene/json_text.h"
#include "sem/scene/read_scene.h"
#include "sem/scene/summary.h"
#include "sem/solve/sparse_cholesky.h"

namespace sem {
namespace {

using Json = nlohmann::ordered_json;

double seconds_of(const std::function<void()>& work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
}

// How often the analysis makes a Hessian and a factorisation. Newton's method: 5 iterations from rest are usual, 20
// where a material has a pressure of its own; 3 in a step of time.
template <int Dim>
double n_factorizations(const Scene<Dim>& scene, const System& system) {
  const Analysis& analysis = scene.analysis;
  const bool once = system.potential->quadratic();
  const bool pressure = std::any_of(scene.solids.begin(), scene.solids.end(), [&](const auto& solid) {
    return has_own_pressure(scene.method, solid.material);
  });
  switch (analysis.kind) {
    case AnalysisKind::statics: return once ? 1 : (pressure ? 20 : 5) * analysis.load_steps;
    case AnalysisKind::modes: return 1;
    case AnalysisKind::dynamics: break;
  }
  if (once) return 1;
  return double(n_steps(analysis)) * (analysis.integrator == Integrator::linearly_implicit_euler ? 1 : 3);
}

// What the analysis factorises, at rest: its condition, and the cost of it as often as the analysis needs it.
template <int Dim>
void add_tangent(const Scene<Dim>& scene, const Model<Dim>& model, Json& json) {
  const System& system = model.system;
  if (!std::isfinite(system.potential->energy(system.rest))) {
    json["condition_estimate"] = "not available: the rest shape has infinite energy";
    return;
  }
  SymmetricMatrix K = system.potential->new_hessian();
  const double assembly = seconds_of([&] { system.potential->hessian(system.rest, false, K); });
  double factorization = 0;
  SparseCholesky cholesky(K.plan(), K.components(), system.free);
  const auto estimate = [&](const SymmetricMatrix& matrix) -> Json {
    bool regular = false;
    factorization = seconds_of([&] { regular = cholesky.compute(matrix); });
    return regular ? Json(cholesky.condition_estimate()) : Json("singular or indefinite");
  };
  json["condition_estimate"]["stiffness"] = estimate(K);
  if (scene.analysis.kind == AnalysisKind::dynamics) {
    const double dt = scene.analysis.time_step;
    K *= dt * dt;
    K.add(1, system.mass);
    json["condition_estimate"]["step_matrix"] = estimate(K);
  }
  // The eigenvalue problem beside its factorisation of n^3 / 3: reduction 2 n^3, tridiagonalisation 4/3 n^3,
  // QR iteration with vectors 6 n^3.
  const double eigen = scene.analysis.kind == AnalysisKind::modes ? 28 * factorization : 0;
  const double n = n_factorizations(scene, system);
  json["predicted"] = {{"factorizations", n},
                       {"seconds_of_an_assembly", assembly},
                       {"seconds_of_a_factorization", factorization},
                       {"analysis_seconds", n * (assembly + factorization) + eigen}};
}

// Of the probes or frequencies of the linear response; text where there is none.
template <int Dim>
Json predicted_error(const Scene<Dim>& scene, const std::string& file, const Announce& announce) {
  if (!scene.output.error_estimate) return "not asked for (output.error_estimate)";
  const Scene<Dim> linear = linear_response(scene);
  try {
    const ErrorEstimate estimate = estimate_error(linear, file, announce);
    if (estimate.columns.empty()) return "nothing to judge: no probes";
    const double error = relative_error(linear, estimate);
    return std::isfinite(error) ? Json(error) : Json("unknown: a probe stays at zero");
  } catch (const std::exception& error) {
    return std::string("unknown: ") + error.what();
  }
}

template <int Dim>
const char* measure_name() {
  return DimTraits<Dim>::param_dim == 1 ? "length_m" : "area_m2";
}

// Every part: its length or area, trims, and on which side the material is (0: not decided).
template <int Dim>
Json part_list(const Scene<Dim>& scene, const Discretization<Dim>& d, const std::vector<double>& measures) {
  Json list;
  for (const auto& solid : scene.solids)
    for (const auto& part : solid.parts) {
      const size_t i = list.size();
      list.push_back({{"solid", solid.name},
                      {"name", part.name},
                      {measure_name<Dim>(), measures[i]},
                      {"trim_loops", part.trims.size()},
                      {"orientation", d.loops.orientation[i]}});
    }
  return list;
}

template <int Dim>
Json info_json(const Scene<Dim>& scene, const Model<Dim>& model, const std::string& file, const Announce& announce) {
  const auto& d = model.discretization;
  Json json;
  json["name"] = scene.name;
  json["parts"] = d.boundary.n_parts();
  json["solids"] = d.boundary.n_solids;
  json["loops"] = d.loops.loops.size();
  json["gaps"] = d.loops.n_gaps;
  json["longest_gap_m"] = d.loops.longest_gap;
  for (const auto& loop : d.loops.loops)
    json["shells"].push_back({{"solid", scene.solids[loop.solid].name},
                              {"parts", loop.parts.size()},
                              {"depth", loop.depth},
                              {"closed", loop.closed()},
                              {"free_edges", loop.n_free_borders},
                              {"widest_gap_m", loop.gap}});
  json["parts_of_undecided_orientation"] = std::count(d.loops.orientation.begin(), d.loops.orientation.end(), 0);
  const auto measures = part_measures(d.boundary);
  json[std::string("boundary_") + measure_name<Dim>()] = std::accumulate(measures.begin(), measures.end(), 0.0);
  json["free_edges"] = d.loops.n_free_borders;
  json["part_list"] = part_list(scene, d, measures);
  json["control_points"] = d.boundary.n_controls();
  json["unknowns"] = model.n_unknowns();
  json["pinned"] = model.system.size() - model.n_unknowns();
  json["boundary_samples"] = d.samples.size();
  json["rays"] = d.rays.rays.size();
  json["rays_unpaired"] = d.rays.n_unpaired;
  json["quadrature_points"] = d.quadrature.size();
  json["joint_patches"] = d.patches.size();
  json["layers"] = d.layers.size();
  json["origins"] = d.origins.members.size();
  json["origin_ties"] = d.origins.ties.size();
  json["cutoff_m"] = d.theta.cutoff;
  json["weights_nonzero_share"] = double(d.weights.w.size()) / (double(d.weights.n_points()) * d.weights.n_parts);
  json["map_fill"] = d.interior.fill();
  json["mass_kg"] = model.total_mass();
  json["stability_stiffness_Pa_per_m"] = model.stability_stiffness;
  const auto accuracy = measure_accuracy(model);
  json["accuracy"] = to_json(accuracy);
  add_tangent(scene, model, json);
  json["predicted"]["relative_error_of_linear_response"] = predicted_error(scene, file, announce);
  json["memory_MB"] = model.megabytes();
  json["stages"] = stages_json(model.cost, stage_errors(model.cost, accuracy));
  scene_to_json(scene, json["settings"]);
  return json;
}

}  // namespace

template <int Dim>
std::string model_info(const Scene<Dim>& scene, const Model<Dim>& model, bool json, const std::string& file,
                       const Announce& announce) {
  const Json info = info_json(scene, model, file, announce);
  return json ? json_text(info) : info_text(info, Dim);
}

template std::string model_info<2>(const Scene<2>&, const Model<2>&, bool, const std::string&, const Announce&);
template std::string model_info<3>(const Scene<3>&, const Model<3>&, bool, const std::string&, const Announce&);

}  // namespace sem
