#pragma once
// A panel of a figure: a rectangle with axes that maps data to pixels.

#include <optional>

#include "figures/figure.h"

namespace sem::figures {

struct Axis {
  std::string label;
  double lower, upper;
  bool logarithmic = false;
};

class Panel {
 public:
  /// `area`: the plot itself in pixels, labels outside of it. Draws frame, ticks and labels.
  Panel(Canvas& canvas, const Box<2>& area, const Axis& x, const Axis& y,
        const std::string& title = "");

  Vec<2> map(double x, double y) const;
  const Box<2>& area() const { return area_; }
  /// A line through the data with markers; what leaves the plot is cut off.
  void curve(const std::vector<double>& x, const std::vector<double>& y, const Color& color,
             MarkerShape marker, const std::vector<double>& dash = {}) const;
  /// A reference triangle (log-log): y ~ x^power from (x0, y0) to x1, its text right of it.
  void slope(double x0, double x1, double y0, double power, const std::string& text) const;
  /// A legend entry; `row` counts from the lower left corner up.
  void legend(int row, const std::string& text, const Color& color, MarkerShape marker,
              const std::vector<double>& dash = {}) const;

 private:
  double fraction(const Axis& axis, double value) const;
  void draw_axis(const Axis& axis, bool horizontal) const;

  Canvas& canvas_;
  Box<2> area_;
  Axis x_, y_;
};

/// A title above a picture without axes.
void panel_title(Canvas& canvas, const Box<2>& area, const std::string& title);

/// A vertical colour bar of viridis with its ends and label.
void color_bar(Canvas& canvas, const Box<2>& bar, double lower, double upper,
               const std::string& label);

}  // namespace sem::figures
