#pragma once
// Output files that are there whole or not at all.

#include <string>
#include <vector>

namespace sem {

/// Writes to a temporary name in the same folder (path.part), then renames: a reader
/// never sees half a file, and an old file survives a failure. Throws InputError.
void write_file(const std::string& path, const std::string& content);

/// The whole file. Throws InputError (field empty) if it cannot be read.
std::string read_file(const std::string& path);

/// Creates the folder and its parents and checks that files can be written
/// there. Throws InputError (field --out).
void make_folder(const std::string& path);

/// The shortest text that reads back as the same number.
std::string exact_text(double value);

/// A table of numbers with named columns, comma separated. A value that is not finite (the
/// stress at a probe where the body is inverted) is an empty cell: it is no number.
class Table {
 public:
  explicit Table(std::vector<std::string> columns);
  void add(const std::vector<double>& row);  ///< asserts that the sizes agree
  int size() const { return int(rows_.size()); }
  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<double>& row(int r) const { return rows_[r]; }
  std::string text() const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace sem
