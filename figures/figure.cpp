#include "figures/figure.h"

#include <algorithm>
#include <cassert>

namespace sem::figures {

std::vector<double> Data::column(const std::string& name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  assert(at != columns.end());
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(row[at - columns.begin()]);
  return values;
}

Data Data::where(const std::string& name, double value) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  assert(at != columns.end());
  Data result{columns, {}};
  for (const auto& row : rows)
    if (row[at - columns.begin()] == value) result.rows.push_back(row);
  return result;
}

const std::vector<Figure>& all_figures() {
  static const std::vector<Figure> figures = {distance_weights(), raycast_quadrature(), quadrature_convergence()};
  return figures;
}

}  // namespace sem::figures
