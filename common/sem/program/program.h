#pragma once
// The program of a dimension: scenes from files or built in, simulated, described, listed,
// exported.

#include <functional>
#include <string>
#include <vector>

#include "sem/draw/image.h"
#include "sem/scene/builtin.h"
#include "sem/scene/read_scene.h"
#include "sem/scene/run.h"

namespace sem {

/// Draws a state of the scene that it was made for, in the size that the scene's output asks for.
template <int Dim>
using Painter = std::function<Image(const Model<Dim>&, const State&)>;

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
};

/// What `main` does: the commands run, info, scenes, export and schema on the built-in scenes
/// and on files. Returns the exit code: 0, 1 if a run or the program failed, 2 for
/// bad input, which is reported on standard error.
template <int Dim>
int run_program(const Program<Dim>& program, int argc, char** argv);

}  // namespace sem
