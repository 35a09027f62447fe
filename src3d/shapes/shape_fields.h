#pragma once
// The shape library of 3D scenes: "shape": {"type": "box", ...}.

#include "sem/scene/read_scene.h"

namespace sem::shapes3d {

/// Describes "type" (box, cylinder, sphere, torus, extrude, revolve, loft, ruled, coons, file), its
/// fields, and those of all types: "degree", "split", "scale", "rotate", "move", applied in this
/// order (parts.h). Reading appends the parts. Throws InputError that names the field for a shape
/// that box.h, solids.h or surfaces.h do not allow. A ShapeLibrary<3>.
void describe_shape(Fields& fields, std::vector<ScenePart<3>>& parts);

}  // namespace sem::shapes3d
