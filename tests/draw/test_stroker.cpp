// Areas and extents of thick lines; the area of a union is measured on the raster canvas.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "sem/draw/raster.h"
#include "sem/draw/stroker.h"

using namespace sem;

namespace {

using std::numbers::pi;

Box<2> extent(const std::vector<Vec<2>>& triangles) {
  Box<2> box;
  for (const auto& x : triangles) box.include(x);
  return box;
}

double area(std::span<const Vec<2>> points, const Stroke& style) {
  RasterCanvas canvas(200, 200, 4);
  canvas.stroke(points, style);
  double sum = 0;
  const Image image = canvas.finish();
  for (auto value : image.rgb) sum += 1 - value / 255.0;
  return sum / 3;
}

/// Two legs of 100 with the given angle between them, the corner at (20, 100).
Polyline corner(double angle) {
  const Vec<2> c(20, 100);
  const double h = angle / 2;
  return {c + 100 * Vec<2>(std::cos(h), -std::sin(h)), c,
          c + 100 * Vec<2>(std::cos(h), std::sin(h))};
}

/// Union of two legs that meet at the angle: both, less the kite on the inner side, plus the kite
/// or the sector on the outer side.
double corner_area(double angle, double width) {
  const double r = width / 2, kite = r * r / std::tan(angle / 2);
  const double outer = angle >= pi / 3 ? r * r / std::tan(angle / 2) : r * r * (pi - angle) / 2;
  return 2 * 100 * width - kite + outer;
}

}  // namespace

TEST_CASE("a straight line has its width and length") {
  const Vec<2> level[] = {{10, 50}, {110, 50}};
  CHECK(area(level, {.width = 3}) == doctest::Approx(300).epsilon(0.002));
  const Vec<2> oblique[] = {{10, 20}, {130, 110}};  // 150 long
  CHECK(area(oblique, {.width = 2.5}) == doctest::Approx(375).epsilon(0.005));
  CHECK(area(oblique, {.width = 10, .cap = Stroke::Cap::round}) ==
        doctest::Approx(1500 + 25 * pi).epsilon(0.005));
}

TEST_CASE("a corner is mitred above 60 degrees and rounded below, at full width") {
  for (double degrees : {150.0, 90.0, 61.0, 59.0, 30.0, 15.0}) {
    CAPTURE(degrees);
    const double angle = degrees * pi / 180, width = 8;
    const auto points = corner(angle);
    CHECK(area(points, {.width = width}) ==
          doctest::Approx(corner_area(angle, width)).epsilon(0.007));
    const double reach = degrees >= 60 ? width / 2 / std::sin(angle / 2) : width / 2;
    CHECK(extent(stroke_triangles(points, {.width = width})).lower[0] ==
          doctest::Approx(20 - reach).epsilon(0.003));
  }
}

TEST_CASE("a line that turns back on itself ends round") {
  const Vec<2> points[] = {{50, 50}, {100, 50}, {50, 50}};
  const auto box = extent(stroke_triangles(points, {.width = 10}));
  CHECK(box.upper[0] == doctest::Approx(105).epsilon(1e-3));
  CHECK(box.lower[0] == doctest::Approx(50));
  CHECK(box.upper[1] == doctest::Approx(55));
}

TEST_CASE("a closed box has mitred corners everywhere") {
  const Vec<2> box[] = {{50, 50}, {150, 50}, {150, 120}, {50, 120}};
  CHECK(area(box, {.width = 4, .closed = true}) ==
        doctest::Approx(104 * 74 - 96 * 66).epsilon(1e-6));
  const Vec<2> repeated[] = {{50, 50}, {150, 50}, {150, 50}, {150, 120}, {50, 120}, {50, 50}};
  CHECK(area(repeated, {.width = 4, .closed = true}) ==
        doctest::Approx(104 * 74 - 96 * 66).epsilon(1e-6));
}

TEST_CASE("dashes have their lengths along corners too") {
  const Vec<2> points[] = {{20, 50}, {103, 50}, {103, 150}};  // 183 long
  // 10 on, 5 off: 12 periods and 3 more; one dash turns the corner at 83 = 5 * 15 + 8.
  CHECK(area(points, {.width = 2, .dash = {10, 5}}) ==
        doctest::Approx(2 * (12 * 10 + 3)).epsilon(1e-3));
}

TEST_CASE("a gap in a closed line opens it there only") {
  const double nan = std::nan("");
  const Vec<2> points[] = {{50, 50}, {150, 50}, {nan, nan}, {150, 120}, {50, 120}};
  CHECK(area(points, {.width = 2, .closed = true}) ==
        doctest::Approx(2 * (100 + 100 + 70)).epsilon(1e-3));
}

TEST_CASE("nothing, a point and a line without width are no strokes") {
  const Vec<2> point[] = {{50, 50}, {50, 50}};
  CHECK(stroke_triangles({}, {}).empty());
  CHECK(stroke_triangles({}, {.closed = true, .dash = {2, 2}}).empty());
  CHECK(stroke_triangles(point, {.width = 5}).empty());
  CHECK(stroke_triangles(point, {.width = 0}).empty());
  CHECK(area(point, {.width = 10, .cap = Stroke::Cap::round}) ==
        doctest::Approx(25 * pi).epsilon(0.015));
}
