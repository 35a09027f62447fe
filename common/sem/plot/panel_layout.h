#pragma once
// One panel on the canvas: its ticks, the margins that its labels need, its drawing.

#include "sem/plot/legend.h"
#include "sem/plot/panel.h"

namespace sem {

/// Widths in pixels around a panel's box.
struct Margins {
  double left = 0, right = 0, top = 0, bottom = 0;
};

class PanelLayout {
 public:
  /// `letter` is empty or "(a)"; `place` where the legend is tried first.
  PanelLayout(const Panel& panel, Canvas& canvas, double point, const std::string& letter,
              LegendPlace place);

  /// The box that the panel may take; one with equal scales takes the largest part in the middle.
  void set_box(const Box<2>& box);
  const Box<2>& box() const { return box_; }
  Margins margins() const;
  /// Moves an automatic legend below if it would cover data. True if it was moved.
  bool move_legend();
  /// `outer`: what the margins leave of the page, for the letter's place.
  void draw(double letter_left) const;
  const std::vector<LegendEntry>& entries() const { return panel_.entries_; }

 private:
  Pen pen_on(Canvas& canvas) const;
  Ticks ticks(const Axis& axis, const AxisScale& scale, bool horizontal) const;
  double widest(const Ticks& ticks) const;
  Box<2> clip_box() const;
  Legend legend(double most_width) const;
  Margins axis_margins() const;
  void draw_axes() const;
  void draw_axis(const Axis& axis, const AxisScale& scale, const Ticks& ticks,
                 bool horizontal) const;
  void draw_references(const Pen& pen, InkCanvas& ink) const;
  void draw_legend(const Pen& pen, const InkCanvas& ink) const;
  void draw_lines_below(const Pen& pen) const;
  InkCanvas ink() const;

  const Panel& panel_;
  Canvas& canvas_;
  double point_;
  std::string letter_;
  LegendPlace place_;
  Box<2> box_;
  AxisScale x_, y_;
  Ticks x_ticks_, y_ticks_;
};

}  // namespace sem
