// Input that means harm, or comes from other editors: sizes, bytes and depths.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "bodies.h"
#include "errors.h"
#include "scene_texts.h"

using namespace sem;

TEST_CASE("hostile: a quadrature that would not fit in memory is an error, not a crash") {
  test::check_names(test::error_of(test::triangle(), {"method.quadrature.rays=100000",
                                                      "method.quadrature.points=10000"}),
                    "test.json", {"method.quadrature.points", "1e+09", "at most 1e+07"});
  const std::string box = write_scene(test::box_scene<3>());
  const auto read = [&] { read_scene<3>(box, "my.json", {}, {"method.quadrature.rays=100000"}); };
  test::check_names(test::error_of(read), "my.json",
                    {"method.quadrature.rays", "1e+10 rays", "at most 1e+07"});
}

TEST_CASE("hostile: pictures without pixels and runs without end") {
  for (const auto& [override, allowed] : std::vector<std::pair<std::string, std::string>>{
           {"output.width=0", "from 16 to 8192"},
           {"output.height=-5", "from 16 to 8192"},
           {"output.width=1000000", "from 16 to 8192"},
           {"analysis.time_step=1e-10", "1 to 1e9 times the time_step, 1e-10"}}) {
    CAPTURE(override);
    test::check_names(test::error_of(test::triangle(), {override}), "test.json", {allowed});
  }
}

TEST_CASE("hostile: a million brackets do not exhaust the stack") {
  for (const std::string open : {"[", "{\"a\":"}) {
    std::string text = "{\"name\": ";
    for (int i = 0; i < 1000000; ++i) text += open;
    CHECK(test::error_of(text).find("100 levels") != std::string::npos);
    const std::string value = text.substr(9);
    CHECK(test::error_of(test::triangle(), {"name=" + value}) == "no error");  // a text
  }
  const std::string closed = std::string(100000, '[') + std::string(100000, ']');
  CHECK(test::error_of(test::triangle(), {"name=" + closed}).find("levels") != std::string::npos);
  CHECK(test::error_of(test::triangle(), {std::string(100000, 'a') + "=1"}).starts_with("--set"));
}

TEST_CASE("hostile: what was found is shown short and never cut inside a character") {
  for (int n = 50; n < 60; ++n) {
    std::string name(n, 'x');
    for (int i = 0; i < 1000; ++i) name += "\xC3\xA4";
    const std::string error = test::error_of(test::triangle("\"dimension\": \"" + name + "\""));
    CHECK(error.size() < 140);
    CHECK_NOTHROW(nlohmann::json(error).dump());  // throws for what is no UTF-8
  }
}

TEST_CASE("a byte order mark, comments and line ends of other systems are welcome") {
  const std::string text = write_scene(test::box_scene<2>());
  std::string other = "\xEF\xBB\xBF// a comment\r\n/* and\r\nanother */";
  for (const char c : text) other += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(write_scene(test::read(other)) == text);
}

TEST_CASE("two solids of one name are refused") {
  auto scene = test::box_scene<2>();
  scene.solids.push_back(scene.solids[0]);
  test::check_names(test::error_of(write_scene(scene)), "test.json",
                    {"solids", "two solids named 'box'"});
}
