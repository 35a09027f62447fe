// The built-in scenes: each reads, survives writing and makes a model.
#include <doctest/doctest.h>

#include <set>

#include "sem/scene/model.h"
#include "sem/scene/read_scene.h"
#include "sem/scene/builtin.h"
#include "src2d/shapes/shape_fields.h"

using namespace sem;

namespace {

Scene<2> read(const BuiltinScene& scene) {
  return read_scene<2>(scene.text, scene.name + ".json", shapes2d::describe_shape);
}

const BuiltinScene& builtin(const std::string& name) {
  for (const auto& scene : builtin_scenes<2>())
    if (scene.name == name) return scene;
  FAIL("no scene " << name);
  return builtin_scenes<2>()[0];
}

}  // namespace

TEST_CASE("built-in scenes: the blob first, all named and described") {
  REQUIRE(builtin_scenes<2>().size() == 12);
  CHECK(builtin_scenes<2>()[0].name == "blob");
  std::set<std::string> names;
  for (const auto& builtin : builtin_scenes<2>()) {
    CAPTURE(builtin.name);
    CHECK(names.insert(builtin.name).second);
    const Scene<2> scene = read(builtin);
    CHECK(scene.name == builtin.name);
    CHECK(scene.description == builtin.description);
    CHECK(builtin.description.size() > 20);
    CHECK(builtin.description.size() < 100);
  }
}

TEST_CASE("built-in scenes: written out in full they read as the same scene") {
  for (const auto& builtin : builtin_scenes<2>()) {
    CAPTURE(builtin.name);
    const std::string written = write_scene(read(builtin));
    CHECK(write_scene(read_scene<2>(written, "written", {})) == written);
  }
}

TEST_CASE("built-in scenes: each makes a model that covers its inside") {
  for (const auto& builtin : builtin_scenes<2>()) {
    CAPTURE(builtin.name);
    const auto model = build_model(read(builtin), builtin.name);
    const auto& d = model->discretization;
    CHECK(d.weights.uncovered.empty());
    CHECK(d.rays.n_unpaired == 0);
    CHECK(d.loops.n_gaps == (builtin.name == "gap_blob" ? 1 : 0));
    CHECK(model->n_unknowns() > 0);
    CHECK(model->system.load.allFinite());
    CHECK(model->mass.allFinite());
  }
}

TEST_CASE("square scene: 24 control points, 100 quadrature points, one corner held") {
  const auto model = build_model(read(builtin("square")), "square");
  CHECK(model->discretization.boundary.n_controls() == 24);
  CHECK(model->discretization.quadrature.size() == 100);
  CHECK(model->n_unknowns() == 48 - 4);
  CHECK(model->total_mass() == doctest::Approx(1600).epsilon(1e-12));
}
