// CAD files as scenes: the shape "file", and scenes made of a file alone.
#include <filesystem>

#include "folder.h"
#include "scene/errors.h"
#include "sem/scene/files.h"
#include "sem/scene/model.h"
#include "sem/scene/read_scene.h"
#include "src3d/cad/cad.h"
#include "src3d/cad/cad_scene.h"
#include "src3d/shapes/shape_fields.h"
#include "trimmed.h"

using namespace sem;

namespace {

// Two cubes, of 0.1 m, the second coloured, as two solids of one file where the format keeps them.
std::vector<CadPart> cubes() {
  std::vector<CadPart> parts;
  for (int s = 0; s < 2; ++s)
    for (const auto& shape : test::box<3>({0.2 * s, 0, 0}, {0.2 * s + 0.1, 0.1, 0.1}, 1)) {
      CadPart& part = parts.emplace_back();
      part.name = "face." + std::to_string(parts.size());
      part.shape = shape;
      if (s == 1) part.color = std::array{1.0, 0.5, 0.0};
    }
  return parts;
}

Scene<3> scene_of(const std::string& text, const std::string& file) {
  return read_scene<3>(text, file, shapes3d::describe_shape);
}

std::string with_shape(const std::string& fields) {
  return R"({"solids": [{"shape": {"type": "file", )" + fields + "}}]}";
}

}  // namespace

TEST_CASE(
    "shape file: parts with names, colours and trims, in metres, from the scene's own folder") {
  if (!has_cad()) return;
  const test::Folder folder("cad_shape");
  std::filesystem::create_directory(folder / "models");
  for (const std::string name : {"models/cubes.step", "models/cubes.igs"}) {
    CAPTURE(name);
    write_cad(folder / name, cubes());
    const auto scene = scene_of(with_shape("\"path\": \"" + name + "\""), folder / "a.json");
    REQUIRE(scene.solids[0].parts.size() == 12);
    CHECK(scene.solids[0].parts[6].name == "face.7");
    CHECK(!scene.solids[0].parts[0].color.has_value());
    REQUIRE(scene.solids[0].parts[6].color.has_value());
    CHECK((*scene.solids[0].parts[6].color)[1] == doctest::Approx(0.5).epsilon(1e-2));
    CHECK((scene.solids[0].parts[6].shape.control_points - cubes()[6].shape.control_points).norm() <
          1e-12);
    // Written with its parts, it reads back without the file.
    const auto again = read_scene<3>(write_scene(scene), "b.json", {});
    CHECK(again.solids[0].parts[6].color == scene.solids[0].parts[6].color);
  }
  const auto scaled = scene_of(
      with_shape(R"("path": "models/cubes.igs", "scale": [10, 10, 10], "move": [0, 0, 1])"),
      folder / "a.json");
  CHECK(scaled.solids[0].parts[0].shape.control_points.row(2).maxCoeff() == doctest::Approx(2));
  write_cad(folder / "trimmed.igs",
            {{"plate", test::paraboloid(0.2), {test::circle({0, 0}, 0.5)}}});
  const auto trimmed = scene_of(with_shape(R"("path": "trimmed.igs")"), folder / "a.json");
  CHECK(trimmed.solids[0].parts[0].trims.size() == 1);
  test::check_names(test::error_of([&] {
                      scene_of(with_shape(R"("path": "trimmed.igs", "split": [2, 1])"),
                               folder / "a.json");
                    }),
                    folder / "a.json", {"solids[0].shape.split", "trims", "plate"});
}

TEST_CASE("shape file: bad input names the scene, the field, what was found and what is allowed") {
  const test::Folder folder("cad_shape_bad");
  const auto error = [&](const std::string& fields) {
    return test::error_of([&] { scene_of(with_shape(fields), folder / "a.json"); });
  };
  const auto rejected = [&](const std::string& fields, const std::vector<std::string>& pieces) {
    CAPTURE(fields);
    test::check_names(error(fields), folder / "a.json", pieces);
  };
  rejected(R"("solid": 1)", {"solids[0].shape", "path"});
  rejected(R"("path": 3)", {"solids[0].shape.path", "found 3"});
  rejected(R"("path": "")", {"solids[0].shape.path", "''", ".igs, .iges, .stp or .step"});
  rejected(R"("path": "a.json")",
           {"solids[0].shape.path", "'a.json'", ".igs, .iges, .stp or .step"});
  rejected(R"("path": "a.step", "pth": 1)", {"solids[0].shape"});
  if (!has_cad()) {
    rejected(R"("path": "a.step")", {"solids[0].shape.path", "a.step", "no OpenCASCADE"});
    return;
  }
  rejected(R"("path": "none.step")", {"solids[0].shape.path", "none.step", "no readable file"});
  write_file(folder / "empty.igs", "");
  rejected(R"("path": "empty.igs")", {"solids[0].shape.path", "empty.igs", "an empty file"});
  write_cad(folder / "cubes.step", cubes());
  rejected(R"("path": "cubes.step", "solid": -1)", {"solids[0].shape.solid", "-1"});
  rejected(R"("path": "cubes.step", "solid": 99)", {"solids[0].shape.solid", "99", "at most"});
  rejected(R"("path": "cubes.step", "scale": [1, 0, 1])", {"solids[0].shape.scale", "0"});
  rejected(R"("path": "cubes.step", "scale": 2)", {"solids[0].shape.scale"});
}

TEST_CASE("a CAD file alone makes a scene that says what it chose, builds, and takes options") {
  if (!has_cad()) return;
  const test::Folder folder("cad_alone");
  const std::string file = folder / "a cube \"1\".step";
  auto parts = cubes();
  parts.resize(6);
  write_cad(file, parts);
  const std::string text = cad_scene(file, "a cube \"1\".step", {});
  CHECK(text.starts_with("// "));
  for (const char* piece : {"(millimetre)", "1 solid, 6 parts", "0.1 x 0.1 x 0.1 m", "rubber",
                            "--pin bottom, 12 control points"})
    CHECK(text.find(piece) != std::string::npos);
  const auto scene = scene_of(text, file);
  CHECK(scene.name == "a cube \"1\"");
  CHECK(scene.solids[0].material.youngs_modulus == 1e6);
  const auto model = build_model(scene, file);
  CHECK(model->total_mass() == doctest::Approx(1).epsilon(1e-9));
  REQUIRE(model->held.size() == 1);
  const Points<3> p = rest_controls(model->discretization.boundary);
  for (const int c : model->held[0].controls) CHECK(p(2, c) == 0);

  const auto held_at = [&](const std::string& pin) {
    const auto made = scene_of(cad_scene(file, "a cube \"1\".step", {pin, "steel", 2}), file);
    CHECK(made.solids[0].material.density == 7800);
    CHECK(made.solids[0].parts[0].shape.control_points.maxCoeff() == doctest::Approx(0.2));
    return made.pins;
  };
  CHECK(held_at("none").empty());
  CHECK(held_at("top")[0].where.box->lower[2] > 0.19);
  CHECK(held_at("left")[0].where.box->upper[0] < 0.01);
  CHECK(held_at("right")[0].where.box->lower[0] > 0.19);
  CHECK(held_at("front")[0].where.box->upper[1] < 0.01);
  CHECK(held_at("back")[0].where.box->lower[1] > 0.19);
  CHECK(held_at("-1,-1,-1,0.5,1,0")[0].where.box->upper == Vec<3>(0.5, 1, 0));
}

TEST_CASE("several solids come back as several from both formats, and names as they were") {
  if (!has_cad()) return;
  const test::Folder folder("cad_solids");
  auto parts = cubes();
  for (size_t i = 6; i < parts.size(); ++i) parts[i].solid = 1;
  for (const std::string name : {"two solids.step", "two solids.igs"}) {
    CAPTURE(name);
    write_cad(folder / name, parts);
    const CadModel model = read_cad(folder / name);
    CHECK(model.n_solids == 2);
    REQUIRE(model.parts.size() == parts.size());
    for (size_t i = 0; i < parts.size(); ++i) {
      CHECK(model.parts[i].solid == parts[i].solid);
      CHECK(model.parts[i].name == parts[i].name);
    }
    const auto scene = scene_of(cad_scene(folder / name, name, {}), folder / name);
    REQUIRE(scene.solids.size() == 2);
    CHECK(scene.solids[1].parts.size() == 6);
    const auto model_of_scene = build_model(scene, name);
    CHECK(model_of_scene->total_mass() == doctest::Approx(2).epsilon(1e-9));
    // What a run writes of it.
    write_cad(folder / ("again " + name), cad_parts(scene.solids));
    CHECK(read_cad(folder / ("again " + name)).n_solids == 2);
  }
}

TEST_CASE("a CAD scene works with its file elsewhere, and on paths with blanks") {
  if (!has_cad()) return;
  const test::Folder folder("cad_paths"), other("cad paths elsewhere");
  auto parts = cubes();
  parts.resize(6);
  const std::string file = folder / "my cube.step";
  write_cad(file, parts);
  const auto absolute = std::filesystem::absolute(file).string();
  CHECK(scene_of(with_shape("\"path\": \"" + absolute + "\""), other / "a b.json")
            .solids[0]
            .parts.size() == 6);
  CHECK(scene_of(with_shape("\"path\": \"my cube.step\""), folder / "a b.json")
            .solids[0]
            .parts.size() == 6);
  test::check_names(test::error_of([&] {
                      scene_of(with_shape("\"path\": \"my cube.step\""), other / "a b.json");
                    }),
                    other / "a b.json", {"solids[0].shape.path", "my cube.step"});
}

TEST_CASE("a CAD file alone: options that are none are refused by name") {
  if (!has_cad()) return;
  const test::Folder folder("cad_alone_bad");
  const std::string file = folder / "cube.igs";
  write_cad(file, cubes());
  const auto rejected = [&](const BareScene& options, const std::string& field,
                            const std::string& found) {
    const std::string error = test::error_of([&] { cad_scene(file, "cube.igs", options); });
    CAPTURE(error);
    test::check_names(error, field, {found, "allowed"});
  };
  for (const char* pin :
       {"floor", "", "1,2,3", "0,0,0,1,1,x", "0,0,0,1,1,", "0,0,0,1,1,inf", "0,0,0,1,1,1,1"})
    rejected({pin, "rubber", 1}, "--pin", std::string("'") + pin + "'");
  rejected({"1,0,0,0,1,1", "rubber", 1}, "--pin", "1,0,0,0,1,1");
  rejected({"5,5,5,6,6,6", "rubber", 1}, "--pin", "without control points");
  rejected({"bottom", "cheese", 1}, "--material", "'cheese'");
  for (const double scale : {0.0, -1.0, double(INFINITY), double(NAN)})
    rejected({"bottom", "rubber", scale}, "--scale", "found");
}
