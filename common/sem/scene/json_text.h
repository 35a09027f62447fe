#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sem/scene/fields.h"
#include "sem/scene/scene.h"

namespace sem {

/// JSON as text that people can read: two spaces of indentation, lists of plain
/// values on one line, numbers so that they read back as the same.
std::string json_text(const nlohmann::ordered_json& json);

/// Sets `json` to the described fields.
void write_json(const Fields::Body& body, nlohmann::ordered_json& json);

/// Sets `json` to the scene with all defaults; its text is write_scene(scene).
template <int Dim>
void scene_to_json(const Scene<Dim>& scene, nlohmann::ordered_json& json);

}  // namespace sem
