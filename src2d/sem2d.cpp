// sem2d: elastic solids in the plane from their NURBS boundary.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "src2d/picture/frame.h"
#include "src2d/scenes/builtin.h"
#include "sem/base/error.h"
#include "sem/base/version.h"
#include "sem/draw/frame_writer.h"
#include "sem/draw/raster.h"
#include "sem/scene/fields.h"
#include "sem/scene/files.h"
#include "sem/scene/info.h"
#include "sem/scene/read_scene.h"
#include "sem/scene/run.h"
#include "src2d/shapes/shape_fields.h"

namespace {

using namespace sem;
namespace fs = std::filesystem;

constexpr const char* overview = R"(sem2d: elastic solids in the plane, described by their NURBS boundary alone

  sem2d run SCENE [--out DIR] [--set key=value ...]   simulate: frames, history.csv, summary.json
  sem2d run SCENE --resume [--out DIR]                go on from the last checkpoint
  sem2d info SCENE [--json]                           sizes, accuracy and all settings, without running
  sem2d scenes                                        the built-in scenes, a line each
  sem2d export NAME > mine.json                       a built-in scene, to start your own from
  sem2d schema                                        every key of a scene file, with units and defaults

SCENE is a JSON file or the name of a built-in scene; try: sem2d run blob
)";

InputError unknown_name(const std::string& field, const std::string& word, const std::string& what,
                        const std::vector<std::string>& names, const std::string& allowed) {
  const std::string close = closest_name(word, names);
  return InputError("", field, "'" + word + "', " + what,
                    (close.empty() ? "" : "'" + close + "' (did you mean that?), or ") + allowed);
}

struct SceneText {
  std::string text, file;
};

SceneText find_scene(const std::string& scene) {
  std::error_code error;
  if (fs::is_regular_file(scene, error)) return {read_file(scene), scene};
  std::vector<std::string> names;
  for (const auto& builtin : builtin_scenes()) {
    if (builtin.name == scene) return {builtin.text, scene};
    names.push_back(builtin.name);
  }
  throw unknown_name("SCENE", scene, "neither a file nor a built-in scene", names,
                     "a JSON file or a name that 'sem2d scenes' lists");
}

Scene<2> load(const SceneText& source, const std::vector<std::string>& overrides) {
  Scene<2> scene = read_scene<2>(source.text, source.file, shapes2d::describe_shape, overrides);
  if (scene.name.empty()) scene.name = fs::path(source.file).stem().string();
  return scene;
}

// A bar on a terminal, a line for every tenth in a pipe.
class Progress {
 public:
  void operator()(double share, const std::string& what) {
    const int now = int(share * (terminal_ ? 40 : 10));
    if (now == shown_ && what == what_) return;
    shown_ = now;
    if (terminal_) {
      std::fprintf(stderr, "\r%-22s [%-40s] %3d %%", what.c_str(), std::string(now, '#').c_str(), int(100 * share));
      open_ = true;
    } else {
      std::fprintf(stderr, "%s %d %%\n", what.c_str(), int(100 * share));
    }
    what_ = what;
  }
  ~Progress() {
    if (open_) std::fprintf(stderr, "\n");
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO), open_ = false;
  int shown_ = -1;
  std::string what_;
};

std::string frame_name(int frame) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%05d.png", frame);
  return name;
}

// Frames of an earlier, longer run into the same folder.
void remove_stale_frames(const fs::path& folder, int n_frames) {
  std::error_code error;
  for (int frame = n_frames; fs::remove(folder / frame_name(frame), error); ++frame) {
  }
}

int run(const std::string& name, std::string folder, const std::vector<std::string>& overrides, bool resume,
        bool draw) {
  const SceneText source = find_scene(name);
  const Scene<2> scene = load(source, overrides);
  if (folder.empty()) folder = "out/" + fs::path(source.file).stem().string();
  const fs::path frames = fs::path(folder) / "frames";
  std::unique_ptr<RasterCanvas> canvas;
  FrameWriter writer;
  FramePainter painter(scene);
  FrameCallback<2> on_frame;
  if (draw)
    on_frame = [&](const Model<2>& model, const State& state, int frame) {
      if (!canvas) {
        make_folder(frames.string());
        canvas = std::make_unique<RasterCanvas>(scene.output.width, scene.output.height);
      }
      canvas->clear();
      painter.draw(*canvas, model, state);
      writer.write((frames / frame_name(frame)).string(), canvas->finish());
    };
  RunResult result;
  {
    Progress progress;  // ends its line before the results are printed
    result = run_scene(scene, {source.file, folder, resume, std::ref(progress)}, on_frame);
    writer.finish();
  }
  if (draw) remove_stale_frames(frames, result.n_frames);
  std::cout << scene.name << ": " << result.message << "\n"
            << "wrote " << folder << "/: history.csv, summary.json, final_state.json";
  if (draw && result.n_frames > 0) std::cout << ", frames/ (" << result.n_frames << " of them)";
  std::cout << "\n" << result.report;
  return result.ok ? 0 : 1;
}

int info(const std::string& name, const std::vector<std::string>& overrides, bool json) {
  const SceneText source = find_scene(name);
  const Scene<2> scene = load(source, overrides);
  std::cout << model_info(scene, *build_model(scene, source.file), json, source.file);
  return 0;
}

int list_scenes() {
  for (const auto& builtin : builtin_scenes()) std::printf("%-18s %s\n", builtin.name.c_str(), builtin.description.c_str());
  return 0;
}

int export_scene(const std::string& name) {
  for (const auto& builtin : builtin_scenes())
    if (builtin.name == name) {
      std::cout << builtin.text;
      return 0;
    }
  std::vector<std::string> names;
  for (const auto& builtin : builtin_scenes()) names.push_back(builtin.name);
  throw unknown_name("NAME", name, "no built-in scene", names, "a name that 'sem2d scenes' lists");
}

int main_program(int argc, char** argv) {
  if (argc == 1) {
    std::cout << overview;
    return 0;
  }
  CLI::App app{"sem2d: elastic solids in the plane, described by their NURBS boundary alone", "sem2d"};
  app.set_version_flag("--version", std::string("sem2d ") + version + " (" + build_type + ")");
  app.require_subcommand(1);
  std::string scene, folder, builtin;
  std::vector<std::string> overrides, more_overrides;
  bool json = false, resume = false, no_frames = false;
  const auto add_overrides = [&](CLI::App* command) {
    command->add_option("--set", overrides, "key=value, as in analysis.time_step=0.005; any number of them")
        ->allow_extra_args(false);
    command->add_option("OVERRIDES", more_overrides, "more of them, with or without another --set");
  };
  auto* run_command = app.add_subcommand("run", "simulate a scene");
  run_command->add_option("SCENE", scene, "JSON file or built-in name")->required();
  run_command->add_option("--out", folder, "output folder; default out/SCENE");
  run_command->add_flag("--resume", resume, "go on from the folder's checkpoint");
  run_command->add_flag("--no-frames", no_frames, "numbers only");
  add_overrides(run_command);
  auto* info_command = app.add_subcommand("info", "sizes, accuracy and settings of a scene, without running it");
  info_command->add_option("SCENE", scene, "JSON file or built-in name")->required();
  info_command->add_flag("--json", json, "everything, parts included");
  add_overrides(info_command);
  auto* scenes_command = app.add_subcommand("scenes", "list the built-in scenes");
  auto* export_command = app.add_subcommand("export", "print a built-in scene");
  export_command->add_option("NAME", builtin, "of a built-in scene")->required();
  auto* schema_command = app.add_subcommand("schema", "print every key of a scene file");
  const std::string first = argv[1];
  std::vector<std::string> commands;
  for (const auto* command : app.get_subcommands([](CLI::App*) { return true; })) commands.push_back(command->get_name());
  if (first[0] != '-' && std::find(commands.begin(), commands.end(), first) == commands.end())
    throw unknown_name("COMMAND", first, "no command", commands, "run, info, scenes, export or schema");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  overrides.insert(overrides.end(), more_overrides.begin(), more_overrides.end());
  if (*run_command) return run(scene, folder, overrides, resume, !no_frames);
  if (*info_command) return info(scene, overrides, json);
  if (*scenes_command) return list_scenes();
  if (*export_command) return export_scene(builtin);
  if (*schema_command) std::cout << document_scene<2>(shapes2d::describe_shape);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return main_program(argc, argv);
  } catch (const sem::InputError& error) {
    std::cerr << "sem2d: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "sem2d: " << error.what() << "\n";
    return 1;
  }
}
