#include "sem/method/ray_blocks.h"

#include <algorithm>
#include <cmath>

#include "sem/base/parallel.h"
#include "sem/method/critical_values.h"
#include "sem/method/line_rules.h"
#include "sem/method/sweep_3d.h"

namespace sem {
namespace {

constexpr double wrong_volume = 0.05;  // difference of volumes, of which one is that of a grid of rays

// A coordinate in [0, 1] stretched to an interval and bent, and how fast it runs there.
struct Bent {
  double value, slope;
};
Bent bent(double t, const Interval& to) {
  const double width = to.upper - to.lower;
  return {to.lower + width * (t * t * (3 - 2 * t)), width * (6 * t * (1 - t))};
}

template <int Dim>
double length_inside(const std::vector<Ray<Dim>>& rays) {
  double sum = 0;
  for (const auto& ray : rays)
    for (const auto& interval : ray.intervals) sum += ray.weight * (interval.end - interval.begin);
  return sum;
}

// Whether a sweep says more of the boundary than the boxes of its pieces do, and all of it.
bool is_worth_a_sweep(const Boundary<3>& boundary) {
  bool curved = false;
  for (const auto& part : boundary.parts) {
    if (part.region) return false;
    for (const auto& piece : part.pieces)
      curved |= (piece.box.upper - piece.box.lower).minCoeff() > 1e-12 * piece.box.diagonal();
  }
  return curved;
}

}  // namespace

template <int Dim>
typename RayBlocks<Dim>::Region RayBlocks<Dim>::fixed_columns(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                                              int axis) {
  Region region{std::make_shared<const Component<Dim>>(Component<Dim>{boundary, loops})};
  region.across = (axis + 1) % Dim;
  if (Dim == 3) {
    region.height = (axis + 2) % Dim;
    region.heights = critical_values<Dim>(boundary, loops, axis, region.height);
  }
  region.columns_at = [values = critical_values<Dim>(boundary, loops, axis, region.across)](double) { return values; };
  return region;
}

template <>
std::vector<RayBlocks<2>::Region> RayBlocks<2>::swept_columns(const Boundary<2>&, const Loops<2>&, int) {
  return {};
}

template <>
std::vector<RayBlocks<3>::Region> RayBlocks<3>::swept_columns(const Boundary<3>& boundary, const Loops<3>& loops,
                                                              int axis) {
  if (!is_worth_a_sweep(boundary)) return {};
  std::vector<Region> regions;
  for (auto& component : split_into_components(boundary, loops)) {
    Region& region = regions.emplace_back();
    region.component = std::make_shared<const Component<3>>(std::move(component));
    std::shared_ptr<const Sweep> best;
    for (const int height : {(axis + 2) % 3, (axis + 1) % 3}) {
      const int across = 3 - axis - height;
      const auto sweep = std::make_shared<const Sweep>(*region.component, axis, across, height);
      if (best && sweep->heights().size() >= best->heights().size()) continue;
      best = sweep;
      region.across = across;
      region.height = height;
    }
    for (const auto& height : best->heights()) region.heights.push_back(height.value);
    region.columns_at = [best](double height) { return best->across_at(height); };
  }
  return regions;
}

template <int Dim>
std::vector<typename RayBlocks<Dim>::Block> RayBlocks<Dim>::blocks_of(const std::vector<Region>& regions) {
  std::vector<Block> blocks;
  const auto add = [&](int r, const Interval& height) {
    const int n = int(regions[r].columns_at((height.lower + height.upper) / 2).size()) - 1;
    for (int c = 0; c < n; ++c) blocks.push_back({r, c, n, height});
  };
  for (int r = 0; r < int(regions.size()); ++r) {
    const auto& heights = regions[r].heights;
    if (Dim == 2) add(r, {0, 0});
    for (size_t k = 0; k + 1 < heights.size(); ++k) add(r, {heights[k], heights[k + 1]});
  }
  return blocks;
}

template <int Dim>
RayBlocks<Dim>::RayBlocks(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int axis, int n_threads)
    : axis_(axis), n_threads_(n_threads) {
  std::vector<Region> fixed;
  fixed.push_back(fixed_columns(boundary, loops, axis));
  std::vector<Block> fixed_blocks = blocks_of(fixed);
  regions_ = swept_columns(boundary, loops, axis);
  if (!regions_.empty()) {
    blocks_ = blocks_of(regions_);
    const double truth = length_inside(cast_rays(boundary, loops, {.axis = axis, .n_rays = 32}, n_threads).rays);
    if (blocks_.size() <= std::max<size_t>(64, 2 * fixed_blocks.size()) &&
        std::abs(volume() - truth) < wrong_volume * truth)
      return;
  }
  regions_ = std::move(fixed);
  blocks_ = std::move(fixed_blocks);
  sections_.clear();
}

template <int Dim>
double RayBlocks<Dim>::volume() {
  const LineRule rule = gauss_legendre(4);
  std::vector<BlockRay<Dim>> rays;
  for (int b = 0; b < size(); ++b)
    for (int k = 0; k < (Dim == 3 ? 16 : 4); ++k) {
      BlockRay<Dim> ray{b, {}, 1};
      for (int a = 0, rest = k; a < Dim - 1; ++a, rest /= 4) {
        ray.at[a] = (1 + rule.node[rest % 4]) / 2;
        ray.weight *= rule.weight[rest % 4] / 2;
      }
      rays.push_back(ray);
    }
  return length_inside(cast(rays));
}

// Finds the columns of all sections that the rays lie in.
template <int Dim>
void RayBlocks<Dim>::cut_sections(const std::vector<BlockRay<Dim>>& rays) {
  std::vector<std::pair<int, double>> missing;
  for (const auto& ray : rays) {
    const Block& block = blocks_[ray.block];
    const std::pair<int, double> key(block.region, bent(ray.at.back(), block.height).value);
    if (sections_.try_emplace(key).second) missing.push_back(key);
  }
  parallel_for(int(missing.size()), n_threads_, [&](int begin, int end) {
    for (int m = begin; m < end; ++m)
      sections_.find(missing[m])->second = regions_[missing[m].first].columns_at(missing[m].second);
  });
}

// Where a section has another number of columns than its block says, they share it evenly.
template <int Dim>
Interval RayBlocks<Dim>::column_at(const Block& block, double height) const {
  const auto& borders = sections_.find({block.region, height})->second;
  if (borders.size() < 2) return {0, 0};
  if (int(borders.size()) == block.n_columns + 1) return {borders[block.column], borders[block.column + 1]};
  const double width = (borders.back() - borders.front()) / block.n_columns;
  return {borders.front() + block.column * width, borders.front() + (block.column + 1) * width};
}

template <int Dim>
std::vector<Ray<Dim>> RayBlocks<Dim>::cast(const std::vector<BlockRay<Dim>>& rays) {
  cut_sections(rays);
  std::vector<Rays<Dim>> of_region(regions_.size());
  for (const auto& place : rays) {
    const Block& block = blocks_[place.block];
    const Region& region = regions_[block.region];
    Ray<Dim>& ray = of_region[block.region].rays.emplace_back();
    ray.origin.setZero();
    ray.weight = place.weight;
    Bent height{0, 1};
    if (Dim == 3) {
      height = bent(place.at.back(), block.height);
      ray.origin[region.height] = height.value;
    }
    const Bent across = bent(place.at[0], column_at(block, height.value));
    ray.origin[region.across] = across.value;
    ray.weight *= across.slope * height.slope;
  }
  for (size_t r = 0; r < regions_.size(); ++r) {
    of_region[r].axis = axis_;
    sem::cast(regions_[r].component->boundary, regions_[r].component->loops, of_region[r], n_threads_);
  }
  std::vector<Ray<Dim>> result;
  std::vector<size_t> next(regions_.size(), 0);
  for (const auto& place : rays) {
    const int region = blocks_[place.block].region;
    result.push_back(std::move(of_region[region].rays[next[region]++]));
  }
  return result;
}

template class RayBlocks<2>;
template class RayBlocks<3>;

}  // namespace sem
