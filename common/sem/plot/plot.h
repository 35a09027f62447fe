#pragma once
// A plot for print: panels on a grid, in inches, laid out so that nothing is clipped.
//
//   Plot plot(3.3, 2.6);
//   Panel& panel = plot.panel();
//   panel.x = {.label = "number of rays", .logarithmic = true};
//   panel.y = {.label = "relative error", .logarithmic = true};
//   panel.curve(n, midpoint, series(0, "midpoints"));
//   panel.curve(n, gauss, series(1, "Gauss"));
//   panel.slope(-3, 100, 400, 1e-6);
//   write_png("error.png", plot_image(plot), 300);
//   write_file("error.svg", plot_svg(plot));

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sem/draw/image.h"
#include "sem/plot/panel.h"

namespace sem {

/// Panels in rows and columns on a white page. All panels of a column (row) have the same left and
/// right (upper and lower) edges unless they are `equal`; the margins between them follow from
/// their labels. Lettering is 8 pt.
class Plot {
 public:
  /// Size in inches; journals' columns are 3.3 or 7 wide.
  Plot(double width, double height);

  /// A new panel that covers cells of the grid; rows count from the top. References stay valid.
  Panel& panel(int row = 0, int column = 0, int n_rows = 1, int n_columns = 1);

  std::vector<double> row_shares = {}, column_shares = {};  ///< relative sizes; missing ones are 1
  std::vector<std::string> row_titles = {}, column_titles = {};
  bool letters = false;  ///< (a), (b), ... at the upper left corner of each panel
  /// One legend below all panels in place of one in each; equal labels appear once.
  bool shared_legend = false;
  /// A colour bar right of all panels.
  void color_bar(const ColorScale& scale, const std::string& label);

  double width() const { return width_; }
  double height() const { return height_; }
  /// Draws on a canvas of the plot's proportions; its pixels per inch follow from its width.
  void draw(Canvas& canvas) const;

 private:
  friend class PlotLayout;
  struct Cell {
    int row, column, n_rows, n_columns;
    std::unique_ptr<Panel> panel;
  };
  double width_, height_;
  std::vector<Cell> cells_;
  std::optional<ColorBar> bar_;
};

/// The plot as pixels and as SVG, of the same size. Throw InputError as RasterCanvas and SvgCanvas
/// do.
Image plot_image(const Plot& plot, double dots_per_inch = 300);
std::string plot_svg(const Plot& plot, double dots_per_inch = 300);

}  // namespace sem
