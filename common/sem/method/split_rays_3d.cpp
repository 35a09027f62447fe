#include "sem/method/critical_values.h"
#include "sem/method/rays.h"
#include "sem/method/split_rays.h"

namespace sem {
namespace {

// The intervals of n by n rays at Gauss points of a rectangle across the axis.
Strands<3> strands_over(const Component<3>& component, int axis, const Vec<2>& lower,
                        const Vec<2>& upper, int n) {
  const LineRule rule = gauss_legendre(n);
  Rays<3> rays;
  rays.axis = axis;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      Ray<3>& ray = rays.rays.emplace_back();
      const Vec<2> at =
          (Vec<2>(1 + rule.node[i], 1 + rule.node[j]) / 2).cwiseProduct(upper - lower) + lower;
      ray.origin = Vec<3>::Zero();
      ray.origin[(axis + 1) % 3] = at[0];
      ray.origin[(axis + 2) % 3] = at[1];
      ray.weight = rule.weight[i] * rule.weight[j] * (upper - lower).prod() / 4;
    }
  cast(component.boundary, component.loops, rays);
  Strands<3> strands;
  for (const auto& ray : rays.rays)
    for (const auto& interval : ray.intervals) {
      Vec<3> from = ray.origin, to = ray.origin;
      from[axis] = interval.begin;
      to[axis] = interval.end;
      strands.push_back(
          {from, to, ray.weight * (interval.end - interval.begin), 1, interval.solid});
    }
  return strands;
}

}  // namespace

template <>
std::vector<Cell<3>> ray_cells<3>(const Component<3>& component, int axis,
                                  const Yardstick<3>& yardstick) {
  const auto critical = [&](int transverse) {
    return critical_values(component.boundary, component.loops, axis, transverse);
  };
  const auto first = critical((axis + 1) % 3), second = critical((axis + 2) % 3);
  std::vector<Cell<3>> cells;
  for (size_t j = 0; j + 1 < second.size(); ++j)
    for (size_t i = 0; i + 1 < first.size(); ++i) {
      const Vec<2> lower(first[i], second[j]), upper(first[i + 1], second[j + 1]);
      cells.push_back(
          fit_cell<3>([&component, axis, lower,
                       upper](int n) { return strands_over(component, axis, lower, upper, n); },
                      yardstick, most_strands));
    }
  return cells;
}

}  // namespace sem
