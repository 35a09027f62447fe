// CAD files in and out. Without OpenCASCADE only that the error says so.
#include <filesystem>

#include "folder.h"
#include "scene/errors.h"
#include "sem/method/boundary_integrals.h"
#include "sem/scene/files.h"
#include "src3d/cad/cad.h"
#include "trimmed.h"

using namespace sem;

namespace {

std::string path(const std::string& name) {
  const std::string folder = std::string(SEM_TEST_OUTPUT) + "/cad";
  std::filesystem::create_directories(folder);
  return folder + "/" + name;
}

// Sphere of eight rational biquadratic patches, poles collapsed.
std::vector<CadPart> sphere(double radius) {
  std::vector<CadPart> parts;
  for (const auto& around : test::circle({0, 0}, radius))
    for (int half = 0; half < 2; ++half) {
      const auto up = test::arc({0, 0}, 1, (half - 1) * M_PI / 2, half * M_PI / 2);
      Nurbs<2, 3> patch = test::biquadratic_patch();
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const Vec<2> across = up.control_points(0, j) * around.control_points.col(i);
          patch.control_points.col(i + 3 * j) =
              Vec<3>(across[0], across[1], radius * up.control_points(1, j));
          patch.weights[i + 3 * j] = around.weights[i] * up.weights[j];
        }
      parts.push_back({"ball." + std::to_string(parts.size() + 1), patch});
    }
  return parts;
}

// A wavy plate with two holes and a knot in each parameter, coloured.
std::vector<CadPart> plate() {
  auto patch = test::paraboloid(0.21);
  patch = insert_knot(insert_knot(patch, 0, 0.3), 1, -0.2);
  for (int i = 0; i < patch.control_points.cols(); ++i) patch.weights[i] = 1 + 0.1 * (i % 3);
  CadPart part{"plate",
               patch,
               {test::polygon({{-0.9, -0.8}, {0.9, -0.8}, {0.8, 0.9}, {-0.7, 0.8}}),
                test::circle({0.2, 0.3}, 0.25), test::circle({-0.4, -0.3}, 0.2, 3)}};
  part.color = std::array{0.25, 0.5, 0.75};
  return {part};
}

std::vector<CadPart> box_with_stud() {
  const auto solid = test::box_with_cylinder(0.2, 0.7);
  std::vector<CadPart> parts;
  for (size_t i = 0; i < solid.parts.size(); ++i)
    parts.push_back({"face." + std::to_string(i + 1), solid.parts[i], solid.trims[i]});
  return parts;
}

Boundary<3> boundary_of(const std::vector<CadPart>& parts) {
  std::vector<Nurbs<2, 3>> shapes;
  std::vector<TrimLoops> trims;
  for (const auto& part : parts) {
    shapes.push_back(part.shape);
    trims.push_back(part.trims);
  }
  return make_boundary<3>({shapes}, trims);
}

void check_same(const std::vector<CadPart>& a, const std::vector<CadPart>& b) {
  REQUIRE(a.size() == b.size());
  const auto before = boundary_of(a), behind = boundary_of(b);
  for (size_t i = 0; i < a.size(); ++i) {
    CAPTURE(a[i].name);
    CHECK(a[i].name == b[i].name);
    CHECK(a[i].shape.degree == b[i].shape.degree);
    for (int axis = 0; axis < 2; ++axis) {
      REQUIRE(a[i].shape.knots[axis].size() == b[i].shape.knots[axis].size());
      for (size_t k = 0; k < a[i].shape.knots[axis].size(); ++k)
        CHECK(std::abs(a[i].shape.knots[axis][k] - b[i].shape.knots[axis][k]) < 1e-12);
    }
    REQUIRE(a[i].shape.control_points.cols() == b[i].shape.control_points.cols());
    CHECK((a[i].shape.control_points - b[i].shape.control_points).cwiseAbs().maxCoeff() < 1e-12);
    CHECK((a[i].shape.weights / a[i].shape.weights[0] - b[i].shape.weights / b[i].shape.weights[0])
              .cwiseAbs()
              .maxCoeff() < 1e-12);
    CHECK(a[i].trims.size() == b[i].trims.size());
    CHECK(a[i].color.has_value() == b[i].color.has_value());
    if (a[i].color && b[i].color)
      for (int c = 0; c < 3; ++c)
        CHECK((*a[i].color)[c] == doctest::Approx((*b[i].color)[c]).epsilon(1e-2));
    const auto &one = before.parts[i].region, &other = behind.parts[i].region;
    CHECK(bool(one) == bool(other));
    if (!one || !other) continue;
    const auto sum = [](const ParameterRule<2>& rule) {
      Vec<3> moments = Vec<3>::Zero();
      for (size_t k = 0; k < rule.u.size(); ++k)
        moments += rule.weight[k] * Vec<3>(1, rule.u[k][0], rule.u[k][0] * rule.u[k][1]);
      return moments;
    };
    CHECK((sum(one->rule(12)) - sum(other->rule(12))).norm() < 1e-11);
    for (const Param<2>& u : one->rule(3).u) CHECK(other->contains(u));
  }
}

void check_round_trip(const std::vector<CadPart>& parts, const std::string& name) {
  for (const char* ending : {".step", ".igs"}) {
    CAPTURE(ending);
    const std::string file = path(name + ending);
    write_cad(file, parts);
    const CadModel model = read_cad(file);
    CHECK(model.notes.empty());
    CHECK(model.n_solids == 1);
    check_same(parts, model.parts);
  }
}

}  // namespace

TEST_CASE("a build without OpenCASCADE says so, and what a CAD file is goes by the name") {
  CHECK(is_cad_file("a/b.IGS"));
  CHECK(is_cad_file("b.step"));
  CHECK(!is_cad_file("b.json"));
  CHECK(!is_cad_file("igs"));
  if (!has_cad())
    test::check_names(test::error_of([&] { read_cad("a.igs"); }), "a.igs", {"no OpenCASCADE"});
}

TEST_CASE(
    "parts come back from IGES and STEP as they were written: names, colours, trims, control "
    "points to 1e-12") {
  if (!has_cad()) return;
  check_round_trip(plate(), "plate");
  check_round_trip(sphere(0.3), "sphere");
  check_round_trip(box_with_stud(), "stud");
}

TEST_CASE("a model from a file has the volume of the body and areas as OpenCASCADE measures them") {
  if (!has_cad()) return;
  const auto volume_of = [](const std::vector<CadPart>& parts, const std::string& file) {
    write_cad(path(file), parts);
    const CadModel model = read_cad(path(file));
    const auto boundary = boundary_of(model.parts);
    const auto moments = boundary_moments(boundary, find_loops(boundary));
    REQUIRE(moments.available);
    REQUIRE(model.volume.has_value());
    CHECK(*model.volume == doctest::Approx(moments.volume).epsilon(1e-6));
    const auto areas = part_measures(boundary);
    REQUIRE(areas.size() == model.area.size());
    for (size_t i = 0; i < areas.size(); ++i)
      CHECK(areas[i] == doctest::Approx(model.area[i]).epsilon(1e-6));
    return moments.volume;
  };
  CHECK(volume_of(box_with_stud(), "volume.igs") ==
        doctest::Approx(1 + 0.7 * M_PI * 0.04).epsilon(1e-10));
  CHECK(volume_of(sphere(0.3), "volume.step") ==
        doctest::Approx(4 * M_PI / 3 * 0.027).epsilon(1e-10));
}

TEST_CASE("a file's unit is honoured") {
  if (!has_cad()) return;
  const std::string file = path("unit.igs");
  write_cad(file, sphere(0.5));
  std::string text = read_file(file);
  const size_t at = text.find(",2,2HMM,");
  REQUIRE(at != std::string::npos);
  CHECK(read_cad(file).unit == "MM");
  const auto size_in = [&](const std::string& unit) {
    std::string changed = text;
    changed.replace(at, 8, unit);
    write_file(path("changed.igs"), changed);
    return boundary_of(read_cad(path("changed.igs")).parts).box.upper[0];
  };
  CHECK(size_in(",2,2HMM,") == doctest::Approx(0.5).epsilon(1e-12));
  CHECK(size_in(",6,1HM, ") == doctest::Approx(500).epsilon(1e-12));
  CHECK(size_in(",1,2HIN,") == doctest::Approx(0.5 * 25.4).epsilon(1e-12));
}

TEST_CASE("files that are not there, empty, cut off, or without faces are refused by name") {
  if (!has_cad()) return;
  const auto error = [](const std::string& file) {
    return test::error_of([&] { read_cad(file); });
  };
  test::check_names(error(path("nothing.igs")), path("nothing.igs"), {"no readable file"});
  for (const char* ending : {".igs", ".step"}) {
    const std::string good = path(std::string("good") + ending),
                      bad = path(std::string("bad") + ending);
    write_cad(good, plate());
    const std::string text = read_file(good);
    write_file(bad, "");
    test::check_names(error(bad), bad, {"an empty file"});
    write_file(bad, text.substr(0, text.size() / 2));
    test::check_names(error(bad), bad, {"cut off"});
    write_file(bad, std::string(4000, 'x'));
    test::check_names(error(bad), bad, {"cut off"});
  }
  test::check_names(error(path("a.json")), path("a.json"), {".igs, .iges, .stp or .step"});
  test::check_names(test::error_of([&] { write_cad(path("x.igs"), {}); }), path("x.igs"),
                    {"no part"});
  auto parts = plate();
  parts[0].shape = insert_knot(parts[0].shape, 0, 0.5, 3);
  test::check_names(test::error_of([&] { write_cad(path("x.igs"), parts); }), path("x.igs"),
                    {"plate", "repeated 3 times"});
  CHECK(!std::filesystem::exists(path("x.igs")));
}

TEST_CASE("a scene's solids become CAD parts with the control points of a state, and back") {
  const auto parts = box_with_stud();
  CadModel model;
  model.parts = parts;
  model.n_solids = 1;
  const auto solids = solids_of(model, {MaterialModel::neo_ref, 1e5, 0.3, 1000});
  REQUIRE(solids.size() == 1);
  CHECK(solids[0].parts[5].trims.size() == parts[5].trims.size());
  const auto boundary = boundary_of(parts);
  const Points<3> moved = 2 * rest_controls(boundary);
  const auto deformed = cad_parts(solids, &moved);
  REQUIRE(deformed.size() == parts.size());
  for (size_t i = 0; i < parts.size(); ++i)
    CHECK(deformed[i].shape.control_points == 2 * parts[i].shape.control_points);
}
