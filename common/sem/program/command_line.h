#pragma once
// The command line of a program. No dimension.

#include <string>
#include <vector>

#include "sem/base/error.h"

namespace sem {

enum class Command { none, run, info, scenes, export_scene, schema };

struct CommandLine {
  Command command = Command::none;  ///< none: all is said, leave with exit_code
  int exit_code = 0;
  std::string scene;   ///< file or name (run, info, export)
  std::string folder;  ///< of the outputs; empty: the default
  std::vector<std::string> overrides;
  bool json = false, resume = false, frames = true;
};

/// Reads the arguments; prints the overview, help or version if they ask for it. Throws InputError
/// for an unknown command.
CommandLine read_command_line(const std::string& program, const std::string& about,
                              const std::string& first_scene, int argc, char** argv);

/// "'word', what", with the closest of the names proposed.
InputError unknown_name(const std::string& field, const std::string& word, const std::string& what,
                        const std::vector<std::string>& names, const std::string& allowed);

}  // namespace sem
