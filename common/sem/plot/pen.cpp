#include "sem/plot/pen.h"

namespace sem {

Pen::Pen(Canvas& on, double pixels_per_point, const AxisScale& x, const AxisScale& y)
    : canvas(on), point(pixels_per_point), x_(x), y_(y) {}

Polyline Pen::map(const std::vector<Vec<2>>& data) const {
  Polyline pixels;
  pixels.reserve(data.size());
  for (const auto& at : data) pixels.push_back(map(at));
  return pixels;
}

Box<2> Pen::box() const {
  Box<2> box;
  box.include(Vec<2>(x_.begin, y_.begin));
  box.include(Vec<2>(x_.end, y_.end));
  return box;
}

Stroke Pen::stroke(const Color& color, double width, const std::vector<double>& dash) const {
  Stroke stroke{.color = color, .width = width * point, .dash = dash};
  for (double& length : stroke.dash) length *= point;
  return stroke;
}

TextStyle Pen::text(TextStyle::Horizontal horizontal, TextStyle::Vertical vertical,
                    const Color& color) const {
  return {
      .size = lettering * point, .color = color, .horizontal = horizontal, .vertical = vertical};
}

}  // namespace sem
