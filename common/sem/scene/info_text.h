#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace sem {

/// What people look for in model_info's JSON of a scene in `dim` dimensions: a line each for body, doubts, points,
/// weights, unknowns, cost and error, and a table of the parts.
std::string info_text(const nlohmann::ordered_json& info, int dim);

}  // namespace sem
