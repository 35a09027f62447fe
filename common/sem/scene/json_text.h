#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace sem {

/// JSON as text that people can read: two spaces of indentation, lists of plain
/// values on one line, numbers so that they read back as the same.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace sem
