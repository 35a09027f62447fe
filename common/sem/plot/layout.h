#pragma once
// The panels of a plot on the page.

#include "sem/plot/panel_layout.h"
#include "sem/plot/plot.h"

namespace sem {

/// Boxes of all panels such that every label lies on the page and panels of a column or row line
/// up.
class PlotLayout {
 public:
  PlotLayout(const Plot& plot, Canvas& canvas);
  void draw();

 private:
  struct Track {  ///< a column or row of the grid
    double begin = 0, size = 0, before = 0, after = 0;
  };
  void arrange();
  void place_tracks(std::vector<Track>& tracks, const std::vector<double>& shares, double begin,
                    double end, double gap);
  void set_boxes();
  void collect_margins();
  std::vector<LegendEntry> shared_entries() const;

  const Plot& plot_;
  Canvas& canvas_;
  double point_;
  std::vector<PanelLayout> panels_;
  std::vector<Track> columns_, rows_;
  Box<2> page_;  ///< what remains for panels with their labels
};

}  // namespace sem
