#pragma once
// What a step of a lesson draws on: a canvas in pixels with a view of the plane on it.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sem/draw/canvas.h"
#include "sem/draw/view.h"

namespace sem {

class Plot;

/// A canvas and a view. The functions that take world positions draw through the view; canvas()
/// draws in pixels, e.g. plots. Widths, sizes and offsets are pixels always. Default sizes are
/// legible where a picture of 900 x 600 pixels is shown at 100 %.
///
/// Handles can be dragged where its *last* view is: a step that only uses canvas() (plots) has
/// none. The mouse reads what hover() was given, wherever that is.
class Picture {
 public:
  static constexpr double text_size = 17;  ///< em in pixels

  /// Draws on `area` of the canvas; `world` is the lesson's box, shown unless set_view is called.
  Picture(Canvas& canvas, const Box<2>& area, const Box<2>& world);

  Canvas& canvas() { return canvas_; }
  /// Pixels that the step may use: all but the title.
  const Box<2>& area() const { return area_; }
  /// A part of the area in shares of its width and height, e.g. part({0, 0}, {0.5, 1}) for the left
  /// half; `upper` is the lower right corner, as y runs down.
  Box<2> part(const Vec<2>& lower, const Vec<2>& upper) const;

  /// From now on the box `world` (y up) is shown in `rectangle` (pixels), as large as fits with the
  /// same scale in both directions. Without a rectangle: the whole area.
  void set_view(const Box<2>& world);
  void set_view(const Box<2>& world, const Box<2>& rectangle);
  const View2& view();
  /// Whether a view was used, the pixels it covers, and the world position under a pixel.
  bool has_view() const { return view_used_; }
  const Box<2>& view_area() const { return view_area_; }
  Vec<2> to_world(const Vec<2>& pixel) const;

  // In world coordinates. Points: 2 by n.
  void curve(const Points<2>& points, const Stroke& stroke);
  void line(const Vec<2>& a, const Vec<2>& b, const Stroke& stroke);
  void fill(const Points<2>& corners, const Color& color);
  void dots(const Points<2>& points, const Color& color, double size = 9,
            MarkerShape shape = MarkerShape::circle);
  void dot(const Vec<2>& point, const Color& color, double size = 9,
           MarkerShape shape = MarkerShape::circle);
  /// An arrow from `from` to from + vector (world units) with a head of fixed size in pixels.
  void arrow(const Vec<2>& from, const Vec<2>& vector, const Color& color, double width = 2);
  /// Text beside a point, `offset` pixels (x right, y down) from it, with a white halo.
  void label(const Vec<2>& point, const std::string& text, const Color& color = colors::black,
             const Vec<2>& offset = {9, -9}, double size = text_size);

  /// The same at a place in pixels.
  void label_at(const Vec<2>& pixel, const std::string& text, const Color& color = colors::black,
                const Vec<2>& offset = {9, -9}, double size = text_size);

  /// A box in the upper right corner (or another) of the area: lines of a mark and what it means.
  struct Entry {
    std::string text;
    Color color;
    std::optional<MarkerShape> marker = {};  ///< without: a line
    std::vector<double> dash = {};
  };
  enum class Corner { upper_left, upper_right, lower_left, lower_right };
  void legend(const std::vector<Entry>& entries, Corner corner = Corner::upper_right);
  /// A plot with axes (sem/plot/plot.h) in a rectangle in pixels: `describe` adds its panels. It is
  /// drawn at 144 dots per inch, so that its lettering is as large as that of the other functions.
  void plot(const Box<2>& rectangle, const std::function<void(Plot& plot)>& describe);

  // What the mouse reads: a short text, or "" for nothing. Of several the one given last that has
  // something to say counts; else, in the last view, it reads its coordinates. The functions
  // outlive the drawing: they own what they use, or use the variables of a step's compute.
  using TextAt = std::function<std::string(const Vec<2>& at)>;
  /// By world position, in the present view's area.
  void hover(const TextAt& text);
  /// By pixel, in a rectangle.
  void hover(const Box<2>& rectangle, TextAt text);
  /// By the column of `points` (world) that is nearest to the mouse, within 40 pixels.
  void hover(const Points<2>& points, std::function<std::string(int column)> text);
  std::string text_at(const Vec<2>& pixel) const;

  /// One line of text in pixels at the top of the area (row 0, 1, ...), left-aligned.
  void note(const std::string& text, int row = 0, const Color& color = colors::black);

 private:
  Canvas& canvas_;
  Box<2> area_, view_area_;
  View2 view_;
  bool view_used_ = false;
  std::vector<std::pair<Box<2>, TextAt>> texts_;
};

}  // namespace sem
