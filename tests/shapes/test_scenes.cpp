// The built-in scenes: each reads, survives writing and makes a model.
#include <set>

#include "dims.h"
#include "sem/scene/builtin.h"
#include "sem/scene/model.h"
#include "sem/scene/read_scene.h"
#include "src2d/shapes/shape_fields.h"
#include "src3d/shapes/shape_fields.h"

using namespace sem;

namespace {

template <int Dim>
ShapeLibrary<Dim> shapes();
template <>
ShapeLibrary<2> shapes<2>() {
  return shapes2d::describe_shape;
}
template <>
ShapeLibrary<3> shapes<3>() {
  return shapes3d::describe_shape;
}

template <int Dim>
Scene<Dim> read(const BuiltinScene& scene) {
  return read_scene<Dim>(scene.text, scene.name + ".json", shapes<Dim>());
}

template <int Dim>
const BuiltinScene& builtin(const std::string& name) {
  for (const auto& scene : builtin_scenes<Dim>())
    if (scene.name == name) return scene;
  FAIL("no scene " << name);
  return builtin_scenes<Dim>()[0];
}

}  // namespace

TEST_CASE_TEMPLATE("built-in scenes: all named and described, the first one is for a first look", T,
                   D2, D3) {
  constexpr int Dim = T::value;
  REQUIRE(builtin_scenes<Dim>().size() == 12);
  CHECK(builtin_scenes<Dim>()[0].name == (Dim == 2 ? "blob" : "cube"));
  std::set<std::string> names;
  for (const auto& builtin : builtin_scenes<Dim>()) {
    CAPTURE(builtin.name);
    CHECK(names.insert(builtin.name).second);
    const Scene<Dim> scene = read<Dim>(builtin);
    CHECK(scene.name == builtin.name);
    CHECK(scene.description == builtin.description);
    CHECK(builtin.description.size() > 20);
    CHECK(builtin.description.size() < 100);
  }
}

TEST_CASE_TEMPLATE("built-in scenes: written out in full they read as the same scene", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const auto& builtin : builtin_scenes<Dim>()) {
    CAPTURE(builtin.name);
    const std::string written = write_scene(read<Dim>(builtin));
    CHECK(write_scene(read_scene<Dim>(written, "written", {})) == written);
  }
}

TEST_CASE_TEMPLATE("built-in scenes: each makes a model that covers its inside", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const auto& builtin : builtin_scenes<Dim>()) {
    CAPTURE(builtin.name);
    if (builtin.name == "tyre" || builtin.name.starts_with("mug")) continue;  // their preparation takes seconds
    const auto model = build_model(read<Dim>(builtin), builtin.name);
    const auto& d = model->discretization;
    CHECK(d.weights.uncovered.empty());
    CHECK(d.rays.n_unpaired == 0);
    CHECK(d.loops.n_gaps == (builtin.name == "gap_blob" ? 1 : 0));
    CHECK(model->n_unknowns() > 0);
    CHECK(model->system.load.allFinite());
    CHECK(model->system.mass.all_finite());
  }
}

TEST_CASE("square scene: 24 control points, 100 quadrature points, one corner held") {
  const auto model = build_model(read<2>(builtin<2>("square")), "square");
  CHECK(model->discretization.boundary.n_controls() == 24);
  CHECK(model->discretization.quadrature.size() == 100);
  CHECK(model->n_unknowns() == 48 - 4);
  CHECK(model->total_mass() == doctest::Approx(1600).epsilon(1e-12));
}
