#include "src2d/tutorials/plots.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/image.h"
#include "sem/lesson/numbers.h"
#include "src2d/tutorials/drawing.h"
#include "src2d/tutorials/matrices.h"

namespace sem::tutorial {

void draw_panel(Picture& picture, const Axis& x, const Axis& y,
                const std::function<void(Panel& panel)>& content,
                const std::optional<Box<2>>& rectangle) {
  picture.plot(rectangle.value_or(picture.part({0.02, 0.02}, {0.98, 0.98})), [&](Plot& plot) {
    Panel& panel = plot.panel();
    panel.x = x;
    panel.y = y;
    content(panel);
  });
}

Series line(const std::string& label, const Color& color, int dash) {
  static const std::vector<double> dashes[] = {{}, {6, 3}, {1.5, 2.5}};
  return {.label = label, .color = color, .width = 1.8, .dash = dashes[dash]};
}

void draw_columns(Picture& picture, const Axis& x, const Axis& y, const std::vector<double>& at,
                  const Eigen::MatrixXd& values, const std::vector<std::string>& names,
                  const std::optional<Box<2>>& rectangle) {
  draw_panel(
      picture, x, y,
      [&](Panel& panel) {
        for (int j = 0; j < values.cols(); ++j)
          panel.curve(at, column(values, j), line(names[j], part_color(j), j % 3));
      },
      rectangle);
}

Axis count_axis(const std::string& label, int n) {
  Axis axis{.label = label, .lower = -0.1, .upper = n + 0.1};
  for (int i = 0; i <= n; ++i) axis.ticks.emplace_back(i, std::to_string(i));
  return axis;
}

Trace spectrum(const std::string& label, const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd values = eigenvalues(matrix);
  Trace trace{label, {}, {}};
  for (int i = 0; i < values.size(); ++i) {
    trace.x.push_back(i + 1);
    trace.y.push_back(std::max(1e-18, std::abs(values[i]) / values.maxCoeff()));
  }
  return trace;
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
  draw_panel(picture, {.label = "step h", .logarithmic = true},
             {.label = "error", .logarithmic = true}, [&](Panel& panel) {
               for (std::size_t k = 0; k < checks.size(); ++k)
                 panel.curve(checks[k].second.h, checks[k].second.error,
                             line(checks[k].first, part_color(1 - int(k))));
             });
}

void draw_bars(Picture& picture, const std::string& y_label,
               const std::vector<std::pair<std::string, double>>& bars) {
  std::vector<double> at, height;
  for (const auto& [bar, value] : bars) at.push_back(double(at.size())), height.push_back(value);
  const double largest = *std::max_element(height.begin(), height.end());
  const Axis x{.lower = -0.8, .upper = double(bars.size()) - 0.2, .tick_labels = false};
  const Axis y{.label = y_label, .lower = 0, .upper = largest > 0 ? 1.1 * largest : 1};
  draw_panel(picture, x, y, [&](Panel& panel) {
    for (std::size_t k = 0; k < bars.size(); ++k)
      panel.note({at[k], height[k]}, bars[k].first, {.offset = {0, 6}});
    panel.bars(at, height, 0.4, blue);
  });
}

void draw_matrix(Picture& picture, const Eigen::MatrixXd& matrix, const std::vector<int>& first,
                 const Box<2>& square) {
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
}

}  // namespace sem::tutorial
