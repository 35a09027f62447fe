#pragma once
// The scenes that come with the program, from src2d/scenes/*.json.

#include <string>
#include <vector>

namespace sem {

struct BuiltinScene {
  std::string name;         ///< of the file, without .json
  std::string description;  ///< one line, the scene's own
  std::string text;         ///< the file, comments included
};

/// All of them; the default scene first.
const std::vector<BuiltinScene>& builtin_scenes();

}  // namespace sem
