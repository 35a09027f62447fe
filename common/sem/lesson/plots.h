#pragma once
// What tutorials draw in any dimension. Plots with axes (sem/plot) in a part of a picture: curves,
// charts, errors of finite differences, bars, and matrices as coloured cells; colours, readings.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sem/lesson/picture.h"
#include "sem/plot/plot.h"

namespace sem::tutorial {

inline const Color blue = colors::categorical(0), red = colors::categorical(1),
                   green = colors::categorical(2);
/// A = blue, B = red, C = green, ...
Color part_color(int part);

/// "1, 0.5, 0" of a vector's entries, each rounded().
std::string list(const Eigen::VectorXd& v, int digits = 4);
/// "time = 0.5 s" from "time, s" and 0.5.
std::string reading(const std::string& label, double value);

/// A bar of viridis from 0 to 1 between two texts at a place in pixels, else in the upper left.
void color_bar(Picture& picture, const std::string& lower, const std::string& upper,
               const std::optional<Vec<2>>& place = {});

/// Values over their own x, and what they are called.
struct Trace {
  std::string label;
  std::vector<double> x, y;
};

/// A plot of one panel on all of the picture, or in a part of it. The mouse reads the points of
/// `curves`, which `content` draws.
void draw_panel(Picture& picture, const Axis& x, const Axis& y,
                const std::function<void(Panel& panel)>& content,
                const std::vector<Trace>& curves = {}, const std::optional<Box<2>>& rectangle = {});
/// Lets the mouse read the nearest point (or the one nearest in x) of several curves of a panel of
/// Picture::plot(rectangle).
void read_curves(Picture& picture, const Box<2>& rectangle, Panel& panel,
                 const std::vector<Trace>& curves, bool along_x = false);
/// A line of a plot; dash 0: solid, 1, 2: others.
Series line(const std::string& label, const Color& color, int dash = 0);
/// A column of a matrix, for plots.
inline std::vector<double> column(const Eigen::MatrixXd& m, int j) {
  return {m.col(j).begin(), m.col(j).end()};
}

/// The columns of a matrix over `at`, with their names, in numbered colours and dashes; a vertical
/// line at `now`.
void draw_columns(Picture& picture, const Axis& x, const Axis& y, const std::vector<double>& at,
                  const Eigen::MatrixXd& values, const std::vector<std::string>& names,
                  const std::optional<Box<2>>& rectangle = {},
                  const std::optional<double>& now = {});

/// An axis of counts from 0 to n, with a tick each.
Axis count_axis(const std::string& label, int n);

/// A panel with axes: traces in numbered colours, with markers if they have fewer than 12 points.
/// Without any labels there is no legend.
struct Chart {
  Axis x, y;
  std::vector<Trace> traces;
  std::optional<double> now = {};  ///< marked on the x axis
};
/// Draws charts side by side, lettering of 16 pixels. Charts with the same labels share a legend.
void draw_charts(Picture& picture, const std::vector<Chart>& charts);
void draw_charts(Picture& picture, const std::vector<Chart>& charts, const Box<2>& rectangle);

/// Central differences (f(x + h e_k) - f(x - h e_k)) / 2h for all unit vectors e_k and steps h from
/// 0.1 down to 1e-11, against the derivative: as many rows as f, as many columns as x.
struct Check {
  std::vector<double> h, error;  ///< error: norm of the difference
  using Function = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;
  Check(const Function& f, const Eigen::VectorXd& x, const Eigen::MatrixXd& derivative);
  double order() const;  ///< of the error from h = 1e-2 to 1e-3
  double least() const;
};
/// "order 2, least error < 1e-07".
std::string text(const Check& check);
/// Their errors against h on logarithmic axes.
void draw_errors(Picture& picture, const std::vector<std::pair<std::string, Check>>& checks);

/// Bars with their names on them.
void draw_bars(Picture& picture, const std::string& y_label,
               const std::vector<std::pair<std::string, double>>& bars);

/// Lets the mouse read "NAME(row, column) = entry" of a matrix that fills a rectangle.
void read_matrix(Picture& picture, const Eigen::MatrixXd& matrix, const Box<2>& rectangle,
                 const std::string& name);
/// A matrix as coloured cells in a square, white = 0, red > 0, blue < 0, with lines before the rows
/// and columns `first` (where parts begin).
void draw_matrix(Picture& picture, const Eigen::MatrixXd& matrix, const std::vector<int>& first,
                 const Box<2>& square, const std::string& name);

}  // namespace sem::tutorial
