#pragma once
// An image of 8-bit RGB pixels and its PNG file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sem/draw/colors.h"

namespace sem {

/// Row by row from the top, 3 bytes a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::optional<std::array<std::uint8_t, 3>> left_out = {};  ///< colour of pixels that show nothing

  Image() = default;
  Image(int n_columns, int n_rows)
      : width(n_columns), height(n_rows), rgb(3 * std::size_t(width) * height) {}

  std::uint8_t* pixel(int column, int row) { return &rgb[3 * (std::size_t(row) * width + column)]; }
  const std::uint8_t* pixel(int column, int row) const {
    return &rgb[3 * (std::size_t(row) * width + column)];
  }
  /// Stores the colour, without its opacity.
  void set(int column, int row, const Color& color);
};

/// A column of 256 pixels of a colour map, its largest value on top: for colour bars.
Image color_ramp(Color (*map)(double));
inline Image viridis_ramp() { return color_ramp(colors::viridis); }

/// The bytes of a PNG file (8-bit RGB) that states `dots_per_inch` in its pHYs chunk, and the
/// colour left out in its tRNS chunk.
std::vector<std::uint8_t> encode_png(const Image& image, double dots_per_inch = 96);

/// The picture in a PNG file, its opacity ignored. Throws InputError if it cannot be read.
Image read_png(const std::string& path);

/// Mean of each block of n x n pixels, rounded; blocks at the right and lower edge may be smaller.
Image shrunk(const Image& image, int n);

/// Writes the PNG under a temporary name in the same folder, then renames it: the file is whole or
/// absent. Throws InputError if it cannot be written.
void write_png(const std::string& path, const Image& image, double dots_per_inch = 96);

}  // namespace sem
