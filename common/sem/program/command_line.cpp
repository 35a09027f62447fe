#include "sem/program/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "sem/base/version.h"
#include "sem/scene/fields.h"

namespace sem {
namespace {

constexpr const char* commands_text = R"(
  PROGRAM run SCENE [--out DIR] [--set key=value ...]   simulate: frames, history.csv, summary.json
  PROGRAM run SCENE --resume [--out DIR]                go on from the last checkpoint
  PROGRAM info SCENE [--json]                           parts, doubts, accuracy, predicted cost and error; no run
  PROGRAM scenes                                        the built-in scenes, a line each
  PROGRAM export NAME > mine.json                       a built-in scene, to start your own from
  PROGRAM schema                                        every key of a scene file, with units and defaults

SCENE is a JSON fileSOLIDS or the name of a built-in scene; try: PROGRAM run )";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at; (at = text.find(from)) != std::string::npos;) text.replace(at, from.size(), to);
}

// ".igs, .iges, .stp, .step"
std::string dotted(const std::vector<std::string>& endings) {
  std::string text;
  for (const auto& ending : endings) text += (text.empty() ? "." : ", .") + ending;
  return text;
}

std::string overview(const std::string& program, const std::string& about,
                     const std::string& first_scene,
                     const std::vector<std::string>& solid_endings) {
  std::string text = commands_text;
  replace_all(text, "PROGRAM", program);
  replace_all(text, "SOLIDS",
              solid_endings.empty() ? "" : ", a CAD file (" + dotted(solid_endings) + ")");
  return program + ": " + about + "\n" + text + first_scene + "\n";
}

}  // namespace

InputError unknown_name(const std::string& field, const std::string& word, const std::string& what,
                        const std::vector<std::string>& names, const std::string& allowed) {
  const std::string close = closest_name(word, names);
  return InputError("", field, "'" + word + "', " + what,
                    (close.empty() ? "" : "'" + close + "' (did you mean that?), or ") + allowed);
}

CommandLine read_command_line(const std::string& program, const std::string& about,
                              const std::string& first_scene,
                              const std::vector<std::string>& solid_endings, int argc,
                              char** argv) {
  CommandLine line;
  if (argc == 1) {
    std::cout << overview(program, about, first_scene, solid_endings);
    return line;
  }
  CLI::App app{program + ": " + about, program};
  app.set_version_flag("--version", program + " " + version + " (" + build_type + ")");
  app.failure_message([&](const CLI::App*, const CLI::Error& error) {
    return program + ": " + error.what() + "; '" + program + " COMMAND --help' lists the allowed\n";
  });
  app.require_subcommand(1);
  std::vector<std::string> more_overrides;
  bool no_frames = false;
  const auto add_overrides = [&](CLI::App* command) {
    command
        ->add_option("--set", line.overrides,
                     "key=value, as in analysis.time_step=0.005; any number of them")
        ->allow_extra_args(false);
    command->add_option("OVERRIDES", more_overrides, "more of them, with or without another --set");
  };
  std::vector<CLI::Option*> bare_options;
  const auto add_bare_options = [&](CLI::App* command) {
    if (solid_endings.empty()) return;
    bare_options.push_back(
        command->add_option("--pin", line.bare.pin,
                            "of a CAD file: what is held: bottom (default), top, left, right, "
                            "front, back, none, or x0,y0,z0,x1,y1,z1 in m"));
    bare_options.push_back(command->add_option("--material", line.bare.material,
                                               "of a CAD file: rubber (default), jelly or steel"));
    bare_options.push_back(
        command->add_option("--scale", line.bare.scale, "of a CAD file: of its lengths in m"));
  };
  const std::string scene_help =
      solid_endings.empty() ? "JSON file or built-in name" : "JSON file, CAD file or built-in name";
  auto* run_command = app.add_subcommand("run", "simulate a scene");
  run_command->add_option("SCENE", line.scene, scene_help)->required();
  run_command->add_option("--out", line.folder, "output folder; default out/SCENE");
  run_command->add_flag("--resume", line.resume, "go on from the folder's checkpoint");
  run_command->add_flag("--no-frames", no_frames, "numbers only");
  if (!solid_endings.empty())
    run_command
        ->add_option("--cad", line.solid_frames,
                     "also write every frame as a CAD file that ends so: step or igs")
        ->check(CLI::IsMember(solid_endings));
  add_bare_options(run_command);
  add_overrides(run_command);
  auto* info_command =
      app.add_subcommand("info", "parts, accuracy, predicted cost and error of a scene, without running it");
  info_command->add_option("SCENE", line.scene, scene_help)->required();
  info_command->add_flag("--json", line.json, "every figure and setting");
  add_bare_options(info_command);
  add_overrides(info_command);
  auto* scenes_command = app.add_subcommand("scenes", "list the built-in scenes");
  auto* export_command = app.add_subcommand("export", "print a built-in scene");
  export_command
      ->add_option("NAME", line.scene,
                   solid_endings.empty() ? "of a built-in scene"
                                         : "of a built-in scene, or a CAD file to make a scene of")
      ->required();
  add_bare_options(export_command);
  app.add_subcommand("schema", "print every key of a scene file");
  const std::string first = argv[1];
  std::vector<std::string> commands;
  for (const auto* command : app.get_subcommands([](CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  if (first[0] != '-' && std::find(commands.begin(), commands.end(), first) == commands.end())
    throw unknown_name("COMMAND", first, "no command", commands,
                       "run, info, scenes, export or schema");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    line.exit_code = app.exit(error) == 0 ? 0 : 2;
    return line;
  }
  for (const auto& word : more_overrides)
    if (word.find('=') == std::string::npos)
      throw InputError("", "OVERRIDES", "'" + word + "'", "key=value, as in analysis.time_step=0.005 (--resume takes no file: it goes on in --out)");
  if (run_command->count("--out") > 0 && line.folder.empty())
    throw InputError("", "--out", "an empty name", "a folder");
  line.overrides.insert(line.overrides.end(), more_overrides.begin(), more_overrides.end());
  line.frames = !no_frames;
  line.has_bare = std::any_of(bare_options.begin(), bare_options.end(),
                              [](const auto* option) { return option->count() > 0; });
  line.command = *run_command      ? Command::run
                 : *info_command   ? Command::info
                 : *scenes_command ? Command::scenes
                 : *export_command ? Command::export_scene
                                   : Command::schema;
  return line;
}

}  // namespace sem
