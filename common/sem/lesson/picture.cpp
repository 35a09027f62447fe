#include "sem/lesson/picture.h"

#include <algorithm>

#include "sem/lesson/numbers.h"
#include "sem/lesson/part_canvas.h"
#include "sem/plot/plot.h"

namespace sem {
namespace {

std::vector<Vec<2>> columns(const Points<2>& points) {
  std::vector<Vec<2>> list;
  list.reserve(points.cols());
  for (int i = 0; i < points.cols(); ++i) list.push_back(points.col(i));
  return list;
}

Vec<2> unmap(const View2& view, const Vec<2>& pixel) {
  const Vec<2> d = (pixel - view.map({0, 0})) / view.scale();
  return {d[0], -d[1]};
}

}  // namespace

Picture::Picture(Canvas& canvas, const Box<2>& area, const Box<2>& world)
    : canvas_(canvas), area_(area), view_area_(area), view_(world, area) {}

Box<2> Picture::part(const Vec<2>& lower, const Vec<2>& upper) const {
  const Vec<2> size = area_.upper - area_.lower;
  return {area_.lower + lower.cwiseProduct(size), area_.lower + upper.cwiseProduct(size)};
}

void Picture::set_view(const Box<2>& world) { set_view(world, area_); }

void Picture::set_view(const Box<2>& world, const Box<2>& rectangle) {
  view_ = View2(world, rectangle);
  view_area_ = rectangle;
  view_used_ = true;
}

const View2& Picture::view() {
  view_used_ = true;
  return view_;
}

Vec<2> Picture::to_world(const Vec<2>& pixel) const { return unmap(view_, pixel); }

void Picture::curve(const Points<2>& points, const Stroke& stroke) {
  const auto list = columns(points);
  canvas_.stroke(view().map(list), stroke);
}

void Picture::line(const Vec<2>& a, const Vec<2>& b, const Stroke& stroke) {
  canvas_.line(view().map(a), view().map(b), stroke);
}

void Picture::fill(const Points<2>& corners, const Color& color) {
  const auto list = columns(corners);
  canvas_.fill(view().map(list), color);
}

void Picture::dots(const Points<2>& points, const Color& color, double size, MarkerShape shape) {
  for (int i = 0; i < points.cols(); ++i) dot(points.col(i), color, size, shape);
}

void Picture::dot(const Vec<2>& point, const Color& color, double size, MarkerShape shape) {
  canvas_.marker(view().map(point), shape, size, color);
}

void Picture::arrow(const Vec<2>& from, const Vec<2>& vector, const Color& color, double width) {
  const Vec<2> a = view().map(from), b = view().map(from + vector), d = b - a;
  const double length = d.norm();
  if (!(length > 0)) return;
  const double head = std::min(length, 4 * width + 4);  // pixels
  const Vec<2> along = d / length, across(-along[1], along[0]);
  const Vec<2> neck = b - head * along;
  canvas_.line(a, neck + 0.2 * head * along, {.color = color, .width = width});
  canvas_.fill({b, neck + 0.4 * head * across, neck - 0.4 * head * across}, color);
}

void Picture::label(const Vec<2>& point, const std::string& text, const Color& color,
                    const Vec<2>& offset, double size) {
  label_at(view().map(point), text, color, offset, size);
}

void Picture::label_at(const Vec<2>& pixel, const std::string& text, const Color& color,
                       const Vec<2>& offset, double size) {
  using Horizontal = TextStyle::Horizontal;
  const Vec<2> at = pixel + offset;
  // On the far side of the point: an offset to the left ends the text there.
  const auto horizontal = offset[0] > 0   ? Horizontal::left
                          : offset[0] < 0 ? Horizontal::right
                                          : Horizontal::center;
  TextStyle style{.size = size, .horizontal = horizontal, .vertical = TextStyle::Vertical::middle};
  style.color = colors::white;
  for (int x = -2; x <= 2; x += 2)
    for (int y = -2; y <= 2; y += 2)
      if (x != 0 || y != 0) canvas_.text(at + Vec<2>(x, y), text, style);
  style.color = color;
  canvas_.text(at, text, style);
}

void Picture::legend(const std::vector<Entry>& entries, Corner corner) {
  constexpr double pad = 10, mark = 30, line_height = 1.5 * text_size;
  double text_width = 0;
  for (const auto& entry : entries)
    text_width = std::max(text_width, canvas_.text_width(entry.text, text_size));
  const Vec<2> size(text_width + mark + 3 * pad, double(entries.size()) * line_height + pad);
  const bool right = corner == Corner::upper_right || corner == Corner::lower_right;
  const bool lower = corner == Corner::lower_left || corner == Corner::lower_right;
  Vec<2> at(right ? area_.upper[0] - size[0] - pad : area_.lower[0] + pad,
            lower ? area_.upper[1] - size[1] - pad : area_.lower[1]);
  at = at.array().round();
  canvas_.fill_box({at, at + size}, colors::white.with_alpha(0.85));
  canvas_.stroke_box({at, at + size}, {.color = colors::light_gray, .width = 1});
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& entry = entries[i];
    const double y = at[1] + pad / 2 + (double(i) + 0.5) * line_height, x = at[0] + pad;
    if (entry.marker)
      canvas_.marker({x + mark / 2, y}, *entry.marker, 10, entry.color);
    else
      canvas_.line({x, y}, {x + mark, y}, {.color = entry.color, .width = 3, .dash = entry.dash});
    canvas_.text({x + mark + pad, y}, entry.text,
                 {.size = text_size, .vertical = TextStyle::Vertical::middle});
  }
}

void Picture::plot(const Box<2>& rectangle, const std::function<void(Plot& plot)>& describe) {
  constexpr double dots_per_inch = 144;
  PartCanvas part(canvas_, rectangle);
  Plot plot(part.width() / dots_per_inch, part.height() / dots_per_inch);
  describe(plot);
  plot.draw(part);
}

void Picture::hover(const TextAt& text) {
  hover(view_area_,
        [text, view = view()](const Vec<2>& pixel) { return text(unmap(view, pixel)); });
}

void Picture::hover(const Box<2>& rectangle, TextAt text) {
  texts_.emplace_back(rectangle, std::move(text));
}

void Picture::hover(const Points<2>& points, std::function<std::string(int)> text) {
  constexpr double reach = 40;
  if (points.cols() == 0) return;
  hover([points, text = std::move(text), most = reach / view().scale()](const Vec<2>& X) {
    int k = 0;
    const double square = (points.colwise() - X).colwise().squaredNorm().minCoeff(&k);
    return square < most * most ? text(k) : "";
  });
}

std::string Picture::text_at(const Vec<2>& pixel) const {
  const auto in = [&](const Box<2>& box) {
    return (pixel.array() >= box.lower.array()).all() && (pixel.array() <= box.upper.array()).all();
  };
  for (auto it = texts_.rbegin(); it != texts_.rend(); ++it) {
    const std::string found = in(it->first) ? it->second(pixel) : "";
    if (!found.empty()) return found;
  }
  if (!view_used_ || !in(view_area_)) return "";
  const Vec<2> X = to_world(pixel);
  return "x = " + rounded(X[0], 3) + ", y = " + rounded(X[1], 3);
}

void Picture::note(const std::string& text, int row, const Color& color) {
  const Vec<2> at = area_.lower + Vec<2>(14, 1.5 * text_size * row + 4);
  canvas_.text(at, text, {.size = text_size, .color = color, .vertical = TextStyle::Vertical::top});
}

}  // namespace sem
