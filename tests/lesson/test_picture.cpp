#include <doctest/doctest.h>

#include "sem/draw/raster.h"
#include "sem/lesson/picture.h"

using namespace sem;

TEST_CASE("to_world undoes the view") {
  RasterCanvas canvas(300, 200, 1);
  Picture picture(canvas, {{0, 40}, {300, 200}}, {{-1, -1}, {3, 1}});
  CHECK(!picture.has_view());
  const Vec<2> X(0.3, -0.7);
  CHECK((picture.to_world(picture.view().map(X)) - X).norm() < 1e-14);
  CHECK(picture.has_view());
  picture.set_view({{0, 0}, {1, 1}}, picture.part({0.5, 0}, {1, 1}));
  CHECK((picture.to_world(picture.view().map(X)) - X).norm() < 1e-14);
  CHECK(picture.view_area().lower == Vec<2>(150, 40));
  CHECK(picture.view().map({0.5, 0.5}) == Vec<2>(225, 120));
}

TEST_CASE("an arrow ends in its tip and not beyond") {
  RasterCanvas canvas(200, 200, 1);
  Picture picture(canvas, {{0, 0}, {200, 200}}, {{0, 0}, {200, 200}});
  picture.arrow({50, 100}, {100, 0}, colors::black, 4);
  picture.arrow({50, 50}, {0, 0}, colors::black, 4);  // nothing
  const Image image = canvas.finish();
  const auto dark = [&](int x, int y) { return image.pixel(x, y)[0] < 128; };
  CHECK(dark(52, 100));
  CHECK(dark(145, 100));
  CHECK(!dark(152, 100));
  CHECK(!dark(48, 100));
  CHECK(!dark(50, 150));
}

TEST_CASE("the mouse reads the text given last that has something to say, else coordinates") {
  RasterCanvas canvas(300, 200, 1);
  Picture picture(canvas, {{0, 0}, {300, 200}}, {{0, 0}, {300, 200}});
  CHECK(picture.text_at({150, 100}) == "");  // no view yet
  Points<2> points(2, 2);
  points << 50, 150, 100, 100;
  picture.hover(points, [](int k) { return "point " + std::to_string(k); });
  CHECK(picture.text_at({60, 100}) == "point 0");
  CHECK(picture.text_at({140, 90}) == "point 1");
  CHECK(picture.text_at({250, 30}) == "x = 250, y = 170");  // too far from both
  picture.hover({{0, 0}, {100, 200}},
                [](const Vec<2>& at) -> std::string { return at[1] < 50 ? "above" : ""; });
  CHECK(picture.text_at({60, 30}) == "above");
  CHECK(picture.text_at({60, 100}) == "point 0");
  picture.hover([](const Vec<2>& X) { return X[0] > 200 ? "right" : ""; });
  CHECK(picture.text_at({250, 30}) == "right");
}

TEST_CASE("texts keep the view in which they were given") {
  RasterCanvas canvas(300, 200, 1);
  Picture picture(canvas, {{0, 0}, {300, 200}}, {{0, 0}, {1, 1}});
  for (const int half : {0, 1}) {
    picture.set_view({{0, 0}, {1, 1}}, picture.part({half / 2.0, 0}, {(half + 1) / 2.0, 1}));
    picture.hover([half](const Vec<2>& X) {
      return std::to_string(half) + (X[0] < 0.5 ? " left" : " right");
    });
  }
  CHECK(picture.text_at({20, 100}) == "0 left");
  CHECK(picture.text_at({130, 100}) == "0 right");
  CHECK(picture.text_at({170, 100}) == "1 left");
  CHECK(picture.text_at({280, 100}) == "1 right");
}
