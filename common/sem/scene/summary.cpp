#include "sem/scene/summary.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace sem {

using Json = nlohmann::ordered_json;

Json stages_json(const std::vector<StageCost>& cost, const std::vector<StageError>& errors) {
  Json json;
  for (const auto& stage : cost) json[stage.stage]["seconds"] = stage.seconds;
  for (const auto& error : errors) {
    Json& line = json[error.stage];
    line["error"] = std::isfinite(error.error) ? Json(error.error) : Json("unknown");
    line["error_meaning"] = error.meaning;
  }
  return json;
}

namespace {

// Of a call, by kind: time measured, operations and bytes counted. Kinds that a solver did not need are left out.
Json work_json(const Counters& counters) {
  Json json = Json::object();
  const auto add = [&](const char* name, const Task& task) {
    if (task.n == 0) return;
    const double n = double(task.n);
    json[name] = {{"calls", task.n}, {"seconds", task.seconds / n}, {"flops", task.work.flops / n}, {"bytes", task.work.bytes / n}};
  };
  add("energy", counters.energies);
  add("gradient", counters.gradients);
  add("hessian", counters.hessians);
  add("factorization", counters.factorizations);
  add("solve", counters.solves);
  return json;
}

}  // namespace

Json solver_json(const AnalysisReport& report) {
  return {{"steps", report.n_steps},
          {"steps_retried", report.n_retried},
          {"iterations", report.iterations},
          {"worst_residual", report.residual},
          {"factorizations", report.counters.factorizations.n},
          {"hessians", report.counters.hessians.n},
          {"psd_projections", report.counters.n_psd_projections},
          {"condition_estimate", report.condition_estimate},
          {"seconds_per_step", report.n_steps > 0 ? report.seconds / double(report.n_steps) : 0},
          {"work", work_json(report.counters)}};
}

Json energy_json(const Table& history) {
  const size_t kinetic = 2, elastic = 3, load = 5, total = 6;
  double drift = 0, exchanged = 0;
  const auto& first = history.row(0);
  for (int r = 0; r < history.size(); ++r) {
    const auto& row = history.row(r);
    drift = std::max(drift, std::abs(row[total] - first[total]));
    for (const size_t c : {kinetic, elastic, load}) exchanged = std::max(exchanged, std::abs(row[c] - first[c]));
  }
  return {{"largest_change_J", drift},
          {"last_change_J", history.row(history.size() - 1)[total] - first[total]},
          {"largest_exchanged_J", exchanged},
          {"relative_drift", exchanged > 0 ? drift / exchanged : 0}};
}

Json estimate_json(const ErrorEstimate& estimate, const std::vector<std::optional<double>>& truths) {
  Json json;
  json["meaning"] = "largest change when one setting is varied; an estimate, not a bound";
  for (size_t c = 0; c < estimate.columns.size(); ++c) {
    Json probe = {{"probe", estimate.columns[c]},
                  {"value", estimate.value[c]},
                  {"estimated_error", estimate.estimate[c]}};
    if (c < truths.size() && truths[c]) {
      probe["truth"] = *truths[c];
      probe["error"] = std::abs(estimate.value[c] - *truths[c]);
    }
    json["probes"].push_back(std::move(probe));
  }
  for (const auto& variation : estimate.variations) {
    Json entry = {{"setting", variation.setting}};
    if (variation.failure.empty())
      entry["largest_change"] = variation.change;
    else
      entry["no_result"] = variation.failure;
    entry["seconds"] = variation.seconds;
    json["variations"].push_back(std::move(entry));
  }
  return json;
}

double column_maximum(const Table& history, const std::string& column) {
  double maximum = 0;
  for (size_t c = 0; c < history.columns().size(); ++c)
    if (history.columns()[c] == column)
      for (int r = 0; r < history.size(); ++r) maximum = std::max(maximum, std::abs(history.row(r)[c]));
  return maximum;
}

}  // namespace sem
