// View2, ticks and colours: plain arithmetic.
#include <doctest/doctest.h>

#include <cmath>

#include "sem/draw/colors.h"
#include "sem/draw/view.h"

using namespace sem;

TEST_CASE("a view keeps the aspect, centres the world and turns y up") {
  const View2 view({{-1, 0}, {3, 1}}, {{10, 20}, {210, 220}});
  CHECK(view.scale() == doctest::Approx(50));
  CHECK((view.map({-1, 0.5}) - Vec<2>(10, 120)).norm() < 1e-12);
  CHECK((view.map({3, 0.5}) - Vec<2>(210, 120)).norm() < 1e-12);
  CHECK((view.map({1, 1}) - Vec<2>(110, 95)).norm() < 1e-12);
}

TEST_CASE("a view of a segment has a finite scale") {
  const View2 view({{0, 1}, {4, 1}}, {{0, 0}, {100, 100}});
  CHECK(view.scale() == doctest::Approx(25));
  CHECK((view.map({2, 1}) - Vec<2>(50, 50)).norm() < 1e-12);
}

TEST_CASE("ticks are round numbers inside the interval and at most n intervals") {
  CHECK(nice_ticks(0, 1, 5) == std::vector<double>{0, 0.2, 0.4, 0.6, 0.8, 1});
  CHECK(nice_ticks(-0.25, 0.3, 3) == std::vector<double>{-0.2, 0, 0.2});
  CHECK(nice_ticks(0, 1e6, 2) == std::vector<double>{0, 500000, 1000000});
  CHECK(nice_step(0, 1, 1) == 1);
  CHECK(nice_step(0, 1.0001, 1) == 2);
  for (double hi : {1e-12, 0.37, 1.0, 7.77, 1e9})
    for (int n : {1, 2, 5, 10}) {
      const auto ticks = nice_ticks(-hi / 3, hi, n);
      CAPTURE(hi);
      CAPTURE(n);
      CHECK(ticks.size() <= std::size_t(n + 1));
      CHECK(2.5 * double(ticks.size() + 1) * nice_step(-hi / 3, hi, n) >= hi * 4 / 3);
      CHECK(ticks.front() >= -hi / 3 * (1 + 1e-8));
      CHECK(ticks.back() <= hi * (1 + 1e-8));
    }
}

TEST_CASE("a tick label has the decimals of its step and a true minus sign") {
  CHECK(tick_label(0.30000000000000004, 0.1) == "0.3");
  CHECK(tick_label(-1.5, 0.5) == "\u22121.5");
  CHECK(tick_label(-1e-17, 0.01) == "0.00");
  CHECK(tick_label(200, 100) == "200");
}

TEST_CASE("the lightness of viridis rises evenly") {
  // CIE L* of sRGB (IEC 61966-2-1, CIE 15).
  const auto lightness = [](const Color& c) {
    const auto linear = [](double v) {
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const double y = 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
    return 116 * std::cbrt(y) - 16;
  };
  const double lo = lightness(colors::viridis(0)), hi = lightness(colors::viridis(1));
  CHECK(hi - lo > 70);
  for (int i = 0; i <= 50; ++i)
    CHECK(std::abs(lightness(colors::viridis(i / 50.0)) - (lo + (hi - lo) * i / 50)) < 2);
  CHECK(colors::viridis(-1).r == colors::viridis(0).r);
  CHECK(colors::viridis(NAN).r == colors::gray.r);
}
