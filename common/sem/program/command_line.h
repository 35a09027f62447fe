#pragma once
// The command line of a program. No dimension.

#include <string>
#include <vector>

#include "sem/base/error.h"
#include "sem/scene/bare_scene.h"

namespace sem {

enum class Command { none, run, info, scenes, export_scene, schema };

struct CommandLine {
  Command command = Command::none;  ///< none: all is said, leave with exit_code
  int exit_code = 0;
  std::string scene;   ///< file or name (run, info, export)
  std::string folder;  ///< of the outputs; empty: the default
  std::vector<std::string> overrides;
  bool json = false, resume = false, frames = true;
  BareScene bare;            ///< of a scene that is a file of solids
  bool has_bare = false;     ///< any of it is given
  std::string solid_frames;  ///< ending of the files of solids to write frames to; empty: none
};

/// Reads the arguments; prints the overview, help or version if they ask for it. Throws InputError
/// for an unknown command. `solid_endings`: of the files of solids that the program knows, if any.
CommandLine read_command_line(const std::string& program, const std::string& about,
                              const std::string& first_scene,
                              const std::vector<std::string>& solid_endings, int argc, char** argv);

/// "'word', what", with the closest of the names proposed.
InputError unknown_name(const std::string& field, const std::string& word, const std::string& what,
                        const std::vector<std::string>& names, const std::string& allowed);

}  // namespace sem
