#include <algorithm>
#include <cmath>

#include "sem/method/critical_values.h"
#include "sem/method/rays.h"
#include "sem/method/split_rays.h"

namespace sem {
namespace {

// Interval number `interval` of all rays between two transverse coordinates, on which there are
// n_intervals.
struct RayBand {
  double lower, upper;
  int interval, n_intervals;
};

// Bands one above the other whose intervals continue each other.
struct RayColumn {
  std::vector<RayBand> bands;
  EndKind lower_end, upper_end;
};

class RaySplitter {
 public:
  RaySplitter(const Component<2>& component, int axis, const Yardstick<2>& yardstick)
      : component_(component),
        axis_(axis),
        yardstick_(yardstick),
        size_(component.boundary.box.diagonal()) {}

  std::vector<Cell<2>> cells() const {
    std::vector<Cell<2>> result;
    for (const auto& column : continued_bands()) append_joined(column, result);
    return result;
  }

 private:
  std::vector<Ray<2>> cast_at(const std::vector<double>& transverse) const {
    Rays<2> rays;
    rays.axis = axis_;
    for (const double y : transverse) {
      Ray<2>& ray = rays.rays.emplace_back();
      ray.origin = Vec<2>::Zero();
      ray.origin[1 - axis_] = y;
      ray.weight = 1;
    }
    cast(component_.boundary, component_.loops, rays);
    return std::move(rays.rays);
  }

  int n_intervals_at(double y) const { return int(cast_at({y})[0].intervals.size()); }

  // The critical values, and what else changes the number of intervals (gaps' caps, rounding).
  std::vector<double> band_ends() const {
    const auto values = critical_values(component_.boundary, component_.loops, axis_, 1 - axis_);
    std::vector<double> ends = values;
    constexpr int n_samples = 6;
    for (size_t k = 0; k + 1 < values.size(); ++k) {
      const auto y = [&](int i) {
        return values[k] + (values[k + 1] - values[k]) * (i + 0.5) / n_samples;
      };
      for (int i = 0; i + 1 < n_samples; ++i) {
        double a = y(i), b = y(i + 1);
        const int before = n_intervals_at(a);
        if (n_intervals_at(b) == before) continue;
        while (b - a > 1e-15 * size_ && a < (a + b) / 2 && (a + b) / 2 < b)
          (n_intervals_at((a + b) / 2) == before ? a : b) = (a + b) / 2;
        ends.push_back((a + b) / 2);
      }
    }
    std::sort(ends.begin(), ends.end());
    return ends;
  }

  // Chains of bands, from below, whose intervals meet.
  std::vector<std::vector<RayBand>> continued_bands() const {
    const auto values = band_ends();
    std::vector<std::vector<RayBand>> done, open;
    std::vector<RayInterval> open_ends;  // of the last band of each open chain, where it ends
    for (size_t k = 0; k + 1 < values.size(); ++k) {
      const double lower = values[k], upper = values[k + 1], inside = 1e-9 * (upper - lower);
      const auto rays = cast_at({(lower + upper) / 2, lower + inside, upper - inside});
      const int n = int(rays[0].intervals.size());
      std::vector<std::vector<RayBand>> chains;
      std::vector<RayInterval> ends;
      const bool steady = int(rays[1].intervals.size()) == n && int(rays[2].intervals.size()) == n;
      for (int i = 0; i < n; ++i) {
        chains.push_back({{lower, upper, i, n}});
        if (steady)
          for (size_t o = 0; o < open.size(); ++o)
            if (!open[o].empty() && continues(open_ends[o], rays[1].intervals[i])) {
              open[o].push_back(chains[i].front());
              chains[i] = std::move(open[o]);
              open[o].clear();
            }
        ends.push_back(steady ? rays[2].intervals[i] : RayInterval{NAN, NAN, -1});
      }
      for (auto& chain : open)
        if (!chain.empty()) done.push_back(std::move(chain));
      open = std::move(chains);
      open_ends = std::move(ends);
    }
    for (auto& chain : open) done.push_back(std::move(chain));
    return done;
  }

  bool continues(const RayInterval& a, const RayInterval& b) const {
    const double near = 1e-6 * size_;
    return a.solid == b.solid && std::abs(a.begin - b.begin) < near &&
           std::abs(a.end - b.end) < near;
  }

  // How an interval's ends move near an end of its band: from their places at distances 1 : 4 : 16.
  EndKind end_kind(const RayBand& band, bool at_upper) const {
    const double d = 1e-6 * (band.upper - band.lower);
    std::vector<double> y;
    for (const double distance : {d, 4 * d, 16 * d})
      y.push_back(at_upper ? band.upper - distance : band.lower + distance);
    std::vector<RayInterval> at;
    for (const auto& ray : cast_at(y)) {
      if (int(ray.intervals.size()) != band.n_intervals) return EndKind::smooth;
      at.push_back(ray.intervals[band.interval]);
    }
    return end_kind_of({at[0], at[1], at[2]}, 1e-13 * size_);
  }

  Strands<2> strands(const RayColumn& column, int n) const {
    const double lower = column.bands.front().lower, upper = column.bands.back().upper;
    const LineRule rule = rule_between(column.lower_end, column.upper_end, n);
    std::vector<double> y;
    for (const double node : rule.node) y.push_back(lower + (upper - lower) * (1 + node) / 2);
    const auto rays = cast_at(y);
    Strands<2> result;
    for (int k = 0; k < n; ++k) {
      const auto band = std::find_if(column.bands.begin(), column.bands.end() - 1,
                                     [&](const RayBand& b) { return y[k] < b.upper; });
      if (int(rays[k].intervals.size()) != band->n_intervals) return {};
      const RayInterval& interval = rays[k].intervals[band->interval];
      Vec<2> from = rays[k].origin, to = from;
      from[axis_] = interval.begin;
      to[axis_] = interval.end;
      const double weight = (upper - lower) / 2 * rule.weight[k] * (interval.end - interval.begin);
      result.push_back({from, to, weight, 1, interval.solid});
    }
    return result;
  }

  Cell<2> fit(const RayColumn& column, int n_most,
              const std::optional<Eigen::VectorXd>& reference = {}) const {
    return fit_cell<2>([splitter = *this, column](int n) { return splitter.strands(column, n); },
                       yardstick_, n_most, reference);
  }

  RayColumn column_of(const RayBand& band) const {
    return {{band}, end_kind(band, false), end_kind(band, true)};
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
    if (cell.fitted || budget == 0 || upper - lower < 1e-13 * size_) {
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

  const Component<2>& component_;
  int axis_;
  const Yardstick<2>& yardstick_;
  double size_;
};

}  // namespace

EndKind end_kind_of(const std::array<RayInterval, 3>& at, double rounding) {
  const auto moves_like_root = [&](double x0, double x1, double x2) {
    const double near = std::abs(x1 - x0), far = std::abs(x2 - x1);
    return near > rounding && far < 2.8 * near;  // 2 for a root, 4 if smooth
  };
  const bool root = moves_like_root(at[0].begin, at[1].begin, at[2].begin) ||
                    moves_like_root(at[0].end, at[1].end, at[2].end);
  if (!root) return EndKind::smooth;
  const double growth = (at[1].end - at[1].begin) / (at[0].end - at[0].begin);
  return growth > 1.9 && growth < 2.1 ? EndKind::closing : EndKind::root;
}

template <>
std::vector<Cell<2>> ray_cells<2>(const Component<2>& component, int axis,
                                  const Yardstick<2>& yardstick) {
  return RaySplitter(component, axis, yardstick).cells();
}

}  // namespace sem
