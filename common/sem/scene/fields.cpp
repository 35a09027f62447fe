#include "sem/scene/fields.h"

#include <algorithm>
#include <cmath>

#include "sem/scene/files.h"

namespace sem {

bool Range::contains(double value) const {
  return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
}

std::string Range::text() const {
  std::string text = "a number";
  const bool below = std::isfinite(lower), above = std::isfinite(upper);
  if (below) text += std::string(lower_open ? " > " : " >= ") + exact_text(lower);
  if (below && above) text += " and";
  if (above) text += std::string(upper_open ? " < " : " <= ") + exact_text(upper);
  return text;
}

namespace {

// Levenshtein distance.
size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitute = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row.back();
}

}  // namespace

std::string closest_name(const std::string& word, const std::vector<std::string>& names) {
  std::string best;
  size_t least = std::max<size_t>(2, word.size() / 2);
  for (const auto& name : names) {
    const size_t distance = edit_distance(word, name);
    if (distance < least) {
      least = distance;
      best = name;
    }
  }
  return best;
}

}  // namespace sem
