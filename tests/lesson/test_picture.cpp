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
