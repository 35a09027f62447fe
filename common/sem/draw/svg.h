#pragma once
// A canvas of vectors: the same calls as an SVG text.

#include <memory>

#include "sem/draw/canvas.h"

namespace sem {

/// Writes an SVG 1.1 picture of width x height pixels at `dots_per_inch`: its size is in inches,
/// its coordinates are the pixels of canvas.h, to 1/100 of a pixel. The same calls give the same
/// bytes. Text stays text, in DejaVu Sans without kerning, with anchors and widths of the font's
/// own metrics, as on a RasterCanvas. Images are embedded as PNG. Dashed lines have bevelled
/// corners where others have rounded ones.
class SvgCanvas : public Canvas {
 public:
  /// Throws InputError if the font is missing. Asserts that width, height and dots are positive.
  SvgCanvas(int width, int height, double dots_per_inch = 300);
  ~SvgCanvas() override;

  /// The whole file so far.
  std::string finish() const;

  double width() const override;
  double height() const override;
  using Canvas::fill;
  void fill(std::span<const Polyline> loops, const Color& color) override;
  void stroke(std::span<const Vec<2>> points, const Stroke& style) override;
  void text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) override;
  double text_width(const std::string& utf8, double size) override;
  void image(const Image& image, const Box<2>& rectangle) override;
  void push_clip(const Box<2>& rectangle) override;
  void pop_clip() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sem
