#pragma once
// Where a panel's content has ink: for placing legends and labels off the data.

#include <vector>

#include "sem/draw/canvas.h"

namespace sem {

/// Marks the cells of a region that are drawn on. White areas remove marks. Clipping is ignored.
class InkCanvas : public Canvas {
 public:
  /// Cells of `cell` pixels over the region; `fonts` knows the widths of texts.
  InkCanvas(const Box<2>& region, double cell, Canvas& fonts);

  /// Number of marked cells that a rectangle touches. All that is outside of the region is free.
  int ink(const Box<2>& rectangle) const;
  void mark(const Box<2>& rectangle, bool inked = true);
  /// Bounding box of the texts drawn, also outside of the region.
  const Box<2>& texts() const { return texts_; }

  double width() const override { return fonts_.width(); }
  double height() const override { return fonts_.height(); }
  using Canvas::fill;
  void fill(std::span<const Polyline> loops, const Color& color) override;
  void stroke(std::span<const Vec<2>> points, const Stroke& style) override;
  void text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) override;
  double text_width(const std::string& utf8, double size) override {
    return fonts_.text_width(utf8, size);
  }
  void image(const Image& image, const Box<2>& rectangle) override;
  void push_clip(const Box<2>&) override {}
  void pop_clip() override {}

 private:
  struct Cells {
    int left, top, right, bottom;  ///< the last two not included
  };
  Cells cells_of(const Box<2>& rectangle) const;

  Box<2> region_, texts_;
  double cell_;
  int n_x_, n_y_;
  std::vector<char> marks_;
  Canvas& fonts_;
};

/// The rectangle that a text covers, from its highest to its lowest letters.
Box<2> text_box(Canvas& fonts, const Vec<2>& position, const std::string& utf8,
                const TextStyle& style);

}  // namespace sem
