#pragma once
// A canvas of pixels: Dear ImGui draw lists, rendered off screen without a window or display.

#include <memory>

#include "sem/draw/canvas.h"
#include "sem/draw/image.h"

namespace sem {

/// Draws at `supersample` times the size in each direction and averages down. The same calls give
/// the same pixels, on any number of threads. One canvas serves any number of frames; it is
/// expensive to make and cheap to clear. A canvas may be used by one thread at a time, and canvases
/// of different threads must not draw at once (Dear ImGui has one current context).
class RasterCanvas : public Canvas {
 public:
  /// A white canvas. Throws InputError if the size is not in 1..8192 pixels or the supersampling
  /// not in 1..4, if the off-screen context cannot be created, or if the font DejaVu Sans is
  /// missing.
  RasterCanvas(int width, int height, int supersample = 2);
  ~RasterCanvas() override;

  /// Starts over: removes all that was drawn, and all clip rectangles.
  void clear(const Color& background = colors::white);
  /// The picture so far; more may be drawn on it.
  Image finish();

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
