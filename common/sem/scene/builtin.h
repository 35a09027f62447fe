#pragma once
// The scenes that come with a program, from its folder scenes/*.json.

#include <string>
#include <vector>

namespace sem {

struct BuiltinScene {
  std::string name;         ///< of the file, without .json
  std::string description;  ///< one line, the scene's own
  std::string text;         ///< the file, comments included
};

/// All of a dimension; the default scene first. Defined by the library that sem_add_scenes (CMake) makes.
template <int Dim>
const std::vector<BuiltinScene>& builtin_scenes();
template <>
const std::vector<BuiltinScene>& builtin_scenes<2>();
template <>
const std::vector<BuiltinScene>& builtin_scenes<3>();

}  // namespace sem
