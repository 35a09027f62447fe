#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include "sem/base/error.h"
#include "sem/nurbs/nurbs.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::string error_of(const std::function<void(Nurbs<1, 2>&)>& spoil) {
  auto curve = circle({0, 0}, 1);
  spoil(curve);
  try {
    check(curve, "scene.json", "parts[2]");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool starts(const std::string& text, const std::string& start) {
  return text.rfind("scene.json: " + start + ": found ", 0) == 0 &&
         text.find("allowed: ") != std::string::npos;
}

}  // namespace

TEST_CASE("a valid NURBS passes") {
  CHECK(error_of([](auto&) {}) == "");
  std::mt19937 random(51);
  for (int trial = 0; trial < 100; ++trial) {
    CHECK_NOTHROW(check(random_nurbs<1, 2>(random, 1 + trial % 6, 3, trial % 2, true), "", ""));
    CHECK_NOTHROW(check(random_nurbs<2, 3>(random, 1 + trial % 4, 2, trial % 2, true), "", ""));
  }
}

TEST_CASE("an invalid NURBS is refused with the field that is wrong") {
  CHECK(starts(error_of([](auto& c) { c.degree[0] = 0; }), "parts[2].degree"));
  CHECK(starts(error_of([](auto& c) { c.degree[0] = -3; }), "parts[2].degree"));
  CHECK(starts(error_of([](auto& c) { c.degree[0] = 33; }), "parts[2].degree"));
  CHECK(starts(error_of([](auto& c) { c.knots[0].clear(); }), "parts[2].knots"));
  CHECK(starts(error_of([](auto& c) { c.knots[0].resize(5); }), "parts[2].knots"));
  CHECK(starts(error_of([](auto& c) { c.knots[0][4] = 0.5; }), "parts[2].knots[4]"));
  CHECK(starts(error_of([](auto& c) { c.knots[0][4] = not_a_number; }), "parts[2].knots[4]"));
  CHECK(starts(error_of([](auto& c) { c.knots[0][11] = infinity; }), "parts[2].knots[11]"));
  CHECK(starts(error_of([](auto& c) { c.knots[0][3] = 0; }), "parts[2].knots[3]"));
  CHECK(starts(error_of([](auto& c) { c.knots[0].push_back(5); }), "parts[2].control_points"));
  CHECK(starts(error_of([](auto& c) { c.control_points(1, 3) = not_a_number; }),
               "parts[2].control_points[3][1]"));
  CHECK(starts(error_of([](auto& c) { c.weights[5] = 0; }), "parts[2].weights[5]"));
  CHECK(starts(error_of([](auto& c) { c.weights[5] = -1; }), "parts[2].weights[5]"));
  CHECK(starts(error_of([](auto& c) { c.weights[5] = not_a_number; }), "parts[2].weights[5]"));
  CHECK(starts(error_of([](auto& c) { c.weights[5] = infinity; }), "parts[2].weights[5]"));
  CHECK(starts(error_of([](auto& c) { c.weights.conservativeResize(8); }), "parts[2].weights"));
  CHECK(starts(error_of([](auto& c) {
                 c.degree[0] = 3;  // domain from knot 3 to 3 + 1 - 1
                 c.knots[0] = {0, 1, 1, 1, 1, 2, 2, 2};
                 c.control_points.conservativeResize(2, 4);
                 c.weights.conservativeResize(4);
               }),
               "parts[2].knots"));
}

TEST_CASE("a surface names the axis of the knots that are wrong") {
  std::mt19937 random(52);
  auto surface = random_nurbs<2, 3>(random, 2, 3, true, false);
  surface.knots[1][4] = -100;
  CHECK_THROWS_WITH_AS(check(surface, "s.json", "parts[0]"),
                       doctest::Contains("parts[0].knots_v[4]"), InputError);
}
