#pragma once
// One panel of a plot: axes and what is drawn between them, described before anything is drawn.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sem/plot/axis.h"
#include "sem/plot/field.h"
#include "sem/plot/pen.h"

namespace sem {

/// How a series of data looks; lengths in points. A label makes an entry of the legend.
struct Series {
  std::string label = {};
  Color color = colors::black;
  double width = 1.1;             ///< of the line; 0: no line
  std::vector<double> dash = {};  ///< lengths drawn, left out, ...; empty: solid
  std::optional<MarkerShape> marker = {};
  double marker_size = 4;
};

/// Series number i >= 0 of a plot: colour, marker and dash all tell it from the others.
Series series(int i, const std::string& label = {});

/// The points (x[i], y[i]).
std::vector<Vec<2>> zip(const std::vector<double>& x, const std::vector<double>& y);

/// How arrows look. `scale` is their length in points per unit of the vectors; 0: the longest of
/// them measures 24 points. With a key the legend shows an arrow of that value and `label`.
struct Arrows {
  std::string label = {};
  Color color = colors::black;
  double width = 0.8;
  double scale = 0;
  double key = 0;
};

/// Where a note stands: `offset` in points from the place it is about (x to the right, y up), its
/// anchor the side that faces that place. With a leader, a thin line joins both.
struct Note {
  Vec<2> offset = Vec<2>::Zero();
  Color color = colors::black;
  bool leader = false;
  double size = lettering;
};

/// What a legend shows of a series.
struct LegendEntry {
  Series style;
  bool box = false;         ///< a filled area
  double arrow_length = 0;  ///< points; 0: no arrow
};

/// A colour bar.
struct ColorBar {
  ColorScale scale;
  std::string label;
};

enum class LegendPlace {
  automatic,  ///< inside where it covers no data, else below
  below,
  right,
  none
};

/// An arrow between two pixels, its shaft `width` points wide.
void draw_arrow(const Pen& pen, const Vec<2>& from, const Vec<2>& to, const Color& color,
                double width);

/// A rectangle with axes. Positions are in units of the data; what leaves the box is cut off.
/// Content is drawn in the order of the calls; values that are not finite are left out.
class Panel {
 public:
  Axis x, y;
  std::string title = {};
  bool equal = false;  ///< one unit is as long in y as in x: drawings of bodies
  bool frame = true;   ///< false: neither box nor axes
  LegendPlace legend = LegendPlace::automatic;
  std::vector<std::string> lines_below = {};  ///< texts under the panel, e.g. its numbers

  // Lines and markers. All vectors of one call have the same length (asserted).
  void curve(const std::vector<double>& xs, const std::vector<double>& ys,
             const Series& style = {});
  void curve(const std::vector<Vec<2>>& points, const Series& style = {});
  /// Bars from y - error to y + error.
  void error_bars(const std::vector<double>& xs, const std::vector<double>& ys,
                  const std::vector<double>& error, const Series& style = {});
  /// Constant between edges; one value less than edges.
  void steps(const std::vector<double>& edges, const std::vector<double>& values,
             const Series& style = {});
  /// Bars of the width (in data) about xs, from 0 (or the lower limit of a logarithmic axis). Sets
  /// the lower limit of y to 0 if no bar is negative and none is given.
  void bars(const std::vector<double>& xs, const std::vector<double>& heights, double width,
            const Color& color, const std::string& label = {});
  /// Segments from[i] to[i].
  void segments(const std::vector<Vec<2>>& from, const std::vector<Vec<2>>& to,
                const Series& style = {});
  /// Segments coloured by value; `width` in points.
  void segments(const std::vector<Vec<2>>& from, const std::vector<Vec<2>>& to,
                const std::vector<double>& values, const ColorScale& scale, double width = 1.1);
  /// Markers coloured by value; `size` in points.
  void markers(const std::vector<Vec<2>>& at, const std::vector<double>& values,
               const ColorScale& scale, double size = 4, MarkerShape shape = MarkerShape::circle);

  // Areas and fields.
  /// Inside of the loops (even-odd: holes are allowed).
  void area(const std::vector<std::vector<Vec<2>>>& loops, const Color& color,
            const std::string& label = {});
  /// Between two curves over xs.
  void band(const std::vector<double>& xs, const std::vector<double>& lower,
            const std::vector<double>& upper, const Color& color, const std::string& label = {});
  /// Every finite cell as a sharp rectangle in its colour. Linear axes only (asserted on drawing).
  void heat_map(const CellGrid& grid, const ColorScale& scale);
  /// Paints everything outside of the loops white, e.g. the cells of a heat map that the boundary
  /// of a body cuts.
  void cut_outside(const std::vector<std::vector<Vec<2>>>& loops);
  void contours(const CellGrid& grid, const std::vector<double>& levels, const Series& style = {});
  /// Sparsity pattern or block structure: fills the cells (row, column), counted from 0 at the top
  /// left; sets the limits of both axes to the matrix. Larger matrices than about 600 rows are
  /// drawn coarser: a cell is filled if any of its entries is.
  void pattern(int n_rows, int n_columns, const std::vector<std::pair<int, int>>& entries,
               const Color& color = colors::okabe_ito[0]);
  /// Arrows from `at` along `vectors`.
  void quiver(const std::vector<Vec<2>>& at, const std::vector<Vec<2>>& vectors,
              const Arrows& style = {});
  /// A bar of the scale with ticks and label, right of the panel.
  void color_bar(const ColorScale& scale, const std::string& label);

  // Notes.
  /// One text at a place; see Note.
  void note(const Vec<2>& at, const std::string& text, const Note& style = {});
  /// A named disc, e.g. a node of a network; `size` is its diameter in points.
  void node(const Vec<2>& at, const std::string& text, double size, const Color& fill,
            const Color& text_color = colors::black);
  /// A line across the panel at the value, e.g. a truth; its text stands on it at the end that is
  /// freer.
  void horizontal(double value, const std::string& text,
                  const Series& style = {.width = 0.8, .dash = {4, 2}});
  void vertical(double value, const std::string& text,
                const Series& style = {.width = 0.8, .dash = {4, 2}});
  /// A reference triangle from (x0, y0) to x1 with hypotenuse y ~ x^power, its power beside it.
  /// Both axes logarithmic (asserted on drawing).
  void slope(double power, double x0, double x1, double y0);

  // Anything else.
  /// Calls `content` when the panel is drawn; `include` first what it covers.
  void draw(std::function<void(const Pen&)> content);
  /// Extends the automatic limits to a point; it need not be finite.
  void include(const Vec<2>& point);
  /// An entry of the legend without content of its own.
  void legend_entry(const Series& style);

 private:
  friend class PanelLayout;
  struct Reference {  ///< the text of a horizontal or vertical line
    double value;
    bool vertical;
    std::string text;
    Color color;
  };
  std::vector<std::function<void(const Pen&)>> content_;
  std::vector<std::function<void(const Pen&)>>
      unclipped_;  ///< notes: drawn last, may leave the box
  std::vector<Reference> references_;
  std::vector<LegendEntry> entries_;
  std::optional<ColorBar> bar_;
  DataRange x_range_, y_range_;
  bool tight_ = false;   ///< automatic limits without margin
  double overhang_ = 1;  ///< points by which markers at the limits reach over them
};

}  // namespace sem
