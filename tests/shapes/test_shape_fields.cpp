// Shapes in a scene's text: what is read, and what is refused and how.
#include <doctest/doctest.h>

#include "sem/base/error.h"
#include "sem/scene/read_scene.h"
#include "src2d/shapes/shape_fields.h"
#include "src3d/shapes/shape_fields.h"

using namespace sem;

namespace {

Scene<2> read2d(const std::string& shape) {
  return read_scene<2>(R"({"solids": [{"shape": )" + shape + "}]}", "test.json",
                       shapes2d::describe_shape);
}

Scene<3> read3d(const std::string& shape) {
  return read_scene<3>(R"({"solids": [{"shape": )" + shape + "}]}", "test.json",
                       shapes3d::describe_shape);
}

// The error names file and field and says what is allowed.
template <class Read>
void check_refused(const Read& read, const std::string& shape, const std::string& field,
                   const std::string& allowed) {
  CAPTURE(shape);
  std::string message;
  try {
    read(shape);
  } catch (const InputError& error) {
    message = error.what();
  }
  CAPTURE(message);
  CHECK(message.find("test.json: solids[0].shape" + field) == 0);
  CHECK(message.find(allowed) != std::string::npos);
}

}  // namespace

TEST_CASE("every 2D shape is read with the parts that its fields ask for") {
  const std::pair<const char*, size_t> cases[] = {
      {R"({"type": "rectangle"})", 4},
      {R"({"type": "rectangle", "lower": [1, 1], "upper": [2, 3], "parts": [1, 2, 3, 4], "degree": 3})",
       10},
      {R"({"type": "polygon", "vertices": [[0, 0], [1, 0], [0, 1]]})", 3},
      {R"({"type": "polygon", "vertices": [[0, 0], [1, 0], [0, 1]], "parts": [2, 1, 5], "degree": 2})",
       8},
      {R"({"type": "disc", "center": [1, 2], "radius": 3, "arcs": 5})", 5},
      {R"({"type": "ellipse", "radii": [3, 1], "rotation": 0.5})", 4},
      {R"({"type": "annulus", "inner_radius": 0.5, "outer_radius": 1, "arcs": 6})", 12},
      {R"({"type": "closed_curve", "control_points": [[0, 0], [1, 0], [0, 1]]})", 1},
      {R"({"type": "spline_loop", "control_points": [[0, 0], [1, 0], [0, 1]], "parts": 3})", 3},
      {R"({"type": "path", "control_points": [[0, 0], [1, 0], [0, 1]], "degree": 1, "parts": 2})", 2}};
  for (const auto& [shape, n] : cases) {
    CAPTURE(shape);
    CHECK(read2d(shape).solids[0].parts.size() == n);
  }
}

TEST_CASE("bad 2D shapes are refused by name of the field") {
  const auto refused = [](const char* shape, const char* field, const char* allowed) {
    check_refused(read2d, shape, field, allowed);
  };
  refused(R"({})", ".type", "required");
  refused(R"({"type": "discs"})", ".type", "'disc'");
  refused(R"({"type": "disc", "radius": 0})", ".radius", "> 0");
  refused(R"({"type": "disc", "radius": -1})", ".radius", "> 0");
  refused(R"({"type": "disc", "arcs": 2})", ".arcs", "from 3");
  refused(R"({"type": "disc", "arcs": 4.5})", ".arcs", "an integer");
  refused(R"({"type": "disc", "radii": [1, 1]})", "", "radius");
  refused(R"({"type": "ellipse", "radii": [1, 0]})", ".radii[1]", "> 0");
  refused(R"({"type": "ellipse", "radii": [1]})", ".radii", "2 numbers");
  refused(R"({"type": "annulus", "inner_radius": 2})", ".inner_radius", "less than outer_radius");
  refused(R"({"type": "rectangle", "upper": [1, 0]})", ".upper", "more than 'lower'");
  refused(R"({"type": "rectangle", "parts": [1, 1]})", ".parts", "4, one for each side");
  refused(R"({"type": "rectangle", "parts": [1, 1, 0, 1]})", ".parts[2]", ">= 1");
  refused(R"({"type": "rectangle", "parts": [1, 1, 1, 999999999]})", ".parts", "at most");
  refused(R"({"type": "rectangle", "degree": 0})", ".degree", "from 1 to 9");
  refused(R"({"type": "rectangle", "degree": 10})", ".degree", "from 1 to 9");
  refused(R"({"type": "polygon"})", ".vertices", "required");
  refused(R"({"type": "polygon", "vertices": [[0, 0], [1, 0]]})", ".vertices", "at least 3");
  refused(R"({"type": "polygon", "vertices": [[0, 0], [1, 0], [1, 0], [0, 1]]})", ".vertices",
          "not empty");
  refused(R"({"type": "polygon", "vertices": [[0, 0], [1, 0], [0, 1], [0, 0]]})", ".vertices",
          "not empty");
  refused(R"({"type": "closed_curve", "control_points": [[0, 0], [1, 0]]})", ".control_points",
          "at least 3");
  refused(R"({"type": "closed_curve", "control_points": [[1, 0], [1, 0], [1, 0]]})",
          ".control_points", "differ");
  refused(R"({"type": "spline_loop", "control_points": [[0, 0], [1, 0], [0, 1]], "parts": 0})",
          ".parts", "from 1");
  refused(R"({"type": "path", "control_points": [[0, 0], [1, 0]], "degree": 2})", ".control_points", "more than 'degree'");
  refused(R"({"type": "path", "control_points": [[1, 0], [1, 0]]})", ".control_points", "differ");
}

TEST_CASE("every 3D shape is read with the parts that its fields ask for") {
  const std::pair<const char*, size_t> cases[] = {
      {R"({"type": "box", "parts": [2, 1, 1], "degree": 2})", 10},
      {R"({"type": "cylinder", "radius": 2, "top_radius": 1, "height": 3, "arcs": 5})", 15},
      {R"({"type": "cylinder", "caps": false})", 4},
      {R"({"type": "sphere", "radius": 0.1, "split": [2, 2]})", 24},
      {R"({"type": "torus", "parts": [4, 1]})", 4},
      {R"({"type": "extrude", "profile": {"type": "rectangle"}, "by": [0, 0, 2], "caps": "coons"})", 6},
      {R"({"type": "extrude", "profile": {"type": "disc"}})", 12},
      {R"({"type": "revolve", "profile": {"type": "rectangle"}, "parts": 3})", 9},
      {R"({"type": "revolve", "profile": {"type": "path", "control_points": [[1, 0], [2, 1], [1, 2]]}, "angle": 1, "parts": 1})", 1},
      {R"({"type": "loft", "sections": [{"profile": {"type": "disc"}}, {"profile": {"type": "disc"}, "scale": [2, 2, 1],
           "rotate": {"axis": [1, 0, 0], "angle": 0.3}, "move": [0, 0, 3]}]})", 12},
      {R"({"type": "ruled", "curves": [{"control_points": [[0, 0, 0], [1, 0, 0]]}, {"control_points": [[0, 1, 0], [1, 1, 1]]}]})", 1},
      {R"({"type": "coons", "curves": [{"control_points": [[0, 0, 0], [1, 0, 0]]}, {"control_points": [[0, 1, 0], [1, 1, 1]]},
           {"control_points": [[0, 0, 0], [0, 1, 0]]}, {"control_points": [[1, 0, 0], [1, 0.5, 3], [1, 1, 1]], "weights": [1, 2, 1]}]})", 1}};
  for (const auto& [shape, n] : cases) {
    CAPTURE(shape);
    CHECK(read3d(shape).solids[0].parts.size() == n);
  }
}

TEST_CASE("bad 3D shapes are refused by name of the field") {
  const auto refused = [](const char* shape, const char* field, const char* allowed) {
    check_refused(read3d, shape, field, allowed);
  };
  refused(R"({"type": "disc"})", ".type", "box");
  refused(R"({"type": "box", "upper": [1, 1, 0]})", ".upper", "more than");
  refused(R"({"type": "box", "parts": [1, 1]})", ".parts", "3, for x, y and z");
  refused(R"({"type": "box", "parts": [1, -1, 1]})", ".parts[1]", ">= 1");
  refused(R"({"type": "box", "degree": 10})", ".degree", "from 1 to 9");
  refused(R"({"type": "box", "scale": [1, -1, 1]})", ".scale[1]", "> 0");
  refused(R"({"type": "box", "split": [1]})", ".split", "2, along u and v");
  refused(R"({"type": "box", "rotate": {"axis": [0, 0, 0]}})", ".rotate.axis", "a direction");
  refused(R"({"type": "cylinder", "radius": 0})", ".radius", "> 0");
  refused(R"({"type": "cylinder", "arcs": 2})", ".arcs", "from 3");
  refused(R"({"type": "torus", "tube_radius": 3})", ".tube_radius", "less than 'radius'");
  refused(R"({"type": "torus", "parts": [4]})", ".parts", "2, around");
  refused(R"({"type": "extrude"})", ".profile", "required");
  refused(R"({"type": "extrude", "profile": {"type": "disc"}, "by": [1, 0, 0]})", ".by", "out of the profile");
  refused(R"({"type": "extrude", "profile": {"type": "disc", "arcs": 5}, "caps": "coons"})", ".caps", "4 parts");
  refused(R"({"type": "extrude", "profile": {"type": "disc", "arcs": 5}, "caps": "ring"})", ".caps", "annulus");
  refused(R"({"type": "revolve", "profile": {"type": "disc"}})", ".profile", "x >= 0");
  refused(R"({"type": "revolve", "profile": {"type": "rectangle"}, "angle": 7})", ".angle", "6.28");
  refused(R"({"type": "loft", "sections": [{"profile": {"type": "disc"}}]})", ".sections", "at least 2");
  refused(R"({"type": "loft", "sections": [{"profile": {"type": "disc"}}, {"profile": {"type": "disc", "arcs": 5}}]})",
          ".sections", "4 as in the first");
  refused(R"({"type": "ruled", "curves": [{"control_points": [[0, 0, 0], [1, 0, 0]]}]})", ".curves", "2");
  refused(R"({"type": "ruled", "curves": [{"control_points": [[0, 0, 0]]}, {"control_points": [[0, 0, 0], [1, 0, 0]]}]})",
          ".curves[0]", "");
  refused(R"({"type": "coons", "curves": [{"control_points": [[0, 0, 0], [1, 0, 0]]}, {"control_points": [[0, 1, 0], [1, 1, 1]]},
              {"control_points": [[0, 0, 0], [0, 1, 0]]}, {"control_points": [[1, 0, 0], [1, 1, 2]]}]})",
          ".curves", "meet in four corners");
}

TEST_CASE("several shapes in one solid: a name goes before those of the parts, groups of any length select them") {
  const auto scene = read_scene<3>(R"({"solids": [{"shapes": [
      {"type": "box"}, {"type": "cylinder", "name": "peg.small", "move": [0.5, 0.5, 1]}]}],
      "pins": [{"part": "peg.small.side"}, {"part": "peg"}, {"part": "solid.1/left"}]})",
                                   "test.json", shapes3d::describe_shape);
  const auto& parts = scene.solids[0].parts;
  REQUIRE(parts.size() == 18);
  CHECK(parts[0].name == "left");
  CHECK(parts[6].name == "peg.small.side.1");
  CHECK(parts[6].shape.control_points(2, 0) == 1);
  std::string message;
  try {
    read_scene<3>(R"({"solids": [{"shapes": [{"type": "box"}, {"type": "box"}]}]})", "test.json", shapes3d::describe_shape);
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK(message.find("two parts named 'left'") != std::string::npos);
}

TEST_CASE("the documentation of a scene describes every shape") {
  const std::string text = document_scene<2>(shapes2d::describe_shape);
  for (const char* word :
       {"rectangle | polygon | disc | ellipse | annulus | closed_curve | spline_loop | path",
        "inner_radius", "rotation", "vertices", "control_points"})
    CHECK(text.find(word) != std::string::npos);
  const std::string text3d = document_scene<3>(shapes3d::describe_shape);
  for (const char* word : {"box | cylinder | sphere | torus | extrude | revolve | loft | ruled | coons", "box: equal parts",
                           "tube_radius", "sections", "curves", "rotate", "split"})
    CHECK(text3d.find(word) != std::string::npos);
}
