#pragma once
// Sections of summary.json that do not depend on the dimension.

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "sem/method/discretization.h"
#include "sem/scene/accuracy.h"
#include "sem/scene/analysis.h"
#include "sem/scene/estimate.h"
#include "sem/scene/files.h"

namespace sem {

/// A line for each stage: seconds, and error with its meaning where there is one.
nlohmann::ordered_json stages_json(const std::vector<StageCost>& cost, const std::vector<StageError>& errors);

nlohmann::ordered_json solver_json(const AnalysisReport& report);

/// Largest change of the total energy, also by the largest energy exchanged; columns as Monitor has them.
nlohmann::ordered_json energy_json(const Table& history);

/// `truths` in the order of the estimate's columns; may be shorter.
nlohmann::ordered_json estimate_json(const ErrorEstimate& estimate, const std::vector<std::optional<double>>& truths);

/// Largest magnitude in a column of the history; 0 if there is none of that name.
double column_maximum(const Table& history, const std::string& column);

}  // namespace sem
