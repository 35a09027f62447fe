// Texts and reference lines of a panel.
#include <cassert>
#include <cmath>

#include "sem/plot/panel.h"

namespace sem {

void Panel::note(const Vec<2>& at, const std::string& text, const Note& style) {
  include(at);
  unclipped_.push_back([=](const Pen& pen) {
    const Vec<2> place = pen.map(at);
    const Vec<2> anchor = place + pen.point * Vec<2>(style.offset[0], -style.offset[1]);
    if (style.leader) {
      const double share = 1 - 2 / std::max(2.0, style.offset.norm());  // ends 2 points short
      pen.canvas.line(place, place + share * (anchor - place), pen.stroke(style.color, 0.5));
    }
    // The side that faces the place; more than 22.5 degrees off an axis it is a corner.
    const Vec<2> way = style.offset.norm() > 0 ? style.offset.normalized() : Vec<2>(0, 0);
    using Horizontal = TextStyle::Horizontal;
    using Vertical = TextStyle::Vertical;
    constexpr double corner = 0.38;
    TextStyle set = pen.text(way[0] > corner    ? Horizontal::left
                             : way[0] < -corner ? Horizontal::right
                                                : Horizontal::center,
                             way[1] > corner    ? Vertical::baseline
                             : way[1] < -corner ? Vertical::top
                                                : Vertical::middle,
                             style.color);
    set.size = style.size * pen.point;
    pen.canvas.text(anchor, text, set);
  });
}

void Panel::node(const Vec<2>& at, const std::string& text, double size, const Color& fill,
                 const Color& text_color) {
  include(at);
  overhang_ = std::max(overhang_, size / 2 + 1);
  unclipped_.push_back([=](const Pen& pen) {
    const Vec<2> center = pen.map(at);
    pen.canvas.marker(center, MarkerShape::circle, (size + 1.2) * pen.point, colors::black);
    pen.canvas.marker(center, MarkerShape::circle, size * pen.point, fill);
    pen.canvas.text(
        center, text,
        pen.text(TextStyle::Horizontal::center, TextStyle::Vertical::middle, text_color));
  });
}

void Panel::horizontal(double value, const std::string& text, const Series& style) {
  y_range_.include(value);
  legend_entry(style);
  draw([=](const Pen& pen) {
    const double at = std::round(pen.map({0, value})[1]);
    const Box<2> box = pen.box();
    pen.canvas.line({box.lower[0], at}, {box.upper[0], at},
                    pen.stroke(style.color, style.width, style.dash));
  });
  references_.push_back({value, false, text, style.color});
}

void Panel::vertical(double value, const std::string& text, const Series& style) {
  x_range_.include(value);
  legend_entry(style);
  draw([=](const Pen& pen) {
    const double at = std::round(pen.map({value, 0})[0]);
    const Box<2> box = pen.box();
    pen.canvas.line({at, box.lower[1]}, {at, box.upper[1]},
                    pen.stroke(style.color, style.width, style.dash));
  });
  references_.push_back({value, true, text, style.color});
}

void Panel::slope(double power, double x0, double x1, double y0) {
  const double y1 = y0 * std::pow(x1 / x0, power);
  include({x0, y0});
  include({x1, y1});
  draw([=, this](const Pen& pen) {
    assert(x.logarithmic && y.logarithmic);
    const Vec<2> a = pen.map({x0, y0}), b = pen.map({x1, y1});
    // The right angle lies above a falling and below a rising line.
    const Vec<2> corners[] = {a, b, {b[0], a[1]}};
    Stroke stroke = pen.stroke({0.35, 0.35, 0.35}, 0.7);
    stroke.closed = true;
    pen.canvas.stroke(corners, stroke);
  });
  unclipped_.push_back([=](const Pen& pen) {
    const Vec<2> a = pen.map({x0, y0}), b = pen.map({x1, y1});
    const bool right = x1 > x0;
    pen.canvas.text({b[0] + (right ? 3 : -3) * pen.point, (a[1] + b[1]) / 2}, number_text(power),
                    pen.text(right ? TextStyle::Horizontal::left : TextStyle::Horizontal::right,
                             TextStyle::Vertical::middle, {0.35, 0.35, 0.35}));
  });
}

void Panel::color_bar(const ColorScale& scale, const std::string& label) {
  bar_ = ColorBar{scale, label};
}

}  // namespace sem
