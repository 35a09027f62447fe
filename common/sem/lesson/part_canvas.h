#pragma once
// A rectangle of a canvas as a canvas of its own.

#include "sem/draw/canvas.h"

namespace sem {

/// Forwards to the other canvas, moved to the rectangle's upper left corner (rounded to whole
/// pixels) and cut off at its edges.
class PartCanvas : public Canvas {
 public:
  PartCanvas(Canvas& whole, const Box<2>& rectangle);
  ~PartCanvas() override;

  double width() const override { return size_[0]; }
  double height() const override { return size_[1]; }
  using Canvas::fill;
  void fill(std::span<const Polyline> loops, const Color& color) override;
  void stroke(std::span<const Vec<2>> points, const Stroke& style) override;
  void text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) override;
  double text_width(const std::string& utf8, double size) override;
  void image(const Image& image, const Box<2>& rectangle) override;
  void push_clip(const Box<2>& rectangle) override;
  void pop_clip() override;
  /// From this canvas to the whole one.
  Box<2> moved(const Box<2>& box) const { return {box.lower + origin_, box.upper + origin_}; }

 private:
  Polyline moved(std::span<const Vec<2>> points) const;

  Canvas& whole_;
  Vec<2> origin_, size_;
};

}  // namespace sem
