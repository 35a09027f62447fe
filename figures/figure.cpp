#include "figures/figure.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <sstream>

#include "sem/base/error.h"
#include "sem/draw/raster.h"
#include "sem/scene/files.h"

namespace sem::figures {
namespace {

std::size_t index_of(const std::vector<std::string>& columns, const std::string& name) {
  const auto at = std::find(columns.begin(), columns.end(), name);
  assert(at != columns.end());
  return std::size_t(at - columns.begin());
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) result.push_back(cell);
  return result;
}

}  // namespace

std::vector<double> Data::column(const std::string& name) const {
  const std::size_t at = index_of(columns, name);
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(row[at]);
  return values;
}

Data Data::where(const std::string& name, double value) const {
  const std::size_t at = index_of(columns, name);
  Data result{columns, {}};
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(result.rows),
               [&](const auto& row) { return row[at] == value; });
  return result;
}

std::string to_csv(const Data& data) {
  Table table(data.columns);
  for (const auto& row : data.rows) table.add(row);
  return table.text();
}

Data from_csv(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  Data data{cells(line), {}};
  for (int number = 2; std::getline(in, line); ++number) {
    auto& row = data.rows.emplace_back();
    for (const auto& cell : cells(line)) {
      double value = 0;
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (error != std::errc() || end != cell.data() + cell.size())
        throw InputError(file, "line " + std::to_string(number), "'" + cell + "'", "a number");
      row.push_back(value);
    }
    if (row.size() != data.columns.size())
      throw InputError(file, "line " + std::to_string(number),
                       std::to_string(row.size()) + " values",
                       std::to_string(data.columns.size()) + ", as many as columns");
  }
  return data;
}

const std::vector<Figure>& all_figures() {
  static const std::vector<Figure> figures = {distance_construction(), distance_weights(),
                                              raycast_quadrature(), quadrature_convergence()};
  return figures;
}

void make_figure(const Figure& figure, const std::string& folder) {
  const std::string csv = folder + "/" + figure.name + ".csv";
  write_file(csv, to_csv(figure.compute()));
  const auto pixels = [](double inches) { return int(std::lround(inches * dots_per_inch)); };
  RasterCanvas canvas(pixels(figure.width), pixels(figure.height));
  figure.draw(canvas, from_csv(read_file(csv), csv));
  write_png(folder + "/" + figure.name + ".png", canvas.finish(), dots_per_inch);
}

}  // namespace sem::figures
