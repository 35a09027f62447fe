#pragma once
// Legends and colour bars: their size, their place, their drawing.

#include "sem/plot/ink.h"
#include "sem/plot/panel.h"

namespace sem {

/// Entries in columns, filled one after the other; sizes in pixels.
class Legend {
 public:
  /// As many columns as fit in `most_width`, at least one.
  Legend(std::vector<LegendEntry> entries, Canvas& canvas, double point, double most_width);

  Vec<2> size() const;
  /// The upper left corner in the box where the legend covers no ink, the nearest to a corner of
  /// the box; nothing if there is no such place.
  std::optional<Vec<2>> free_place(const InkCanvas& ink, const Box<2>& box) const;
  void draw(const Pen& pen, const Vec<2>& corner) const;

 private:
  double sample_width() const;
  void arrange(int n_columns, Canvas& canvas);
  std::vector<LegendEntry> entries_;
  double point_;
  int n_rows_ = 0;
  std::vector<double> column_widths_;
};

/// Width in pixels of a bar with ticks and label for a panel of the given height.
double color_bar_width(const ColorBar& bar, Canvas& canvas, double point, double height);
/// Draws it with its left edge at `left`, between the heights.
void draw_color_bar(const ColorBar& bar, Canvas& canvas, double point, double left, double top,
                    double bottom);

}  // namespace sem
