#include "sem/plot/panel_layout.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/font.h"

namespace sem {
namespace {

// Points.
constexpr double frame_width = 0.6, tick_length = 3, minor_tick_length = 1.8, tick_gap = 3;
constexpr double x_tick_gap = 4;  // so that the numbers at the corner of both axes stay apart
constexpr double label_gap = 4, title_gap = 4, key_gap = 5, scale_gap = 7;
constexpr double label_height = lettering * (0.8 + font_descent);
constexpr double cell = 1.5;  // of the search for free places
constexpr double frameless_margin = 2, line_height = 11;

using Horizontal = TextStyle::Horizontal;
using Vertical = TextStyle::Vertical;

/// A line of whole pixels: its width, and the offset of its middle from a whole pixel.
struct Hairline {
  double width, offset;
  explicit Hairline(double point)
      : width(std::max(1.0, std::round(frame_width * point))), offset(std::fmod(width, 2) / 2) {}
  double snap(double at) const { return std::round(at - offset) + offset; }
};

}  // namespace

PanelLayout::PanelLayout(const Panel& panel, Canvas& canvas, double point,
                         const std::string& letter, LegendPlace place)
    : panel_(panel), canvas_(canvas), point_(point), letter_(letter), place_(place) {}

void PanelLayout::set_box(const Box<2>& box) {
  auto x_limits = axis_limits(panel_.x, panel_.x_range_),
       y_limits = axis_limits(panel_.y, panel_.y_range_);
  // Limits from the data are tight for pictures of bodies; others keep their margin.
  const auto tighten = [&](const Axis& axis, const DataRange& range,
                           std::pair<double, double>& limits) {
    if (axis.logarithmic || !(range.lower < range.upper)) return;
    if (!axis.lower) limits.first = range.lower;
    if (!axis.upper) limits.second = range.upper;
  };
  if (panel_.tight_ || panel_.equal || !panel_.frame) {
    tighten(panel_.x, panel_.x_range_, x_limits);
    tighten(panel_.y, panel_.y_range_, y_limits);
  }
  box_ = box;
  if (panel_.equal) {
    const Vec<2> data(x_limits.second - x_limits.first, y_limits.second - y_limits.first);
    const Vec<2> room = box.upper - box.lower;
    const double scale = room.cwiseQuotient(data).minCoeff();
    const Vec<2> center = (box.lower + box.upper) / 2;
    box_ = {center - scale / 2 * data, center + scale / 2 * data};
  }
  const Hairline line(point_);
  for (int axis = 0; axis < 2; ++axis) {
    box_.lower[axis] = line.snap(box_.lower[axis]);
    box_.upper[axis] = line.snap(box_.upper[axis]);
  }
  x_ = {x_limits.first, x_limits.second, box_.lower[0], box_.upper[0], panel_.x.logarithmic};
  y_ = {y_limits.first, y_limits.second, box_.upper[1], box_.lower[1], panel_.y.logarithmic};
  if (panel_.x.reversed) std::swap(x_.begin, x_.end);
  if (panel_.y.reversed) std::swap(y_.begin, y_.end);
  x_ticks_ = ticks(panel_.x, x_, true);
  y_ticks_ = ticks(panel_.y, y_, false);
}

Ticks PanelLayout::ticks(const Axis& axis, const AxisScale& scale, bool horizontal) const {
  if (!axis.ticks.empty()) return {axis.ticks};
  const double length = std::abs(scale.end - scale.begin) / point_;
  const double gap = 0.7 * lettering * point_;
  for (int n = std::clamp(int(length / (horizontal ? 26 : 16)), 1, 7);; --n) {
    Ticks ticks = axis.logarithmic ? log_ticks(scale.lower, scale.upper, n)
                                   : linear_ticks(scale.lower, scale.upper, n);
    if (!horizontal || n == 1) return ticks;
    double last = -1e300;
    bool apart = true;
    std::sort(ticks.ticks.begin(), ticks.ticks.end(),
              [&](const Tick& a, const Tick& b) { return scale(a.value) < scale(b.value); });
    for (const auto& tick : ticks.ticks) {
      if (tick.label.empty()) continue;
      const double half = canvas_.text_width(tick.label, lettering * point_) / 2;
      apart = apart && scale(tick.value) - half > last + gap;
      last = scale(tick.value) + half;
    }
    if (apart) return ticks;
  }
}

double PanelLayout::widest(const Ticks& ticks) const {
  double width = 0;
  for (const auto& tick : ticks.ticks)
    width = std::max(width, canvas_.text_width(tick.label, lettering * point_));
  return width;
}

Pen PanelLayout::pen_on(Canvas& canvas) const { return Pen(canvas, point_, x_, y_); }

Box<2> PanelLayout::clip_box() const {
  if (panel_.frame) return box_;
  const Vec<2> reach = Vec<2>::Constant((panel_.overhang_ + frameless_margin) * point_);
  return {box_.lower - reach, box_.upper + reach};
}

Legend PanelLayout::legend(double most_width) const {
  return Legend(panel_.entries_, canvas_, point_, most_width);
}

Margins PanelLayout::axis_margins() const {
  if (!panel_.frame) {
    const double reach = (panel_.overhang_ + frameless_margin) * point_;
    return {reach, reach, reach, reach};
  }
  Margins m;
  const double line = frame_width * point_, size = lettering * point_;
  m.left = m.right = m.top = m.bottom = line;
  const auto text = [&](const std::string& label) { return canvas_.text_width(label, size); };
  if (panel_.x.tick_labels)
    for (const auto& tick : x_ticks_.ticks) {
      if (tick.label.empty()) continue;
      const double at = x_(tick.value), half = text(tick.label) / 2;
      m.left = std::max(m.left, box_.lower[0] - at + half);
      m.right = std::max(m.right, at + half - box_.upper[0]);
      m.bottom = (x_tick_gap + lettering * (font_cap_height + font_descent)) * point_;
    }
  if (panel_.y.tick_labels)
    for (const auto& tick : y_ticks_.ticks) {
      if (tick.label.empty()) continue;
      const double at = y_(tick.value), half = size / 2;
      m.top = std::max(m.top, box_.lower[1] - at + half);
      m.bottom = std::max(m.bottom, at + half - box_.upper[1]);
      m.left = std::max(m.left, tick_gap * point_ + widest(y_ticks_));
    }
  const Vec<2> room = box_.upper - box_.lower;
  const std::string x_label = axis_label(panel_.x.label, x_ticks_),
                    y_label = axis_label(panel_.y.label, y_ticks_);
  if (!x_label.empty()) {
    m.bottom += (label_gap + label_height) * point_ - 0.1 * size;
    const double over = (text(x_label) - room[0]) / 2;
    m.left = std::max(m.left, over);
    m.right = std::max(m.right, over);
  }
  if (!y_label.empty()) {
    m.left += (label_gap + label_height) * point_;
    const double over = (text(y_label) - room[1]) / 2;
    m.top = std::max(m.top, over);
    m.bottom = std::max(m.bottom, over);
  }
  return m;
}

Margins PanelLayout::margins() const {
  Margins m = axis_margins();
  const Vec<2> room = box_.upper - box_.lower;
  // Notes may reach over the box.
  InkCanvas notes(box_, room.maxCoeff(), canvas_);
  for (const auto& content : panel_.unclipped_) content(pen_on(notes));
  if (notes.texts().lower.allFinite()) {
    m.left = std::max(m.left, box_.lower[0] - notes.texts().lower[0]);
    m.right = std::max(m.right, notes.texts().upper[0] - box_.upper[0]);
    m.top = std::max(m.top, box_.lower[1] - notes.texts().lower[1]);
    m.bottom = std::max(m.bottom, notes.texts().upper[1] - box_.upper[1]);
  }
  if (panel_.bar_)
    m.right = std::max(m.right,
                       scale_gap * point_ + color_bar_width(*panel_.bar_, canvas_, point_, room[1]));
  if (!panel_.entries_.empty() && place_ == LegendPlace::right)
    m.right += 2 * key_gap * point_ + legend(0).size()[0];
  if (!panel_.entries_.empty() && place_ == LegendPlace::below) {
    const Vec<2> size = legend(m.left + room[0]).size();
    m.bottom += key_gap * point_ + size[1];
    m.right = std::max(m.right, (size[0] - room[0] - m.left));
  }
  for (const auto& line : panel_.lines_below) {
    m.bottom += line_height * point_;
    m.right = std::max(m.right, canvas_.text_width(line, lettering * point_) - room[0] - m.left);
  }
  if (!panel_.title.empty()) {
    const double over = (canvas_.text_width(panel_.title, lettering * point_) - room[0]) / 2;
    m.left = std::max(m.left, over);
    m.right = std::max(m.right, over);
  }
  if (!panel_.title.empty() || !letter_.empty()) m.top += (title_gap + lettering) * point_;
  return m;
}

InkCanvas PanelLayout::ink() const {
  InkCanvas ink(clip_box(), cell * point_, canvas_);
  for (const auto& content : panel_.content_) content(pen_on(ink));
  for (const auto& content : panel_.unclipped_) content(pen_on(ink));
  for (const auto& text : panel_.references_) {  // the lines' texts may stand at either end
    const Vec<2> at = pen_on(ink).map({text.value, text.value});
    const double r = 10 * point_;
    if (text.vertical || text.text.empty()) continue;
    ink.mark({Vec<2>(box_.lower[0], at[1] - r), Vec<2>(box_.upper[0], at[1])});
  }
  return ink;
}

bool PanelLayout::move_legend() {
  if (place_ != LegendPlace::automatic || panel_.entries_.empty()) return false;
  if (legend(0).free_place(ink(), clip_box())) return false;
  place_ = LegendPlace::below;
  return true;
}

void PanelLayout::draw(double letter_left) const {
  const Pen on_canvas = pen_on(canvas_);
  InkCanvas used = ink();
  canvas_.push_clip(clip_box());
  for (const auto& content : panel_.content_) content(on_canvas);
  canvas_.pop_clip();
  if (panel_.frame) draw_axes();
  if (panel_.bar_)
    draw_color_bar(*panel_.bar_, canvas_, point_, box_.upper[0] + scale_gap * point_, box_.lower[1],
                   box_.upper[1]);
  draw_references(on_canvas, used);
  for (const auto& content : panel_.unclipped_) content(on_canvas);
  draw_legend(on_canvas, used);
  draw_lines_below(on_canvas);
  const Margins m = axis_margins();
  const double title =
      box_.lower[1] - std::max(m.top, title_gap * point_ - 1) - title_gap / 2 * point_;
  canvas_.text({(box_.lower[0] + box_.upper[0]) / 2, title}, panel_.title,
               on_canvas.text(Horizontal::center, Vertical::baseline));
  canvas_.text({letter_left, title}, letter_, on_canvas.text(Horizontal::left, Vertical::baseline));
}

void PanelLayout::draw_lines_below(const Pen& pen) const {
  const Margins m = axis_margins();
  const double room = m.left + box_.upper[0] - box_.lower[0];
  double y = box_.upper[1] + m.bottom + 2 * point_;
  if (place_ == LegendPlace::below && !panel_.entries_.empty())
    y += key_gap * point_ + legend(room).size()[1];
  for (const auto& line : panel_.lines_below) {
    canvas_.text({box_.lower[0] - m.left, y}, line, pen.text(Horizontal::left, Vertical::top));
    y += line_height * point_;
  }
}

void PanelLayout::draw_axes() const {
  draw_axis(panel_.x, x_, x_ticks_, true);
  draw_axis(panel_.y, y_, y_ticks_, false);
  canvas_.stroke_box(box_, {.width = Hairline(point_).width});
  const Pen pen = pen_on(canvas_);
  const Vec<2> middle = (box_.lower + box_.upper) / 2;
  const bool x_labels = panel_.x.tick_labels && !x_ticks_.ticks.empty();
  const double below = (x_labels ? x_tick_gap + lettering * font_cap_height : 0) + label_gap;
  canvas_.text({middle[0], box_.upper[1] + below * point_}, axis_label(panel_.x.label, x_ticks_),
               pen.text(Horizontal::center, Vertical::top));
  const double width =
      panel_.y.tick_labels ? tick_gap * point_ + widest(y_ticks_) : frame_width * point_;
  TextStyle style = pen.text(Horizontal::center, Vertical::bottom);
  style.upward = true;
  canvas_.text({box_.lower[0] - width - label_gap * point_, middle[1]},
               axis_label(panel_.y.label, y_ticks_), style);
}

void PanelLayout::draw_axis(const Axis& axis, const AxisScale& scale, const Ticks& ticks,
                            bool horizontal) const {
  const Hairline line(point_);
  const Pen pen = pen_on(canvas_);
  for (const auto& tick : ticks.ticks) {
    const double at = line.snap(scale(tick.value));
    const double length = (tick.label.empty() ? minor_tick_length : tick_length) * point_;
    const Vec<2> foot = horizontal ? Vec<2>(at, box_.upper[1]) : Vec<2>(box_.lower[0], at);
    const Vec<2> inward = horizontal ? Vec<2>(0, -length) : Vec<2>(length, 0);
    canvas_.line(foot, foot + inward, {.width = line.width});
    if (!axis.tick_labels) continue;
    if (horizontal)
      canvas_.text(foot + Vec<2>(0, x_tick_gap * point_), tick.label,
                   pen.text(Horizontal::center, Vertical::top));
    else
      canvas_.text(foot - Vec<2>(tick_gap * point_, 0), tick.label,
                   pen.text(Horizontal::right, Vertical::middle));
  }
}

void PanelLayout::draw_references(const Pen& pen, InkCanvas& ink) const {
  for (const auto& [value, vertical, text, color] : panel_.references_) {
    if (text.empty()) continue;
    const double at = vertical ? x_(value) : y_(value), gap = 2.5 * point_, inset = 4 * point_;
    TextStyle best;
    Vec<2> place;
    int least = -1;
    for (const double side : {-1.0, 1.0})     // above, below; left, right
      for (const bool end : {true, false}) {  // right or upper end, the other
        TextStyle style = pen.text(end ? Horizontal::right : Horizontal::left,
                                   side < 0 ? Vertical::bottom : Vertical::top, color);
        style.upward = vertical;
        const double along = vertical ? (end ? box_.lower[1] + inset : box_.upper[1] - inset)
                                      : (end ? box_.upper[0] - inset : box_.lower[0] + inset);
        const double across = at + side * (side < 0 ? 1 * point_ : gap);
        const Vec<2> anchor = vertical ? Vec<2>(across, along) : Vec<2>(along, across);
        Box<2> covered = text_box(canvas_, anchor, text, style);
        const bool inside = (covered.lower.array() >= box_.lower.array()).all() &&
                            (covered.upper.array() <= box_.upper.array()).all();
        const int count = ink.ink(covered) + (inside ? 0 : 100000);
        if (least >= 0 && count >= least) continue;
        least = count;
        best = style;
        place = anchor;
      }
    canvas_.text(place, text, best);
    ink.mark(text_box(canvas_, place, text, best));
  }
}

void PanelLayout::draw_legend(const Pen& pen, const InkCanvas& ink) const {
  if (panel_.entries_.empty() || place_ == LegendPlace::none) return;
  const Margins m = axis_margins();
  if (place_ == LegendPlace::automatic) {
    const Legend inside = legend(0);
    if (const auto corner = inside.free_place(ink, clip_box())) inside.draw(pen, *corner);
  } else if (place_ == LegendPlace::below) {
    const double room = m.left + box_.upper[0] - box_.lower[0];
    const Legend below = legend(room);
    const double left =
        std::max(box_.upper[0] - room, box_.upper[0] - below.size()[0] / 2 - room / 2);
    below.draw(pen, {left, box_.upper[1] + m.bottom + key_gap * point_});
  } else {
    const double bar = panel_.bar_
                           ? scale_gap * point_ + color_bar_width(*panel_.bar_, canvas_, point_,
                                                                box_.upper[1] - box_.lower[1])
                           : 0;
    legend(0).draw(pen, {box_.upper[0] + std::max(m.right, bar) + 2 * key_gap * point_ -
                             frame_width * point_,
                         box_.lower[1]});
  }
}

}  // namespace sem
