#include "sem/scene/files.h"

#include <cassert>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sem/base/error.h"

namespace sem {

namespace fs = std::filesystem;

void write_file(const std::string& path, const std::string& content) {
  const std::string temporary = path + ".part";
  std::error_code error;
  std::ofstream out(temporary, std::ios::binary);
  const bool opened = out.is_open();
  out.write(content.data(), std::streamsize(content.size()));
  out.close();
  if (!out) {
    if (opened) fs::remove(temporary, error);
    throw InputError(path, "", "a file that cannot be written", "a writable folder with room");
  }
  fs::rename(temporary, path, error);
  if (error) {
    fs::remove(temporary, error);
    throw InputError(path, "", "a file that cannot be replaced", "a writable file name");
  }
}

std::string read_file(const std::string& path) {
  std::error_code error;
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path, error))
    throw InputError(path, "", "no readable file", "the name of an existing file");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!fs::is_directory(path, error))
    throw InputError("", "--out", "'" + path + "', which is no folder and cannot be made one", "a writable folder");
  const fs::path probe = fs::path(path) / ".sem_write_test";
  std::ofstream out(probe);
  const bool writable = bool(out);
  out.close();
  fs::remove(probe, error);
  if (!writable) throw InputError("", "--out", "'" + path + "', which is not writable", "a writable folder");
}

std::string exact_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

Table::Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

void Table::add(const std::vector<double>& row) {
  assert(row.size() == columns_.size());
  rows_.push_back(row);
}

std::string Table::text() const {
  std::string out;
  for (size_t c = 0; c < columns_.size(); ++c) out += (c ? "," : "") + columns_[c];
  out += '\n';
  for (const auto& row : rows_) {
    for (size_t c = 0; c < row.size(); ++c) {
      if (c) out += ',';
      if (std::isfinite(row[c])) out += exact_text(row[c]);
    }
    out += '\n';
  }
  return out;
}

}  // namespace sem
