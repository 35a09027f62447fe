#include <algorithm>
#include <cmath>
#include <memory>

#include "sem/method/boundary_integrals.h"
#include "sem/method/ray_columns.h"
#include "sem/method/split_rays.h"
#include "sem/method/sweep_3d.h"

namespace sem {
namespace {

// Eigenvectors of a symmetric matrix by Jacobi's rotations, a right-handed frame.
Mat<3> principal_axes(Mat<3> A) {
  Mat<3> frame = Mat<3>::Identity();
  for (int sweep = 0; sweep < 20; ++sweep)
    for (int p = 0; p < 3; ++p)
      for (int q = p + 1; q < 3; ++q) {
        const double angle = 0.5 * std::atan2(2 * A(p, q), A(q, q) - A(p, p));
        Mat<3> turn = Mat<3>::Identity();
        turn(p, p) = turn(q, q) = std::cos(angle);
        turn(p, q) = std::sin(angle);
        turn(q, p) = -std::sin(angle);
        A = (turn.transpose() * A * turn).eval();
        frame = (frame * turn).eval();
      }
  return frame;
}

// The axes in which the solid is cut, as columns: those of space where they are the body's
// principal axes, where faces lie across them, or where parts are trimmed; else the principal ones.
Mat<3> frame_of(const Component<3>& component) {
  Mat<3> frame = Mat<3>::Identity();
  double area = 0, faced = 0;
  for (const auto& part : component.boundary.parts) {
    if (part.region) return frame;
    for (const auto& piece : part.pieces) {
      const auto at = derivatives(part.nurbs, Param<2>((piece.lower + piece.upper) / 2), 1);
      const Vec<3> normal = DimTraits<3>::area_normal(at.first);
      const double here = normal.norm() * (piece.upper - piece.lower).prod();
      area += here;
      if (normal.cwiseAbs().maxCoeff() > (1 - 1e-9) * normal.norm()) faced += here;
    }
  }
  const auto moments = boundary_moments(component.boundary, component.loops);
  if (!moments.available || faced > 0.2 * area) return frame;
  const Mat<3> covariance = moments.second / moments.volume -
                            moments.first * moments.first.transpose() / std::pow(moments.volume, 2);
  const double off_axis =
      (covariance - Mat<3>(covariance.diagonal().asDiagonal())).cwiseAbs().maxCoeff();
  return off_axis > 1e-9 * covariance.trace() ? principal_axes(covariance) : frame;
}

// The component in the coordinates of a frame.
std::shared_ptr<const Component<3>> turned(const Component<3>& component, const Mat<3>& frame) {
  auto result = std::make_shared<Component<3>>(component);
  if (frame.isIdentity(0)) return result;
  result->boundary.box = {};
  for (auto& part : result->boundary.parts) {
    Nurbs<2, 3> shape = part.nurbs;
    shape.control_points = frame.transpose() * part.nurbs.control_points;
    part = prepare(shape);
    result->boundary.box.include(part.box);
  }
  return result;
}

// All of the inside between two heights; the columns of its sections whole or cut in halves.
struct Slab {
  CriticalHeight lower, upper;
  bool halved_columns = false;
};

// Both halves of a column, or the column.
std::vector<RayColumn> cut(const RayColumn& column, bool in_halves) {
  if (!in_halves) return {column};
  RayColumn lower = column, upper = column;
  const double middle = (column.bands.front().lower + column.bands.front().upper) / 2;
  lower.bands.front().upper = upper.bands.front().lower = middle;
  lower.upper_end = upper.lower_end = EndKind::smooth;
  return {lower, upper};
}

class SlabSplitter {
 public:
  // The component in the coordinates of the frame.
  SlabSplitter(std::shared_ptr<const Component<3>> component, const Mat<3>& frame, int axis,
               int height, const Yardstick<3>& yardstick)
      : component_(std::move(component)),
        frame_(frame),
        axis_(axis),
        across_(3 - axis - height),
        height_(height),
        yardstick_(yardstick),
        sweep_(std::make_shared<Sweep>(*component_, axis, across_, height)) {}

  int n_slabs() const { return int(sweep_->heights().size()) - 1; }

  std::vector<Cell<3>> cells() const {
    std::vector<Cell<3>> result;
    const auto& heights = sweep_->heights();
    int budget = 12;
    for (size_t k = 0; k + 1 < heights.size(); ++k)
      append_halved({heights[k], heights[k + 1]}, budget, result);
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
      const RayColumns<3> section(*component_, plane);
      for (const auto& whole : section.columns_between(sweep_->across_at(plane.origin[height_])))
        for (const auto& column : cut(whole, slab.halved_columns)) {
          Strands<3> rays = section.strands(column, n);
          if (rays.empty()) return {};
          for (auto& ray : rays) {
            ray.from = (frame_ * ray.from).eval();
            ray.to = (frame_ * ray.to).eval();
            ray.weight *= thickness / 2 * rule.weight[k];
            result.push_back(ray);
          }
        }
    }
    return result;
  }

  Cell<3> fit(const Slab& slab) const {
    return fit_cell<3>([splitter = *this, slab](int n) { return splitter.strands(slab, n); },
                       yardstick_, most_strands);
  }

  // Appends the cell of a slab or, where it takes too many rays, the one with halved columns or
  // those of its halves, as long as the budget of halvings lasts.
  void append_halved(const Slab& slab, int& budget, std::vector<Cell<3>>& cells) const {
    auto cell = fit(slab);
    if (!cell.fitted)
      if (auto finer = fit({slab.lower, slab.upper, true}); finer.fitted || budget == 0)
        cell = std::move(finer);
    if (cell.fitted || budget == 0) {
      cells.push_back(std::move(cell));
      return;
    }
    --budget;
    const CriticalHeight middle{(slab.lower.value + slab.upper.value) / 2, EndKind::smooth};
    append_halved({slab.lower, middle}, budget, cells);
    append_halved({middle, slab.upper}, budget, cells);
  }

  std::shared_ptr<const Component<3>> component_;
  Mat<3> frame_;
  int axis_, across_, height_;
  const Yardstick<3>& yardstick_;
  std::shared_ptr<const Sweep> sweep_;
};

}  // namespace

template <>
std::vector<Cell<3>> ray_cells<3>(const Component<3>& component, int axis,
                                  const Yardstick<3>& yardstick) {
  const Mat<3> frame = frame_of(component);
  const auto in_frame = turned(component, frame);
  std::vector<SlabSplitter> splitters;
  int fewest = std::numeric_limits<int>::max(), best = -1;
  for (int along = 0; along < 3; ++along)
    for (const int height : {(along + 1) % 3, (along + 2) % 3}) {
      splitters.emplace_back(in_frame, frame, along, height, yardstick);
      fewest = std::min(fewest, splitters.back().n_slabs());
    }
  for (int k = 0; k < 2 && best < 0; ++k)
    if (splitters[2 * axis + k].n_slabs() == fewest) best = 2 * axis + k;
  if (best < 0) return {};
  return splitters[best].cells();
}

}  // namespace sem
