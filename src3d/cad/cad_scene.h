#pragma once
// A scene of a CAD file alone.

#include <string>

#include "sem/scene/bare_scene.h"

namespace sem {

/// The text of a scene: every solid of the file, which the text calls `path`, as a shape of type
/// "file"; of rubber, jelly or steel; held in a slab at its bottom or what else is asked for;
/// under gravity. Its first lines, comments, say what was chosen and what reading had to mend.
/// Sides: left, right (x), front, back (y), bottom, top (z). A slab is the thinnest of some that
/// holds three control points off one line.
/// Throws InputError as read_cad, and for options that are none (field --pin, --material, --scale).
std::string cad_scene(const std::string& file, const std::string& path, const BareScene& options);

}  // namespace sem
