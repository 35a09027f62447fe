#include "sem/draw/image.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

#include "sem/base/error.h"

namespace sem {
namespace {

void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(std::uint8_t(value >> shift));
}

/// CRC-32 of PNG (ISO 3309), bit by bit: for short chunks.
std::uint32_t crc32(const std::uint8_t* begin, const std::uint8_t* end) {
  std::uint32_t crc = 0xffffffffu;
  for (; begin != end; ++begin) {
    crc ^= *begin;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

/// A chunk of a PNG file: length, name, content, check sum.
void append_chunk(std::vector<std::uint8_t>& bytes, const char (&name)[5],
                  const std::vector<std::uint8_t>& content) {
  append_big_endian(bytes, std::uint32_t(content.size()));
  const std::size_t checked = bytes.size();
  bytes.insert(bytes.end(), name, name + 4);
  bytes.insert(bytes.end(), content.begin(), content.end());
  append_big_endian(bytes, crc32(bytes.data() + checked, bytes.data() + bytes.size()));
}

/// What stands between the header and the pixels.
std::vector<std::uint8_t> extra_chunks(const Image& image, double dots_per_inch) {
  const auto per_metre = std::uint32_t(std::lround(dots_per_inch / 0.0254));
  std::vector<std::uint8_t> chunks, size;
  append_big_endian(size, per_metre);
  append_big_endian(size, per_metre);
  size.push_back(1);  // the unit is the metre
  append_chunk(chunks, "pHYs", size);
  if (image.left_out) {
    std::vector<std::uint8_t> color;  // 16 bits a component
    for (const std::uint8_t part : *image.left_out) color.insert(color.end(), {0, part});
    append_chunk(chunks, "tRNS", color);
  }
  return chunks;
}

[[noreturn]] void cannot_write(const std::string& path, int error) {
  throw InputError(path, "", error ? std::strerror(error) : "a failed write",
                   "a file in a folder that exists, can be written and has space left");
}

}  // namespace

Image color_ramp(Color (*map)(double)) {
  Image ramp(1, 256);
  for (int row = 0; row < 256; ++row) ramp.set(0, row, map(1 - row / 255.0));
  return ramp;
}

void Image::set(int column, int row, const Color& color) {
  const double parts[] = {color.r, color.g, color.b};
  for (int i = 0; i < 3; ++i)
    pixel(column, row)[i] = std::uint8_t(std::lround(255 * std::clamp(parts[i], 0.0, 1.0)));
}

std::vector<std::uint8_t> encode_png(const Image& image, double dots_per_inch) {
  assert(image.width > 0 && image.height > 0 && dots_per_inch > 0);
  std::vector<std::uint8_t> png;
  const auto append = [](void* context, void* data, int size) {
    auto& all = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    all.insert(all.end(), bytes, bytes + size);
  };
  if (!stbi_write_png_to_func(append, &png, image.width, image.height, 3, image.rgb.data(), 0))
    throw std::bad_alloc();
  const auto extra = extra_chunks(image, dots_per_inch);
  constexpr int header_end = 8 + 25;  // signature and IHDR
  png.insert(png.begin() + header_end, extra.begin(), extra.end());
  return png;
}

void write_png(const std::string& path, const Image& image, double dots_per_inch) {
  const auto png = encode_png(image, dots_per_inch);
  const std::string temporary = path + ".part";
  errno = 0;
  std::ofstream file(temporary, std::ios::binary);
  if (!file) cannot_write(path, errno);
  file.write(reinterpret_cast<const char*>(png.data()), std::streamsize(png.size()));
  file.close();
  std::error_code error;
  if (file) {
    std::filesystem::rename(temporary, path, error);
    if (!error) return;
  }
  const int reason = error ? error.value() : errno;
  std::filesystem::remove(temporary, error);
  cannot_write(path, reason);
}

Image read_png(const std::string& path) {
  Image image;
  int n_channels = 0;
  std::uint8_t* const rgb = stbi_load(path.c_str(), &image.width, &image.height, &n_channels, 3);
  if (!rgb) throw InputError(path, "", stbi_failure_reason(), "a PNG file that can be read");
  image.rgb.assign(rgb, rgb + std::size_t(3) * image.width * image.height);
  stbi_image_free(rgb);
  return image;
}

Image shrunk(const Image& image, int n) {
  Image small((image.width + n - 1) / n, (image.height + n - 1) / n);
  for (int row = 0; row < small.height; ++row)
    for (int column = 0; column < small.width; ++column) {
      const int right = std::min((column + 1) * n, image.width),
                bottom = std::min((row + 1) * n, image.height);
      int sum[3] = {0, 0, 0};
      for (int y = row * n; y < bottom; ++y)
        for (int x = column * n; x < right; ++x)
          for (int i = 0; i < 3; ++i) sum[i] += image.pixel(x, y)[i];
      const int count = (right - column * n) * (bottom - row * n);
      for (int i = 0; i < 3; ++i)
        small.pixel(column, row)[i] = std::uint8_t((sum[i] + count / 2) / count);
    }
  return small;
}

}  // namespace sem
