#pragma once
// The numbers of a figure: named tables of named columns, in one CSV file.

#include <string>
#include <utility>
#include <vector>

namespace sem::figures {

/// Columns of numbers, as long as each other. A value that is not finite is an empty cell of the
/// file and reads back as not-a-number.
class DataTable {
 public:
  explicit DataTable(std::vector<std::string> columns = {});

  /// Appends a row; asserts that it has a value for every column.
  void add(const std::vector<double>& row);
  int n_rows() const { return columns_.empty() ? 0 : int(values_[0].size()); }
  const std::vector<std::string>& columns() const { return columns_; }

  /// A column by name. Throws InputError if there is none.
  const std::vector<double>& operator[](const std::string& column) const;
  /// The value of a column in one row: for tables of single values.
  double value(const std::string& column, int row = 0) const;
  /// The rows in which a column has a value, in order.
  DataTable where(const std::string& column, double value) const;
  /// The rows in runs of equal values of a column: curve by curve, part by part.
  std::vector<DataTable> runs(const std::string& column) const;

 private:
  friend class Data;
  std::vector<std::string> columns_;
  std::vector<std::vector<double>> values_;  // by column
};

/// The tables of a figure, in the order they were added.
class Data {
 public:
  /// A new table; the reference is valid until the next call. Asserts that the name is new, not
  /// empty and without comma.
  DataTable& add(const std::string& name, const std::vector<std::string>& columns);
  /// A table by name. Throws InputError if there is none.
  const DataTable& operator[](const std::string& name) const;
  bool has(const std::string& name) const;
  const std::vector<std::pair<std::string, DataTable>>& tables() const { return tables_; }

 private:
  std::vector<std::pair<std::string, DataTable>> tables_;
};

/// One CSV for all tables: the first column `table` names the row's table, the others are those of
/// all tables; a cell is empty where the table has no such column. Shortest numbers that read back
/// as the same bits.
std::string to_csv(const Data& data);

/// What to_csv wrote; every table has all columns of the file, not-a-number where cells are empty.
/// Throws InputError naming `file`, line and what was found.
Data from_csv(const std::string& text, const std::string& file);

}  // namespace sem::figures
