#include <algorithm>
#include <cmath>

#include "sem/nurbs/closest.h"
#include "sem/nurbs/distance_bounds.h"
#include "sem/nurbs/search_counts.h"
#include "sem/nurbs/surface_cells.h"
#include "sem/nurbs/surface_foot.h"

// Branch and bound on cells, prepared with boxes, then on patches of a cell. The squared distance
// is q / v, q = |w (P-X)|^2 and v = w^2 in Bernstein form, so min q_i / v_i is a lower bound. Upper
// bounds come from Newton, kept inside the patch. A patch is done when a bound is as far as the
// best point, or when the minimum m found on it is its only one because q - m v is convex there.
// Both ask for weights that are much alike: see SurfacePatch. Where points are equally close along
// a curve, q - m v is nowhere convex, but vanishes there: a patch split along the curve has no
// negative coefficients left (a cylinder and its axis, say). Trimmed: where the whole surface's
// closest point is not in the region, the border's closest point comes first. Nothing else counts
// but stationary points inside the region, so a patch that the border runs through is also done
// when q / v has none there, or only the one found.

namespace sem {
namespace {

using detail::SurfaceCell;
using detail::SurfaceFoot;
using detail::SurfacePatch;
using detail::Vec4;  // w (P - X), w

constexpr int max_patches = 50000;  // of a cell; only a curve of equally close points needs so many
constexpr int max_halvings = 37;    // of the unit interval: 1e-11
constexpr int max_steps = 40;       // of Newton's
constexpr int many_halvings = 3;    // from then on a patch is split where its minimum is

struct Patch : SurfacePatch {
  double bound;  // lower bound of the distance
};

// Kept between calls so that nothing is allocated in the steady state.
struct Scratch {
  std::vector<Vec4> coefficients;  // of the stack
  std::vector<Vec4> whole;         // of a piece
  std::vector<Patch> patches;
  detail::DistanceBounds bounds;  // of a patch
  std::vector<std::pair<double, int>> order;
};

class SurfaceClosest {
 public:
  SurfaceClosest(const PreparedNurbs<2, 3>& part, const Region<2, 3>* region, const Vec<3>& X,
                 double cutoff, Scratch& scratch)
      : part_(part),
        cells_(*part.cells),
        region_(region),
        X_(X),
        from_origin_(X - part.cells->origin),
        feet_(part, X, scratch.whole),
        scratch_(scratch),
        least_(cutoff),
        size_(part.box.diagonal()) {
    best_.u.setConstant(std::numeric_limits<double>::quiet_NaN());
    best_.point.setConstant(std::numeric_limits<double>::quiet_NaN());
    best_.distance = std::numeric_limits<double>::infinity();
  }

  ClosestPoint<3> run() {
    if (region_) {
      const auto border = region_->closest_on_border(X_, least_);
      if (border.distance <= least_) {
        best_ = border;
        least_ = border.distance;
      }
    }
    auto& order = scratch_.order;
    order.clear();
    for (int k = 0; k < int(part_.pieces.size()); ++k) {
      const double bound = cells_.cells[k].distance(from_origin_);
      if (!hopeless(bound)) order.push_back({bound, k});
    }
    if (!order.empty()) {  // most of the rest need no order after that
      const auto nearest = std::min_element(order.begin(), order.end());
      search(nearest->second, nearest->first);
      order.erase(nearest);
      std::erase_if(order, [&](const auto& cell) { return hopeless(cell.first); });
      std::sort(order.begin(), order.end());
    }
    for (const auto& [bound, k] : order)
      if (!hopeless(bound)) search(k, bound);
    for (int step = 0; step < 3 && polish(); ++step) {
    }
    detail::search_counts().closest_patches += n_looked_at_;
    return best_;
  }

 private:
  // Nothing better than the best point by more than the tolerance.
  bool hopeless(double bound) const {
    if (std::isinf(best_.distance)) return bound > least_;
    return bound >= least_ - 1e-14 * (least_ + size_);
  }

  Vec4* coefficients(int k) { return &scratch_.coefficients[size_t(k) * n_]; }

  void reserve(int n_patches) {
    if (int(scratch_.patches.size()) < n_patches) scratch_.patches.resize(n_patches);
    if (scratch_.coefficients.size() < size_t(n_patches) * n_)
      scratch_.coefficients.resize(size_t(n_patches) * n_);
  }

  void search(int index, double bound) {
    const SurfaceCell& cell = cells_.cells[index];
    ++n_looked_at_;
    if (!region_ && finish(cell)) return;
    if (cell.first_child < 0) {
      refine(cell, bound);
      return;
    }
    std::array<std::pair<double, int>, 4> children;
    for (int k = 0; k < 4; ++k) {
      const int child = cell.first_child + k;
      children[k] = {cells_.cells[child].distance(from_origin_), child};
    }
    std::sort(children.begin(), children.end());
    for (const auto& [distance, child] : children)
      if (!hopeless(distance)) search(child, distance);
  }

  // True if no point of the cell is better than the best one now known, by its prepared bounds:
  // from its middle, or if the distance is convex on it from its minimum.
  bool finish(const SurfaceCell& cell) {
    auto curvature = cell.curvature(
        from_origin_, std::min(least_ * least_, 4 * (from_origin_ - cell.centre).squaredNorm()));
    const bool convex = curvature.uu > 0 && curvature.vv > 0 &&
                        curvature.uu * curvature.vv > curvature.uv * curvature.uv;
    if (!convex && cell.first_child >= 0) return false;
    feet_.set_piece(part_.pieces[cell.piece]);
    const Vec<3> place = cell.axes * (from_origin_ - cell.centre);
    Vec<2> share = Vec<2>::Constant(0.5);
    for (int a = 0; a < 2; ++a)
      if (cell.half[a] > 0) share[a] = std::clamp(0.5 + 0.5 * place[a] / cell.half[a], 0.0, 1.0);
    SurfaceFoot found = feet_.start(cell.patch.parameter(share), cell.patch);
    for (int steps = 0;; ++steps) {
      curvature = cell.curvature(from_origin_, found.jet.offset.squaredNorm());
      if (hopeless(lower_bound(cell.patch, found, curvature))) return true;
      if (!convex || steps == max_steps || !feet_.step(found, cell.patch)) break;
    }
    offer(found.s, found.jet.offset);
    return hopeless(lower_bound(cell.patch, found, curvature));
  }

  void refine(const SurfaceCell& cell, double bound) {
    const auto& piece = part_.pieces[cell.piece];
    feet_.set_piece(piece);
    n_ = int(piece.weights.size());
    rational_ = cells_.rational[cell.piece];
    reserve(1);
    const Vec4* stored = &cells_.coefficients[cell.first_coefficient];
    for (int i = 0; i < n_; ++i) {
      Vec4& c = coefficients(0)[i] = stored[i];
      c.head<3>() -= c[3] * from_origin_;
    }
    scratch_.patches[0] = {cell.patch, bound};
    for (int n = 1, n_patches = 0; n > 0;) {
      const Patch patch = scratch_.patches[n - 1];
      ++n_looked_at_;
      if (hopeless(patch.bound) || patch.halvings > max_halvings || ++n_patches > max_patches ||
          finish(patch, coefficients(n - 1))) {
        --n;
        continue;
      }
      replace_by_quarters(patch, n);
      n += 3;
      // The most promising patch on top.
      int top = n - 1;
      for (int k = n - 4; k < n; ++k)
        if (scratch_.patches[k].bound < scratch_.patches[top].bound) top = k;
      if (top != n - 1) {
        std::swap(scratch_.patches[top], scratch_.patches[n - 1]);
        std::swap_ranges(coefficients(top), coefficients(top) + n_, coefficients(n - 1));
      }
    }
  }

  // Of the stack's last patch, n - 1, about split_at_.
  void replace_by_quarters(const Patch& patch, int n) {
    reserve(n + 3);
    std::array<SurfacePatch, 4> quarters;
    detail::split(patch, split_at_, feet_.piece().degree, rational_,
                  {coefficients(n - 1), coefficients(n), coefficients(n + 1), coefficients(n + 2)},
                  quarters);
    for (int k = 0; k < 4; ++k)
      scratch_.patches[n - 1 + k] = {quarters[k],
                                     std::max(patch.bound, hull_bound(coefficients(n - 1 + k)))};
  }

  // Where to split a patch: its middle, or after many halvings a minimum inside.
  static Vec<2> split_at(const Patch& patch, const Vec<2>& minimum) {
    Vec<2> t = Vec<2>::Constant(0.5);
    if (patch.halvings < many_halvings) return t;
    for (int a = 0; a < 2; ++a) {
      const double share = (minimum[a] - patch.lower[a]) / (patch.upper[a] - patch.lower[a]);
      const double at = share / (share + patch.ratio[a] * (1 - share));
      if (at > 0.01 && at < 0.99) t[a] = at;
    }
    return t;
  }

  // Distance of the plane across the direction of the patch's middle.
  double hull_bound(const Vec4* c) const {
    const int p = feet_.piece().degree[0];
    Vec<3> direction = Vec<3>::Zero();
    for (int corner : {0, p, n_ - 1 - p, n_ - 1}) direction += c[corner].head<3>() / c[corner][3];
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_; ++i) least = std::min(least, direction.dot(c[i].head<3>()) / c[i][3]);
    return least > 0 ? least / direction.norm() : 0;
  }

  // True if no point of the patch is better than the best one now known; else split_at_ is set.
  bool finish(const Patch& patch, const Vec4* c) {
    int where = 0;
    const double least =
        scratch_.bounds.set(c, feet_.piece().degree, part_.power != nullptr, where);
    if (hopeless(std::sqrt(std::max(0.0, least)))) return true;
    const Overlap overlap =
        region_ ? region_->overlap(global(patch.lower), global(patch.upper)) : Overlap::all;
    if (overlap == Overlap::none) return true;
    const int p = 2 * feet_.piece().degree[0], q = 2 * feet_.piece().degree[1];
    const Vec<2> share(double(where % (p + 1)) / p, double(where / (p + 1)) / q);
    SurfaceFoot found = feet_.start(patch.parameter(share), patch);
    if (hopeless(
            lower_bound(patch, found, scratch_.bounds.curvature(found.jet.offset.squaredNorm()))))
      return true;
    for (int steps = 0; steps < max_steps && feet_.step(found, patch); ++steps) {
    }
    offer(found.s, found.jet.offset);
    split_at_ = split_at(patch, found.s);
    return hopeless(lower_bound(patch, found,
                                scratch_.bounds.curvature(found.jet.offset.squaredNorm()))) ||
           (overlap == Overlap::some &&
            scratch_.bounds.at_most_one_stationary(std::max(0.0, least), least_ * least_));
  }

  // Lower bound of the distance on a patch from what is found at a point with squared distance m: f
  // = q - m v is zero there, its gradient g. If a, b, c bound its second derivatives, f >= g.d + (a
  // d_u^2 - 2 c |d_u d_v| + b d_v^2) / 2. Where f is convex and the point its minimum, nothing on
  // the patch is closer than by rounding; else f falls no further than it has room.
  static double lower_bound(const SurfacePatch& patch, const SurfaceFoot& found,
                            const detail::DistanceCurvature& curvature) {
    const double m = found.jet.offset.squaredNorm();
    const auto [uu, vv, uv, least_v, largest_v] = curvature;
    Vec<2> g = 2 * largest_v * found.gradient.cwiseProduct(patch.speed(found.s));
    for (int a = 0; a < 2; ++a)
      if (found.fixed[a]) g[a] = 0;  // f rises from this side of the patch
    // With c |d_u d_v| <= c (d_u^2 + d_v^2) / 2 each axis for itself, as far as there is room.
    const Vec<2> place = patch.place(found.s), least(uu - uv, vv - uv);
    double slack = 0;
    for (int a = 0; a < 2; ++a) {
      const double fall = std::abs(g[a]), room = g[a] > 0 ? place[a] : 1 - place[a];
      const double way = least[a] > 0 ? std::min(room, fall / least[a]) : room;
      slack += std::max((fall - least[a] * way / 2) * way, -least[a] * (1 - room) * (1 - room) / 2);
    }
    // Where the patch is thin along an axis, f's curvature along it may be all rounding: there |d|
    // <= 1.
    g = g.cwiseAbs();
    const double flat_u = g[0] + std::max(0.0, -uu) / 2, flat_v = g[1] + std::max(0.0, -vv) / 2;
    slack = std::min(slack, flat_u + flat_v + uv);
    if (uu > 0) slack = std::min(slack, flat_v + (g[0] + uv) * (g[0] + uv) / (2 * uu));
    if (vv > 0) slack = std::min(slack, flat_u + (g[1] + uv) * (g[1] + uv) / (2 * vv));
    const double determinant = uu * vv - uv * uv;
    if (uu > 0 && vv > 0 && determinant > 1e-6 * uu * vv)
      slack = std::min(
          slack, 0.5 * (vv * g[0] * g[0] + 2 * uv * g[0] * g[1] + uu * g[1] * g[1]) / determinant);
    return std::sqrt(std::max(0.0, m - slack / least_v));
  }

  // One of Newton's steps at the best point: distances cannot tell the foot better than to the
  // square root of their rounding. False if there is nothing to gain.
  bool polish() {
    if (!best_piece_) return false;
    feet_.set_piece(*best_piece_);
    Vec<2> next = best_s_;
    if (!feet_.polish(next)) return false;
    if (region_ && !region_->contains(global(next))) return false;
    const Vec<3> offset = feet_.evaluate(next).offset;
    if (!(offset.norm() <= best_.distance + 1e-15 * (best_.distance + size_))) return false;
    const double moved = (next - best_s_).cwiseAbs().maxCoeff();
    set_best(next, offset);
    return moved > 1e-9;
  }

  void offer(const Vec<2>& s, const Vec<3>& offset) {
    const double distance = offset.norm();
    if (!(distance <= least_) || distance == best_.distance) return;
    if (region_ && !region_->contains(global(s))) return;
    least_ = distance;
    set_best(s, offset);
  }

  void set_best(const Vec<2>& s, const Vec<3>& offset) {
    best_piece_ = &feet_.piece();
    best_s_ = s;
    best_.distance = offset.norm();
    best_.point = X_ + offset;
    best_.u = global(s);
  }

  // The part's parameters at s of the piece.
  Param<2> global(const Vec<2>& s) const {
    Param<2> u;
    for (int a = 0; a < 2; ++a)
      u[a] = s[a] == 1 ? feet_.piece().upper[a]
                       : feet_.piece().lower[a] +
                             s[a] * (feet_.piece().upper[a] - feet_.piece().lower[a]);
    return u;
  }

  const PreparedNurbs<2, 3>& part_;
  const detail::SurfaceCells& cells_;
  const Region<2, 3>* region_;  // null: all of the part
  const Vec<3> X_, from_origin_;
  detail::SurfaceFeet feet_;
  Scratch& scratch_;
  double least_, size_;
  ClosestPoint<3> best_;
  const BezierPiece<2, 3>* best_piece_ = nullptr;
  Vec<2> best_s_, split_at_;
  int n_ = 0;
  long n_looked_at_ = 0;
  bool rational_ = false;  // weights of the piece differ
};

}  // namespace

template <>
ClosestPoint<3> closest_point(const PreparedNurbs<2, 3>& part, const Vec<3>& X, double cutoff) {
  thread_local Scratch scratch;
  const auto whole = SurfaceClosest(part, nullptr, X, cutoff, scratch).run();
  if (!part.region || !(whole.distance <= cutoff) || part.region->contains(whole.u)) return whole;
  return SurfaceClosest(part, part.region.get(), X, cutoff, scratch).run();
}

}  // namespace sem
