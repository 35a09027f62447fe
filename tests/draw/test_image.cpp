// PNG files: decoded by an independent reader, and never half-written.
#include <doctest/doctest.h>
#include <stb/stb_image.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "sem/base/error.h"
#include "sem/draw/frame_writer.h"
#include "sem/draw/image.h"

using namespace sem;
namespace fs = std::filesystem;

namespace {

Image gradient(int width, int height, int seed = 0) {
  Image image(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      for (int i = 0; i < 3; ++i)
        image.pixel(column, row)[i] = std::uint8_t(seed + 7 * column + 13 * row * (i + 1));
  return image;
}

/// Empty folder, removed at the end.
struct Folder {
  fs::path path;
  explicit Folder(const std::string& name)
      : path(fs::temp_directory_path() / ("sem_test_" + name)) {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  std::string file(const std::string& name) const { return (path / name).string(); }
  std::size_t n_files() const {
    return std::size_t(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

std::vector<std::uint8_t> decode(const std::string& path, int* width, int* height, int* channels) {
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> data(
      stbi_load(path.c_str(), width, height, channels, 0), &stbi_image_free);
  REQUIRE(data);
  return {data.get(), data.get() + std::size_t(*width) * *height * *channels};
}

}  // namespace

TEST_CASE("a PNG decodes to the same pixels, without alpha") {
  const Folder folder("png");
  const Image image = gradient(37, 21);
  write_png(folder.file("a.png"), image);
  int width = 0, height = 0, channels = 0;
  const auto decoded = decode(folder.file("a.png"), &width, &height, &channels);
  CHECK(width == 37);
  CHECK(height == 21);
  CHECK(channels == 3);
  CHECK(decoded == image.rgb);
  CHECK(folder.n_files() == 1);  // nothing temporary is left
}

TEST_CASE("a PNG states its resolution right after the header") {
  const auto png = encode_png(gradient(5, 4), 300);
  // 300 dpi = 11811 = 0x2e23 pixels a metre. The checksum is that of zlib.crc32 over type and data.
  const unsigned char expected[] = {0,    0, 0, 9,    'p',  'H', 'Y',  's',  0,    0,   0x2e,
                                    0x23, 0, 0, 0x2e, 0x23, 1,   0x78, 0xa5, 0x3f, 0x76};
  REQUIRE(png.size() > 33 + sizeof expected);
  CHECK(std::memcmp(png.data() + 33, expected, sizeof expected) == 0);
}

TEST_CASE("writing to a missing folder is an input error that names the file") {
  const Folder folder("missing");
  const std::string path = folder.file("no_such_folder/a.png");
  CHECK_THROWS_WITH_AS(write_png(path, gradient(4, 4)), doctest::Contains(path.c_str()),
                       InputError);
  CHECK(folder.n_files() == 0);
}

TEST_CASE("a failed write leaves no file behind") {
  const Folder folder("failed");
  // The name is taken by a folder that is not empty, so that the final renaming fails.
  fs::create_directories(folder.path / "a.png" / "inside");
  CHECK_THROWS_AS(write_png(folder.file("a.png"), gradient(4, 4)), InputError);
  CHECK(folder.n_files() == 1);
}

TEST_CASE("the frame writer writes every frame as given") {
  const Folder folder("frames");
  FrameWriter writer(1);
  for (int i = 0; i < 8; ++i)
    writer.write(folder.file(std::to_string(i) + ".png"), gradient(30, 20, i));
  writer.finish();
  CHECK(folder.n_files() == 8);
  for (int i = 0; i < 8; ++i) {
    int width = 0, height = 0, channels = 0;
    CHECK(decode(folder.file(std::to_string(i) + ".png"), &width, &height, &channels) ==
          gradient(30, 20, i).rgb);
  }
}

TEST_CASE("the frame writer writes what is queued before it is destroyed") {
  const Folder folder("destroyed");
  {
    FrameWriter writer;
    for (int i = 0; i < 2; ++i) writer.write(folder.file(std::to_string(i)), gradient(300, 200));
  }
  CHECK(folder.n_files() == 2);
}

TEST_CASE("the frame writer reports the error of its thread and never hangs") {
  const Folder folder("error");
  FrameWriter writer(1);
  const auto write_many = [&] {
    for (int i = 0; i < 5; ++i)
      writer.write(folder.file("missing/" + std::to_string(i)), gradient(4, 4));
    writer.finish();
  };
  CHECK_THROWS_AS(write_many(), InputError);
  CHECK_THROWS_AS(writer.finish(), InputError);
  CHECK(folder.n_files() == 0);
}
