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
      {R"({"type": "spline_loop", "control_points": [[0, 0], [1, 0], [0, 1]], "parts": 3})", 3}};
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
}

TEST_CASE("bad boxes are refused by name of the field") {
  const auto refused = [](const char* shape, const char* field, const char* allowed) {
    check_refused(read3d, shape, field, allowed);
  };
  CHECK(read3d(R"({"type": "box", "parts": [2, 1, 1], "degree": 2})").solids[0].parts.size() == 10);
  refused(R"({"type": "disc"})", ".type", "box");
  refused(R"({"type": "box", "upper": [1, 1, 0]})", ".upper", "more than");
  refused(R"({"type": "box", "parts": [1, 1]})", ".parts", "3, for x, y and z");
  refused(R"({"type": "box", "parts": [1, -1, 1]})", ".parts[1]", ">= 1");
}

TEST_CASE("the documentation of a scene describes every shape") {
  const std::string text = document_scene<2>(shapes2d::describe_shape);
  for (const char* word :
       {"rectangle | polygon | disc | ellipse | annulus | closed_curve | spline_loop",
        "inner_radius", "rotation", "vertices", "control_points"})
    CHECK(text.find(word) != std::string::npos);
  CHECK(document_scene<3>(shapes3d::describe_shape).find("box: equal parts") != std::string::npos);
}
