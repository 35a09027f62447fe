// Areas, heat maps and arrows of a panel.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "sem/draw/image.h"
#include "sem/plot/panel.h"

namespace sem {
namespace {

/// An image of the grid with its rows from the top, upside down or mirrored as the axes ask for.
template <class ColorOf>
Image image_of(const CellGrid& grid, bool flip_x, bool flip_y, const ColorOf& color_of) {
  Image image(grid.n_x, grid.n_y);
  image.left_out = {1, 2, 3};  // no colour of our maps
  for (int row = 0; row < grid.n_y; ++row)
    for (int column = 0; column < grid.n_x; ++column) {
      const double value =
          grid.at(flip_x ? grid.n_x - 1 - column : column, flip_y ? row : grid.n_y - 1 - row);
      if (std::isfinite(value))
        image.set(column, row, color_of(value));
      else
        std::copy(image.left_out->begin(), image.left_out->end(), image.pixel(column, row));
    }
  return image;
}

template <class ColorOf>
void draw_cells(const Pen& pen, const CellGrid& grid, const ColorOf& color_of) {
  const Vec<2> a = pen.map(grid.box.lower), b = pen.map(grid.box.upper);
  Box<2> rectangle;
  rectangle.include(a);
  rectangle.include(b);
  pen.canvas.image(image_of(grid, b[0]<a[0], b[1]> a[1], color_of), rectangle);
}

}  // namespace

void Panel::area(const std::vector<std::vector<Vec<2>>>& loops, const Color& color,
                 const std::string& label) {
  for (const auto& loop : loops)
    for (const auto& at : loop) include(at);
  if (!label.empty()) entries_.push_back({{.label = label, .color = color}, true});
  draw([=](const Pen& pen) {
    std::vector<Polyline> pixels;
    for (const auto& loop : loops) pixels.push_back(pen.map(loop));
    pen.canvas.fill(pixels, color);
  });
}

void Panel::band(const std::vector<double>& xs, const std::vector<double>& lower,
                 const std::vector<double>& upper, const Color& color, const std::string& label) {
  std::vector<Vec<2>> loop = zip(xs, lower), back = zip(xs, upper);
  loop.insert(loop.end(), back.rbegin(), back.rend());
  area({loop}, color, label);
}

void Panel::cut_outside(const std::vector<std::vector<Vec<2>>>& loops) {
  draw([=](const Pen& pen) {
    const Box<2> box = pen.box();
    const Vec<2> far = Vec<2>::Constant(pen.canvas.width());  // all that the panel's clipping shows
    const Vec<2> a = box.lower - far, b = box.upper + far;
    std::vector<Polyline> pixels = {{a, {b[0], a[1]}, b, {a[0], b[1]}}};
    for (const auto& loop : loops) pixels.push_back(pen.map(loop));
    pen.canvas.fill(pixels, colors::white);
  });
}

void Panel::heat_map(const CellGrid& grid, const ColorScale& scale) {
  assert(grid.values.size() == std::size_t(grid.n_x) * grid.n_y);
  include(grid.box.lower);
  include(grid.box.upper);
  tight_ = true;
  draw([=, this](const Pen& pen) {
    assert(!x.logarithmic && !y.logarithmic);
    draw_cells(pen, grid, scale);
  });
}

void Panel::contours(const CellGrid& grid, const std::vector<double>& levels, const Series& style) {
  Series line = style;
  for (const double level : levels)
    for (const auto& points : contour_lines(grid, level)) {
      curve(points, line);
      line.label.clear();  // one entry for all
    }
}

void Panel::pattern(int n_rows, int n_columns, const std::vector<std::pair<int, int>>& entries,
                    const Color& color) {
  constexpr int most = 600;
  const int coarse = (std::max(n_rows, n_columns) + most - 1) / most;
  CellGrid grid = empty_grid({Vec<2>(0, 0), Vec<2>(n_columns, n_rows)}, 1);
  grid.n_x = (n_columns + coarse - 1) / coarse;
  grid.n_y = (n_rows + coarse - 1) / coarse;
  grid.box.upper = coarse * Vec<2>(grid.n_x, grid.n_y);
  grid.values.assign(std::size_t(grid.n_x) * grid.n_y, std::nan(""));
  for (const auto& [row, column] : entries) {
    assert(row >= 0 && row < n_rows && column >= 0 && column < n_columns);
    grid.at(column / coarse, row / coarse) = 1;
  }
  x.lower = y.lower = 0;
  x.upper = n_columns;
  y.upper = n_rows;
  y.reversed = equal = true;
  draw([=](const Pen& pen) { draw_cells(pen, grid, [&](double) { return color; }); });
}

void Panel::quiver(const std::vector<Vec<2>>& at, const std::vector<Vec<2>>& vectors,
                   const Arrows& style) {
  assert(at.size() == vectors.size());
  double longest = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    include(at[i]);
    if (vectors[i].allFinite()) longest = std::max(longest, vectors[i].norm());
  }
  constexpr double default_length = 24;  // points
  const double scale = style.scale > 0 ? style.scale : longest > 0 ? default_length / longest : 1;
  overhang_ = std::max(overhang_, longest * scale + 1);
  if (style.key > 0)
    entries_.push_back({{.label = style.label, .color = style.color, .width = style.width},
                        false,
                        style.key * scale});
  draw([=](const Pen& pen) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vec<2> start = pen.map(at[i]), way = scale * pen.point * vectors[i];
      draw_arrow(pen, start, start + Vec<2>(way[0], -way[1]), style.color, style.width);
    }
  });
}

void draw_arrow(const Pen& pen, const Vec<2>& from, const Vec<2>& to, const Color& color,
                double width) {
  const double length = (to - from).norm();
  if (!(length > 0.2 * pen.point)) return;  // also not a number
  const Vec<2> along = (to - from) / length, across(-along[1], along[0]);
  const double head = std::min(4 * pen.point, 0.6 * length);
  const Vec<2> base = to - head * along;
  pen.canvas.line(from, base, pen.stroke(color, width));
  pen.canvas.fill({to, base + 0.38 * head * across, base - 0.38 * head * across}, color);
}

}  // namespace sem
