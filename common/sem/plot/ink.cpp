#include "sem/plot/ink.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/font.h"
#include "sem/draw/image.h"

namespace sem {

InkCanvas::InkCanvas(const Box<2>& region, double cell, Canvas& fonts)
    : region_(region), cell_(cell), fonts_(fonts) {
  const Vec<2> size = (region.upper - region.lower) / cell;
  n_x_ = std::max(1, int(std::ceil(size[0])));
  n_y_ = std::max(1, int(std::ceil(size[1])));
  marks_.assign(std::size_t(n_x_) * n_y_, 0);
}

InkCanvas::Cells InkCanvas::cells_of(const Box<2>& rectangle) const {
  const Vec<2> lower = (rectangle.lower - region_.lower) / cell_,
               upper = (rectangle.upper - region_.lower) / cell_;
  const auto within = [](double x, int n) { return int(std::clamp(x, 0.0, double(n))); };
  return {within(std::floor(lower[0]), n_x_), within(std::floor(lower[1]), n_y_),
          within(std::ceil(upper[0]), n_x_), within(std::ceil(upper[1]), n_y_)};
}

int InkCanvas::ink(const Box<2>& rectangle) const {
  const Cells c = cells_of(rectangle);
  int count = 0;
  for (int j = c.top; j < c.bottom; ++j)
    for (int i = c.left; i < c.right; ++i) count += marks_[std::size_t(j) * n_x_ + i];
  return count;
}

void InkCanvas::mark(const Box<2>& rectangle, bool inked) {
  if (!rectangle.lower.allFinite() || !rectangle.upper.allFinite()) return;
  const Cells c = cells_of(rectangle);
  for (int j = c.top; j < c.bottom; ++j)
    std::fill(marks_.begin() + std::size_t(j) * n_x_ + c.left,
              marks_.begin() + std::size_t(j) * n_x_ + std::max(c.left, c.right), char(inked));
}

void InkCanvas::fill(std::span<const Polyline> loops, const Color& color) {
  const bool white = color.r == 1 && color.g == 1 && color.b == 1;
  // Row by row between the crossings with the loops, at the middle of the cells.
  for (int j = 0; j < n_y_; ++j) {
    const double y = region_.lower[1] + (j + 0.5) * cell_;
    std::vector<double> crossings;
    for (const auto& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec<2>&a = loop[k], &b = loop[(k + 1) % loop.size()];
        if ((a[1] > y) == (b[1] > y)) continue;
        crossings.push_back(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
      }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      mark({Vec<2>(crossings[k], y), Vec<2>(crossings[k + 1], y)}, !white);
  }
  if (white) return;
  for (const auto& loop : loops) stroke(loop, {.width = 1, .closed = true});
}

void InkCanvas::stroke(std::span<const Vec<2>> points, const Stroke& style) {
  const Vec<2> half = Vec<2>::Constant(style.width / 2);
  const std::size_t n = points.size(), n_segments = style.closed ? n : n - (n > 0);
  Box<2> reach = region_;
  reach.lower -= half;
  reach.upper += half;
  for (std::size_t k = 0; k < n_segments; ++k) {
    const Vec<2>&a = points[k], &b = points[(k + 1) % n];
    if (!a.allFinite() || !b.allFinite()) continue;
    Box<2> box;
    box.include(a);
    box.include(b);
    if ((box.upper.array() < reach.lower.array()).any() ||
        (box.lower.array() > reach.upper.array()).any())
      continue;
    const int n_steps = std::min(100000, 1 + int(2 * (b - a).norm() / cell_));
    for (int i = 0; i <= n_steps; ++i) {
      const Vec<2> x = a + double(i) / n_steps * (b - a);
      mark({x - half, x + half});
    }
  }
}

void InkCanvas::text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) {
  const Box<2> box = text_box(fonts_, position, utf8, style);
  mark(box);
  if (box.lower.allFinite()) texts_.include(box);
}

void InkCanvas::image(const Image& image, const Box<2>& rectangle) {
  const Vec<2> pixel =
      (rectangle.upper - rectangle.lower).cwiseQuotient(Vec<2>(image.width, image.height));
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const auto* rgb = image.pixel(column, row);
      if (image.left_out && std::equal(rgb, rgb + 3, image.left_out->begin())) continue;
      const Vec<2> corner = rectangle.lower + Vec<2>(column, row).cwiseProduct(pixel);
      mark({corner, corner + pixel});
    }
}

Box<2> text_box(Canvas& fonts, const Vec<2>& position, const std::string& utf8,
                const TextStyle& style) {
  constexpr double ascent = 0.8;  // ems, of accents and superscripts
  const double width = fonts.text_width(utf8, style.size);
  const Vec<2> start = text_origin(position, style, width);
  Box<2> box;
  if (style.upward) {
    box.include(start + Vec<2>(-ascent * style.size, 0));
    box.include(start + Vec<2>(font_descent * style.size, -width));
  } else {
    box.include(start + Vec<2>(0, -ascent * style.size));
    box.include(start + Vec<2>(width, font_descent * style.size));
  }
  return box;
}

}  // namespace sem
