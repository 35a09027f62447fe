#include "sem/plot/plot.h"

#include <cassert>
#include <cmath>

#include "sem/draw/raster.h"
#include "sem/draw/svg.h"
#include "sem/plot/layout.h"

namespace sem {

Plot::Plot(double width, double height) : width_(width), height_(height) {
  assert(width > 0 && height > 0);
}

Panel& Plot::panel(int row, int column, int n_rows, int n_columns) {
  assert(row >= 0 && column >= 0 && n_rows > 0 && n_columns > 0);
  cells_.push_back({row, column, n_rows, n_columns, std::make_unique<Panel>()});
  return *cells_.back().panel;
}

void Plot::color_bar(const ColorScale& scale, const std::string& label) {
  bar_ = ColorBar{scale, label};
}

void Plot::draw(Canvas& canvas) const { PlotLayout(*this, canvas).draw(); }

Image plot_image(const Plot& plot, double dots_per_inch) {
  RasterCanvas canvas(int(std::lround(plot.width() * dots_per_inch)),
                      int(std::lround(plot.height() * dots_per_inch)));
  plot.draw(canvas);
  return canvas.finish();
}

std::string plot_svg(const Plot& plot, double dots_per_inch) {
  SvgCanvas canvas(int(std::lround(plot.width() * dots_per_inch)),
                   int(std::lround(plot.height() * dots_per_inch)), dots_per_inch);
  plot.draw(canvas);
  return canvas.finish();
}

}  // namespace sem
