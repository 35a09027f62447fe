#include "figures/data.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "sem/base/error.h"
#include "sem/scene/files.h"

namespace sem::figures {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::size_t index_of(const std::vector<std::string>& columns, const std::string& name) {
  const auto at = std::find(columns.begin(), columns.end(), name);
  if (at == columns.end()) throw InputError("", "column", "'" + name + "'", listed(columns));
  return std::size_t(at - columns.begin());
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

double number_of(const std::string& cell, const std::string& file, int line) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size())
    throw InputError(file, "line " + std::to_string(line), "'" + cell + "'", "a number");
  return value;
}

}  // namespace

DataTable::DataTable(std::vector<std::string> columns)
    : columns_(std::move(columns)), values_(columns_.size()) {}

void DataTable::add(const std::vector<double>& row) {
  assert(row.size() == columns_.size());
  for (std::size_t i = 0; i < row.size(); ++i) values_[i].push_back(row[i]);
}

const std::vector<double>& DataTable::operator[](const std::string& column) const {
  return values_[index_of(columns_, column)];
}

double DataTable::value(const std::string& column, int row) const {
  const auto& values = (*this)[column];
  if (row < 0 || row >= n_rows())
    throw InputError("", column, "no row " + std::to_string(row),
                     std::to_string(n_rows()) + " rows");
  return values[row];
}

DataTable DataTable::where(const std::string& column, double value) const {
  const auto& key = (*this)[column];
  DataTable result(columns_);
  for (int row = 0; row < n_rows(); ++row)
    if (key[row] == value)
      for (std::size_t i = 0; i < columns_.size(); ++i)
        result.values_[i].push_back(values_[i][row]);
  return result;
}

std::vector<DataTable> DataTable::runs(const std::string& column) const {
  const auto& key = (*this)[column];
  std::vector<DataTable> result;
  for (int row = 0; row < n_rows(); ++row) {
    if (row == 0 || key[row] != key[row - 1]) result.emplace_back(columns_);
    for (std::size_t i = 0; i < columns_.size(); ++i)
      result.back().values_[i].push_back(values_[i][row]);
  }
  return result;
}

DataTable& Data::add(const std::string& name, const std::vector<std::string>& columns) {
  assert(!name.empty() && name.find_first_of(",\n") == std::string::npos && !has(name));
  tables_.emplace_back(name, DataTable(columns));
  return tables_.back().second;
}

bool Data::has(const std::string& name) const {
  return std::any_of(tables_.begin(), tables_.end(),
                     [&](const auto& t) { return t.first == name; });
}

const DataTable& Data::operator[](const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& [known, table] : tables_) {
    if (known == name) return table;
    names.push_back(known);
  }
  throw InputError("", "table", "'" + name + "'", listed(names));
}

std::string to_csv(const Data& data) {
  std::vector<std::string> columns;
  for (const auto& [name, table] : data.tables())
    for (const auto& column : table.columns())
      if (std::find(columns.begin(), columns.end(), column) == columns.end())
        columns.push_back(column);
  std::string text = "table";
  for (const auto& column : columns) text += "," + column;
  text += "\n";
  for (const auto& [name, table] : data.tables()) {
    std::vector<const std::vector<double>*> values;
    for (const auto& column : columns) {
      const auto& own = table.columns();
      values.push_back(std::find(own.begin(), own.end(), column) == own.end() ? nullptr
                                                                              : &table[column]);
    }
    for (int row = 0; row < table.n_rows(); ++row) {
      text += name;
      for (const auto* column : values) {
        text += ",";
        if (column && std::isfinite((*column)[row])) text += exact_text((*column)[row]);
      }
      text += "\n";
    }
  }
  return text;
}

Data from_csv(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  std::vector<std::string> columns = cells_of(line);
  if (columns[0] != "table") throw InputError(file, "line 1", "'" + columns[0] + "'", "'table'");
  columns.erase(columns.begin());
  Data data;
  DataTable* table = nullptr;
  for (int number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != columns.size() + 1)
      throw InputError(file, "line " + std::to_string(number),
                       std::to_string(cells.size()) + " cells",
                       std::to_string(columns.size() + 1) + ", as many as columns");
    if (data.tables().empty() || data.tables().back().first != cells[0]) {
      if (cells[0].empty() || data.has(cells[0]))
        throw InputError(file, "line " + std::to_string(number), "table '" + cells[0] + "'",
                         "named tables, the rows of each in one piece");
      table = &data.add(cells[0], columns);
    }
    std::vector<double> row;
    for (std::size_t i = 1; i < cells.size(); ++i) row.push_back(number_of(cells[i], file, number));
    table->add(row);
  }
  return data;
}

}  // namespace sem::figures
