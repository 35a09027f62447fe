#include <algorithm>
#include <cmath>
#include <memory>

#include "sem/method/ray_columns.h"
#include "sem/method/split_rays.h"
#include "sem/method/sweep_3d.h"

namespace sem {
namespace {

// All of the inside between two heights.
struct Slab {
  CriticalHeight lower, upper;
};

class SlabSplitter {
 public:
  SlabSplitter(const Component<3>& component, int axis, int height, const Yardstick<3>& yardstick)
      : component_(component), axis_(axis), across_(3 - axis - height), height_(height),
        yardstick_(yardstick),
        sweep_(std::make_shared<Sweep>(component, axis, across_, height)) {}

  int n_slabs() const { return int(sweep_->heights().size()) - 1; }

  std::vector<Cell<3>> cells() const {
    std::vector<Cell<3>> result;
    const auto& heights = sweep_->heights();
    int budget = 12;
    for (size_t k = 0; k + 1 < heights.size(); ++k) append_halved({heights[k], heights[k + 1]}, budget, result);
    return result;
  }

 private:
  // n rays in every column of every one of n sections.
  Strands<3> strands(const Slab& slab, int n) const {
    const LineRule rule = rule_between(slab.lower.kind, slab.upper.kind, n);
    const double thickness = slab.upper.value - slab.lower.value;
    Strands<3> result;
    for (int k = 0; k < n; ++k) {
      RayPlane<3> plane{axis_, across_};
      plane.origin[height_] = slab.lower.value + thickness * (1 + rule.node[k]) / 2;
      const RayColumns<3> section(component_, plane);
      for (const auto& chain : section.chains(sweep_->across_at(plane.origin[height_])))
        for (const RayBand& band : chain) {
          const RayColumn column{{band}, section.end_kind(band, false), section.end_kind(band, true)};
          Strands<3> rays = section.strands(column, n);
          if (rays.empty()) return {};
          for (auto& ray : rays) {
            ray.weight *= thickness / 2 * rule.weight[k];
            result.push_back(ray);
          }
        }
    }
    return result;
  }

  // Appends the cell of a slab or, where it takes too many rays, of its halves, as long as the budget
  // of halvings lasts.
  void append_halved(const Slab& slab, int& budget, std::vector<Cell<3>>& cells) const {
    auto cell = fit_cell<3>([splitter = *this, slab](int n) { return splitter.strands(slab, n); },
                            yardstick_, most_strands);
    if (cell.fitted || budget == 0) {
      cells.push_back(std::move(cell));
      return;
    }
    --budget;
    const CriticalHeight middle{(slab.lower.value + slab.upper.value) / 2, EndKind::smooth};
    append_halved({slab.lower, middle}, budget, cells);
    append_halved({middle, slab.upper}, budget, cells);
  }

  const Component<3>& component_;
  int axis_, across_, height_;
  const Yardstick<3>& yardstick_;
  std::shared_ptr<const Sweep> sweep_;
};

}  // namespace

template <>
std::vector<Cell<3>> ray_cells<3>(const Component<3>& component, int axis,
                                  const Yardstick<3>& yardstick) {
  const SlabSplitter first(component, axis, (axis + 1) % 3, yardstick);
  const SlabSplitter second(component, axis, (axis + 2) % 3, yardstick);
  return (second.n_slabs() < first.n_slabs() ? second : first).cells();
}

}  // namespace sem
