#pragma once
// The program of a dimension: scenes from files or built in, simulated, described, listed,
// exported.

#include <functional>
#include <string>
#include <vector>

#include "sem/draw/image.h"
#include "sem/scene/bare_scene.h"
#include "sem/scene/builtin.h"
#include "sem/scene/read_scene.h"
#include "sem/scene/run.h"

namespace sem {

/// Draws a state of the scene that it was made for, in the size that the scene's output asks for.
template <int Dim>
using Painter = std::function<Image(const Model<Dim>&, const State&)>;

/// Files with nothing but solids in them (3D: CAD): read as scenes, and written of a scene's state.
template <int Dim>
struct SolidFiles {
  std::vector<std::string>
      endings;  ///< of their names, without the dot; the first of each format comes first
  std::function<bool(const std::string& file)> is_one;  ///< by its name
  /// The text of a scene that calls the file `path`. Its first comments are for the user.
  std::function<std::string(const std::string& file, const std::string& path, const BareScene&)>
      scene_text;
  /// Writes the scene's parts with these control points (Dim by all), whole or not at all.
  std::function<void(const std::string& file, const Scene<Dim>&, const Points<Dim>&)> write;
};

/// What one program has for itself.
template <int Dim>
struct Program {
  std::string name;                  ///< "sem2d"
  std::string about;                 ///< "elastic solids in the plane, ...", one line
  std::vector<BuiltinScene> scenes;  ///< built in; the first is the one to try first
  ShapeLibrary<Dim> shapes;
  /// Made when the first frame is due; the scene outlives the painter. Empty: the program draws no
  /// frames and says so.
  std::function<Painter<Dim>(const Scene<Dim>&)> painter;
  SolidFiles<Dim> solid_files = {};  ///< no endings: the program knows none
};

/// What `main` does: the commands run, info, scenes, export and schema on the built-in scenes
/// and on files. Returns the exit code: 0, 1 if a run or the program failed, 2 for
/// bad input, which is reported on standard error.
template <int Dim>
int run_program(const Program<Dim>& program, int argc, char** argv);

}  // namespace sem
