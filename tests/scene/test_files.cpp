// Output files: whole or not at all, numbers to the last bit.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include "errors.h"
#include "folder.h"
#include "sem/scene/files.h"

using namespace sem;
namespace fs = std::filesystem;

TEST_CASE("write_file replaces a file and leaves no temporary one") {
  const test::Folder folder("files_replace");
  const std::string path = folder / "a.txt", text("with\0zero", 9);
  write_file(path, "old");
  write_file(path, text);
  CHECK(read_file(path) == text);
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
  write_file(path, "");
  CHECK(read_file(path).empty());
}

TEST_CASE("write_file that fails keeps the old file") {
  const test::Folder folder("files_fail");
  const std::string path = folder / "a.txt";
  write_file(path, "old");
  SUBCASE("the temporary file cannot be opened") {
    fs::create_directory(path + ".part");
    test::check_names(test::error_of([&] { write_file(path, "new"); }), path,
                      {"cannot be written", "allowed: "});
    CHECK(fs::exists(path + ".part"));  // it is not ours
  }
  SUBCASE("the disk is full") {
    if (!fs::exists("/dev/full")) return;
    fs::create_symlink("/dev/full", path + ".part");
    test::check_names(test::error_of([&] { write_file(path, "new"); }), path,
                      {"cannot be written"});
    CHECK(!fs::exists(fs::symlink_status(path + ".part")));
  }
  CHECK(read_file(path) == "old");
}

TEST_CASE("write_file onto a folder or into none is an InputError and leaves nothing") {
  const test::Folder folder("files_onto");
  fs::create_directory(folder / "sub");
  test::check_names(test::error_of([&] { write_file(folder / "sub", "x"); }), folder / "sub",
                    {"cannot be replaced"});
  CHECK(!fs::exists((folder / "sub") + ".part"));
  test::check_names(test::error_of([&] { write_file(folder / "no/a.txt", "x"); }),
                    folder / "no/a.txt", {"cannot be written"});
}

TEST_CASE("read_file of a folder or of nothing is an InputError") {
  const test::Folder folder("files_read");
  test::check_names(test::error_of([&] { read_file(folder.path()); }), folder.path(),
                    {"no readable file"});
  test::check_names(test::error_of([&] { read_file(folder / "none"); }), folder / "none",
                    {"no readable file"});
}

TEST_CASE("make_folder makes parents, and rejects what cannot be a folder to write in") {
  const test::Folder folder("files_make");
  make_folder(folder / "a/b/c");
  make_folder(folder / "a/b/c/");
  CHECK(fs::is_empty(folder / "a/b/c"));  // the probe is gone
  test::write(folder / "file", "x");
  for (const std::string& bad :
       {folder / "file", folder / "file/sub", std::string("/proc/sem/out"), std::string()}) {
    CAPTURE(bad);
    test::check_names(test::error_of([&] { make_folder(bad); }), "--out",
                      {"'" + bad + "'", "a writable folder"});
  }
  CHECK(test::content(folder / "file") == "x");
}

TEST_CASE("a table's numbers read back as the same bits") {
  std::mt19937_64 random(7);
  std::vector<double> values = {0.0,
                                -0.0,
                                0.1,
                                1.0 / 3,
                                5e-324,
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::min(),
                                -1e15,
                                123456789.0};
  while (values.size() < 2000) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) values.push_back(value);
  }
  Table table({"x", "y"});
  for (size_t i = 0; i < values.size(); ++i) table.add({values[i], double(i)});
  std::istringstream lines(table.text());
  std::string line;
  std::getline(lines, line);
  CHECK(line == "x,y");
  for (size_t i = 0; i < values.size(); ++i) {
    std::getline(lines, line);
    char* end = nullptr;
    const double value = std::strtod(line.c_str(), &end);
    CHECK(std::memcmp(&value, &values[i], sizeof value) == 0);
    CHECK(*end == ',');
    CHECK(std::strtod(end + 1, nullptr) == double(i));
  }
}

TEST_CASE("a value that is no number is an empty cell") {
  Table table({"a", "b", "c"});
  table.add({std::nan(""), 1, std::numeric_limits<double>::infinity()});
  CHECK(table.text() == "a,b,c\n,1,\n");
}
