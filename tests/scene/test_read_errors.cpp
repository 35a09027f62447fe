// Strict reading of scenes: what is refused and how it is said.
#include <doctest/doctest.h>

#include "scene_texts.h"

using namespace sem;
using namespace sem::test;

namespace {

void check_error(const std::string& text, const std::string& expected) {
  CAPTURE(text);
  CHECK(error_of(text) == expected);
}

// The error begins with `begin` and contains `part`.
void check_error(const std::string& text, const std::string& begin, const std::string& part) {
  CAPTURE(text);
  const std::string error = error_of(text);
  CAPTURE(error);
  CHECK(error.starts_with(begin));
  CHECK(error.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("refused: text that is no JSON, with line and column") {
  check_error("", "test.json: line 1, column 1: found no valid JSON", "comments");
  check_error("{\n  \"name\": nonsense\n}", "test.json: line 2, column 12: ", "invalid literal");
  check_error("{\n  \"name\": \"a\",\n}", "test.json: line 3, column 1: ", "unexpected '}'");
  check_error("{\"gravity\": [0, NaN]}", "test.json: line 1, column 17: ", "invalid literal");
  check_error("{} {}", "test.json: line 1, column 4: ", "expected end of input");
  check_error("{ /* open", "test.json: line 1, column ", "comment");
  check_error("{\"name\": \"\xff\"}", "test.json: line 1, column ", "UTF-8");
  check_error("[]", "test.json: found []; allowed: an object { ... }");
  check_error("3", "test.json: found 3; allowed: an object { ... }");
}

TEST_CASE("refused: a key twice in an object, by its path") {
  check_error(triangle(R"("name": "a", "gravity": [0, 1], "name": "b")"),
              "test.json: name: found this key twice in one object; allowed: each key once");
  check_error(triangle(R"("method": {"weights": {"cutoff": 1, "cutoff": 1}})"),
              "test.json: method.weights.cutoff: found this key twice in one object; allowed: each "
              "key once");
  check_error(
      triangle(
          R"("pins": [{}, {"box": {"lower": [0, 0], "upper": [1, 1]}, "part": "", "part": ""}])"),
      "test.json: pins[1].part: found this key twice in one object; allowed: each key once");
  // The same key in different objects is none.
  CHECK(error_of(triangle(R"("pins": [{"part": "mast"}, {"part": "mast"}])")) == "no error");
}

TEST_CASE("refused: numbers that no double holds, nesting that no scene needs") {
  check_error(triangle(R"("gravity": [0, 1e999])"),
              "test.json: line 4, column 113", "found the number 1e999; allowed: numbers of at most 1e30");
  check_error(triangle(R"("analysis": {"time_step": -1e400})"), "test.json: line 4", "-1e400");
  check_error(triangle(R"("gravity": [0, -2e30])"), "test.json: gravity[1]", "found -2e+30; allowed: a number, at most 1e30 in size");
  check_error(R"({"pins": )" + std::string(100000, '['), "test.json: pins[0]",
              "levels of brackets");
}

TEST_CASE("refused: a part without extent") {
  check_error(R"({"solids": [{"parts": [{"name": "dot", "degree": 1, "knots": [0, 0, 1, 1], "control_points": [[2, 3], [2, 3]]}]}]})",
              "test.json: solids[0].parts", "all control points of 'dot' in one place");
}

TEST_CASE("refused: unknown keys, with the nearest valid one") {
  check_error(
      triangle(R"("method": {"weights": {"cutof": 1}})"),
      "test.json: method.weights: found the unknown key 'cutof'; allowed: 'cutoff' (did you "
      "mean that?), or one of cutoff, distance, layers, patch_levels, side_ramp, sparsity");
  check_error(triangle(R"("gravty": [0, 1])"),
              "test.json: found the unknown key 'gravty'; allowed: 'gravity'", "did you mean");
  check_error(triangle("", R"("color": "red")"),
              "test.json: solids[0]: found the unknown key 'color'; allowed: one of material, "
              "name, parts");
  check_error(triangle("", R"("shape": {"type": "disc"})"),  // no library to look it up
              "test.json: solids[0]: found the unknown key 'shape'", "parts");
  check_error(triangle(R"("analysis": {"type": "static", "time_step": 0.1})"),
              "test.json: analysis: found the unknown key 'time_step'; allowed: ", "load_steps");
  check_error(
      triangle(R"("pins": [{"part": "mast", "axis": "x"}])"),
      "test.json: pins[0]: found the unknown key 'axis'; allowed: 'axes' (did you mean that?)",
      "axes");
}

TEST_CASE("refused: required fields that are missing, with the key that may be meant") {
  check_error("{}", "test.json: solids: found nothing; allowed: this field is required");
  check_error(R"({"solid": []})",
              "test.json: solids: found nothing, but 'solid'; allowed: this field is required");
  check_error(R"({"solids": [{"parts": [{"degree": 1, "knots": [0, 0, 1, 1]}]}]})",
              "test.json: solids[0].parts[0].control_points: found nothing; allowed: this field is "
              "required");
  check_error(
      R"({"solids": [{"parts": [{"knots": [0, 0, 1, 1]}]}]})",
      "test.json: solids[0].parts[0].degree: found nothing; allowed: this field is required");
  check_error(triangle(R"("loads": [{"type": "point", "at": [0, 0]}])"),
              "test.json: loads[0].force: found nothing; allowed: this field is required");
  check_error(triangle(R"("probes": [{"name": "p", "type": "reaction"}])"),
              "test.json: probes[0].pin: found nothing; allowed: this field is required");
  check_error(triangle(R"("pins": [{"box": {"lower": [0, 0]}}])"),
              "test.json: pins[0].box.upper: found nothing; allowed: this field is required");
}

TEST_CASE("refused: values of the wrong type") {
  check_error(triangle(R"("name": 3)"), "test.json: name: found 3; allowed: a text in quotes");
  check_error(triangle(R"("gravity": -10)"),
              "test.json: gravity: found -10; allowed: a list of 2 numbers");
  check_error(triangle(R"("gravity": [0, 0, -10])"),
              "test.json: gravity: found [0,0,-10]; allowed: a list of 2 numbers");
  check_error(triangle(R"("gravity": [0, "-10"])"),
              "test.json: gravity[1]: found \"-10\"; allowed: a number");
  check_error(triangle(R"("gravity": [0, null])"),
              "test.json: gravity[1]: found null; allowed: a number");
  check_error(triangle(R"("method": [])"),
              "test.json: method: found []; allowed: an object { ... }");
  check_error(triangle(R"("pins": {})"), "test.json: pins: found {}; allowed: a list [ ... ]");
  check_error(triangle(R"("pins": ["mast"])"),
              "test.json: pins[0]: found \"mast\"; allowed: an object { ... }");
  check_error(triangle(R"("output": {"error_estimate": 1})"),
              "test.json: output.error_estimate: found 1; allowed: true or false");
  check_error(triangle(R"("pins": [{"control_points": 3}])"),
              "test.json: pins[0].control_points: found 3; allowed: a list of integers");
  check_error(triangle(R"("method": {"fit": 1})"),
              "test.json: method.fit: found 1; allowed: one of degree_by_degree", "pseudo_inverse");
  check_error(triangle("", R"("material": {"youngs_modulus": "1e5"})"),
              "test.json: solids[0].material.youngs_modulus: found \"1e5\"; allowed: a number > 0");
}

TEST_CASE("refused: integers that are none, counts below their least") {
  const auto with_rays = [](const char* value) {
    std::string keys = R"("method": {"quadrature": {"rays": )";
    keys += value;
    return triangle(keys += "}}");
  };
  for (const char* value :
       {"3.9", "3.0", "1e2", "-1", "0", "100001", "4294967296", "18446744073709551615",
        "-9223372036854775808", "99999999999999999999999", "true"}) {
    const std::string error = error_of(with_rays(value));
    CAPTURE(value);
    CAPTURE(error);
    CHECK(error.starts_with("test.json: method.quadrature.rays: found "));
    CHECK(error.ends_with("; allowed: an integer from 1 to 100000"));
  }
  check_error(with_rays("3.9"),
              "test.json: method.quadrature.rays: found 3.9; allowed: an integer from 1 to 100000");
  check_error(triangle(R"("pins": [{"control_points": [0, -1]}])"),
              "test.json: pins[0].control_points[1]: found -1; allowed: an integer >= 0");
  check_error(triangle(R"("method": {"degree": 5})"),
              "test.json: method.degree: found 5; allowed: an integer from 1 to 4");
  check_error(triangle(R"("method": {"samples": {"points_per_span": 1}})"),
              "test.json: method.samples.points_per_span: found 1; allowed: 0 or at least 2");
}

TEST_CASE("refused: numbers out of their range") {
  const auto material = [](const char* entry) {
    return triangle("", std::string(R"("material": {)") + entry + "}");
  };
  check_error(
      material(R"("poisson_ratio": 0.5)"),
      "test.json: solids[0].material.poisson_ratio: found 0.5; allowed: a number > -1 and < 0.5");
  check_error(
      material(R"("poisson_ratio": -1)"),
      "test.json: solids[0].material.poisson_ratio: found -1; allowed: a number > -1 and < 0.5");
  check_error(material(R"("density": -1)"),
              "test.json: solids[0].material.density: found -1; allowed: a number >= 0");
  check_error(material(R"("youngs_modulus": 0)"),
              "test.json: solids[0].material.youngs_modulus: found 0; allowed: a number > 0");
  check_error(triangle(R"("analysis": {"time_step": 0})"),
              "test.json: analysis.time_step: found 0; allowed: a number > 0");
  check_error(
      triangle(R"("analysis": {"time_step": 0.5, "duration": 0.1})"),
      "test.json: analysis.duration: found 0.1; allowed: 1 to 1e9 times the time_step, 0.5");
  check_error(triangle(R"("method": {"weights": {"cutoff": 0}})"),
              "test.json: method.weights.cutoff: found 0; allowed: a number > 0");
  check_error(triangle(R"("method": {"weights": {"sparsity": 1.5}})"),
              "test.json: method.weights.sparsity: found 1.5; allowed: a number > 0 and <= 1");
}

TEST_CASE("refused: words that are no choice, with the nearest one") {
  check_error(triangle("", R"("material": {"model": "neo_lag"})"),
              "test.json: solids[0].material.model: found 'neo_lag'; allowed: 'neo_log' (did you "
              "mean that?), or one "
              "of linear, stvk, corotated, neo_log, neo_ref, neo_iso");
  check_error(triangle(R"("analysis": {"type": "statics"})"),
              "test.json: analysis.type: found 'statics'; allowed: 'static' (did you mean that?), "
              "or one of static, "
              "dynamic, modes");
  check_error(triangle(R"("method": {"quadrature": {"axis": "z"}})"),
              "test.json: method.quadrature.axis: found 'z'; allowed: ", "one of x, y");
  check_error(triangle(R"("pins": [{"axes": "xz"}])"),
              "test.json: pins[0].axes: found 'z'; allowed: some of xy");
}

TEST_CASE("refused: NURBS that are none, by their field") {
  const auto part = [](const char* keys) {
    return std::string(R"({"solids": [{"parts": [{)") + keys + "}]}]}";
  };
  check_error(
      part(R"("degree": 1, "knots": [0, 0, 2, 1, 3], "control_points": [[0, 0], [1, 0], [2, 0]])"),
      "test.json: solids[0].parts[0].knots[3]: found 1; allowed: >= the knot before it, 2");
  check_error(
      part(
          R"("degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0]], "weights": [1, 0])"),
      "test.json: solids[0].parts[0].weights[1]: found 0; allowed: a number > 0");
  check_error(
      part(
          R"("degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0]], "weights": [1])"),
      "test.json: solids[0].parts[0].weights: found [1]; allowed: a list of 2 numbers");
  check_error(part(R"("degree": 1, "knots": [0, 0, 1], "control_points": [[0, 0], [1, 0]])"),
              "test.json: solids[0].parts[0].knots", "; allowed: ");
  check_error(
      part(R"("degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0], [2, 0]])"),
      "test.json: solids[0].parts[0].", "; allowed: ");
  check_error(part(R"("degree": 1, "knots": [0, 0, 1, 1], "control_points": [])"),
              "test.json: solids[0].parts[0].", "; allowed: ");
  check_error(part(R"("degree": 0, "knots": [0, 1], "control_points": [[0, 0]])"),
              "test.json: solids[0].parts[0].degree: found 0; allowed: an integer from 1 to ",
              "32");
  check_error(part(R"("degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, "x"]])"),
              "test.json: solids[0].parts[0].control_points[1]",
              ": found \"x\"; allowed: a number");
  check_error(
      part(R"("degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1]])"),
      "test.json: solids[0].parts[0].control_points[1]: found [1]; allowed: a list of 2 numbers");
}

TEST_CASE("refused: names that nothing has, with the nearest one") {
  check_error(
      triangle(R"("pins": [{"part": "mst"}])"),
      "test.json: pins[0].part: found 'mst'; allowed: 'mast' (did you mean that?), or one of ",
      "side.2");
  check_error(
      triangle(
          R"("loads": [{"type": "body", "force": [0, 1]}, {"type": "boundary", "part": "sale/mast", "pressure": 1}])"),
      "test.json: loads[1].part: found 'sale/mast'; allowed: 'sail/mast' (did "
      "you mean that?)",
      "side");
  check_error(triangle(R"("loads": [{"type": "body", "force": [0, 1], "solid": "hull"}])"),
              "test.json: loads[0].solid: found 'hull'; allowed: one of sail");
  for (const char* known : {"mast", "side", "side.2", "sail/mast", "sail/side", "sail/side.1"})
    CHECK(error_of(triangle(std::string(R"("pins": [{"part": ")") + known + "\"}]")) == "no error");
}

TEST_CASE("refused: a name twice, probes that cannot be") {
  check_error(R"({"solids": [{"parts": [
      {"name": "a", "degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0]]},
      {"name": "a", "degree": 1, "knots": [0, 0, 1, 1], "control_points": [[1, 0], [0, 0]]}]}]})",
              "test.json: solids[0].parts: found two parts named 'a'; allowed: a name of its own "
              "for each part");
  check_error(R"({"solids": []})",
              "test.json: solids: found an empty list; allowed: at least one solid");
  check_error(R"({"solids": [{}]})",
              "test.json: solids[0]: found no part; allowed: 'parts' or a 'shape'");
  check_error(
      triangle(R"("probes": [{"name": "p", "at": [0, 0]}, {"name": "p", "at": [1, 0]}])"),
      "test.json: probes[1]: found a second probe named 'p'; allowed: a name of its own for each");
  check_error(triangle(R"("probes": [{"name": "p,q", "at": [0, 0]}])"),
              "test.json: probes[0].name: found 'p,q'; allowed: a name without commas, quotes and "
              "line ends");
  check_error(
      triangle(
          R"("pins": [{"part": "mast"}], "probes": [{"name": "p", "type": "reaction", "pin": 1}])"),
      "test.json: probes[0].pin: found 1; allowed: the index of one of the 1 pins, from 0");
}

TEST_CASE("refused: settings that exclude each other") {
  check_error(
      triangle(R"("method": {"weights": {"cutoff": 1, "sparsity": 0.5}})"),
      "test.json: method.weights.cutoff: found both cutoff and sparsity; allowed: one of them");
  check_error(triangle(R"("pins": [{"part": "mast", "displacement": [1, 0]}])"),
              "test.json: pins[0].duration: found 0 with a prescribed displacement; allowed: > 0 s in a dynamic analysis");
  check_error(triangle(R"("dimension": 3)"),
              "test.json: dimension: found 3; allowed: 2 in this program");
  check_error(triangle(R"("pins": [{"box": {"lower": [1, 0], "upper": [0, 1]}}])"),
              "test.json: pins[0].box.lower: found a corner above 'upper'; allowed: lower <= upper "
              "in every coordinate");
}
