#pragma once
// Glyphs of DejaVu Sans at one size: metrics, and their picture for a texture.

#include <functional>
#include <memory>
#include <string>

#include "sem/draw/canvas.h"

struct ImFontAtlas;
struct ImFontGlyph;

namespace sem {

/// Height of a capital letter and depth of the letter p, in ems of DejaVu Sans.
constexpr double font_cap_height = 0.729, font_descent = 0.236;

/// Where the baseline of a text of the given width starts, in pixels of the canvas, for its anchor;
/// the baseline lies on a whole pixel.
Vec<2> text_origin(const Vec<2>& position, const TextStyle& style, double width);

class Font {
 public:
  /// `size` is the em in pixels of the texture. Throws InputError if the font file is missing.
  explicit Font(double size);
  ~Font();

  double size() const { return size_; }
  /// Sum of the advances in pixels of the texture.
  double width(const std::string& utf8) const;
  /// Calls visit(glyph, x) for each character, x being the advance of those before it.
  void for_each_glyph(const std::string& utf8,
                      const std::function<void(const ImFontGlyph&, double x)>& visit) const;
  /// Distance from the top of the glyphs' coordinates to the baseline.
  double ascent() const;
  /// One byte (coverage) a pixel.
  unsigned char* texture(int* width, int* height) const;

  unsigned texture_id = 0;  ///< of the canvas that uses the font

 private:
  double size_;
  std::unique_ptr<ImFontAtlas> atlas_;
};

}  // namespace sem
