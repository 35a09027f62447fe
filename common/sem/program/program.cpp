#include "sem/program/program.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "sem/base/error.h"
#include "sem/draw/frame_writer.h"
#include "sem/program/command_line.h"
#include "sem/program/progress.h"
#include "sem/scene/fields.h"
#include "sem/scene/files.h"
#include "sem/scene/info.h"

namespace sem {
namespace {

namespace fs = std::filesystem;

std::string frame_name(int frame, const std::string& ending) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%05d.", frame);
  return name + ending;
}

// Frames of an earlier, longer run into the same folder.
void remove_stale_frames(const fs::path& folder, int n_frames, const std::string& ending) {
  std::error_code error;
  for (int frame = n_frames; fs::remove(folder / frame_name(frame, ending), error); ++frame) {
  }
}

struct SceneText {
  std::string text, file;
};

template <int Dim>
class Commands {
 public:
  Commands(const Program<Dim>& program, const CommandLine& line) : program_(program), line_(line) {}

  int call() const {
    switch (line_.command) {
      case Command::none:
        return line_.exit_code;
      case Command::run:
        return run();
      case Command::info:
        return info();
      case Command::scenes:
        return list_scenes();
      case Command::export_scene:
        return export_scene();
      case Command::schema:
        std::cout << document_scene<Dim>(program_.shapes);
    }
    return 0;
  }

 private:
  // The text of a built-in scene; throws for a name that is none.
  const std::string& builtin_text(const char* field, const char* what, const char* other) const {
    std::vector<std::string> names;
    for (const auto& builtin : program_.scenes) {
      if (builtin.name == line_.scene) return builtin.text;
      names.push_back(builtin.name);
    }
    throw unknown_name(field, line_.scene, what, names,
                       other + ("a name that '" + program_.name + " scenes' lists"));
  }

  bool is_solid_file() const {
    return !program_.solid_files.endings.empty() && program_.solid_files.is_one(line_.scene);
  }

  // The scene made of a file of solids; `path`: what the scene calls the file.
  std::string solid_file_text(const std::string& path) const {
    return program_.solid_files.scene_text(line_.scene, path, line_.bare);
  }

  SceneText find_scene() const {
    std::error_code error;
    if (is_solid_file())
      return {solid_file_text(fs::path(line_.scene).filename().string()), line_.scene};
    refuse_bare_options();
    if (fs::is_regular_file(line_.scene, error)) {
      for (const char* ending : {".step", ".stp", ".igs", ".iges"})
        if (line_.scene.ends_with(ending))
          throw InputError(line_.scene, "SCENE", "a CAD file", "a JSON file or a built-in scene; CAD files are for sem3d, built with OpenCASCADE");
      return {read_file(line_.scene), line_.scene};
    }
    return {builtin_text("SCENE", "neither a file nor a built-in scene", "a JSON file or "),
            line_.scene};
  }

  void refuse_bare_options() const {
    if (line_.has_bare)
      throw InputError("", "--pin, --material, --scale", "the scene '" + line_.scene + "'",
                       "these only with a CAD file; else --set");
  }

  // What the first comments of a scene made of a file of solids say.
  std::string choices(const SceneText& source) const {
    std::istringstream lines(source.text);
    std::string said;
    for (std::string line; is_solid_file() && std::getline(lines, line) && line.starts_with("// ");)
      said += line.substr(3) + "\n";
    return said;
  }

  Scene<Dim> load(const SceneText& source) const {
    Scene<Dim> scene = read_scene<Dim>(source.text, source.file, program_.shapes, line_.overrides);
    if (scene.name.empty()) scene.name = fs::path(source.file).stem().string();
    return scene;
  }

  int run() const {
    const SceneText source = find_scene();
    const Scene<Dim> scene = load(source);
    std::cout << choices(source) << std::flush;
    const std::string folder =
        line_.folder.empty() ? "out/" + fs::path(source.file).stem().string() : line_.folder;
    const fs::path frames = fs::path(folder) / "frames";
    const bool draw = line_.frames && program_.painter, solids = !line_.solid_frames.empty();
    Painter<Dim> paint;
    FrameWriter writer;
    FrameCallback<Dim> on_frame;
    if (draw || solids)
      on_frame = [&](const Model<Dim>& model, const State& state, int frame) {
        if (draw) {
          if (!paint) paint = program_.painter(scene);
          auto picture = paint(model, state);
          make_folder(frames.string());
          writer.write((frames / frame_name(frame, "png")).string(), std::move(picture));
        }
        if (solids) make_folder(frames.string());
        if (solids)
          program_.solid_files.write((frames / frame_name(frame, line_.solid_frames)).string(),
                                     scene, control_points(model.discretization.unknowns, state.z));
      };
    RunResult result;
    {
      Progress progress;  // ends its line before the results are printed
      result = run_scene(scene, {source.file, folder, line_.resume, std::ref(progress)}, on_frame);
      writer.finish();
    }
    if (draw) remove_stale_frames(frames, result.n_frames, "png");
    if (solids) remove_stale_frames(frames, result.n_frames, line_.solid_frames);
    std::cout << scene.name << ": " << result.message << "\n"
              << "wrote " << folder << "/: history.csv, summary.json, final_state.json";
    if ((draw || solids) && result.n_frames > 0)
      std::cout << ", frames/ (" << result.n_frames << " of them)";
    if (!program_.painter) std::cout << " (no frames: " << program_.name << " does not draw)";
    std::cout << "\n" << result.report;
    return result.ok ? 0 : 1;
  }

  int info() const {
    const SceneText source = find_scene();
    const Scene<Dim> scene = load(source);
    if (!line_.json) std::cout << choices(source);
    Progress progress;
    const std::string text = model_info(scene, *build_model(scene, source.file), line_.json, source.file, [&](const std::string& what) {
      progress(0, "estimating the error: " + what);
    });
    std::cout << text;
    if (!line_.json && !program_.painter)
      std::cout << "frames: none, " << program_.name << " does not draw\n";
    return 0;
  }

  int list_scenes() const {
    for (const auto& builtin : program_.scenes)
      std::printf("%-18s %s\n", builtin.name.c_str(), builtin.description.c_str());
    return 0;
  }

  int export_scene() const {
    if (is_solid_file()) {
      std::cout << solid_file_text(line_.scene);
      return 0;
    }
    refuse_bare_options();
    std::cout << builtin_text("NAME", "no built-in scene", "");
    return 0;
  }

  const Program<Dim>& program_;
  const CommandLine& line_;
};

}  // namespace

template <int Dim>
int run_program(const Program<Dim>& program, int argc, char** argv) {
  int code = 2;
  try {
    const CommandLine line =
        read_command_line(program.name, program.about, program.scenes.front().name,
                          program.solid_files.endings, argc, argv);
    return Commands<Dim>(program, line).call();
  } catch (const InputError& error) {
    std::cerr << program.name << ": " << error.what() << "\n";
  } catch (const std::exception& error) {
    std::cerr << program.name << ": " << error.what() << "\n";
    code = 1;
  }
  return code;
}

template int run_program<2>(const Program<2>&, int, char**);
template int run_program<3>(const Program<3>&, int, char**);

}  // namespace sem
