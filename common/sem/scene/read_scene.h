#pragma once
// Scenes from and to JSON.

#include <functional>
#include <string>
#include <vector>

#include "sem/scene/fields.h"
#include "sem/scene/scene.h"

namespace sem {

/// Shapes by name, of a dimension's shape library: describes the fields of a
/// solid's "shape" object ("type" first) and, when reading, appends its parts.
template <int Dim>
using ShapeLibrary = std::function<void(Fields&, std::vector<ScenePart<Dim>>&)>;

/// Throws InputError for whatever is wrong with the text or the scene it describes.
template <int Dim>
Scene<Dim> read_scene(const std::string& text, const std::string& file, const ShapeLibrary<Dim>& shapes,
                      const std::vector<std::string>& overrides = {});

/// The scene with all defaults filled in and shapes as explicit parts: reads back as the same scene.
template <int Dim>
std::string write_scene(const Scene<Dim>& scene);

/// The schema for people.
template <int Dim>
std::string document_scene(const ShapeLibrary<Dim>& shapes);

}  // namespace sem
