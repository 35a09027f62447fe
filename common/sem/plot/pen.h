#pragma once
// What the content of a panel is drawn with.

#include "sem/draw/canvas.h"
#include "sem/plot/axis.h"

namespace sem {

/// Lettering of all figures, in points (1/72 inch) at the final size.
constexpr double lettering = 8;

/// A canvas with the panel's axes. Positions are data, lengths of lines, markers and texts are
/// points (1/72 inch) at the final size.
class Pen {
 public:
  Pen(Canvas& on, double pixels_per_point, const AxisScale& x, const AxisScale& y);

  Canvas& canvas;      ///< in pixels
  const double point;  ///< pixels

  Vec<2> map(const Vec<2>& data) const { return {x_(data[0]), y_(data[1])}; }
  Polyline map(const std::vector<Vec<2>>& data) const;
  /// The panel's box in pixels.
  Box<2> box() const;
  /// A style in points as one in pixels.
  Stroke stroke(const Color& color, double width, const std::vector<double>& dash = {}) const;
  /// Lettering, centred unless said otherwise.
  TextStyle text(TextStyle::Horizontal horizontal = TextStyle::Horizontal::center,
                 TextStyle::Vertical vertical = TextStyle::Vertical::middle,
                 const Color& color = colors::black) const;

 private:
  AxisScale x_, y_;
};

}  // namespace sem
