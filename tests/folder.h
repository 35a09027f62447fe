#pragma once
// A folder of a test's own, and files as text.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace sem::test {

/// Empty when made, removed when destroyed; inside the build tree.
class Folder {
 public:
  explicit Folder(const std::string& name) : path_(std::filesystem::path(SEM_TEST_OUTPUT) / name) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path() const { return path_.string(); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace sem::test
