#pragma once
// A canvas that remembers what was drawn on it.

#include <stdexcept>
#include <string>
#include <vector>

#include "sem/draw/image.h"
#include "sem/draw/svg.h"
#include "sem/plot/ink.h"

namespace sem::test {

/// Knows the widths of texts.
inline Canvas& fonts() {
  static SvgCanvas canvas(1, 1);
  return canvas;
}

class RecordingCanvas : public Canvas {
 public:
  struct Text {
    Box<2> box;
    std::string utf8;
    TextStyle style;
  };
  struct Line {
    Polyline points;
    Stroke style;
    bool clipped;
  };
  struct Picture {
    Image image;
    Box<2> rectangle;
  };

  RecordingCanvas(double width, double height) : width_(width), height_(height) {}

  double width() const override { return width_; }
  double height() const override { return height_; }
  using Canvas::fill;
  void fill(std::span<const Polyline> loops, const Color&) override {
    for (const auto& loop : loops) fills.push_back(loop);
  }
  void stroke(std::span<const Vec<2>> points, const Stroke& style) override {
    lines.push_back({Polyline(points.begin(), points.end()), style, !clips_.empty()});
  }
  void text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) override {
    if (!utf8.empty()) texts.push_back({text_box(fonts(), position, utf8, style), utf8, style});
  }
  double text_width(const std::string& utf8, double size) override {
    return fonts().text_width(utf8, size);
  }
  void image(const Image& image, const Box<2>& rectangle) override {
    images.push_back({image, rectangle});
  }
  void push_clip(const Box<2>& box) override {
    clips_.push_back(box);
    clips.push_back(box);
  }
  void pop_clip() override { clips_.pop_back(); }

  bool has(const std::string& utf8) const { return count(utf8) > 0; }
  int count(const std::string& utf8) const {
    int n = 0;
    for (const auto& text : texts) n += text.utf8 == utf8;
    return n;
  }
  const Text& find(const std::string& utf8) const {
    for (const auto& text : texts)
      if (text.utf8 == utf8) return text;
    throw std::runtime_error("no text " + utf8);
  }

  std::vector<Text> texts;
  std::vector<Line> lines;
  std::vector<Polyline> fills;
  std::vector<Picture> images;
  std::vector<Box<2>> clips;  ///< of the panels, in order

 private:
  double width_, height_;
  std::vector<Box<2>> clips_;
};

inline bool overlap(const Box<2>& a, const Box<2>& b) {
  return (a.lower.array() < b.upper.array()).all() && (b.lower.array() < a.upper.array()).all();
}

}  // namespace sem::test
