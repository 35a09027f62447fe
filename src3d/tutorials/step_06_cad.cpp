// Step 6 in space: CAD files
//
//   build/release/bin/sem3d_step_06_cad --out out/step_06               numbers, pictures
//   build/release/bin/sem3d_step_06_cad --set left_out=7 --until 2      an open shell
//   build/release/bin/sem3d_step_06_cad --set keep=on                   keep the files
//
// New here: a modeller's solid is a list of trimmed faces, which is all that the method asks for.
//
//   write_cad   parts -> STEP or IGES, a face each, with name, colour and trims, in mm
//   read_cad    file -> parts in m, whatever the file's unit; what had to be mended
//   solids_of, cad_parts   to a scene and back, with the control points of a state
//
// Nothing is meshed: deforming moves control points, and the file that is written back has the same
// faces, trimmed by the same curves in the same parameter planes. Truths: what was written comes
// back; OpenCASCADE's own areas and volume beside the method's; the drilled plate's volume.
// A build without OpenCASCADE says so, and goes on with the parts in memory.
//
// Things to try: --set left_out=7: who knows the volume still? --set turn_by=80. Open the two files
// that --set keep=on leaves in a modeller (their place is printed to standard error).
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "sem/base/error.h"
#include "sem/lesson/lesson.h"
#include "sem/method/boundary_integrals.h"
#include "sem/scene/model.h"
#include "sem/solve/statics.h"
#include "src3d/cad/cad.h"
#include "src3d/tutorials/scenes.h"
#include "src3d/tutorials/solid_view.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

constexpr double height = 0.4, radius = 0.3;

// The largest difference of control points of equally named parts, m; NaN if a part is missing.
double difference(const std::vector<CadPart>& a, const std::vector<CadPart>& b) {
  double most = a.size() == b.size() ? 0 : NAN;
  for (const auto& part : a) {
    const auto same =
        std::find_if(b.begin(), b.end(), [&](auto& p) { return p.name == part.name; });
    if (same == b.end() || same->shape.weights.size() != part.shape.weights.size()) return NAN;
    const Points<3> d = part.shape.control_points - same->shape.control_points;
    most = std::max(most, d.cwiseAbs().maxCoeff());
  }
  return most;
}

// Files in a folder of their own, which goes with the program.
class Files {
 public:
  ~Files() {
    std::error_code ignored;
    if (!keep) std::filesystem::remove_all(folder_, ignored);
  }
  std::string path(const std::string& name) {
    std::filesystem::create_directories(folder_);
    if (keep) std::cerr << (folder_ / name).string() << "\n";
    return (folder_ / name).string();
  }
  bool keep = false;

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("sem3d_step_06_cad_" + std::to_string(getpid()));
};

std::string read_text(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 6 in space: CAD files", {{0, 0}, {1, 1}});
  SolidView view(lesson, -25, 40);
  Files files;
  std::vector<int> sides;  // of the faces' normals: 1 out of the material
  const auto show = [&](Picture& picture, const std::vector<CadPart>& parts) {
    render::RenderScene scene;
    const auto body = boundary_of(parts);
    add_parts(scene, body, [&](int i) {
      const auto& c = parts[i].color;
      return c ? Color{(*c)[0], (*c)[1], (*c)[2]} : clay;
    });
    SpaceNotes notes;
    for (int i = 0; i < body.n_parts(); ++i) {
      const bool whole = parts[i].trims.empty();
      const auto at = point_slopes(body.parts[i], whole ? Param<2>(0.5, 0.5) : Param<2>(0.15, 0.1));
      notes.labels.push_back(
          {at.point, parts[i].name, ink, {0, 0}, sides[i] * DimTraits<3>::area_normal(at.first)});
    }
    view.draw(picture, scene, notes);
  };

  // [1] Out: faces with names, colours, trims.
  int format = 0, left_out = 0;
  std::vector<CadPart> written;
  std::string file;
  // Writes and reads back; in a build without OpenCASCADE the parts themselves.
  const auto through_file = [&](const std::string& name, const std::vector<CadPart>& parts) {
    if (!has_cad()) {
      CadModel same;
      same.parts = parts;
      same.n_solids = 1;
      return same;
    }
    file = files.path(name + (format == 0 ? ".step" : ".igs"));
    write_cad(file, parts);
    return read_cad(file);
  };
  CadModel model;
  lesson.choice("format", format, {"step", "iges"});
  lesson.slider("left_out", left_out, 0, 10, "number of a face that is not written; 0: none");
  lesson.toggle("keep", files.keep, "the files, in the folder for temporary files");
  lesson.step(
      "Parts to a file and back",
      [&](std::ostream& out) {
        SceneSolid<3> solid;
        solid.name = "plate";
        solid.parts = drilled_plate({0.5, 0.5}, radius, height, 4);
        if (left_out > 0) solid.parts.erase(solid.parts.begin() + left_out - 1);
        written = cad_parts({solid});
        for (auto& part : written) {
          const Color c = part.name[0] == 'h' ? red : part.trims.empty() ? clay : blue;
          part.color = std::array<double, 3>{c.r, c.g, c.b};
        }
        model = through_file("plate", written);
        sides = find_loops(boundary_of(model.parts)).orientation;
        if (has_cad())
          out << written.size() << " faces written, " << model.parts.size() << " read, in "
              << model.n_solids << " solid; unit of the file: " << model.unit << "\n";
        else
          out << "This build has no OpenCASCADE: no file is written, the parts stay in memory.\n";
        int n_trims = 0, n_colors = 0;
        for (const auto& part : model.parts)
          n_trims += int(part.trims.size()), n_colors += part.color.has_value();
        out << n_trims << " loops of trims, " << n_colors << " colours; control points off by "
            << error_text(difference(written, model.parts)) << " m\n";
        try {
          read_cad(files.path("plate.step") + "p");
        } catch (const InputError&) {
          out << (has_cad() ? "a file that is not there: InputError\n"
                            : "reading any: InputError\n");
        }
      },
      [&](Picture& picture) {
        show(picture, model.parts);
        picture.note(has_cad() ? "as read from the file: faces with their names and colours"
                               : "no OpenCASCADE: the parts in memory");
      });

  // [2] What is in it? Sides are not taken from the file but found (step 2); OpenCASCADE joins the
  // faces to a shell, where it can.
  std::vector<std::pair<std::string, double>> errors;
  lesson.step(
      "Inspect: faces, trims, sides, areas",
      [&](std::ostream& out) {
        const auto body = boundary_of(model.parts);
        const auto shells = find_loops(body);
        const auto samples = sample_boundary(body, {.points_per_span = 10});
        std::vector<std::vector<std::string>> rows;
        errors.clear();
        for (int i = 0; i < body.n_parts(); ++i) {
          const auto& part = model.parts[i];
          const double area =
              samples.weight(Eigen::seq(samples.first[i], samples.first[i + 1] - 1)).sum();
          const double theirs = has_cad() ? std::abs(model.area[i] / area - 1) : 0;
          const double wall = radius * M_PI / 2 * height, face = 1 - M_PI * radius * radius;
          const double truth = part.name[0] == 'h' ? wall : part.trims.empty() ? height : face;
          rows.push_back(
              {part.name,
               std::to_string(part.shape.degree[0]) + " x " + std::to_string(part.shape.degree[1]),
               std::to_string(part.trims.size()), shells.orientation[i] > 0 ? "out" : "in",
               rounded(area, 5), error_text(area / truth - 1, 1e-6),
               has_cad() ? error_text(theirs, 1e-6) : "-"});
        }
        out << table({"face", "degrees", "loops", "normal", "area, m^2", "error", "OpenCASCADE's"},
                     rows);
        const auto moments = boundary_moments(body, shells);
        const double truth = height * (1 - M_PI * radius * radius);
        out << "volume: by the boundary "
            << (left_out == 0 ? "off by " + error_text(moments.volume / truth - 1) : "unknown");
        if (has_cad())
          out << ", OpenCASCADE's "
              << (model.volume ? "off by " + error_text(*model.volume / truth - 1, 1e-6)
                               : "unknown")
              << "; free edges: " << model.n_free_edges;
        out << "\n";
      },
      [&](Picture& picture) {
        // The same faces, away from the middle.
        auto apart = model.parts;
        for (auto& part : apart) {
          const Vec<3> away =
              part.shape.control_points.rowwise().mean() - Vec<3>(0.5, 0.5, height / 2);
          part.shape.control_points.colwise() += (part.name[0] == 'h' ? 0.9 : 0.5) * away;
        }
        show(picture, apart);
        picture.note("faces pulled apart: each is a NURBS surface with its own trims");
      });

  // [3] A file states its unit. The same text in metres describes a plate a thousand times larger.
  lesson.step(
      "Units: millimetres and metres",
      [&](std::ostream& out) {
        if (!has_cad() || format == 1) {
          out << "Shown with STEP files and OpenCASCADE only.\n";
          return;
        }
        std::string text = read_text(file);
        const std::string milli = "SI_UNIT(.MILLI.,.METRE.)";
        int n_found = 0;
        for (auto at = text.find(milli); at != std::string::npos; at = text.find(milli), ++n_found)
          text.replace(at, milli.size(), "SI_UNIT($,.METRE.)");
        out << "the file says " << milli << (n_found == 0 ? ": not found" : "") << "\n";
        const std::string metres = files.path("metres.step");
        std::ofstream(metres) << text;
        const CadModel large = read_cad(metres);
        for (const auto& [name, m] : {std::pair<const char*, const CadModel*>("as written", &model),
                                      {"with SI_UNIT($,.METRE.)", &large}})
          out << "  " << name << ": unit " << m->unit << ", "
              << rounded(boundary_of(m->parts).box.upper[0]) << " m wide\n";
      },
      [&](Picture& picture) {
        show(picture, model.parts);
        picture.note("control points are in m, whatever unit the file has");
      });

  // [4] From faces to a scene: held at the left, its right face turned about the x axis.
  double turn_by = 40;
  SceneSolid<3> solid;
  Scene<3> scene;
  std::unique_ptr<Model<3>> solved;
  std::vector<CadPart> turned, back;
  lesson.slider("turn_by", turn_by, 0, 80, "of the right face, degrees");
  lesson.step(
      "Deform it, and write it back",
      [&](std::ostream& out) {
        scene = plate_scene(solids_of(model, plate_material));
        scene.pins[1].rotation[0] = turn_by * M_PI / 180;
        scene.pins[1].center = Vec<3>(1, 0.5, height / 2);
        solved = build_model(scene, "plate");
        State state = solved->initial;
        StaticOptions options;
        options.target = solved->target;
        options.path = solved->path;
        options.n_load_steps = 2;
        const auto report = solve_static(solved->system, state, options);
        const Points<3> controls = control_points(solved->discretization.unknowns, state.z);
        turned = cad_parts(scene.solids, &controls);
        for (std::size_t i = 0; i < turned.size(); ++i) turned[i].color = model.parts[i].color;
        back = through_file("turned", turned).parts;
        out << name(report.status) << ", " << solved->n_unknowns() << " unknowns\n"
            << back.size() << " faces " << (has_cad() ? "written and read" : "in memory")
            << "; control points off by " << error_text(difference(turned, back)) << " m\n";
        const auto body = boundary_of(back);
        const Vec<3> corner = point(body.parts[1], Param<2>(0, 0)) - scene.pins[1].center;
        out << "the right face's first corner is turned by "
            << rounded(std::abs(std::atan2(corner[2], corner[1]) - std::atan2(-height / 2, -0.5)) *
                           180 / M_PI,
                       4)
            << " degrees\n";
      },
      [&](Picture& picture) {
        show(picture, back);
        picture.note("the deformed faces, with the same trims");
      });
  return lesson.run(argc, argv);
}
// Next: step_07_motion, a whole scene.
