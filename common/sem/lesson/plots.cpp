#include "sem/lesson/plots.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/image.h"
#include "sem/lesson/numbers.h"

namespace sem::tutorial {

Color part_color(int part) {
  static constexpr int order[] = {0, 1, 2, 3, 4, 5, 7};
  return colors::categorical(order[part % 7]);
}

std::string list(const Eigen::VectorXd& v, int digits) {
  std::string text;
  for (int i = 0; i < v.size(); ++i) text += (i > 0 ? ", " : "") + rounded(v[i], digits);
  return text;
}

std::string reading(const std::string& label, double value) {
  const auto comma = label.rfind(", ");
  const std::string unit = comma == std::string::npos ? "" : " " + label.substr(comma + 2);
  return label.substr(0, comma) + " = " + rounded(value, 4) + unit;
}

void color_bar(Picture& picture, const std::string& lower, const std::string& upper,
               const std::optional<Vec<2>>& place) {
  const Vec<2> at = place.value_or(picture.part({0.02, 0.02}, {1, 1}).lower);
  constexpr double width = 150, height = 16, size = Picture::text_size;
  Canvas& canvas = picture.canvas();
  const double left = at[0] + canvas.text_width(lower, size) + 8;
  for (int i = 0; i < int(width); ++i)
    canvas.fill_box({{left + i, at[1]}, {left + i + 1, at[1] + height}},
                    colors::viridis(i / width));
  const TextStyle style{.size = size, .vertical = TextStyle::Vertical::middle};
  canvas.text({at[0], at[1] + height / 2}, lower, style);
  canvas.text({left + width + 8, at[1] + height / 2}, upper, style);
}

void read_curves(Picture& picture, const Box<2>& rectangle, Panel& panel,
                 const std::vector<Trace>& curves, bool along_x) {
  // Where they are in pixels, the panel knows when it is drawn. NaN: it cannot show them.
  const auto box = std::make_shared<Box<2>>();
  const auto shown = std::make_shared<std::vector<Polyline>>();
  panel.draw([=](const Pen& pen) {
    *box = pen.box();
    shown->clear();
    for (const auto& curve : curves) shown->push_back(pen.map(zip(curve.x, curve.y)));
  });
  const Vec<2> origin = rectangle.lower.array().round();
  picture.hover(rectangle, [=, x = panel.x.label, y = panel.y.label](const Vec<2>& at) {
    const Vec<2> pixel = at - origin;
    double least = std::numeric_limits<double>::infinity();
    std::string text;
    if ((pixel.array() < box->lower.array()).any() || (pixel.array() > box->upper.array()).any())
      return text;
    for (std::size_t c = 0; c < shown->size(); ++c)
      for (std::size_t k = 0; k < (*shown)[c].size(); ++k) {
        const Vec<2> d = (*shown)[c][k] - pixel;
        const double distance = along_x ? std::abs(d[0]) : d.norm();
        if (!(distance < least)) continue;
        least = distance;
        text = curves[c].label;
        for (const auto& [label, value] : {std::pair(x, curves[c].x[k]), {y, curves[c].y[k]}})
          if (!label.empty()) text += (text.empty() ? "" : "\n") + reading(label, value);
      }
    return text;
  });
}

void draw_panel(Picture& picture, const Axis& x, const Axis& y,
                const std::function<void(Panel& panel)>& content, const std::vector<Trace>& curves,
                const std::optional<Box<2>>& rectangle) {
  const Box<2> place = rectangle.value_or(picture.part({0.02, 0.02}, {0.98, 0.98}));
  picture.plot(place, [&](Plot& plot) {
    Panel& panel = plot.panel();
    panel.x = x;
    panel.y = y;
    content(panel);
    read_curves(picture, place, panel, curves);
  });
}

Series line(const std::string& label, const Color& color, int dash) {
  static const std::vector<double> dashes[] = {{}, {6, 3}, {1.5, 2.5}};
  return {.label = label, .color = color, .width = 1.8, .dash = dashes[dash]};
}

void draw_columns(Picture& picture, const Axis& x, const Axis& y, const std::vector<double>& at,
                  const Eigen::MatrixXd& values, const std::vector<std::string>& names,
                  const std::optional<Box<2>>& rectangle, const std::optional<double>& now) {
  std::vector<Trace> curves;
  for (int j = 0; j < values.cols(); ++j) curves.push_back({names[j], at, column(values, j)});
  draw_panel(
      picture, x, y,
      [&](Panel& panel) {
        for (int j = 0; j < values.cols(); ++j)
          panel.curve(at, curves[j].y, line(names[j], part_color(j), j % 3));
        if (now) panel.vertical(*now, "");
      },
      curves, rectangle);
}

Axis count_axis(const std::string& label, int n) {
  Axis axis{.label = label, .lower = -0.1, .upper = n + 0.1};
  for (int i = 0; i <= n; ++i) axis.ticks.emplace_back(i, std::to_string(i));
  return axis;
}

void draw_charts(Picture& picture, const std::vector<Chart>& charts) {
  draw_charts(picture, charts, picture.part({0.02, 0.02}, {0.98, 0.97}));
}

void draw_charts(Picture& picture, const std::vector<Chart>& charts, const Box<2>& rectangle) {
  const auto labels = [](const Chart& chart) {
    std::vector<std::string> list;
    for (const auto& trace : chart.traces) list.push_back(trace.label);
    return list;
  };
  picture.plot(rectangle, [&](Plot& plot) {
    plot.shared_legend = charts.size() > 1 && labels(charts[0]) == labels(charts[1]);
    for (int c = 0; c < int(charts.size()); ++c) {
      Panel& panel = plot.panel(0, c);
      panel.x = charts[c].x;
      panel.y = charts[c].y;
      if (charts.size() > 1) panel.legend = LegendPlace::below;
      for (int k = 0; k < int(charts[c].traces.size()); ++k) {
        const auto& [label, x, y] = charts[c].traces[k];
        Series style = series(label.empty() ? 0 : k, label);
        style.width = label.empty() ? 1.0 : 1.6;
        style.marker_size = 5;
        if (x.size() >= 12) style.marker.reset();
        panel.curve(x, y, style);
      }
      read_curves(picture, rectangle, panel, charts[c].traces);
      if (charts[c].now) panel.vertical(*charts[c].now, "now");
    }
  });
}

Check::Check(const Function& f, const Eigen::VectorXd& x, const Eigen::MatrixXd& derivative) {
  for (int k = 0; k <= 40; ++k) {
    h.push_back(std::pow(10.0, -1 - 0.25 * k));
    Eigen::MatrixXd difference(derivative.rows(), derivative.cols());
    for (int j = 0; j < x.size(); ++j) {
      const Eigen::VectorXd step = h[k] * Eigen::VectorXd::Unit(x.size(), j);
      difference.col(j) = (f(x + step) - f(x - step)) / (2 * h[k]);
    }
    error.push_back((difference - derivative).norm());
  }
}

double Check::order() const { return std::log10(error[4] / error[8]); }

double Check::least() const { return *std::min_element(error.begin(), error.end()); }

std::string text(const Check& check) {
  const bool exact = check.error[4] < 1e-9;  // at h = 1e-2: there is nothing to converge
  return (exact ? "exact for every h" : "order " + rounded(check.order(), 2)) + ", least error " +
         error_text(check.least(), 1e-6);
}

void draw_errors(Picture& picture, const std::vector<std::pair<std::string, Check>>& checks) {
  std::vector<Trace> curves;
  for (const auto& [name, check] : checks) curves.push_back({name, check.h, check.error});
  const auto content = [&](Panel& panel) {
    for (int k = 0; k < int(curves.size()); ++k)
      panel.curve(curves[k].x, curves[k].y, line(curves[k].label, part_color(1 - k)));
  };
  draw_panel(picture, {.label = "step h", .logarithmic = true},
             {.label = "error", .logarithmic = true}, content, curves);
}

void draw_bars(Picture& picture, const std::string& y_label,
               const std::vector<std::pair<std::string, double>>& bars) {
  std::vector<double> at, height;
  std::vector<Trace> tops;
  for (const auto& [bar, value] : bars) {
    at.push_back(double(at.size())), height.push_back(value);
    tops.push_back({bar, {at.back()}, {value}});
  }
  const double largest = *std::max_element(height.begin(), height.end());
  const Box<2> place = picture.part({0.02, 0.02}, {0.98, 0.98});
  picture.plot(place, [&](Plot& plot) {
    Panel& panel = plot.panel();
    panel.x = {.lower = -0.8, .upper = double(bars.size()) - 0.2, .tick_labels = false};
    panel.y = {.label = y_label, .lower = 0, .upper = largest > 0 ? 1.1 * largest : 1};
    for (std::size_t k = 0; k < bars.size(); ++k)
      panel.note({at[k], height[k]}, bars[k].first, {.offset = {0, 6}});
    panel.bars(at, height, 0.4, blue);
    read_curves(picture, place, panel, tops, true);
  });
}

void draw_matrix(Picture& picture, const Eigen::MatrixXd& matrix, const std::vector<int>& first,
                 const Box<2>& square, const std::string& name) {
  Image image(int(matrix.cols()), int(matrix.rows()));
  const double largest = matrix.cwiseAbs().maxCoeff();
  for (int i = 0; i < matrix.rows(); ++i)
    for (int j = 0; j < matrix.cols(); ++j)
      image.set(j, i, colors::diverging(0.5 + 0.5 * matrix(i, j) / largest));
  picture.canvas().image(image, square);
  const Vec<2> size = square.upper - square.lower;
  for (const int i : first) {
    const Vec<2> at = square.lower + size * i / double(matrix.rows());
    const Stroke line{.color = colors::gray, .width = 1};
    picture.canvas().line({at[0], square.lower[1]}, {at[0], square.upper[1]}, line);
    picture.canvas().line({square.lower[0], at[1]}, {square.upper[0], at[1]}, line);
  }
  read_matrix(picture, matrix, square, name);
}

void read_matrix(Picture& picture, const Eigen::MatrixXd& matrix, const Box<2>& rectangle,
                 const std::string& name) {
  picture.hover(rectangle, [=](const Vec<2>& pixel) {
    const Vec<2> share = (pixel - rectangle.lower).cwiseQuotient(rectangle.upper - rectangle.lower);
    const int i = std::min(int(share[1] * double(matrix.rows())), int(matrix.rows()) - 1),
              j = std::min(int(share[0] * double(matrix.cols())), int(matrix.cols()) - 1);
    return name + "(" + std::to_string(i + 1) + ", " + std::to_string(j + 1) +
           ") = " + rounded(matrix(i, j), 3);
  });
}

}  // namespace sem::tutorial
