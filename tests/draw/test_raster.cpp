// Pixels of the raster canvas against areas known in closed form.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sem/base/error.h"
#include "sem/draw/raster.h"

using namespace sem;

namespace {

using std::numbers::pi;

/// Covered area in pixels of what was drawn in black on white.
double ink(const Image& image, int begin = 0, int end = -1) {
  double sum = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = begin; column < (end < 0 ? image.width : end); ++column)
      sum += 1 - image.pixel(column, row)[0] / 255.0;
  return sum;
}

bool is(const Image& image, int column, int row, int r, int g, int b, int tolerance = 0) {
  const auto* p = image.pixel(column, row);
  return std::abs(p[0] - r) <= tolerance && std::abs(p[1] - g) <= tolerance &&
         std::abs(p[2] - b) <= tolerance;
}

Polyline circle(const Vec<2>& center, double radius, int n = 400) {
  Polyline points;
  for (int i = 0; i < n; ++i)
    points.emplace_back(center +
                        radius * Vec<2>(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n)));
  return points;
}

const Polyline star = [] {
  Polyline points;
  for (int i = 0; i < 5; ++i)
    points.push_back({50 + 40 * std::sin(4 * pi * i / 5), 50 - 40 * std::cos(4 * pi * i / 5)});
  return points;
}();

void draw_everything(RasterCanvas& canvas) {
  canvas.clear();
  canvas.fill(circle({50, 50}, 30), colors::okabe_ito[1].with_alpha(0.4));
  canvas.fill(star, colors::okabe_ito[2]);
  canvas.stroke(star, {.color = colors::okabe_ito[0].with_alpha(0.5), .width = 3, .closed = true});
  canvas.stroke(circle({50, 50}, 44), {.width = 1.5, .closed = true, .dash = {5, 3}});
  canvas.text({5, 90}, "\u03b1 = \u22120.5", {.size = 10});
  canvas.marker({20, 20}, MarkerShape::cross, 8, colors::black);
}

}  // namespace

TEST_CASE("a new canvas is white") {
  RasterCanvas canvas(20, 10);
  const Image image = canvas.finish();
  CHECK(image.width == 20);
  CHECK(image.height == 10);
  CHECK(image.rgb == std::vector<std::uint8_t>(600, 255));
}

TEST_CASE("a filled polygon covers its area") {
  for (int supersample : {1, 2, 3, 4}) {
    CAPTURE(supersample);
    RasterCanvas canvas(100, 100, supersample);
    canvas.fill(circle({50.3, 49.6}, 40), colors::black);  // convex
    CHECK(ink(canvas.finish()) == doctest::Approx(pi * 1600).epsilon(0.002));
    canvas.clear();
    canvas.fill({{10.5, 10}, {90, 10.25}, {50, 40}, {12, 80}}, colors::black);  // concave
    CHECK(ink(canvas.finish()) == doctest::Approx(2547.5625).epsilon(0.003));
  }
}

TEST_CASE("whole pixels are filled exactly, with the origin at the top left") {
  RasterCanvas canvas(30, 20);
  canvas.fill_box({{3, 5}, {10, 7}}, {1, 0, 0});
  const Image image = canvas.finish();
  int n_red = 0;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 30; ++column) {
      const bool inside = column >= 3 && column < 10 && row >= 5 && row < 7;
      CHECK(is(image, column, row, 255, inside ? 0 : 255, inside ? 0 : 255));
      n_red += inside;
    }
  CHECK(n_red == 14);
}

TEST_CASE("holes, islands in holes and the middle of a star follow the even-odd rule") {
  RasterCanvas canvas(100, 100);
  const Polyline loops[] = {circle({50, 50}, 45), circle({50, 50}, 30), circle({50, 50}, 10)};
  canvas.fill(loops, colors::black);
  const Image ring = canvas.finish();
  CHECK(ink(ring) == doctest::Approx(pi * (45 * 45 - 30 * 30 + 100)).epsilon(0.002));
  CHECK(is(ring, 50, 50, 0, 0, 0));
  CHECK(is(ring, 70, 50, 255, 255, 255));

  canvas.clear();
  canvas.fill(star, colors::black);
  const Image pentagram = canvas.finish();
  CHECK(is(pentagram, 50, 50, 255, 255, 255));
  CHECK(is(pentagram, 50, 25, 0, 0, 0));
}

TEST_CASE("loops that share an edge or a corner leave no seam") {
  RasterCanvas canvas(60, 60);
  const Polyline shared[] = {{{5, 5}, {25, 5}, {25, 25}, {5, 25}},
                             {{25, 5}, {45, 5}, {45, 25}, {25, 25}},
                             {{25, 25}, {45, 25}, {45, 45}, {25, 45}}};
  canvas.fill(shared, colors::black);
  CHECK(ink(canvas.finish()) == doctest::Approx(1200).epsilon(1e-9));
}

TEST_CASE("a long concave loop is filled right") {
  // A comb of 30 000 teeth, more points than 16-bit indices count.
  RasterCanvas canvas(200, 50);
  Polyline comb{{180, 40}, {20, 40}};
  const int n = 30000;
  for (int i = 0; i <= 2 * n; ++i) comb.push_back({20 + 80.0 * i / n, i % 2 ? 10.0 : 30.0});
  canvas.fill(comb, colors::black);
  CHECK(ink(canvas.finish()) == doctest::Approx(160 * 20).epsilon(0.02));
}

TEST_CASE("a transparent colour blends once, also where a shape overlaps itself") {
  RasterCanvas canvas(100, 100);
  const Color half = colors::black.with_alpha(0.5);
  const Vec<2> zigzag[] = {{10, 10}, {90, 20}, {10, 24}, {90, 90}, {90, 10}};
  canvas.stroke(zigzag, {.color = half, .width = 12});
  canvas.fill_box({{2, 60}, {20, 80}}, half);
  const Image image = canvas.finish();
  int darkest = 255;
  for (auto value : image.rgb) darkest = std::min<int>(darkest, value);
  CHECK(std::abs(darkest - 127) <= 1);
  CHECK(is(image, 10, 70, 127, 127, 127, 1));
}

TEST_CASE("shapes drawn later cover those before, whichever way they are drawn") {
  RasterCanvas canvas(100, 100);
  canvas.fill(star, colors::black);
  canvas.text({30, 60}, "XXXX", {.size = 30});
  canvas.image(Image(2, 2), {{30, 30}, {60, 60}});
  canvas.stroke(star, {.width = 5, .closed = true});
  canvas.fill_box({{0, 0}, {100, 100}}, {0, 1, 0});
  const Image image = canvas.finish();
  for (int i = 0; i < 100; ++i) CHECK(is(image, i, (37 * i) % 100, 0, 255, 0));
}

TEST_CASE("the same calls give the same pixels, on one canvas and on another") {
  RasterCanvas canvas(100, 100), other(100, 100);
  draw_everything(canvas);
  const Image first = canvas.finish();
  draw_everything(other);
  CHECK(other.finish().rgb == first.rgb);
  draw_everything(canvas);
  CHECK(canvas.finish().rgb == first.rgb);
}

TEST_CASE("a picture taken in between changes nothing") {
  RasterCanvas canvas(100, 100);
  canvas.push_clip({{0, 0}, {60, 100}});
  canvas.fill(star, colors::black);
  canvas.finish();
  canvas.stroke(circle({50, 50}, 30), {.width = 4});
  const Image in_two = canvas.finish();
  canvas.clear();
  canvas.push_clip({{0, 0}, {60, 100}});
  canvas.fill(star, colors::black);
  canvas.stroke(circle({50, 50}, 30), {.width = 4});
  CHECK(canvas.finish().rgb == in_two.rgb);
}

TEST_CASE("forty thousand rectangles are all drawn") {
  RasterCanvas canvas(400, 400, 1);
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 200; ++column) {
      const Vec<2> x(2 * column, 2 * row);
      canvas.fill_box({x, x + Vec<2>(1, 1)}, colors::black);
    }
  const Image image = canvas.finish();
  CHECK(ink(image) == doctest::Approx(40000).epsilon(1e-9));
  CHECK(is(image, 398, 398, 0, 0, 0));
}

TEST_CASE("nothing is drawn outside of the clip rectangles, and all again after the last pop") {
  RasterCanvas canvas(100, 100);
  const Box<2> all{{0, 0}, {100, 100}};
  canvas.push_clip({{10, 10}, {60, 60}});
  canvas.push_clip({{50, 0}, {100, 100}});
  canvas.fill_box(all, colors::black);
  canvas.fill(star, colors::black);
  canvas.pop_clip();
  canvas.pop_clip();
  CHECK(ink(canvas.finish()) == doctest::Approx(10 * 50).epsilon(1e-9));
  canvas.push_clip({{80, 80}, {90, 90}});
  canvas.push_clip({{0, 0}, {10, 10}});  // nothing in common
  canvas.fill_box(all, colors::black);
  canvas.pop_clip();
  canvas.pop_clip();
  CHECK(ink(canvas.finish()) == doctest::Approx(10 * 50).epsilon(1e-9));
  canvas.fill_box(all, colors::black);
  CHECK(ink(canvas.finish()) == doctest::Approx(100 * 100).epsilon(1e-9));
}

TEST_CASE("an image shows each value as one cell, first row at the top") {
  Image cells(2, 2);
  cells.set(0, 0, {1, 0, 0});
  cells.set(1, 0, {0, 1, 0});
  cells.set(0, 1, {0, 0, 1});
  RasterCanvas canvas(40, 40);
  canvas.image(cells, {{10, 10}, {30, 30}});
  const Image image = canvas.finish();
  CHECK(is(image, 10, 10, 255, 0, 0));
  CHECK(is(image, 19, 19, 255, 0, 0));
  CHECK(is(image, 20, 19, 0, 255, 0));
  CHECK(is(image, 10, 29, 0, 0, 255));
  CHECK(is(image, 29, 29, 0, 0, 0));
  CHECK(is(image, 30, 30, 255, 255, 255));
}

TEST_CASE("Greek, mathematics and the minus sign have glyphs of their own") {
  RasterCanvas canvas(60, 40);
  const auto picture = [&](const std::string& text) {
    canvas.clear();
    canvas.text({5, 30}, text, {.size = 24});
    return canvas.finish();
  };
  const Image missing = picture("\U0001F600");  // shown as a replacement
  for (const char* text : {"\u03b1", "\u03a9", "\u03bd", "\u2211", "\u2207", "\u222b", "\u2264",
                           "\u2212", "\u00b2", "\u2082", "\u1d62", "\u00b7"}) {
    CAPTURE(text);
    const Image image = picture(text);
    CHECK(ink(image) > 4);
    CHECK(image.rgb != missing.rgb);
  }
  CHECK(ink(picture(" ")) == 0);
}

TEST_CASE("text keeps to its anchors and its width") {
  RasterCanvas canvas(200, 100);
  const std::string text = "HHHHH";
  const double width = canvas.text_width(text, 20);
  CHECK(width ==
        doctest::Approx(5 * 0.752 * 20).epsilon(0.01));  // DejaVu Sans: H advances 0.752 em
  CHECK(canvas.text_width(text, 40) == doctest::Approx(2 * width).epsilon(1e-3));
  using H = TextStyle::Horizontal;
  using V = TextStyle::Vertical;
  canvas.text({100, 50}, text, {.size = 20, .horizontal = H::right, .vertical = V::top});
  const Image right = canvas.finish();
  CHECK(ink(right, 100) == 0);
  CHECK(ink(right, int(100 - width) - 1) == doctest::Approx(ink(right)));
  for (int column = 0; column < 200; ++column) CHECK(is(right, column, 49, 255, 255, 255, 40));
  canvas.clear();
  canvas.text({100, 50}, text, {.size = 20, .horizontal = H::center, .vertical = V::middle});
  const Image middle = canvas.finish();
  CHECK(ink(middle, 0, 100) == doctest::Approx(ink(middle) / 2).epsilon(0.05));
}

TEST_CASE("upward text is the text turned by 90 degrees") {
  RasterCanvas canvas(80, 80);
  const double x = 40, y = 40;
  canvas.text({x, y}, "Lp", {.size = 20});
  const Image level = canvas.finish();
  canvas.clear();
  canvas.text({x, y}, "Lp", {.size = 20, .upward = true});
  const Image upward = canvas.finish();
  double difference = 0;
  for (int row = 0; row < 80; ++row)  // (dx, dy) goes to (dy, -dx)
    for (int column = 0; column < 80; ++column)
      difference +=
          std::abs(level.pixel(column, row)[0] - upward.pixel(row, 79 - column)[0]) / 255.0;
  CHECK(ink(level) > 50);
  CHECK(difference < 0.02 * ink(level));
}

TEST_CASE("coordinates that are not finite are left out and the rest is drawn") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  RasterCanvas canvas(100, 100);
  const Polyline loops[] = {{{0, 0}, {nan, 50}, {50, 50}},
                            {{10, 10}, {20, 10}, {20, 20}, {10, 20}}};
  canvas.fill(loops, colors::black);
  const Vec<2> points[] = {{40, 10}, {60, 10}, {inf, 20}, {40, 30}, {60, 30}};
  canvas.stroke(points, {.width = 2});
  canvas.text({nan, 10}, "text", {});
  CHECK(ink(canvas.finish()) == doctest::Approx(100 + 40 + 40).epsilon(1e-9));
}

TEST_CASE("markers of one size are about equally large") {
  RasterCanvas canvas(40, 40);
  for (auto shape :
       {MarkerShape::circle, MarkerShape::square, MarkerShape::diamond, MarkerShape::triangle}) {
    canvas.clear();
    canvas.marker({20, 20}, shape, 20, colors::black);
    CHECK(ink(canvas.finish()) == doctest::Approx(pi * 100).epsilon(0.25));
  }
}

TEST_CASE("sizes out of range are input errors") {
  CHECK_THROWS_AS(RasterCanvas(0, 10), InputError);
  CHECK_THROWS_AS(RasterCanvas(10, 100000), InputError);
  CHECK_THROWS_AS(RasterCanvas(10, 10, 5), InputError);
}
