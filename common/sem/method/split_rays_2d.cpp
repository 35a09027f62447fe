#include <algorithm>
#include <cmath>

#include "sem/method/critical_values.h"
#include "sem/method/ray_columns.h"
#include "sem/method/split_rays.h"

namespace sem {
namespace {

class RaySplitter {
 public:
  RaySplitter(const Component<2>& component, int axis, const Yardstick<2>& yardstick)
      : columns_(component, {axis, 1 - axis}),
        values_(critical_values(component.boundary, component.loops, axis, 1 - axis)),
        yardstick_(yardstick) {}

  std::vector<Cell<2>> cells() const {
    std::vector<Cell<2>> result;
    for (const auto& chain : columns_.chains(values_)) append_joined(chain, result);
    return result;
  }

 private:
  Cell<2> fit(const RayColumn& column, int n_most,
              const std::optional<Eigen::VectorXd>& reference = {}) const {
    return fit_cell<2>([columns = columns_, column](int n) { return columns.strands(column, n); },
                       yardstick_, n_most, reference);
  }

  RayColumn column_of(const RayBand& band) const {
    return {{band}, columns_.end_kind(band, false), columns_.end_kind(band, true)};
  }

  // A cell and what it is made of.
  struct FittedRayColumn {
    RayColumn column;
    Cell<2> cell;
  };

  // The columns first to last as one, if that needs fewer rays.
  std::optional<FittedRayColumn> joined(const std::vector<FittedRayColumn>& columns, size_t first,
                                        size_t last) const {
    RayColumn column{{}, columns[first].column.lower_end, columns[last].column.upper_end};
    int n_rays = -1;
    std::optional<Eigen::VectorXd> reference = Eigen::VectorXd::Zero(yardstick_.scale.size());
    for (size_t k = first; k <= last; ++k) {
      column.bands.insert(column.bands.end(), columns[k].column.bands.begin(),
                          columns[k].column.bands.end());
      n_rays += columns[k].cell.n_strands();
      if (!columns[k].cell.fitted) reference.reset();  // its own is not good enough
      if (reference) *reference += columns[k].cell.reference;
    }
    Cell<2> cell = fit(column, std::min(n_rays, 2 * most_strands), reference);
    if (!cell.fitted) return {};
    return FittedRayColumn{std::move(column), std::move(cell)};
  }

  // Appends the cells of a chain of bands: joined all in one or neighbour with neighbour where
  // that saves rays.
  void append_joined(const std::vector<RayBand>& chain, std::vector<Cell<2>>& cells) const {
    std::vector<FittedRayColumn> columns;
    for (const RayBand& band : chain) {
      const RayColumn column = column_of(band);
      columns.push_back({column, fit(column, most_strands)});
    }
    if (columns.size() > 1)
      if (auto all = joined(columns, 0, columns.size() - 1)) {
        columns.clear();
        columns.push_back(std::move(*all));
      }
    for (size_t k = 0; k + 1 < columns.size();) {
      if (auto both = joined(columns, k, k + 1)) {
        columns[k] = std::move(*both);
        columns.erase(columns.begin() + k + 1);
        if (k > 0) --k;
      } else {
        ++k;
      }
    }
    int budget = 60;
    for (auto& [column, cell] : columns) append_halved(column, std::move(cell), budget, cells);
  }

  // Appends the cell or, where it is not fitted, its halves, as long as the budget of halvings
  // lasts.
  void append_halved(const RayColumn& column, Cell<2> cell, int& budget,
                     std::vector<Cell<2>>& cells) const {
    const double lower = column.bands.front().lower, upper = column.bands.back().upper;
    if (cell.fitted || budget == 0 || upper - lower < 1e-13 * columns_.size()) {
      cells.push_back(std::move(cell));
      return;
    }
    --budget;
    const double middle = (lower + upper) / 2;
    RayColumn below{{}, column.lower_end, EndKind::smooth};
    RayColumn above{{}, EndKind::smooth, column.upper_end};
    for (RayBand band : column.bands) {
      if (band.lower < middle) {
        below.bands.push_back(band);
        below.bands.back().upper = std::min(band.upper, middle);
      }
      if (band.upper > middle) {
        above.bands.push_back(band);
        above.bands.back().lower = std::max(band.lower, middle);
      }
    }
    for (const RayColumn& half : {below, above})
      append_halved(half, fit(half, most_strands), budget, cells);
  }

  RayColumns<2> columns_;
  std::vector<double> values_;  // critical
  const Yardstick<2>& yardstick_;
};

}  // namespace

template <>
std::vector<Cell<2>> ray_cells<2>(const Component<2>& component, int axis,
                                  const Yardstick<2>& yardstick) {
  return RaySplitter(component, axis, yardstick).cells();
}

}  // namespace sem
