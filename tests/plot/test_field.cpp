// Grids of cells: contour lines, grids from tables, colour scales.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "sem/base/error.h"
#include "sem/plot/field.h"

using namespace sem;

namespace {

constexpr double pi = std::numbers::pi;

template <class F>
CellGrid sampled(const Box<2>& box, double size, const F& f) {
  CellGrid grid = empty_grid(box, size);
  for (int j = 0; j < grid.n_y; ++j)
    for (int i = 0; i < grid.n_x; ++i) grid.at(i, j) = f(grid.center(i, j));
  return grid;
}

double length(const std::vector<Vec<2>>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

const Box<2> square{Vec<2>(-1, -1), Vec<2>(1, 1)};

}  // namespace

TEST_CASE("the contour of a cone is a closed circle, to second order in the cell") {
  double last_error = 0;
  for (const double size : {0.1, 0.05, 0.025}) {
    const auto lines =
        contour_lines(sampled(square, size, [](const Vec<2>& x) { return x.norm(); }), 0.6);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].front() == lines[0].back());
    CHECK(length(lines[0]) == doctest::Approx(2 * pi * 0.6).epsilon(0.01));
    double error = 0;
    for (const auto& x : lines[0]) error = std::max(error, std::abs(x.norm() - 0.6));
    CHECK(error < size * size);
    if (last_error > 0) CHECK(error < 0.4 * last_error);
    last_error = error;
  }
}

TEST_CASE("a contour that leaves the grid is one open line from edge to edge") {
  const auto lines =
      contour_lines(sampled(square, 0.1, [](const Vec<2>& x) { return x[0] + 0.2 * x[1]; }), 0.1);
  REQUIRE(lines.size() == 1);
  CHECK(std::abs(lines[0].front()[1]) == doctest::Approx(0.95));
  CHECK(lines[0].front()[1] == doctest::Approx(-lines[0].back()[1]));
}

TEST_CASE("contours of two hills do not touch; at their saddle they neither cross nor break") {
  const auto hills = [](const Vec<2>& x) {
    return std::exp(-8 * (x - Vec<2>(0.5, 0)).squaredNorm()) +
           std::exp(-8 * (x + Vec<2>(0.5, 0)).squaredNorm());
  };
  const CellGrid grid = sampled(square, 0.04, hills);
  CHECK(contour_lines(grid, 0.6).size() == 2);
  CHECK(contour_lines(grid, 0.2).size() == 1);
  // Level 0 of x y meets four-cornered saddles.
  for (const auto& line :
       contour_lines(sampled(square, 0.1, [](const Vec<2>& x) { return x[0] * x[1]; }), 1e-9))
    CHECK(line.size() > 5);
}

TEST_CASE("squares with a missing corner have no contour") {
  CellGrid grid = sampled(square, 0.1, [](const Vec<2>& x) { return x[0]; });
  grid.at(10, 10) = std::nan("");
  CHECK(contour_lines(grid, 0.01).size() == 2);
}

TEST_CASE("a grid from a table has its cells in place; others are missing") {
  const CellGrid grid = grid_of({0.5, 1.5, 2.5, 0.5}, {1, 1, 1, 3}, {10, 11, 12, 20});
  CHECK(grid.n_x == 3);
  CHECK(grid.n_y == 2);
  CHECK(grid.at(1, 0) == 11);
  CHECK(grid.at(0, 1) == 20);
  CHECK(std::isnan(grid.at(2, 1)));
  CHECK((grid.box.lower - Vec<2>(0, 0)).norm() < 1e-14);
  CHECK((grid.box.upper - Vec<2>(3, 4)).norm() < 1e-14);
  CHECK((grid.center(2, 1) - Vec<2>(2.5, 3)).norm() < 1e-14);
  CHECK_THROWS_AS(grid_of({0, 1, 2.5}, {0, 0, 0}, {1, 2, 3}), InputError);
  CHECK_THROWS_AS(grid_of({}, {}, {}), InputError);
}

TEST_CASE("a grid survives the way through rounded numbers") {
  const CellGrid grid = sampled(square, 2.0 / 161, [](const Vec<2>& x) { return x[0] * x[1]; });
  std::vector<double> x, y, values;
  for (int j = 0; j < grid.n_y; ++j)
    for (int i = 0; i < grid.n_x; ++i) {
      x.push_back(std::round(1e9 * grid.center(i, j)[0]) / 1e9);
      y.push_back(std::round(1e9 * grid.center(i, j)[1]) / 1e9);
      values.push_back(grid.at(i, j));
    }
  CHECK(grid_of(x, y, values).values == grid.values);
}

TEST_CASE("colour scales: ends, logarithms, a middle for diverging values") {
  const auto same = [](const Color& a, const Color& b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) < 1e-12;
  };
  CHECK(same(ColorScale{2, 4}(3), colors::viridis(0.5)));
  CHECK(same(ColorScale{2, 4}(9), colors::viridis(1)));
  CHECK(same(ColorScale{.lower = 1, .upper = 100, .logarithmic = true}(10), colors::viridis(0.5)));
  const ColorScale scale = diverging_scale_of({-3, std::nan(""), 1});
  CHECK(scale.lower == -3);
  CHECK(scale.upper == 3);
  CHECK(same(scale(0), colors::diverging(0.5)));
  const ColorScale constant = scale_of({5, 5});
  CHECK(constant.lower < constant.upper);
}

TEST_CASE("the diverging map is as light on both sides and lightest in the middle") {
  const auto luminance = [](double t) {
    const Color c = colors::diverging(t);
    const auto linear = [](double v) { return std::pow((v + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
  };
  for (double t = 0; t < 0.5; t += 0.1) {
    CHECK(luminance(t) == doctest::Approx(luminance(1 - t)).epsilon(0.05));
    CHECK(luminance(t) < luminance(t + 0.1));
  }
}
