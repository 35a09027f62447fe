#include "sem/plot/panel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sem {

Series series(int i, const std::string& label) {
  static constexpr MarkerShape shapes[] = {MarkerShape::circle,   MarkerShape::square,
                                           MarkerShape::triangle, MarkerShape::diamond,
                                           MarkerShape::cross,    MarkerShape::plus};
  static const std::vector<double> dashes[] = {{}, {4, 2}, {1.2, 1.6}, {6, 2, 1.2, 2}};
  // Yellow is too pale for lines on white.
  static constexpr int order[] = {0, 1, 2, 3, 4, 5, 7};
  return {.label = label,
          .color = colors::okabe_ito[order[i % 7]],
          .dash = dashes[i % 4],
          .marker = shapes[i % 6]};
}

std::vector<Vec<2>> zip(const std::vector<double>& x, const std::vector<double>& y) {
  assert(x.size() == y.size());
  std::vector<Vec<2>> points(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) points[i] = {x[i], y[i]};
  return points;
}

void Panel::include(const Vec<2>& point) {
  x_range_.include(point[0]);
  y_range_.include(point[1]);
}

void Panel::draw(std::function<void(const Pen&)> content) {
  content_.push_back(std::move(content));
}

void Panel::legend_entry(const Series& style) {
  if (!style.label.empty()) entries_.push_back({style});
}

void Panel::curve(const std::vector<double>& xs, const std::vector<double>& ys,
                  const Series& style) {
  curve(zip(xs, ys), style);
}

void Panel::curve(const std::vector<Vec<2>>& points, const Series& style) {
  for (const auto& at : points) include(at);
  legend_entry(style);
  overhang_ = std::max(overhang_, 0.6 * (style.marker ? style.marker_size : style.width));
  draw([=](const Pen& pen) {
    const Polyline line = pen.map(points);
    if (style.width > 0) {
      Stroke stroke = pen.stroke(style.color, style.width, style.dash);
      if (style.dash.empty()) stroke.cap = Stroke::Cap::round;
      pen.canvas.stroke(line, stroke);
    }
    if (!style.marker) return;
    for (const auto& at : line)
      pen.canvas.marker(at, *style.marker, style.marker_size * pen.point, style.color);
  });
}

void Panel::error_bars(const std::vector<double>& xs, const std::vector<double>& ys,
                       const std::vector<double>& error, const Series& style) {
  assert(xs.size() == ys.size() && xs.size() == error.size());
  for (std::size_t i = 0; i < xs.size(); ++i) {
    include({xs[i], ys[i] - error[i]});
    include({xs[i], ys[i] + error[i]});
  }
  draw([=](const Pen& pen) {
    const Stroke stroke = pen.stroke(style.color, 0.8);
    const Vec<2> half_cap(1.8 * pen.point, 0);
    for (std::size_t i = 0; i < xs.size(); ++i) {
      const Vec<2> lower = pen.map({xs[i], ys[i] - error[i]}),
                   upper = pen.map({xs[i], ys[i] + error[i]});
      // An end that a logarithmic axis does not have leaves a bar to the edge of the panel.
      const Vec<2> bottom = lower.allFinite() ? lower : Vec<2>(upper[0], pen.box().upper[1]);
      pen.canvas.line(bottom, upper, stroke);
      for (const Vec<2>& end : {lower, upper})
        pen.canvas.line(end - half_cap, end + half_cap, stroke);
    }
  });
  curve(xs, ys, style);
}

void Panel::steps(const std::vector<double>& edges, const std::vector<double>& values,
                  const Series& style) {
  assert(edges.size() == values.size() + 1);
  std::vector<Vec<2>> corners;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const double edge : {edges[i], edges[i + 1]}) corners.emplace_back(edge, values[i]);
  curve(corners, style);
}

void Panel::bars(const std::vector<double>& xs, const std::vector<double>& heights, double width,
                 const Color& color, const std::string& label) {
  assert(xs.size() == heights.size());
  for (std::size_t i = 0; i < xs.size(); ++i)
    for (const double side : {-0.5, 0.5}) include({xs[i] + side * width, heights[i]});
  if (!y.logarithmic) {
    y_range_.include(0);
    if (!y.lower && y_range_.lower >= 0) y.lower = 0;  // bars stand on the axis
  }
  if (!label.empty()) entries_.push_back({{.label = label, .color = color}, true});
  draw([=](const Pen& pen) {
    for (std::size_t i = 0; i < xs.size(); ++i) {
      const Vec<2> a = pen.map({xs[i] - width / 2, heights[i]}),
                   b = pen.map({xs[i] + width / 2, 0});
      Box<2> bar;
      bar.include(a);
      bar.include(Vec<2>(b[0], std::isfinite(b[1]) ? b[1] : pen.box().upper[1]));
      pen.canvas.fill_box(bar, color);
    }
  });
}

void Panel::segments(const std::vector<Vec<2>>& from, const std::vector<Vec<2>>& to,
                     const Series& style) {
  assert(from.size() == to.size());
  for (const auto* ends : {&from, &to})
    for (const auto& at : *ends) include(at);
  legend_entry(style);
  draw([=](const Pen& pen) {
    const Stroke stroke = pen.stroke(style.color, style.width, style.dash);
    for (std::size_t i = 0; i < from.size(); ++i)
      pen.canvas.line(pen.map(from[i]), pen.map(to[i]), stroke);
  });
}

void Panel::segments(const std::vector<Vec<2>>& from, const std::vector<Vec<2>>& to,
                     const std::vector<double>& values, const ColorScale& scale, double width) {
  assert(from.size() == to.size() && from.size() == values.size());
  for (const auto* ends : {&from, &to})
    for (const auto& at : *ends) include(at);
  draw([=](const Pen& pen) {
    for (std::size_t i = 0; i < from.size(); ++i)
      if (std::isfinite(values[i]))
        pen.canvas.line(pen.map(from[i]), pen.map(to[i]), pen.stroke(scale(values[i]), width));
  });
}

void Panel::markers(const std::vector<Vec<2>>& at, const std::vector<double>& values,
                    const ColorScale& scale, double size, MarkerShape shape) {
  assert(at.size() == values.size());
  for (const auto& x_at : at) include(x_at);
  overhang_ = std::max(overhang_, 0.6 * size);
  draw([=](const Pen& pen) {
    for (std::size_t i = 0; i < at.size(); ++i)
      if (std::isfinite(values[i]))
        pen.canvas.marker(pen.map(at[i]), shape, size * pen.point, scale(values[i]));
  });
}

}  // namespace sem
