#include "sem/scene/estimate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sem/base/error.h"
#include "sem/base/stopwatch.h"
#include "sem/nurbs/refine.h"
#include "sem/scene/analysis.h"
#include "sem/scene/monitor.h"
#include "sem/solve/modes.h"

namespace sem {
namespace {

using Rows = std::vector<std::vector<double>>;  // a row of values per time of the original run

[[noreturn]] void fail(Status status) { throw std::runtime_error(describe(status)); }

// The values of the scene's analysis; every `stride`-th step is a time of the original run.
template <int Dim>
Rows values_of(const Scene<Dim>& scene, const std::unique_ptr<Model<Dim>>& model, long stride) {
  const Monitor<Dim> monitor(scene, *model);
  State state = model->initial;
  if (scene.analysis.kind == AnalysisKind::modes) {
    const Modes modes = vibration_modes(model->system, state.z, scene.analysis.n_modes);
    if (modes.status != Status::converged) fail(modes.status);
    return {{modes.omega.begin(), modes.omega.end()}};
  }
  if (scene.analysis.kind == AnalysisKind::statics) {
    const auto report = equilibrium(model->system, scene.analysis, model->target, state, model->path);
    if (report.status != Status::converged) fail(report.status);
    return {monitor.probes(state, {})};
  }
  Rows rows;
  const auto report = march(model->system, scene.analysis, state, [&](const State& now, const StepInfo& info) {
    if (now.step % stride == 0) rows.push_back(monitor.probes(now, info.acceleration));
  }, model->set_load());
  if (report.status != Status::converged) fail(report.status);
  return rows;
}

// Every part cut in the middle of its domain, along every parameter; its halves are "name~1" and "name~2".
template <int Dim>
void halve_parts(Scene<Dim>& scene) {
  for (auto& solid : scene.solids)
    for (int axis = 0; axis < Dim - 1; ++axis) {
      std::vector<ScenePart<Dim>> halves;
      for (const auto& part : solid.parts) {
        if (!part.trims.empty()) {  // stay whole: halves would need halves of the loops
          halves.push_back(part);
          continue;
        }
        const Interval u = domain(part.shape, axis);
        int n = 0;
        for (const auto& shape : split_at(part.shape, axis, (u.lower + u.upper) / 2)) {
          halves.push_back(part);
          halves.back().shape = shape;
          halves.back().name += "~" + std::to_string(++n);
        }
      }
      solid.parts = std::move(halves);
    }
}

struct Change {
  const char* setting;
  std::optional<Refinement> refinement;  // none: what `apply` does
  double factor = 1;
};

constexpr const char* twice_penalty = "twice the clamps' penalty";
constexpr const char* twice_gamma = "twice the stability stiffness";
constexpr const char* larger_cutoff = "1.5 times the cutoff";
constexpr const char* lower_degree = "one degree less";

template <int Dim>
std::vector<Change> changes_for(const Scene<Dim>& scene) {
  const bool condensed = scene.method.formulation == Formulation::condensed;
  const double factor = condensed ? 2 : 1;
  std::vector<Change> changes = {{"twice the rays and points", Refinement::quadrature},
                                 {"every part halved", Refinement::parts, factor},
                                 {condensed ? twice_penalty : twice_gamma, {}},
                                 {larger_cutoff, {}}};
  if (scene.method.projection.degree < 4)
    changes.push_back({"one degree more", Refinement::degree, factor});
  else if (!condensed)
    changes.push_back({lower_degree, {}});
  if (scene.analysis.kind == AnalysisKind::dynamics)
    changes.push_back({"half the time step", Refinement::time_step,
                       scene.analysis.integrator == Integrator::implicit_midpoint ? 4. / 3 : 2.});
  return changes;
}

// False if the change cannot be made.
template <int Dim>
bool apply(const Change& change, const Model<Dim>& model, Scene<Dim>& scene) {
  if (change.refinement) return refine(scene, *change.refinement);
  if (change.setting == lower_degree) --scene.method.projection.degree;
  if (change.setting == twice_penalty) scene.clamp_penalty *= 2;
  if (change.setting == twice_gamma) scene.stability_stiffness = 2 * model.stability_stiffness;
  if (change.setting == larger_cutoff) {
    scene.method.weights.sparsity.reset();
    scene.method.weights.cutoff = 1.5 * model.discretization.theta.cutoff;
  }
  return true;
}

}  // namespace

bool ErrorEstimate::complete() const {
  return std::none_of(variations.begin(), variations.end(),
                      [](const Variation& v) { return v.refinement && !v.failure.empty(); });
}

template <int Dim>
Scene<Dim> linear_response(Scene<Dim> scene) {
  for (auto& solid : scene.solids) {
    solid.material.model = MaterialModel::linear;
    for (auto& part : solid.parts)
      if (part.material) part.material->model = MaterialModel::linear;
  }
  if (scene.analysis.kind == AnalysisKind::dynamics) scene.analysis.kind = AnalysisKind::statics;
  return scene;
}

template <int Dim>
bool refine(Scene<Dim>& scene, Refinement refinement) {
  auto& m = scene.method;
  switch (refinement) {
    case Refinement::quadrature:
      m.rays.n_rays *= 2;
      m.interval.points *= 2;
      m.interior_rule.weight_tolerance /= 10;
      m.interval.spacing /= 2;
      m.interior_rule.waves *= 2;
      m.interior_rule.compress *= 2;
      return true;
    case Refinement::parts:
      for (const auto& pin : scene.pins)
        if (!pin.where.control_points.empty()) return false;
      halve_parts(scene);
      return true;
    case Refinement::degree:
      if (m.projection.degree == 4) return false;
      ++m.projection.degree;
      return true;
    case Refinement::time_step:
      scene.analysis.time_step /= 2;
      return scene.analysis.kind == AnalysisKind::dynamics;
  }
  return false;
}

template <int Dim>
ErrorEstimate estimate_error(const Scene<Dim>& scene, const std::string& file, const Announce& announce) {
  if (scene.analysis.kind != AnalysisKind::modes && scene.probes.empty()) return {};
  if (announce) announce("as given");
  const auto model = build_model(scene, file);
  return estimate_error(scene, file, *model, values_of(scene, model, 1), announce);
}

template <int Dim>
ErrorEstimate estimate_error(const Scene<Dim>& scene, const std::string& file, const Model<Dim>& model,
                             const Rows& original, const Announce& announce) {
  ErrorEstimate result;
  const bool modes = scene.analysis.kind == AnalysisKind::modes;
  if ((!modes && scene.probes.empty()) || original.empty()) return result;
  result.value = original.back();
  if (modes)
    for (size_t m = 1; m <= result.value.size(); ++m)
      result.columns.push_back("mode_" + std::to_string(m) + "_rad_s");
  else
    result.columns = Monitor<Dim>(scene, model).probe_columns();
  result.estimate.assign(result.value.size(), 0);
  for (const Change& change : changes_for(scene)) {
    Scene<Dim> varied = scene;
    if (!apply(change, model, varied)) continue;
    Variation variation;
    variation.setting = change.setting;
    variation.refinement = change.refinement;
    variation.factor = change.factor;
    if (announce) announce(change.setting);
    const Stopwatch watch;
    try {
      const auto changed = build_model(varied, file);
      variation.megabytes = changed->megabytes();
      const Rows rows = values_of(varied, changed, change.refinement == Refinement::time_step ? 2 : 1);
      variation.change.assign(result.value.size(), 0);
      for (size_t t = 0; t < std::min(rows.size(), original.size()); ++t)
        for (size_t c = 0; c < std::min(rows[t].size(), variation.change.size()); ++c)
          variation.change[c] = std::max(variation.change[c], std::abs(rows[t][c] - original[t][c]));
      for (size_t c = 0; c < variation.change.size(); ++c)
        result.estimate[c] = std::max(result.estimate[c], change.factor * variation.change[c]);
    } catch (const std::exception& error) {  // no memory for twice the points, too
      variation.failure = error.what();
    }
    variation.seconds = watch.seconds();
    result.variations.push_back(std::move(variation));
  }
  return result;
}

template Scene<2> linear_response<2>(Scene<2>);
template Scene<3> linear_response<3>(Scene<3>);
template bool refine<2>(Scene<2>&, Refinement);
template bool refine<3>(Scene<3>&, Refinement);
template ErrorEstimate estimate_error<2>(const Scene<2>&, const std::string&, const Announce&);
template ErrorEstimate estimate_error<2>(const Scene<2>&, const std::string&, const Model<2>&, const Rows&, const Announce&);
template ErrorEstimate estimate_error<3>(const Scene<3>&, const std::string&, const Announce&);
template ErrorEstimate estimate_error<3>(const Scene<3>&, const std::string&, const Model<3>&, const Rows&, const Announce&);

}  // namespace sem
