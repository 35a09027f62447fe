#include "figures/check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "sem/scene/files.h"

namespace sem::figures {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t most_bytes = 100000;
constexpr int short_table = 50;

bool is_measured(const std::string& column, const Figure& figure) {
  const auto& declared = figure.measured;
  return column.ends_with("_seconds") ||
         std::find(declared.begin(), declared.end(), column) != declared.end();
}

double rounded(double value) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.9g", value);
  return std::atof(digits);
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / double(values.size());
}

std::vector<double> row_of(const DataTable& table, int row) {
  std::vector<double> values;
  for (const auto& column : table.columns()) values.push_back(rounded(table[column][row]));
  return values;
}

/// The largest difference of two columns of one table, as a sentence; empty if it is tolerated.
std::string difference(const std::string& name, const std::vector<double>& expected,
                       const std::vector<double>& actual, double tolerance) {
  double scale = 0, worst = 0;
  int worst_row = -1, n_missing = 0;
  for (const double value : expected)
    if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  for (std::size_t row = 0; row < expected.size(); ++row) {
    n_missing += std::isfinite(expected[row]) != std::isfinite(actual[row]);
    const double d = std::abs(expected[row] - actual[row]);
    if (!(d > worst)) continue;
    worst = d;
    worst_row = int(row);
  }
  if (n_missing > 0)
    return name + ": " + std::to_string(n_missing) + " values are missing on one side";
  if (!(worst > tolerance * scale)) return "";
  return name + ": row " + std::to_string(worst_row) + " is " + number_text(actual[worst_row], 9) +
         ", stored " + number_text(expected[worst_row], 9);
}

/// The data with the stored values of measured columns, for a picture that can be compared.
Data with_stored_measures(const Data& data, const Data& stored, const Figure& figure) {
  Data result;
  for (const auto& [name, table] : data.tables()) {
    auto& copy = result.add(name, table.columns());
    const bool same_rows = stored.has(name) && stored[name].n_rows() == table.n_rows();
    for (int row = 0; row < table.n_rows(); ++row) {
      std::vector<double> values;
      for (const auto& column : table.columns()) {
        const bool replaced = same_rows && is_measured(column, figure);
        values.push_back((replaced ? stored[name] : table)[column][row]);
      }
      copy.add(values);
    }
  }
  return result;
}

Image difference_image(const Image& a, const Image& b) {
  Image result(std::max(a.width, b.width), std::max(a.height, b.height));
  std::fill(result.rgb.begin(), result.rgb.end(), 255);
  for (int row = 0; row < std::min(a.height, b.height); ++row)
    for (int column = 0; column < std::min(a.width, b.width); ++column)
      for (int i = 0; i < 3; ++i) {
        const int d = std::abs(int(a.pixel(column, row)[i]) - int(b.pixel(column, row)[i]));
        result.pixel(column, row)[i] = std::uint8_t(255 - std::min(255, 4 * d));
      }
  return result;
}

}  // namespace

Data thinned(const Data& data, int most_cells) {
  const auto n_kept = [&](int stride) {
    double cells = 0;
    for (const auto& [name, table] : data.tables()) {
      const int n = table.n_rows();
      cells += double(table.columns().size()) * (n > short_table ? (n + stride - 1) / stride : n);
    }
    return cells;
  };
  double shortest = 0;
  for (const auto& [name, table] : data.tables())
    if (table.n_rows() > short_table) shortest = std::max(shortest, double(table.n_rows()));
  int stride = 1;
  while (n_kept(stride) > most_cells && stride < shortest) ++stride;
  Data result;
  for (const auto& [name, table] : data.tables()) {
    const int step = table.n_rows() > short_table ? stride : 1;
    auto& kept = result.add(name, table.columns());
    for (int row = 0; row < table.n_rows(); row += step) kept.add(row_of(table, row));
    if (step == 1) continue;
    auto& means = result.add(name + " mean of " + std::to_string(table.n_rows()), table.columns());
    std::vector<double> values;
    for (const auto& column : table.columns()) values.push_back(rounded(mean(table[column])));
    means.add(values);
  }
  return result;
}

std::vector<std::string> compare_numbers(const Data& expected, const Data& actual,
                                         const Figure& figure, const Tolerance& tolerance) {
  std::vector<std::string> differences;
  for (const auto& [name, table] : actual.tables())
    if (table.n_rows() > 0 && !expected.has(name))
      differences.push_back("table '" + name + "' is not stored");
  for (const auto& [name, table] : expected.tables()) {
    if (!actual.has(name)) {
      differences.push_back("table '" + name + "' is gone");
      continue;
    }
    const DataTable& now = actual[name];
    if (now.n_rows() != table.n_rows() || now.columns() != table.columns()) {
      differences.push_back("table '" + name + "' has " + std::to_string(now.n_rows()) +
                            " rows and " + std::to_string(now.columns().size()) +
                            " columns, stored " + std::to_string(table.n_rows()) + " and " +
                            std::to_string(table.columns().size()) + ", or other names of columns");
      continue;
    }
    for (const auto& column : table.columns()) {
      if (is_measured(column, figure)) continue;
      const std::string text =
          difference(name + "." + column, table[column], now[column], tolerance.numbers);
      if (!text.empty()) differences.push_back(text);
    }
  }
  return differences;
}

std::vector<std::string> compare_pictures(const Image& expected, const Image& actual,
                                          const Tolerance& tolerance) {
  if (expected.width != actual.width || expected.height != actual.height)
    return {"the picture is " + std::to_string(actual.width) + " x " +
            std::to_string(actual.height) + ", stored " + std::to_string(expected.width) + " x " +
            std::to_string(expected.height)};
  constexpr int block = 8;
  double total = 0, worst = 0;
  for (int top = 0; top < expected.height; top += block)
    for (int left = 0; left < expected.width; left += block) {
      double sum = 0;
      for (int row = top; row < std::min(top + block, expected.height); ++row)
        for (int column = left; column < std::min(left + block, expected.width); ++column)
          for (int i = 0; i < 3; ++i)
            sum += std::abs(double(expected.pixel(column, row)[i]) - actual.pixel(column, row)[i]);
      total += sum;
      worst = std::max(worst, sum / (3 * block * block));
    }
  total /= double(expected.rgb.size());
  std::vector<std::string> differences;
  if (total > tolerance.mean)
    differences.push_back("the picture differs by " + number_text(total) + " of 255 on average");
  if (worst > tolerance.local)
    differences.push_back("the picture differs by " + number_text(worst) + " of 255 somewhere");
  return differences;
}

Image stored_picture(const Plot& plot) {
  Image image = shrunk(plot_image(plot, dots_per_inch), 4);
  while (encode_png(image).size() > most_bytes) image = shrunk(image, 2);
  return image;
}

Data stored_form(const Figure& figure, const Data& data) {
  return figure.slow ? thinned(data, std::numeric_limits<int>::max()) : thinned(data);
}

Data stored_numbers(const Figure& figure, const std::string& references) {
  const std::string path = references + "/" + figure.name + ".csv";
  return from_csv(read_file(path), path);
}

void update_reference(const Figure& figure, const Data& data, const std::string& references) {
  const std::string path = references + "/" + figure.name;
  const Data read = from_csv(to_csv(data), path + ".csv");
  write_file(path + ".csv", to_csv(stored_form(figure, read)));
  write_png(path + ".png", stored_picture(plot_of(figure, read)), dots_per_inch / 4);
}

std::vector<std::string> check_figure(const Figure& figure, const Data& data,
                                      const std::string& references, const std::string& folder) {
  const std::string path = references + "/" + figure.name, out = folder + "/" + figure.name;
  const Data stored = stored_numbers(figure, references);
  const Data read = from_csv(to_csv(data), "");  // as update_reference thinned it
  const Data actual = from_csv(to_csv(stored_form(figure, read)), "");
  auto differences = compare_numbers(stored, actual, figure);
  const Data drawn = with_stored_measures(read, stored, figure);
  const Image expected = read_png(path + ".png"), picture = stored_picture(plot_of(figure, drawn));
  const auto of_picture = compare_pictures(expected, picture);
  differences.insert(differences.end(), of_picture.begin(), of_picture.end());
  if (of_picture.empty()) {
    std::error_code ignored;
    for (const char* suffix : {"_expected.png", "_actual.png", "_difference.png"})
      fs::remove(out + suffix, ignored);
  } else {
    write_png(out + "_expected.png", expected, dots_per_inch / 4);
    write_png(out + "_actual.png", picture, dots_per_inch / 4);
    write_png(out + "_difference.png", difference_image(expected, picture), dots_per_inch / 4);
  }
  return differences;
}

}  // namespace sem::figures
