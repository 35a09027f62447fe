#pragma once
// The shape library of 3D scenes: "shape": {"type": "box", ...}.

#include "sem/scene/read_scene.h"

namespace sem::shapes3d {

/// Describes "type" (box) and its fields; reading appends its parts. Throws
/// InputError that names the field for a box that box.h does not allow. A
/// ShapeLibrary<3>.
void describe_shape(Fields& fields, std::vector<ScenePart<3>>& parts);

}  // namespace sem::shapes3d
