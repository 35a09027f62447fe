#pragma once
// A small scene as text, and the error of reading one.

#include "sem/base/error.h"
#include "sem/scene/read_scene.h"

namespace sem::test {

// A triangle of straight parts; `solid` is appended to the keys of its solid,
// `keys` to those of the scene.
inline std::string triangle(const std::string& keys = "", const std::string& solid = "") {
  return R"({"solids": [{"name": "sail", "parts": [
    {"name": "side.1", "degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0]]},
    {"name": "side.2", "degree": 1, "knots": [0, 0, 1, 1], "control_points": [[1, 0], [0, 1]]},
    {"name": "mast", "degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 1], [0, 0]]}])" +
         (solid.empty() ? "" : ", " + solid) + "}]" + (keys.empty() ? "" : ", " + keys) + "}";
}

inline Scene<2> read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_scene<2>(text, "test.json", {}, overrides);
}

inline std::string error_of(const std::string& text,
                            const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace sem::test
