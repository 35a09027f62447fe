#include "sem/method/ray_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sem {

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

template <int Dim>
std::vector<Ray<Dim>> RayColumns<Dim>::cast_at(const std::vector<double>& transverse) const {
  Rays<Dim> rays;
  rays.axis = plane_.axis;
  for (const double y : transverse) {
    Ray<Dim>& ray = rays.rays.emplace_back();
    ray.origin = plane_.origin;
    ray.origin[plane_.across] = y;
    ray.weight = 1;
  }
  cast(component_.boundary, component_.loops, rays);
  return std::move(rays.rays);
}

template <int Dim>
std::vector<double> RayColumns<Dim>::band_ends(const std::vector<double>& values) const {
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

template <int Dim>
typename RayColumns<Dim>::PartsOnRay RayColumns<Dim>::parts_on_ray(double y) const {
  const auto ray = cast_at({y})[0];
  const double tie = 1e-11 * size_;  // coincident parts: the first of them
  PartsOnRay parts;
  const auto add_bound = [&](double t) {
    int first = std::numeric_limits<int>::max();
    for (const auto& hit : ray.hits)
      if (std::abs(hit.t - t) < tie) first = std::min(first, hit.part);
    parts.bounds.push_back(first);
  };
  for (const auto& interval : ray.intervals) {
    add_bound(interval.begin);
    add_bound(interval.end);
  }
  for (const auto& hit : ray.hits) parts.met.push_back(hit.part);
  std::sort(parts.met.begin(), parts.met.end());
  return parts;
}

// The bounds of the inside have kinks where two parts change places along the rays. They do not
// where one part ends and its neighbour goes on: then other parts are met on both sides of the
// place.
template <int Dim>
std::vector<double> RayColumns<Dim>::with_crossings(const std::vector<double>& values) const {
  std::vector<double> ends = values;
  constexpr int n_samples = 6;
  for (size_t k = 0; k + 1 < values.size(); ++k) {
    const double width = values[k + 1] - values[k];
    const auto y = [&](int i) { return values[k] + width * (i + 0.5) / n_samples; };
    PartsOnRay before = parts_on_ray(y(0));
    for (int i = 0; i + 1 < n_samples; ++i) {
      PartsOnRay after = parts_on_ray(y(i + 1));
      double a = y(i), b = y(i + 1);
      if (after.bounds != before.bounds) {
        while (b - a > 1e-15 * size_ && a < (a + b) / 2 && (a + b) / 2 < b)
          (parts_on_ray((a + b) / 2).bounds == before.bounds ? a : b) = (a + b) / 2;
        const double aside = 1e-6 * width;
        if (parts_on_ray(a - aside).met == parts_on_ray(b + aside).met) ends.push_back((a + b) / 2);
      }
      before = std::move(after);
    }
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

template <int Dim>
std::vector<std::vector<RayBand>> RayColumns<Dim>::chains(const std::vector<double>& at) const {
  const auto values = band_ends(at);
  std::vector<std::vector<RayBand>> done, open;
  std::vector<RayInterval> open_ends;  // of the last band of each open chain, where it ends
  for (size_t k = 0; k + 1 < values.size(); ++k) {
    const double lower = values[k], upper = values[k + 1], inside = 1e-9 * (upper - lower);
    const auto rays = cast_at({(lower + upper) / 2, lower + inside, upper - inside});
    const int n = int(rays[0].intervals.size());
    std::vector<std::vector<RayBand>> here;
    std::vector<RayInterval> ends;
    const bool steady = int(rays[1].intervals.size()) == n && int(rays[2].intervals.size()) == n;
    for (int i = 0; i < n; ++i) {
      here.push_back({{lower, upper, i, n}});
      if (steady)
        for (size_t o = 0; o < open.size(); ++o)
          if (!open[o].empty() && continues(open_ends[o], rays[1].intervals[i])) {
            open[o].push_back(here[i].front());
            here[i] = std::move(open[o]);
            open[o].clear();
          }
      ends.push_back(steady ? rays[2].intervals[i] : RayInterval{NAN, NAN, -1});
    }
    for (auto& chain : open)
      if (!chain.empty()) done.push_back(std::move(chain));
    open = std::move(here);
    open_ends = std::move(ends);
  }
  for (auto& chain : open) done.push_back(std::move(chain));
  return done;
}

template <int Dim>
bool RayColumns<Dim>::continues(const RayInterval& a, const RayInterval& b) const {
  const double near = 1e-6 * size_;
  return a.solid == b.solid && std::abs(a.begin - b.begin) < near && std::abs(a.end - b.end) < near;
}

// From the ends' places at distances 1 : 4 : 16 of a share of the band.
template <int Dim>
std::vector<EndKind> RayColumns<Dim>::end_kinds(double lower, double upper, int n_intervals,
                                                bool at_upper, double share) const {
  const double d = share * (upper - lower);
  std::vector<double> y;
  for (const double distance : {d, 4 * d, 16 * d})
    y.push_back(at_upper ? upper - distance : lower + distance);
  const auto rays = cast_at(y);
  std::vector<EndKind> kinds(n_intervals, EndKind::smooth);
  for (const auto& ray : rays)
    if (int(ray.intervals.size()) != n_intervals) return kinds;
  for (int i = 0; i < n_intervals; ++i)
    kinds[i] = end_kind_of({rays[0].intervals[i], rays[1].intervals[i], rays[2].intervals[i]},
                           1e-13 * size_);
  return kinds;
}

template <int Dim>
EndKind RayColumns<Dim>::end_kind(const RayBand& band, bool at_upper) const {
  return end_kinds(band.lower, band.upper, band.n_intervals, at_upper, 1e-6)[band.interval];
}

template <int Dim>
std::vector<RayColumn> RayColumns<Dim>::columns_between(const std::vector<double>& at) const {
  constexpr double share = 1e-4;  // rays closer to a tangent cost more
  const auto values = with_crossings(at);
  std::vector<RayColumn> columns;
  for (size_t k = 0; k + 1 < values.size(); ++k) {
    const double lower = values[k], upper = values[k + 1];
    const int n = n_intervals_at((lower + upper) / 2);
    if (n == 0) continue;
    const auto at_lower = end_kinds(lower, upper, n, false, share);
    const auto at_upper = end_kinds(lower, upper, n, true, share);
    for (int i = 0; i < n; ++i)
      columns.push_back({{{lower, upper, i, n}}, at_lower[i], at_upper[i]});
  }
  return columns;
}

template <int Dim>
Strands<Dim> RayColumns<Dim>::strands(const RayColumn& column, int n) const {
  const double lower = column.bands.front().lower, upper = column.bands.back().upper;
  const LineRule rule = rule_between(column.lower_end, column.upper_end, n);
  std::vector<double> y;
  for (const double node : rule.node) y.push_back(lower + (upper - lower) * (1 + node) / 2);
  const auto rays = cast_at(y);
  Strands<Dim> result;
  for (int k = 0; k < n; ++k) {
    const auto band = std::find_if(column.bands.begin(), column.bands.end() - 1,
                                   [&](const RayBand& b) { return y[k] < b.upper; });
    if (int(rays[k].intervals.size()) != band->n_intervals) return {};
    const RayInterval& interval = rays[k].intervals[band->interval];
    Vec<Dim> from = rays[k].origin, to = from;
    from[plane_.axis] = interval.begin;
    to[plane_.axis] = interval.end;
    const double weight = (upper - lower) / 2 * rule.weight[k] * (interval.end - interval.begin);
    result.push_back({from, to, weight, 1, interval.solid});
  }
  return result;
}

template class RayColumns<2>;
template class RayColumns<3>;

}  // namespace sem
