#pragma once
// The shape library of 2D scenes: "shape": {"type": "rectangle", ...}.

#include "sem/scene/read_scene.h"

namespace sem::shapes2d {

/// Describes "type" (rectangle, polygon, disc, ellipse, annulus, closed_curve,
/// spline_loop, path) and the fields of that type; reading appends its parts. Throws
/// InputError that names the field for a shape that shapes.h does not allow.
/// A ShapeLibrary<2>.
void describe_shape(Fields& fields, std::vector<ScenePart<2>>& parts);

}  // namespace sem::shapes2d
