// Models of CAD files, read as any program would write them, held and deformed.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "figures/solid_states.h"
#include "sem/base/error.h"
#include "sem/picture/scales.h"
#include "sem/scene/builtin.h"
#include "sem/scene/read_scene.h"
#include "src2d/shapes/shapes.h"
#include "src3d/cad/cad.h"
#include "src3d/cad/cad_scene.h"
#include "src3d/shapes/shape_fields.h"
#include "src3d/shapes/solids.h"

namespace sem::figures {
namespace {

// A folder of its own for the files, gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("sem_cad_models_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::vector<Nurbs<1, 2>> curves_of(const std::vector<ScenePart<2>>& profile) {
  std::vector<Nurbs<1, 2>> curves;
  for (const auto& part : profile) curves.push_back(part.shape);
  return curves;
}

// A wrench 2 m long, lying in the plane z = 0: walls along a spline, a hole, and two plane faces,
// rectangles with u = x and v = y that are trimmed to what lies between.
std::vector<CadPart> wrench() {
  constexpr double height = 0.14;
  shapes2d::SplineLoop loop;
  loop.control_points.resize(2, 24);
  loop.control_points << -0.5, -0.1, 0.3, 0.45, 0.7, 0.95, 1.02, 0.85, 0.6, 0.52, 0.6, 0.85, 1.02,
      0.95, 0.7, 0.45, 0.3, -0.1, -0.5, -0.65, -0.9, -1.02, -0.9, -0.65,  //
      -0.1, -0.08, -0.1, -0.22, -0.33, -0.28, -0.14, -0.1, -0.12, 0, 0.12, 0.1, 0.14, 0.28, 0.33,
      0.22, 0.1, 0.08, 0.1, 0.24, 0.24, 0, -0.24, -0.24;
  loop.n_parts = 12;
  const auto profile = shapes2d::make_parts(loop);
  const auto hole = shapes2d::make_parts(shapes2d::Disc{{-0.8, 0}, 0.1});
  shapes3d::Parts parts;
  for (const auto& sides : {profile, hole})
    for (auto& part : make_parts(shapes3d::Extrusion{sides, {0, 0, height}, shapes3d::Caps::none}))
      parts.push_back(part);
  for (const double z : {0.0, height}) {
    const Vec<3> corners[] = {{-1.1, -0.4, z}, {1.1, -0.4, z}, {-1.1, 0.4, z}, {1.1, 0.4, z}};
    ScenePart<3> face;
    face.shape.degree = {1, 1};
    face.shape.knots = {{{-1.1, -1.1, 1.1, 1.1}, {-0.4, -0.4, 0.4, 0.4}}};
    face.shape.control_points.resize(3, 4);
    for (int c = 0; c < 4; ++c) face.shape.control_points.col(c) = corners[c];
    face.shape.weights = Eigen::VectorXd::Ones(4);
    face.trims = {curves_of(profile), curves_of(hole)};
    parts.push_back(face);
  }
  std::vector<CadPart> faces;
  for (const auto& part : parts)
    faces.push_back({"face." + std::to_string(faces.size() + 1), part.shape, part.trims});
  return faces;
}

std::vector<CadPart> parts_of_scene(const std::string& name) {
  for (const auto& builtin : builtin_scenes<3>())
    if (builtin.name == name)
      return cad_parts(read_scene<3>(builtin.text, name, shapes3d::describe_shape).solids);
  throw InputError("", "scene", name, "a built-in scene");
}

struct Shown {
  const char *name, *title, *ending, *pin;
  std::vector<std::string> overrides;
  Vec<3> from;  // to the camera
};
const std::vector<Shown>& all_shown() {
  static const std::vector<Shown> shown = {
      {"wrench",
       "wrench (STEP)",
       ".step",
       "left",
       {"solids[0].material.youngs_modulus=4e6", R"(analysis={"type":"static","load_steps":4})"},
       {0.5, -1, 0.6}},
      {"mug",
       "mug (IGES)",
       ".igs",
       "bottom",
       {R"(loads=[{"type":"boundary","part":"handle","traction":[4000,0,-4000]}])",
        R"(analysis={"type":"static","load_steps":4})"},
       {0.5, -1, 0.42}},
      {"rocket",
       "rocket (STEP)",
       ".step",
       "bottom",
       {R"(loads=[{"type":"body","force":[8000,0,0]}])",
        R"(analysis={"type":"static","load_steps":4})"},
       {0.5, -1, 0.42}}};
  return shown;
}

std::vector<CadPart> model_parts(const std::string& name) {
  if (name == "wrench") return wrench();
  return parts_of_scene(name == "mug" ? "mug_trimmed" : name);
}

Data compute() {
  Data data;
  const TemporaryFolder folder;
  for (const auto& shown : all_shown()) {
    const std::string name = shown.name, file = folder / (name + shown.ending);
    write_cad(file, model_parts(name));
    const std::string text = cad_scene(file, name + shown.ending, {.pin = shown.pin});
    Scene<3> scene =
        read_scene<3>(text, folder / (name + ".json"), shapes3d::describe_shape, shown.overrides);
    scene.method.n_threads = 1;
    const auto model = build_model(scene, name);
    State state = model->initial;
    const auto report =
        equilibrium(model->system, scene.analysis, model->target, state, model->path);
    if (report.status != Status::converged)
      throw InputError(name, "analysis", "no equilibrium", "one");
    add_body(data, name, *model, scene.solids);
    add_state(data, name + " deformed", *model, state);
  }
  return data;
}

void draw(Plot& plot, const Data& data) {
  int column = 0;
  for (const auto& shown : all_shown()) {
    const std::string name = shown.name;
    const SolidState deformed = solid_state_of(data, name, name + " deformed");
    const auto rest = surfaces_of(data, name + " ");
    const double largest = round_up(deformed.largest);
    Panel& panel = plot.panel(0, column++);
    panel.title = shown.title;
    panel.lines_below = {"to " + number_text(largest / 1e3, 3) + " kPa"};
    auto seen = seen_points(deformed.parts, deformed.trims);
    for (const auto& X : seen_points(rest, deformed.trims)) seen.push_back(X);
    double ground = std::numeric_limits<double>::infinity();
    for (const auto& X : seen) ground = std::min(ground, X[2]);
    const auto scene = [deformed, rest, largest, ground](double point) {
      auto result = stressed(deformed, {0, largest}, point);
      result.lines.push_back(rest_lines(rest, deformed.parts, 0.5 * point, deformed.trims));
      result.ground = ground;
      return result;
    };
    draw_view(panel, {scene, seen, {.from = shown.from}, {}, true});
  }
  plot.color_bar({0, 1}, "von Mises stress (of the scale's end)");
}

}  // namespace

Figure cad_models() {
  Figure figure{"cad_models",
                "Models of CAD files, written by the library and read back with their trimmed "
                "faces, of rubber (the wrench of a stiffer one, 4 MPa), under "
                "their weight, a pull at the handle or a wind. Gray lines: at rest, of what moved",
                7,
                2.6,
                compute,
                draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
