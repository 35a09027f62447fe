#include "figures/panel.h"

#include <cmath>

#include "sem/draw/image.h"
#include "sem/draw/view.h"

namespace sem::figures {
namespace {

constexpr double line_width = 0.6 * point, tick_length = 3 * point;
constexpr double curve_width = 1.1 * point, marker_size = 4 * point;
using Style = TextStyle;

std::string superscript(int exponent) {
  static const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

}  // namespace

Panel::Panel(Canvas& canvas, const Box<2>& area, const Axis& x, const Axis& y,
             const std::string& title)
    : canvas_(canvas), area_(area), x_(x), y_(y) {
  draw_axis(x_, true);
  draw_axis(y_, false);
  canvas.stroke_box(area, {.width = line_width});
  if (!title.empty()) panel_title(canvas, area, title);
}

double Panel::fraction(const Axis& axis, double value) const {
  if (axis.logarithmic) return std::log(value / axis.lower) / std::log(axis.upper / axis.lower);
  return (value - axis.lower) / (axis.upper - axis.lower);
}

Vec<2> Panel::map(double x, double y) const {
  return {area_.lower[0] + fraction(x_, x) * (area_.upper[0] - area_.lower[0]),
          area_.upper[1] - fraction(y_, y) * (area_.upper[1] - area_.lower[1])};
}

void Panel::draw_axis(const Axis& axis, bool horizontal) const {
  std::vector<std::pair<double, std::string>> ticks;
  if (axis.logarithmic) {
    const int first = int(std::ceil(std::log10(axis.lower) - 1e-9)),
              last = int(std::floor(std::log10(axis.upper) + 1e-9));
    const int stride = std::max(1, (last - first + 5) / 6);
    for (int e = first; e <= last; e += stride)
      ticks.push_back({std::pow(10.0, e), "10" + superscript(e)});
  } else {
    const double step = nice_step(axis.lower, axis.upper, 5);
    for (const double tick : nice_ticks(axis.lower, axis.upper, 5))
      ticks.push_back({tick, tick_label(tick, step)});
  }
  for (const auto& [value, text] : ticks) {
    const double f = fraction(axis, value);
    const Vec<2> at =
        horizontal ? Vec<2>(area_.lower[0] + f * (area_.upper[0] - area_.lower[0]), area_.upper[1])
                   : Vec<2>(area_.lower[0], area_.upper[1] - f * (area_.upper[1] - area_.lower[1]));
    const Vec<2> inward = horizontal ? Vec<2>(0, -tick_length) : Vec<2>(tick_length, 0);
    canvas_.line(at, at + inward, {.width = line_width});
    if (horizontal)
      canvas_.text(at + Vec<2>(0, 3 * point), text,
                   {.size = text_size,
                    .horizontal = Style::Horizontal::center,
                    .vertical = Style::Vertical::top});
    else
      canvas_.text(at - Vec<2>(3 * point, 0), text,
                   {.size = text_size,
                    .horizontal = Style::Horizontal::right,
                    .vertical = Style::Vertical::middle});
  }
  const Vec<2> center = (area_.lower + area_.upper) / 2;
  if (horizontal)
    canvas_.text({center[0], area_.upper[1] + 14 * point}, axis.label,
                 {.size = text_size,
                  .horizontal = Style::Horizontal::center,
                  .vertical = Style::Vertical::top});
  else
    canvas_.text({area_.lower[0] - 28 * point, center[1]}, axis.label,
                 {.size = text_size, .horizontal = Style::Horizontal::center, .upward = true});
}

void Panel::curve(const std::vector<double>& x, const std::vector<double>& y, const Color& color,
                  MarkerShape marker, const std::vector<double>& dash) const {
  Polyline line;
  for (size_t i = 0; i < x.size(); ++i) line.push_back(map(x[i], y[i]));
  canvas_.push_clip(area_);
  canvas_.stroke(line, {.color = color, .width = curve_width, .dash = dash});
  for (const auto& at : line) canvas_.marker(at, marker, marker_size, color);
  canvas_.pop_clip();
}

void Panel::slope(double x0, double x1, double y0, double power, const std::string& text) const {
  const Vec<2> a = map(x0, y0), b = map(x1, y0 * std::pow(x1 / x0, power));
  const Vec<2> corners[] = {a, b, {b[0], a[1]}};
  canvas_.stroke(corners, {.color = colors::gray, .width = 0.8 * point, .closed = true});
  canvas_.text({b[0] + 3 * point, (a[1] + b[1]) / 2}, text,
               {.size = text_size, .color = colors::gray, .vertical = Style::Vertical::middle});
}

void Panel::legend(int row, const std::string& text, const Color& color, MarkerShape marker,
                   const std::vector<double>& dash) const {
  const Vec<2> at(area_.lower[0] + 8 * point, area_.upper[1] - (10 + 11 * row) * point);
  const Vec<2> end = at + Vec<2>(20 * point, 0);
  canvas_.line(at, end, {.color = color, .width = curve_width, .dash = dash});
  canvas_.marker((at + end) / 2, marker, marker_size, color);
  canvas_.text(end + Vec<2>(4 * point, 0), text,
               {.size = text_size, .vertical = Style::Vertical::middle});
}

void panel_title(Canvas& canvas, const Box<2>& area, const std::string& title) {
  canvas.text({(area.lower[0] + area.upper[0]) / 2, area.lower[1] - 4 * point}, title,
              {.size = text_size,
               .horizontal = Style::Horizontal::center,
               .vertical = Style::Vertical::bottom});
}

void color_bar(Canvas& canvas, const Box<2>& bar, double lower, double upper,
               const std::string& label) {
  canvas.image(viridis_ramp(), bar);
  canvas.stroke_box(bar, {.width = line_width});
  char text[32];
  for (const double share : {0.0, 1.0}) {
    std::snprintf(text, sizeof text, "%.2g", lower + share * (upper - lower));
    canvas.text({bar.upper[0] + 3 * point, share > 0 ? bar.lower[1] : bar.upper[1]}, text,
                {.size = text_size, .vertical = Style::Vertical::middle});
  }
  canvas.text({bar.upper[0] + 10 * point, (bar.lower[1] + bar.upper[1]) / 2}, label,
              {.size = text_size,
               .horizontal = Style::Horizontal::center,
               .vertical = Style::Vertical::middle,
               .upward = true});
}

}  // namespace sem::figures
