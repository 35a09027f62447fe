#include "sem/plot/legend.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/font.h"
#include "sem/draw/image.h"

namespace sem {
namespace {

// Points.
constexpr double sample = 18, text_gap = 4, row_height = 10.5, entry_gap = 10;
constexpr double bar_width = 7, tick = 2.2, bar_tick_gap = 3, bar_label_gap = 4;

/// At least two with labels where the scale has them.
Ticks bar_ticks(const ColorScale& scale, double height_in_points) {
  for (int n = std::clamp(int(height_in_points / 16), 2, 6);; ++n) {
    Ticks ticks = scale.logarithmic ? log_ticks(scale.lower, scale.upper, n)
                                    : linear_ticks(scale.lower, scale.upper, n);
    const auto n_labels = std::count_if(ticks.ticks.begin(), ticks.ticks.end(),
                                        [](const Tick& t) { return !t.label.empty(); });
    if (n_labels >= 2 || n > 8) return ticks;
  }
}

double widest(const Ticks& ticks, Canvas& canvas, double point) {
  double width = 0;
  for (const auto& t : ticks.ticks)
    width = std::max(width, canvas.text_width(t.label, lettering * point));
  return width;
}

}  // namespace

Legend::Legend(std::vector<LegendEntry> entries, Canvas& canvas, double point, double most_width)
    : entries_(std::move(entries)), point_(point) {
  for (int n = std::max(1, int(entries_.size())); n >= 1; --n) {
    arrange(n, canvas);
    if (size()[0] <= most_width) break;
  }
}

void Legend::arrange(int n_columns, Canvas& canvas) {
  const int n = int(entries_.size());
  n_rows_ = (n + n_columns - 1) / n_columns;
  column_widths_.assign(n_rows_ > 0 ? (n + n_rows_ - 1) / n_rows_ : 0, 0);
  for (int k = 0; k < n; ++k) {
    const double text = canvas.text_width(entries_[k].style.label, lettering * point_);
    double& width = column_widths_[k / n_rows_];
    width = std::max(width, (sample_width() + text_gap) * point_ + text);
  }
}

double Legend::sample_width() const {
  double width = 0;
  for (const auto& e : entries_) {
    const bool line = !e.box && e.style.width > 0;
    width = std::max({width, e.arrow_length, line && e.arrow_length == 0 ? sample : 8});
  }
  return width;
}

Vec<2> Legend::size() const {
  double width = entry_gap * point_ * std::max(0.0, double(column_widths_.size()) - 1);
  for (const double column : column_widths_) width += column;
  return {width, n_rows_ * row_height * point_};
}

std::optional<Vec<2>> Legend::free_place(const InkCanvas& ink, const Box<2>& box) const {
  const Vec<2> inset = Vec<2>::Constant(5 * point_), clearance = Vec<2>::Constant(1.5 * point_);
  const Vec<2> first = box.lower + inset, last = box.upper - inset - size();
  if ((first.array() > last.array()).any()) return {};
  constexpr int n = 24;  // places tried in each direction
  std::optional<Vec<2>> best;
  double best_distance = 0;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Vec<2> share(double(i) / n, double(j) / n);
      // Upper right first, then the other corners, then along the edges.
      const double distance =
          std::min(share[0] + 0.001, 1 - share[0]) + std::min(share[1], 1 - share[1] + 0.002);
      if (best && distance >= best_distance) continue;
      const Vec<2> corner = first + share.cwiseProduct(last - first);
      if (ink.ink({corner - clearance, corner + size() + clearance}) > 0) continue;
      best = corner;
      best_distance = distance;
    }
  return best;
}

void Legend::draw(const Pen& pen, const Vec<2>& corner) const {
  const double width = sample_width() * point_;
  double column = 0;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const int row = int(k) % n_rows_;
    if (k > 0 && row == 0) column += column_widths_[k / n_rows_ - 1] + entry_gap * point_;
    const auto& [style, box, arrow_length] = entries_[k];
    const Vec<2> left = corner + Vec<2>(column, (row + 0.5) * row_height * point_);
    const Vec<2> right = left + Vec<2>(width, 0), middle = (left + right) / 2;
    if (box) {
      const Vec<2> half(std::min(width / 2, 6 * point_), 3 * point_);
      pen.canvas.fill_box({middle - half, middle + half}, style.color);
    } else if (arrow_length > 0) {
      const Vec<2> half(arrow_length * point_ / 2, 0);
      draw_arrow(pen, middle - half, middle + half, style.color, style.width);
    } else {
      if (style.width > 0)
        pen.canvas.line(left, right, pen.stroke(style.color, style.width, style.dash));
      if (style.marker)
        pen.canvas.marker(middle, *style.marker, style.marker_size * point_, style.color);
    }
    pen.canvas.text(right + Vec<2>(text_gap * point_, 0), style.label,
                    pen.text(TextStyle::Horizontal::left));
  }
}

double color_bar_width(const ColorBar& bar, Canvas& canvas, double point, double height) {
  const Ticks ticks = bar_ticks(bar.scale, height / point);
  const bool label = !axis_label(bar.label, ticks).empty();
  return (bar_width + bar_tick_gap + (label ? bar_label_gap + lettering : 0)) * point +
         widest(ticks, canvas, point);
}

void draw_color_bar(const ColorBar& bar, Canvas& canvas, double point, double left, double top,
                    double bottom) {
  left = std::round(left);
  const Box<2> box{Vec<2>(left, top), Vec<2>(left + std::round(bar_width * point), bottom)};
  const double frame = std::max(1.0, std::round(0.6 * point));
  canvas.image(color_ramp(bar.scale.map), box);
  canvas.stroke_box(box, {.width = frame});
  const Ticks ticks = bar_ticks(bar.scale, (bottom - top) / point);
  const AxisScale scale{bar.scale.lower, bar.scale.upper, bottom, top, bar.scale.logarithmic};
  TextStyle style{.size = lettering * point, .vertical = TextStyle::Vertical::middle};
  for (const auto& t : ticks.ticks) {
    const double y = std::round(scale(t.value) - top) + top;
    const double length = (t.label.empty() ? 0.5 : 1) * tick * point;
    canvas.line({box.upper[0] - length, y}, {box.upper[0], y}, {.width = frame});
    canvas.text({box.upper[0] + bar_tick_gap * point, y}, t.label, style);
  }
  style.horizontal = TextStyle::Horizontal::center;
  style.vertical = TextStyle::Vertical::top;
  style.upward = true;
  canvas.text({box.upper[0] + (bar_tick_gap + bar_label_gap) * point + widest(ticks, canvas, point),
               (top + bottom) / 2},
              axis_label(bar.label, ticks), style);
}

}  // namespace sem
