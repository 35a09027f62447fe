// Reading, writing and documenting scenes.
#include <doctest/doctest.h>

#include <regex>
#include <set>

#include "dims.h"
#include "scene_texts.h"

using namespace sem;
using namespace sem::test;

namespace {

// In 3D one bilinear patch will do.
std::string patch(const std::string& keys = "") {
  return R"({"solids": [{"parts": [{"name": "lid", "degree_u": 1, "degree_v": 1,
    "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 2, 2],
    "control_points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.5]], "weights": [1, 2, 1, 1]}]}])" +
         (keys.empty() ? "" : ", " + keys) + "}";
}

// Every kind of entry that a scene can have.
template <int Dim>
std::string full_scene() {
  const std::string v = Dim == 2 ? "[1, -2]" : "[1, -2, 3]";
  const std::string w = Dim == 2 ? "[2, 2]" : "[2, 2, 4]";
  const std::string part = Dim == 2 ? "mast" : "lid";
  const std::string keys =
      R"("name": "full", "description": "all of it", "dimension": )" + std::to_string(Dim) +
      R"(, "method": {"degree": 3, "fit": "pseudo_inverse", "samples": {"points_per_span": 4, "weight": "uniform"},
        "quadrature": {"axis": "y", "rays": 7, "grid": "gauss", "rule": "gauss", "points": 3, "spacing": 0.25},
        "weights": {"distance": "draft", "sparsity": 0.4}, "origins": "one", "kept_columns": 5,
        "renormalise": false, "threads": 3},
      "stability": {"stiffness": 2.5, "kinetic_length": 0.125}, "gravity": )" +
      v + R"(, "loads": [{"type": "body", "force": )" + v + R"(, "solid": ""},
        {"type": "boundary", "part": ")" +
      part + R"(", "box": {"lower": )" + v + R"(, "upper": )" + w + R"(}, "traction": )" + v +
      R"(, "pressure": 0.1}, {"type": "point", "at": )" + v + R"(, "force": )" + w +
      R"(}], "pins": [{"part": ")" + part +
      R"(", "control_points": [0, 1], "axes": "y", "displacement": )" + v +
      R"(}, {"box": {"lower": )" + v + R"(, "upper": )" + w + R"(}}],
      "initial": {"velocity": )" +
      v + R"(, "angular_velocity": 0.3},
      "probes": [{"name": "a", "type": "displacement", "at": )" +
      v + R"(}, {"name": "b", "type": "stress", "at": )" + w +
      R"(}, {"name": "c", "type": "reaction", "pin": 1}],
      "analysis": {"type": "static", "load_steps": 4, "max_iterations": 9, "tolerance": 1e-7},
      "output": {"frame_rate": 24, "width": 640, "height": 480,
        "view": {"lower": [-1, -2], "upper": [3, 4]}, "error_estimate": false, "checkpoint_interval": 0.5})";
  return Dim == 2
             ? triangle(
                   keys,
                   R"("material": {"model": "stvk", "youngs_modulus": 0.1, "poisson_ratio": -0.2, "density": 3})")
             : patch(keys);
}

}  // namespace

TEST_CASE("reading: comments are allowed, absent keys keep their defaults") {
  const Scene<2> scene = read("// a scene\n" + triangle(R"("gravity": [0, -10] /* down */)"));
  CHECK(scene.gravity == Vec<2>(0, -10));
  CHECK(scene.solids[0].parts.size() == 3);
  CHECK(scene.solids[0].parts[1].shape.weights == Eigen::Vector2d(1, 1));
  CHECK(scene.method.projection.degree == ProjectionOptions{}.degree);
  CHECK(scene.method.weights.cutoff == WeightOptions{}.cutoff);
  CHECK(scene.analysis.time_step == Analysis{}.time_step);
  CHECK(scene.output.width == OutputOptions{}.width);
  CHECK(scene.solids[0].material.model == MaterialModel::neo_log);
}

TEST_CASE_TEMPLATE("reading: every key reaches its field", T, D2, D3) {
  constexpr int Dim = T::value;
  const Scene<Dim> s = read_scene<Dim>(full_scene<Dim>(), "full.json", {});
  Vec<Dim> v, w;
  for (int a = 0; a < Dim; ++a) v[a] = a == 1 ? -2 : a + 1, w[a] = a == 2 ? 4 : 2;
  CHECK(s.name == "full");
  CHECK(s.description == "all of it");
  CHECK(s.method.projection.degree == 3);
  CHECK(s.method.projection.fit == FitKind::pseudo_inverse);
  CHECK(s.method.sampling.points_per_span == 4);
  CHECK(s.method.sampling.weight == SampleWeight::uniform);
  CHECK(s.method.rays.axis == 1);
  CHECK(s.method.rays.n_rays == 7);
  CHECK(s.method.rays.grid == RayGrid::gauss);
  CHECK(s.method.interval.rule == IntervalRule::gauss);
  CHECK(s.method.interval.points == 3);
  CHECK(s.method.interval.spacing == 0.25);
  CHECK(s.method.weights.variant == DistanceWeight::draft);
  CHECK(s.method.weights.sparsity == 0.4);
  CHECK(s.method.origins == OriginChoice::one);
  CHECK(s.method.kept_columns == 5);
  CHECK(s.method.renormalise == false);
  CHECK(s.method.n_threads == 3);
  CHECK(s.stability_stiffness == 2.5);
  CHECK(s.kinetic_length == 0.125);
  CHECK(s.gravity == v);
  REQUIRE(s.body_loads.size() == 1);
  CHECK(s.body_loads[0].force == v);
  REQUIRE(s.boundary_loads.size() == 1);
  CHECK(s.boundary_loads[0].where.part == (Dim == 2 ? "mast" : "lid"));
  CHECK(s.boundary_loads[0].where.box->lower == v);
  CHECK(s.boundary_loads[0].where.box->upper == w);
  CHECK(s.boundary_loads[0].traction == v);
  CHECK(s.boundary_loads[0].pressure == 0.1);
  REQUIRE(s.point_loads.size() == 1);
  CHECK(s.point_loads[0].at == v);
  CHECK(s.point_loads[0].force == w);
  REQUIRE(s.pins.size() == 2);
  CHECK(s.pins[0].where.control_points == std::vector{0, 1});
  CHECK(s.pins[0].displacement == v);
  for (int a = 0; a < Dim; ++a) {
    CHECK(s.pins[0].axes[a] == (a == 1));
    CHECK(s.pins[1].axes[a]);
  }
  CHECK(s.velocity == v);
  CHECK(s.angular_velocity == 0.3);
  REQUIRE(s.probes.size() == 3);
  CHECK(s.probes[1].kind == ProbeKind::stress);
  CHECK(s.probes[1].at == w);
  CHECK(s.probes[2].kind == ProbeKind::reaction);
  CHECK(s.probes[2].pin == 1);
  CHECK(s.analysis.kind == AnalysisKind::statics);
  CHECK(s.analysis.load_steps == 4);
  CHECK(s.analysis.max_iterations == 9);
  CHECK(s.analysis.tolerance == 1e-7);
  CHECK(s.output.frame_rate == 24);
  CHECK(s.output.width == 640);
  CHECK(s.output.height == 480);
  CHECK(s.output.view->lower == Vec<2>(-1, -2));
  CHECK(s.output.view->upper == Vec<2>(3, 4));
  CHECK(s.output.error_estimate == false);
  CHECK(s.output.checkpoint_interval == 0.5);
}

TEST_CASE_TEMPLATE("writing: a written scene reads back as the same", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const std::string& text : {full_scene<Dim>(), Dim == 2 ? triangle() : patch()}) {
    const std::string written = write_scene(read_scene<Dim>(text, "full.json", {}));
    const Scene<Dim> again = read_scene<Dim>(written, "written.json", {});
    CHECK(write_scene(again) == written);
    // Not only the text: numbers that have no short decimal form, and rational weights.
    const Scene<Dim> first = read_scene<Dim>(text, "full.json", {});
    CHECK(again.solids[0].material.youngs_modulus == first.solids[0].material.youngs_modulus);
    CHECK(again.solids[0].parts[0].shape.weights == first.solids[0].parts[0].shape.weights);
    CHECK(again.solids[0].parts[0].shape.control_points ==
          first.solids[0].parts[0].shape.control_points);
  }
}

TEST_CASE("writing: numbers keep all their digits") {
  Scene<2> scene = read(triangle());
  scene.gravity << 1.0 / 3, -0.1 - 0.2;
  scene.analysis.time_step = 5e-324;
  scene.analysis.duration = 4.9e-316;
  scene.solids[0].material.youngs_modulus = 1.7976931348623157e29;
  const Scene<2> again = read(write_scene(scene));
  CHECK(again.gravity == scene.gravity);
  CHECK(again.analysis.time_step == 5e-324);
  CHECK(again.analysis.duration == 4.9e-316);
  CHECK(again.solids[0].material.youngs_modulus == 1.7976931348623157e29);
}

TEST_CASE_TEMPLATE("schema: every key that a scene can hold is described with it", T, D2, D3) {
  constexpr int Dim = T::value;
  const std::string schema = document_scene<Dim>({});
  std::set<std::string> keys;
  for (const std::string analysis :
       {R"({"type": "static"})", R"({"type": "dynamic"})", R"({"type": "modes"})"}) {
    auto scene = read_scene<Dim>(full_scene<Dim>(), "", {});
    for (auto& pin : scene.pins) pin.displacement.setZero();
    scene.analysis =
        read("{\"analysis\": " + analysis + triangle().insert(1, ", ").substr(1)).analysis;
    scene.solids[0].parts[0].material.emplace();
    const std::string text = write_scene(scene);
    const std::regex key("\"(\\w+)\": ");
    for (std::sregex_iterator i(text.begin(), text.end(), key), end; i != end; ++i)
      keys.insert((*i)[1]);
  }
  keys.insert({"weights", "cutoff", "sparsity"});
  CHECK(keys.size() > 60);
  for (const auto& key : keys) {
    CAPTURE(key);
    CHECK(std::regex_search(schema, std::regex("(^|\n) *" + key + ": ")));
  }
  // Units, defaults and choices are part of it.
  CHECK(schema.find("time_step: a number > 0, s; default 0.01") != std::string::npos);
  CHECK(schema.find("kg/m^3") != std::string::npos);
  CHECK(schema.find("linear | stvk | corotated | neo_log | neo_ref | neo_iso") !=
        std::string::npos);
}

TEST_CASE("overrides: set a value by its path, JSON or a bare word") {
  const std::string text =
      triangle(R"("gravity": [0, -10], "analysis": {"type": "dynamic", "time_step": 0.1})");
  const Scene<2> scene = read(
      text, {"method.degree=2", "solids[0].material.youngs_modulus=2e5", "analysis.time_step=0.005",
             "gravity[1]=-1", "name=a b = c", "description=\"3\"",
             "solids[0].parts[0].control_points[1][0]=2", "solids[0].material.model=stvk",
             "initial={\"velocity\": [1, 2]}", "output.error_estimate=false", "method.degree=3"});
  CHECK(scene.method.projection.degree == 3);  // the last one counts
  CHECK(scene.solids[0].material.youngs_modulus == 2e5);
  CHECK(scene.solids[0].material.model == MaterialModel::stvk);
  CHECK(scene.analysis.time_step == 0.005);
  CHECK(scene.gravity == Vec<2>(0, -1));
  CHECK(scene.name == "a b = c");
  CHECK(scene.description == "3");
  CHECK(scene.solids[0].parts[0].shape.control_points(0, 1) == 2);
  CHECK(scene.velocity == Vec<2>(1, 2));
  CHECK(scene.output.error_estimate == false);
}

TEST_CASE("overrides: read as strictly as the file") {
  const auto check = [](const std::string& pair, const std::string& begin) {
    const std::string error = error_of(triangle(R"("gravity": [0, -10])"), {pair});
    CAPTURE(pair);
    CAPTURE(error);
    CHECK(error.starts_with(begin));
  };
  check("analysis.time_stp=1",
        "test.json: analysis: found the unknown key 'time_stp'; allowed: 'time_step' (did you");
  check("analysis.time_step=fast",
        "test.json: analysis.time_step: found \"fast\"; allowed: a number > 0");
  check("method.degree=2.5",
        "test.json: method.degree: found 2.5; allowed: an integer from 1 to 4");
  check("analysis={\"time_step\": 0}",
        "test.json: analysis.time_step: found 0; allowed: a number > 0");
  const std::string twice = "analysis={\"type\": \"static\", \"type\": \"modes\"}";
  check(twice, "--set " + twice + ": type: found this key twice");
  check("gravity[1]=1e999", "test.json: gravity[1]: found \"1e999\"; allowed: a number");
  check("gravity[2]=1", "--set: gravity[2]=1: found index 2, which is not in the scene");
  check("gravity.x=1", "--set: gravity.x=1: found 'gravity.x', where 'x' is no key of an object");
  for (const char* pair :
       {"analysis.=1", ".=1", "a..b=1", "solids[]=1", "solids[x]=1", "solids[-1]=1", "solids[0=1",
        "solids[0]name=1", "solids[99999999999999999999]=1"})
    check(pair, std::string("--set: ") + pair + ": found '");
  check("gravity", "--set: gravity: found no key=value");
  check("=1", "--set: =1: found no key=value");
  // Bytes that are no text are replaced: the settings can still be written.
  CHECK_NOTHROW(write_scene(read(triangle(), {"name=\xff"})));
}

TEST_CASE("the nearest name: few edits away, or none") {
  const std::vector<std::string> names = {"cutoff", "distance", "sparsity"};
  CHECK(closest_name("cutof", names) == "cutoff");
  CHECK(closest_name("distence", names) == "distance");
  CHECK(closest_name("sparcity", names) == "sparsity");
  CHECK(closest_name("wavelength", names) == "");
  CHECK(closest_name("x", names) == "");
  CHECK(closest_name("cutoff", {}) == "");
}
