#include "sem/lesson/numbers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

namespace sem {
namespace {

/// Number of characters (not bytes).
int n_characters(const std::string& utf8) {
  return int(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// Columns as wide as their widest cell; column 0 to the left if asked for.
std::string align(const std::vector<std::vector<std::string>>& rows, const std::string& indent,
                  bool first_left) {
  std::vector<int> widths(rows.empty() ? 0 : rows[0].size(), 0);
  for (const auto& row : rows) {
    assert(row.size() == widths.size());
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], n_characters(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = indent;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - n_characters(row[i]), ' ');
      const bool left = i == 0 && first_left;
      line += (i == 0 ? "" : "  ") + (left ? row[i] + blanks : blanks + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace

std::string rounded(double x, int digits, double scale) {
  assert(digits >= 1 && digits <= 12);
  if (std::isnan(x)) return "nan";
  if (std::abs(x) < 1e-13 * scale) return "0";
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, x * (1 + 1e-11));
  return text;
}

std::string error_text(double x, double bound) {
  if (std::abs(x) < bound) return "< " + rounded(bound, 2, 0);
  return rounded(std::abs(x), 2, 0);
}

std::string rounded(const Eigen::MatrixXd& matrix, int digits, const std::string& indent) {
  const double scale = matrix.size() == 0 ? 1 : matrix.cwiseAbs().maxCoeff();
  std::vector<std::vector<std::string>> rows(matrix.rows());
  for (int i = 0; i < matrix.rows(); ++i)
    for (int j = 0; j < matrix.cols(); ++j) rows[i].push_back(rounded(matrix(i, j), digits, scale));
  return align(rows, indent, false);
}

std::string table(const std::vector<std::string>& headings,
                  const std::vector<std::vector<std::string>>& rows, const std::string& indent) {
  std::vector<std::vector<std::string>> all{headings};
  all.insert(all.end(), rows.begin(), rows.end());
  return align(all, indent, true);
}

}  // namespace sem
