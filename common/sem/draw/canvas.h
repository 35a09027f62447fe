#pragma once
// What a picture can be drawn on. Nothing here knows of a back end: RasterCanvas
// (raster.h) turns the calls into pixels, SvgCanvas (svg.h) into vectors.
//
// Coordinates and lengths are in output pixels, origin at the top left corner, x to the
// right and y down; pixel (i, j) covers [i, i + 1] x [j, j + 1]. Later calls cover earlier ones.

#include <span>
#include <string>
#include <vector>

#include "sem/base/dim.h"
#include "sem/draw/colors.h"

namespace sem {

struct Image;

/// A chain of straight segments, or the corners of a polygon, in pixels.
using Polyline = std::vector<Vec<2>>;

/// How a line is drawn. Corners above 60 degrees are mitred, sharper ones rounded.
struct Stroke {
  enum class Cap { butt, round };
  Color color = colors::black;
  double width = 1;
  bool closed = false;            ///< joins the last point to the first
  Cap cap = Cap::butt;            ///< of both ends, and of every dash
  std::vector<double> dash = {};  ///< lengths drawn, left out, drawn, ...; empty: solid
};

/// How a text is set: DejaVu Sans, `size` pixels to the em.
struct TextStyle {
  enum class Horizontal { left, center, right };
  enum class Vertical { top, middle, baseline, bottom };  ///< top and middle of a capital letter
  double size = 12;
  Color color = colors::black;
  Horizontal horizontal = Horizontal::left;
  Vertical vertical = Vertical::baseline;
  bool upward = false;  ///< turned by 90 degrees, reading from bottom to top
};

enum class MarkerShape { circle, square, diamond, triangle, plus, cross };

class Canvas {
 public:
  virtual ~Canvas() = default;

  /// Size of the picture in pixels.
  virtual double width() const = 0;
  virtual double height() const = 0;

  /// Fills the points that are inside an odd number of the loops (each closed implicitly):
  /// holes, self-crossing and touching loops are allowed. Loops with a coordinate that is not
  /// finite are left out.
  virtual void fill(std::span<const Polyline> loops, const Color& color) = 0;

  /// Draws a line through the points. Points that are not finite interrupt it; a single point
  /// is drawn only with round caps. Where the line crosses itself a transparent colour does not add
  /// up.
  virtual void stroke(std::span<const Vec<2>> points, const Stroke& style) = 0;

  /// Sets one line of UTF-8 text with its anchor at `position`: Latin, Greek, mathematical
  /// operators, arrows, super- and subscripts. The baseline is moved to the nearest whole pixel.
  virtual void text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) = 0;

  /// Width of the text in pixels at `size` pixels to the em.
  virtual double text_width(const std::string& utf8, double size) = 0;

  /// Stretches an image over the rectangle, its first row at the top; every value of the image is
  /// one sharp-edged cell (heat maps show their data, not an interpolation). Pixels of the colour
  /// `left_out` show what is below.
  virtual void image(const Image& image, const Box<2>& rectangle) = 0;

  /// Until the matching pop, nothing is drawn outside of the rectangle (rounded to whole pixels or
  /// finer), nor outside of the rectangles pushed before.
  virtual void push_clip(const Box<2>& rectangle) = 0;
  virtual void pop_clip() = 0;

  // In terms of the above.
  void fill(const Polyline& loop, const Color& color) { fill(std::span(&loop, 1), color); }
  void line(const Vec<2>& a, const Vec<2>& b, const Stroke& style);
  void fill_box(const Box<2>& box, const Color& color);
  void stroke_box(const Box<2>& box, Stroke style);
  /// `size` is the diameter of the circle; the other shapes look as large as it.
  void marker(const Vec<2>& position, MarkerShape shape, double size, const Color& color);
};

}  // namespace sem
