#include "sem/scene/estimate.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "sem/base/error.h"
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
Rows values_of(const Scene<Dim>& scene, const std::string& file, long stride) {
  const auto model = build_model(scene, file);
  const Monitor<Dim> monitor(scene, *model);
  State state = model->initial;
  if (scene.analysis.kind == AnalysisKind::modes) {
    const Modes modes = vibration_modes(model->system, state.z, scene.analysis.n_modes);
    if (modes.status != Status::converged) fail(modes.status);
    return {{modes.omega.begin(), modes.omega.end()}};
  }
  if (scene.analysis.kind == AnalysisKind::statics) {
    const auto report = equilibrium(model->system, scene.analysis, model->target, state);
    if (report.status != Status::converged) fail(report.status);
    return {monitor.probes(state, {})};
  }
  Rows rows;
  const auto report = march(model->system, scene.analysis, state, [&](const State& now, const StepInfo& info) {
    if (now.step % stride == 0) rows.push_back(monitor.probes(now, info.acceleration));
  });
  if (report.status != Status::converged) fail(report.status);
  return rows;
}

// Every part cut in the middle of its domain, along every parameter.
template <int Dim>
void halve_parts(Scene<Dim>& scene) {
  for (auto& solid : scene.solids)
    for (int axis = 0; axis < Dim - 1; ++axis) {
      std::vector<ScenePart<Dim>> halves;
      for (const auto& part : solid.parts) {
        const Interval u = domain(part.shape, axis);
        for (const auto& shape : split_at(part.shape, axis, (u.lower + u.upper) / 2)) {
          halves.push_back(part);
          halves.back().shape = shape;
        }
      }
      solid.parts = std::move(halves);
    }
}

template <int Dim>
struct Change {
  const char* setting;
  std::function<void(Scene<Dim>&)> apply;
  long stride = 1;
};

template <int Dim>
std::vector<Change<Dim>> changes_for(const Scene<Dim>& scene, const Model<Dim>& model) {
  std::vector<Change<Dim>> changes;
  changes.push_back({"twice the rays and points", [](Scene<Dim>& s) {
    s.method.rays.n_rays *= 2;
    s.method.interval.points *= 2;
    s.method.interior_rule.weight_tolerance /= 10;
    s.method.interval.spacing /= 2;
    s.method.interior_rule.waves *= 2;
    s.method.interior_rule.compress *= 2;
  }});
  bool by_index = false;
  for (const auto& pin : scene.pins) by_index |= !pin.where.control_points.empty();
  if (!by_index) changes.push_back({"every part halved", [](Scene<Dim>& s) { halve_parts(s); }});
  const double gamma = model.stability_stiffness, cutoff = model.discretization.theta.cutoff;
  if (scene.method.formulation == Formulation::condensed)
    changes.push_back({"twice the clamps' penalty", [](Scene<Dim>& s) { s.clamp_penalty *= 2; }});
  else
    changes.push_back({"twice the stability stiffness",
                       [=](Scene<Dim>& s) { s.stability_stiffness = 2 * gamma; }});
  changes.push_back({"1.5 times the cutoff", [=](Scene<Dim>& s) {
    s.method.weights.sparsity.reset();
    s.method.weights.cutoff = 1.5 * cutoff;
  }});
  if (scene.method.projection.degree < 4)
    changes.push_back({"one degree more", [](Scene<Dim>& s) { ++s.method.projection.degree; }});
  else
    changes.push_back({"one degree less", [](Scene<Dim>& s) { --s.method.projection.degree; }});
  if (scene.analysis.kind == AnalysisKind::dynamics)
    changes.push_back({"half the time step", [](Scene<Dim>& s) { s.analysis.time_step /= 2; }, 2});
  return changes;
}

}  // namespace

template <int Dim>
ErrorEstimate estimate_error(const Scene<Dim>& scene, const std::string& file) {
  ErrorEstimate result;
  const bool modes = scene.analysis.kind == AnalysisKind::modes;
  if (!modes && scene.probes.empty()) return result;
  const auto model = build_model(scene, file);
  const Rows original = values_of(scene, file, 1);
  if (original.empty()) return result;
  result.value = original.back();
  if (modes)
    for (size_t m = 1; m <= result.value.size(); ++m)
      result.columns.push_back("mode_" + std::to_string(m) + "_rad_s");
  else
    result.columns = Monitor<Dim>(scene, *model).probe_columns();
  result.estimate.assign(result.value.size(), 0);
  for (const auto& change : changes_for(scene, *model)) {
    Variation variation;
    variation.setting = change.setting;
    const auto start = std::chrono::steady_clock::now();
    try {
      Scene<Dim> varied = scene;
      change.apply(varied);
      const Rows rows = values_of(varied, file, change.stride);
      variation.change.assign(result.value.size(), 0);
      for (size_t t = 0; t < std::min(rows.size(), original.size()); ++t)
        for (size_t c = 0; c < std::min(rows[t].size(), variation.change.size()); ++c)
          variation.change[c] = std::max(variation.change[c], std::abs(rows[t][c] - original[t][c]));
      for (size_t c = 0; c < variation.change.size(); ++c)
        result.estimate[c] = std::max(result.estimate[c], variation.change[c]);
    } catch (const std::exception& error) {  // no memory for twice the points, too
      variation.failure = error.what();
    }
    variation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.variations.push_back(std::move(variation));
  }
  return result;
}

template ErrorEstimate estimate_error<2>(const Scene<2>&, const std::string&);
template ErrorEstimate estimate_error<3>(const Scene<3>&, const std::string&);

}  // namespace sem
