// Plots on the page: nothing clipped, panels in line, legends off the data.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "plot/recording.h"
#include "sem/plot/plot.h"

using namespace sem;
using sem::test::overlap;
using sem::test::RecordingCanvas;

namespace {

RecordingCanvas drawn(const Plot& plot, double dots_per_inch = 300) {
  RecordingCanvas canvas(std::round(plot.width() * dots_per_inch),
                         std::round(plot.height() * dots_per_inch));
  plot.draw(canvas);
  return canvas;
}

void check_inside(const RecordingCanvas& canvas) {
  for (const auto& text : canvas.texts) {
    CAPTURE(text.utf8);
    CHECK(text.box.lower[0] >= 0);
    CHECK(text.box.lower[1] >= 0);
    CHECK(text.box.upper[0] <= canvas.width());
    CHECK(text.box.upper[1] <= canvas.height());
  }
}

void check_texts_apart(const RecordingCanvas& canvas) {
  for (std::size_t i = 0; i < canvas.texts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      // The boxes reserve room for descenders, which numbers at the corner of two axes do not have.
      Box<2> a = canvas.texts[i].box, b = canvas.texts[j].box;
      for (Box<2>* box : {&a, &b}) box->upper[1] -= 0.236 * canvas.texts[i].style.size;
      CAPTURE(canvas.texts[i].utf8);
      CAPTURE(canvas.texts[j].utf8);
      CHECK(!overlap(a, b));
    }
}

std::vector<double> linspace(double a, double b, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(a + (b - a) * i / (n - 1));
  return values;
}

template <class F>
std::vector<double> of(const std::vector<double>& x, const F& f) {
  std::vector<double> y;
  for (const double value : x) y.push_back(f(value));
  return y;
}

// Four panels with everything that takes room outside of them.
Plot crowded() {
  Plot plot(7, 5);
  plot.letters = true;
  const auto x = linspace(0, 10, 50);
  Panel& linear = plot.panel(0, 0);
  linear.x = {.label = "time (s)"};
  linear.y = {.label = "energy of the whole body (J)"};
  linear.title = "a title";
  linear.curve(x, of(x, [](double t) { return 1e-7 * std::sin(t); }), series(0, "kinetic"));
  linear.curve(x, of(x, [](double t) { return 1e-7 * std::cos(t); }), series(1, "potential"));
  Panel& log = plot.panel(0, 1);
  log.x = {.label = "number of rays", .logarithmic = true};
  log.y = {.label = "relative error", .logarithmic = true};
  const auto n = of(linspace(1, 10, 10), [](double k) { return std::exp2(k); });
  log.curve(n, of(n, [](double k) { return 1 / (k * k * k); }), series(0, "Gauss"));
  log.slope(-3, 30, 200, 1e-2);
  log.legend = LegendPlace::right;
  Panel& body = plot.panel(1, 0);
  body.equal = true;
  body.heat_map(empty_grid({Vec<2>(0, 0), Vec<2>(2, 1)}, 0.1), {0, 1});
  body.color_bar({-2.5e-3, 1}, "stress (Pa)");
  body.note({2, 1}, "a corner with a name", {.offset = {8, 8}, .leader = true});
  Panel& lines = plot.panel(1, 1);
  lines.bars({1, 2, 3}, {3, 1, 2}, 0.8, colors::okabe_ito[0], "parts");
  lines.horizontal(2.5, "truth (1 − ν)", {.width = 0.8});
  lines.x.ticks = {{1, "first"}, {2, "second"}, {3, "third"}};
  lines.legend = LegendPlace::below;
  return plot;
}

}  // namespace

TEST_CASE("every text of a crowded plot lies on the page, none on another") {
  const RecordingCanvas canvas = drawn(crowded());
  CHECK(canvas.texts.size() > 30);
  check_inside(canvas);
  check_texts_apart(canvas);
}

TEST_CASE("so do the texts at a third of the resolution, and in a small plot") {
  check_inside(drawn(crowded(), 100));
  Plot plot(3.3, 2);
  Panel& panel = plot.panel();
  panel.x = {.label = "a label nearly as long as the picture is wide"};
  panel.y = {.label = "as tall as the picture (m)"};
  panel.curve({0, 1e6}, {-1e6, 1e6}, {.label = "a line"});
  check_inside(drawn(plot));
}

TEST_CASE("panels of a column and of a row have the same edges; letters count them") {
  const RecordingCanvas canvas = drawn(crowded());
  REQUIRE(canvas.clips.size() == 4);
  CHECK(canvas.clips[1].lower[0] == canvas.clips[3].lower[0]);
  CHECK(canvas.clips[0].lower[1] == canvas.clips[1].lower[1]);
  CHECK(canvas.clips[0].upper[1] == canvas.clips[1].upper[1]);
  for (const char* letter : {"(a)", "(b)", "(c)", "(d)"}) CHECK(canvas.count(letter) == 1);
}

TEST_CASE("shares divide the room, and a panel may cover several cells") {
  Plot plot(7, 4);
  plot.column_shares = {2, 1};
  for (int i = 0; i < 2; ++i) plot.panel(0, i).frame = false;
  plot.panel(1, 0, 1, 2).frame = false;
  const auto clips = drawn(plot).clips;
  const auto width = [&](int i) { return clips[i].upper[0] - clips[i].lower[0]; };
  CHECK(width(0) == doctest::Approx(2 * width(1)).epsilon(0.02));
  CHECK(clips[2].lower[0] == clips[0].lower[0]);
  CHECK(clips[2].upper[0] == clips[1].upper[0]);
}

TEST_CASE("a legend stands where no data are") {
  const auto x = linspace(0, 1, 200);
  // A curve that leaves one corner free at a time.
  for (const double sign_x : {1.0, -1.0})
    for (const double sign_y : {1.0, -1.0}) {
      Plot plot(3.3, 2.6);
      Panel& panel = plot.panel();
      std::vector<double> xs, ys;
      for (const double t : x) {  // an L along two sides, thick enough to fill the rest
        for (const double s : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}) {
          xs.push_back(sign_x * s), ys.push_back(sign_y * t);
          xs.push_back(sign_x * t), ys.push_back(sign_y * s);
        }
      }
      panel.curve(xs, ys, {.label = "data", .width = 0, .marker = MarkerShape::circle});
      const RecordingCanvas canvas = drawn(plot);
      const Box<2> legend = canvas.find("data").box, &box = canvas.clips[0];
      const Vec<2> center = (legend.lower + legend.upper) / 2, middle = (box.lower + box.upper) / 2;
      CHECK((center[0] - middle[0]) * sign_x > 0);  // the free corner
      CHECK((center[1] - middle[1]) * sign_y < 0);
      for (const auto& marker : canvas.fills) {
        Box<2> covered;
        for (const auto& corner : marker) covered.include(corner);
        const Vec<2> at = (covered.lower + covered.upper) / 2;
        const bool in_legend = (at - center).norm() < legend.diagonal();
        if (in_legend && at[1] > legend.lower[1] && at[1] < legend.upper[1])
          continue;  // its sample
        CHECK(!overlap(covered, legend));
      }
    }
}

TEST_CASE("a legend without a free place stands below the panel, one for all below the plot") {
  const auto x = linspace(0, 1, 4000);
  Plot plot(3.3, 2.6);
  Panel& panel = plot.panel();
  panel.curve(x, of(x, [](double t) { return std::sin(2000 * t); }), {.label = "noise"});
  const RecordingCanvas canvas = drawn(plot);
  CHECK(canvas.find("noise").box.lower[1] > canvas.clips[0].upper[1]);
  check_inside(canvas);

  Plot two(7, 2.6);
  two.shared_legend = true;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 3; ++k)
      two.panel(0, i).curve({0, 1}, {0, double(k)}, series(k, "series " + std::to_string(k)));
  const RecordingCanvas shared = drawn(two);
  CHECK(shared.count("series 1") == 1);
  CHECK(shared.find("series 1").box.lower[1] > shared.clips[0].upper[1]);
}

TEST_CASE("frame and ticks lie on whole pixels") {
  for (const double dots_per_inch : {300.0, 150.0}) {
    const RecordingCanvas canvas = drawn(crowded(), dots_per_inch);
    const double width = std::max(1.0, std::round(0.6 * dots_per_inch / 72));
    int n_ticks = 0;
    for (const auto& line : canvas.lines) {
      if (line.clipped || line.points.size() != 2 || line.style.width != width) continue;
      const Vec<2> way = line.points[1] - line.points[0];
      const int across = way[0] == 0 ? 0 : 1;
      const double edge = line.points[0][across] - width / 2;
      CHECK(std::abs(edge - std::round(edge)) < 1e-9);
      ++n_ticks;
    }
    CHECK(n_ticks > 20);
  }
}

TEST_CASE("equal panels have one scale; a body fills its panel in one direction") {
  Plot plot(3.3, 3.3);
  Panel& panel = plot.panel();
  panel.equal = true;
  panel.frame = false;
  panel.curve(std::vector<Vec<2>>{{0, 0}, {4, 0}, {4, 1}});
  const RecordingCanvas canvas = drawn(plot);
  const Polyline& line = canvas.lines[0].points;
  const double horizontal = (line[1] - line[0]).norm(), vertical = (line[2] - line[1]).norm();
  CHECK(horizontal == doctest::Approx(4 * vertical).epsilon(0.01));
  CHECK(horizontal > 0.9 * canvas.width());
  CHECK(line[2][1] < line[1][1]);  // y is up
}

TEST_CASE("data land where the axes say, linear and logarithmic, and gaps stay gaps") {
  Plot plot(3.3, 2.6);
  Panel& panel = plot.panel();
  panel.x = {.lower = 0, .upper = 4};
  panel.y = {.lower = 1, .upper = 100, .logarithmic = true};
  panel.curve({1, 2, 3}, {10, 0, std::nan("")});
  const RecordingCanvas canvas = drawn(plot);
  const Box<2>& box = canvas.clips[0];
  const Polyline& line = canvas.lines[0].points;
  CHECK(line[0][0] == doctest::Approx(box.lower[0] + (box.upper[0] - box.lower[0]) / 4));
  CHECK(line[0][1] == doctest::Approx((box.lower[1] + box.upper[1]) / 2));
  CHECK(std::isnan(line[1][1]));
  CHECK(std::isnan(line[2][1]));
}

TEST_CASE("a heat map shows the colour of each value in place, nothing where there is none") {
  Plot plot(3.3, 2);
  Panel& panel = plot.panel();
  panel.equal = true;
  CellGrid grid = empty_grid({Vec<2>(0, 0), Vec<2>(3, 2)}, 1);
  grid.at(0, 0) = 0;
  grid.at(2, 1) = 1;
  panel.heat_map(grid, {0, 1});
  panel.color_bar({0, 1}, "value");
  const RecordingCanvas canvas = drawn(plot);
  REQUIRE(canvas.images.size() == 2);
  const auto& [image, rectangle] = canvas.images[0];
  CHECK((rectangle.lower - canvas.clips[0].lower).norm() < 1e-9);
  CHECK((rectangle.upper - canvas.clips[0].upper).norm() < 1e-9);
  const auto is = [&](int column, int row, const Color& color) {
    Image one(1, 1);
    one.set(0, 0, color);
    return std::equal(one.rgb.begin(), one.rgb.end(), image.pixel(column, row));
  };
  CHECK(is(0, 1, colors::viridis(0)));  // the lower left cell is in the last row
  CHECK(is(2, 0, colors::viridis(1)));
  CHECK(std::equal(image.left_out->begin(), image.left_out->end(), image.pixel(1, 0)));
  CHECK(canvas.has("0.0"));
  CHECK(canvas.has("1.0"));
  CHECK(canvas.has("value"));
}

TEST_CASE("a pattern has row 0 at the top, and keeps lone entries of large matrices") {
  Plot plot(3.3, 3.3);
  plot.panel().pattern(3, 3, {{0, 2}});
  const auto small = drawn(plot).images[0].image;
  const auto filled = [](const Image& image, int column, int row) {
    return !std::equal(image.left_out->begin(), image.left_out->end(), image.pixel(column, row));
  };
  CHECK(filled(small, 2, 0));
  CHECK(!filled(small, 2, 2));
  Plot large(3.3, 3.3);
  large.panel().pattern(5000, 5000, {{4999, 0}});
  const auto image = drawn(large).images[0].image;
  CHECK(image.width <= 600);
  CHECK(filled(image, 0, image.height - 1));
}

TEST_CASE("arrows have the length of their vectors; the key shows its own") {
  Plot plot(3.3, 3.3);
  Panel& panel = plot.panel();
  panel.quiver({{0, 0}, {1, 1}}, {{0, 2}, {1, 0}},
               {.label = "1 m/s", .scale = 12, .key = 1});  // points per unit
  const RecordingCanvas canvas = drawn(plot);
  const double point = 300.0 / 72;
  std::vector<double> lengths;  // from the tail to the head's tip, the head being the next fill
  std::size_t head = 0;
  for (const auto& line : canvas.lines)
    if (line.points.size() == 2 && line.style.width == 0.8 * point && head < canvas.fills.size())
      lengths.push_back((canvas.fills[head++][0] - line.points[0]).norm() / point);
  REQUIRE(lengths.size() == 3);
  CHECK(lengths[0] == doctest::Approx(24));
  CHECK(lengths[1] == doctest::Approx(12));
  CHECK(lengths[2] == doctest::Approx(12));  // the key
}

TEST_CASE("a reference triangle has its slope on the paper") {
  Plot plot(3.3, 2.6);
  Panel& panel = plot.panel();
  panel.x = {.lower = 1, .upper = 1000, .logarithmic = true};
  panel.y = {.lower = 1e-6, .upper = 1, .logarithmic = true};
  panel.slope(-2, 10, 100, 1e-2);
  const RecordingCanvas canvas = drawn(plot);
  CHECK(canvas.has("−2"));
  const Vec<2> size = canvas.clips[0].upper - canvas.clips[0].lower;
  const Polyline& triangle = canvas.lines[0].points;
  const Vec<2> way = (triangle[1] - triangle[0]).cwiseQuotient(size);  // shares of the panel
  CHECK(way[0] * 3 == doctest::Approx(1));                             // decades
  CHECK(-way[1] * 6 == doctest::Approx(-2));
}

TEST_CASE("the same plot gives the same bytes, as pixels and as vectors") {
  const Plot plot = crowded();
  CHECK(plot_svg(plot) == plot_svg(plot));
  const Image a = plot_image(plot, 100), b = plot_image(plot, 100);
  CHECK(a.rgb == b.rgb);
  CHECK(a.width == 700);
}

TEST_CASE("pixels and vectors show the same texts at the same places") {
  // The two canvases know the widths of texts on their own.
  const Plot plot = crowded();
  RecordingCanvas canvas = drawn(plot);
  const std::string svg = plot_svg(plot);
  std::size_t n_texts = 0;
  for (std::size_t at = svg.find("<text"); at != std::string::npos; at = svg.find("<text", at + 1))
    ++n_texts;
  CHECK(n_texts == canvas.texts.size());
  const Image image = plot_image(plot);
  for (const auto& text : canvas.texts) {
    int dark = 0;
    for (int row = int(text.box.lower[1]); row < int(text.box.upper[1]); ++row)
      for (int column = int(text.box.lower[0]); column < int(text.box.upper[0]); ++column)
        dark += image.pixel(column, row)[0] < 128;
    CAPTURE(text.utf8);
    CHECK(dark > 0);
  }
}
