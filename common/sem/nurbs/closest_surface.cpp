#include <algorithm>
#include <cmath>

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/distance_bounds.h"
#include "sem/nurbs/kernels.h"

// Branch and bound on patches. A first lower bound of the distance comes from a
// plane that the convex hull lies beyond. The squared distance is q / v, q =
// |w (P-X)|^2 and v = w^2 in Bernstein form, so min q_i / v_i is a second one.
// Upper bounds come from Newton, kept inside the patch. A patch is done when a
// bound is as far as the best point, or when the minimum m found on it is its
// only one because q - m v is convex there. Both ask for weights that are much alike: along each axis a
// patch runs in the parameter t that makes the weights of its ends equal (Moebius),
//   s = lower + (upper - lower) r t / (1 - t + r t).
// Halved there, weights of 1, w, 1 become those of 1, about sqrt(w / 2), 1.
// Where points are equally close along a curve, q - m v is nowhere convex, but vanishes there: a patch split along
// the curve has no negative coefficients left (a cylinder and its axis, say).
// Trimmed: where the whole surface's closest point is not in the region, the border's closest point comes
// first. Nothing else counts but stationary points inside the region, so a patch that the border runs through
// is also done when q / v has none there, or only the one found.

namespace sem {
namespace {

using detail::Vec4;  // w (P - X), w

constexpr int max_patches = 50000;  // only a curve of equally close points needs so many
constexpr int max_halvings = 37;    // of the unit interval: 1e-11
constexpr int many_halvings = 3;    // from then on a patch is split where its minimum is

struct Patch {
  Vec<2> lower, upper;  // in [0, 1]^2 of the piece
  Vec<2> ratio;         // r of each axis
  int halvings;
  double bound;  // lower bound of the distance
};

// Kept between calls so that nothing is allocated in the steady state.
struct Scratch {
  std::vector<Vec4> coefficients;  // of the whole piece, then of the stack
  std::vector<Patch> patches;
  detail::DistanceBounds bounds;   // of a patch
  std::vector<std::pair<double, int>> order;
};

class SurfaceClosest {
 public:
  SurfaceClosest(const PreparedNurbs<2, 3>& part, const Region<2, 3>* region, const Vec<3>& X, double cutoff,
                 Scratch& scratch)
      : part_(part), region_(region), X_(X), scratch_(scratch), least_(cutoff), size_(part.box.diagonal()) {
    best_.u.setConstant(std::numeric_limits<double>::quiet_NaN());
    best_.point.setConstant(std::numeric_limits<double>::quiet_NaN());
    best_.distance = std::numeric_limits<double>::infinity();
  }

  ClosestPoint<3> run() {
    auto& order = scratch_.order;
    order.clear();
    if (region_) {
      const auto border = region_->closest_on_border(X_, least_);
      if (border.distance <= least_) {
        best_ = border;
        least_ = border.distance;
      }
    }
    for (size_t k = 0; k < part_.pieces.size(); ++k) {
      const Box<3>& box = part_.pieces[k].box;
      const Vec<3> outside = (box.lower - X_).cwiseMax(X_ - box.upper).cwiseMax(0.0);
      order.push_back({outside.norm(), int(k)});
    }
    std::sort(order.begin(), order.end());
    for (const auto& [bound, k] : order)
      if (!hopeless(bound)) search(part_.pieces[k]);
    for (int step = 0; step < 3 && polish(); ++step) {
    }
    return best_;
  }

 private:
  // Nothing better than the best point by more than the tolerance.
  bool hopeless(double bound) const {
    if (std::isinf(best_.distance)) return bound > least_;
    return bound >= least_ - 1e-14 * (least_ + size_);
  }

  Vec4* coefficients(int k) { return &scratch_.coefficients[size_t(k + 1) * n_]; }
  const Vec4* whole() const { return scratch_.coefficients.data(); }

  void reserve(int n_patches) {
    if (int(scratch_.patches.size()) < n_patches) scratch_.patches.resize(n_patches);
    if (scratch_.coefficients.size() < size_t(n_patches + 1) * n_)
      scratch_.coefficients.resize(size_t(n_patches + 1) * n_);
  }

  void search(const BezierPiece<2, 3>& piece) {
    piece_ = &piece;
    n_ = int(piece.weights.size());
    reserve(1);
    for (int i = 0; i < n_; ++i) {
      const double w = piece.weights[i];
      scratch_.coefficients[i] << w * (piece.points.col(i) - X_), w;
    }
    std::copy(whole(), whole() + n_, coefficients(0));
    rational_ = piece.weights.minCoeff() < piece.weights.maxCoeff();
    scratch_.patches[0] = {Vec<2>::Zero(), Vec<2>::Ones(), Vec<2>::Ones(), 0, hull_bound(coefficients(0))};
    if (rational_) balance(scratch_.patches[0], coefficients(0));
    for (int n = 1, n_patches = 0; n > 0;) {
      const Patch patch = scratch_.patches[n - 1];
      if (hopeless(patch.bound) || patch.halvings > max_halvings ||
          ++n_patches > max_patches || finish(patch, coefficients(n - 1))) {
        --n;
        continue;
      }
      split(patch, split_at_, n);
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

  // Replaces patch n - 1 by its quarters about t.
  void split(const Patch& patch, const Vec<2>& t, int n) {
    reserve(n + 3);
    const auto halve = [&](int from, int axis, int to) {
      Vec4* c = coefficients(from);
      detail::split_patch<4>(c, piece_->degree.data(), axis, t[axis], coefficients(to), c);
    };
    const int i = n - 1;
    halve(i, 0, n);
    halve(i, 1, n + 1);
    halve(n, 1, n + 2);
    const int upper_u[4] = {1, 0, 1, 0}, upper_v[4] = {1, 1, 0, 0};
    const Vec<2> middle = parameter(patch, t);
    for (int k = 0; k < 4; ++k) {
      Patch& child = scratch_.patches[i + k];
      child = patch;
      ++child.halvings;
      for (int a = 0; a < 2; ++a) {
        const bool upper = a == 0 ? upper_u[k] : upper_v[k];
        const double r = patch.ratio[a];
        (upper ? child.lower : child.upper)[a] = middle[a];
        child.ratio[a] = upper ? r / (r + (1 - t[a]) * (1 - r)) : 1 - t[a] * (1 - r);
      }
      child.bound = std::max(patch.bound, hull_bound(coefficients(i + k)));
      if (rational_) balance(child, coefficients(i + k));
    }
  }

  // s at t.
  static Vec<2> parameter(const Patch& patch, const Vec<2>& t) {
    const Vec<2> along = patch.ratio.cwiseProduct(t);
    return patch.lower + (patch.upper - patch.lower).cwiseProduct(along.cwiseQuotient(Vec<2>::Ones() - t + along));
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

  // ds/dt at s.
  static Vec<2> speed(const Patch& patch, const Vec<2>& s) {
    const Vec<2> size = patch.upper - patch.lower;
    Vec<2> speed = size;
    for (int a = 0; a < 2; ++a) {
      if (patch.ratio[a] == 1 || !(size[a] > 0)) continue;
      const double share = (s[a] - patch.lower[a]) / size[a], r = patch.ratio[a];
      speed[a] *= (share + r * (1 - share)) * (share + r * (1 - share)) / r;
    }
    return speed;
  }

  // Makes the products of the weights at both ends of each axis equal.
  void balance(Patch& patch, Vec4* c) const {
    const int p[2] = {piece_->degree[0], piece_->degree[1]}, stride[2] = {1, p[0] + 1};
    for (int a = 0; a < 2; ++a) {
      const int across = stride[1 - a] * p[1 - a], along = stride[a] * p[a];
      const double begin = c[0][3] * c[across][3], end = c[along][3] * c[along + across][3];
      if (begin == end) continue;
      const double factor = std::pow(begin / end, 0.5 / p[a]);
      patch.ratio[a] *= factor;
      for (int j = 0; j <= p[1 - a]; ++j) {
        double power = 1;
        for (int i = 1; i <= p[a]; ++i) c[j * stride[1 - a] + i * stride[a]] *= power *= factor;
      }
    }
  }

  // Distance of the plane across the direction of the patch's middle.
  double hull_bound(const Vec4* c) const {
    const int p = piece_->degree[0];
    Vec<3> direction = Vec<3>::Zero();
    for (int corner : {0, p, n_ - 1 - p, n_ - 1}) direction += c[corner].head<3>() / c[corner][3];
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_; ++i) least = std::min(least, direction.dot(c[i].head<3>()) / c[i][3]);
    return least > 0 ? least / direction.norm() : 0;
  }

  // True if no point of the patch is better than the best one now known; else split_at_ is set.
  bool finish(const Patch& patch, const Vec4* c) {
    int where = 0;
    const double least = scratch_.bounds.set(c, piece_->degree, part_.power != nullptr, where);
    if (hopeless(std::sqrt(std::max(0.0, least)))) return true;
    const Overlap overlap = region_ ? region_->overlap(global(patch.lower), global(patch.upper)) : Overlap::all;
    if (overlap == Overlap::none) return true;
    const int p = 2 * piece_->degree[0], q = 2 * piece_->degree[1];
    const Vec<2> share(double(where % (p + 1)) / p, double(where / (p + 1)) / q);
    const Descent found = descend(parameter(patch, share), patch);
    split_at_ = split_at(patch, found.s);
    return hopeless(bound_from_minimum(patch, found)) ||
           (overlap == Overlap::some && scratch_.bounds.at_most_one_stationary(std::max(0.0, least), least_ * least_));
  }

  struct Jet {
    Vec<3> offset;  // C - X
    double weight;
    Eigen::Matrix<double, 3, 2> first;
    Vec<3> second[3];  // uu, uv, vv
  };

  // A local minimum on a patch; `fixed` where it is held by a side of the patch.
  struct Descent {
    Vec<2> s, gradient;  // of half the squared distance
    bool fixed[2];
    Jet jet;
  };

  // Lower bound of the distance from a minimum m of its square. If f = q - m v
  // is convex, f >= g.d + (a d_u^2 - 2 c |d_u d_v| + b d_v^2) / 2 with its
  // gradient g at the minimum and bounds a, b, c of its second derivatives:
  // nothing on the patch is closer than by rounding. Else by what f may fall over the whole patch.
  double bound_from_minimum(const Patch& patch, const Descent& found) {
    const double m = found.jet.offset.squaredNorm();
    const auto [uu, vv, uv, least_v, largest_v] = scratch_.bounds.curvature(m);
    Vec<2> g = 2 * largest_v * found.gradient.cwiseProduct(speed(patch, found.s)).cwiseAbs();
    for (int a = 0; a < 2; ++a)
      if (found.fixed[a]) g[a] = 0;  // f rises from this side of the patch
    // Where the patch is thin along an axis, f's curvature along it may be all rounding: there |d| <= 1.
    const double flat_u = g[0] + std::max(0.0, -uu) / 2, flat_v = g[1] + std::max(0.0, -vv) / 2;
    double slack = flat_u + flat_v + uv;
    if (uu > 0) slack = std::min(slack, flat_v + (g[0] + uv) * (g[0] + uv) / (2 * uu));
    if (vv > 0) slack = std::min(slack, flat_u + (g[1] + uv) * (g[1] + uv) / (2 * vv));
    const double determinant = uu * vv - uv * uv;
    if (uu > 0 && vv > 0 && determinant > 1e-6 * uu * vv)
      slack = std::min(slack, 0.5 * (vv * g[0] * g[0] + 2 * uv * g[0] * g[1] + uu * g[1] * g[1]) / determinant);
    return std::sqrt(std::max(0.0, m - slack / least_v));
  }

  // w (C - X), w and their derivatives u, v, uu, uv, vv.
  void evaluate_powers(const Vec<2>& s, Vec4* A) const {
    const detail::PowerForm& power = *part_.power;
    const double* coefficients = power.coefficient + (piece_ - part_.pieces.data()) * power.stride;
    const double local[2] = {2 * s[0] - 1, 2 * s[1] - 1};
    alignas(32) double jets[24];
    detail::kernels->surface_second_jets(power, coefficients, local, jets);
    const Vec<3> R = X_ - Eigen::Map<const Vec<3>>(coefficients);
    constexpr double scale[6] = {1, 2, 2, 4, 4, 4};
    for (int m = 0; m < 6; ++m) {
      A[m] = scale[m] * Eigen::Map<const Vec4>(jets + 4 * m);
      A[m].head<3>() -= A[m][3] * R;
    }
  }

  void evaluate_bernstein(const Vec<2>& s, Vec4* A) const {
    double B[2][3][max_nurbs_functions];
    for (int a = 0; a < 2; ++a)
      detail::bernstein_basis(piece_->degree[a], s[a], 2, max_nurbs_functions, B[a][0]);
    constexpr int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    for (int m = 0; m < 6; ++m) A[m].setZero();
    const Vec4* c = whole();
    for (int j = 0; j <= piece_->degree[1]; ++j) {
      Vec4 row[3] = {Vec4::Zero(), Vec4::Zero(), Vec4::Zero()};
      for (int k = 0; k <= piece_->degree[0]; ++k, ++c)
        for (int t = 0; t < 3; ++t) row[t] += B[0][t][k] * *c;
      for (int m = 0; m < 6; ++m) A[m] += B[1][order[m][1]][j] * row[order[m][0]];
    }
  }

  Jet evaluate(const Vec<2>& s) const {
    Vec4 A[6];
    part_.power ? evaluate_powers(s, A) : evaluate_bernstein(s, A);
    Jet jet;
    jet.weight = A[0][3];
    const double inverse = 1 / jet.weight;
    for (auto& derivative : A) derivative *= inverse;
    jet.offset = A[0].head<3>();
    for (int a = 0; a < 2; ++a) jet.first.col(a) = A[1 + a].head<3>() - A[1 + a][3] * jet.offset;
    for (int m = 0; m < 3; ++m) {
      const int a = m == 2 ? 1 : 0, b = m == 0 ? 0 : 1;
      jet.second[m] = A[3 + m].head<3>() - A[1 + a][3] * jet.first.col(b) -
                      A[1 + b][3] * jet.first.col(a) - A[3 + m][3] * jet.offset;
    }
    return jet;
  }

  // Newton with Gauss-Newton as a fallback, kept inside the patch.
  Descent descend(const Vec<2>& start, const Patch& patch) {
    Descent at;
    at.s = start;
    at.jet = evaluate(at.s);
    const auto differentiate = [&] {
      at.gradient = at.jet.first.transpose() * at.jet.offset;
      for (int a = 0; a < 2; ++a)
        at.fixed[a] = (at.s[a] <= patch.lower[a] && at.gradient[a] >= 0) ||
                      (at.s[a] >= patch.upper[a] && at.gradient[a] <= 0);
    };
    differentiate();
    for (int iteration = 0; iteration < 40; ++iteration) {
      const Jet& jet = at.jet;
      Mat<2> normal = jet.first.transpose() * jet.first;
      const double damping = 1e-14 * normal.trace() + 1e-300;
      normal.diagonal().array() += damping;
      Mat<2> hessian = normal;
      hessian(0, 0) += jet.offset.dot(jet.second[0]);
      hessian(1, 1) += jet.offset.dot(jet.second[2]);
      hessian(0, 1) = hessian(1, 0) += jet.offset.dot(jet.second[1]);
      const bool* fixed = at.fixed;
      const bool convex = (fixed[0] || hessian(0, 0) > 0) && (fixed[1] || hessian(1, 1) > 0) &&
                          (fixed[0] || fixed[1] || hessian.determinant() > 0);
      const Vec<2> step = solve(convex ? hessian : normal, at.gradient, fixed);
      const double old = jet.offset.squaredNorm();
      const double least_length = 1e-13 / (1e-300 + step.cwiseAbs().maxCoeff());
      double length = 1;
      Vec<2> next;
      Jet there;
      for (; length == 1 || length > least_length; length *= 0.5) {
        next = (at.s - length * step).cwiseMax(patch.lower).cwiseMin(patch.upper);
        there = evaluate(next);
        if (there.offset.squaredNorm() <= old) break;
      }
      if (there.offset.squaredNorm() > old) break;
      const double moved = (next - at.s).cwiseAbs().maxCoeff();
      at.s = next;
      at.jet = there;
      differentiate();
      // Newton squares the error, and the distance's is its square again; see polish().
      if (moved < (convex && length == 1 ? 1e-5 : 1e-15)) break;
    }
    offer(at.s, at.jet.offset);
    return at;
  }

  // One of Newton's steps at the best point: distances cannot tell the foot better than to the
  // square root of their rounding. False if there is nothing to gain.
  bool polish() {
    if (!best_piece_) return false;
    piece_ = best_piece_;
    const Jet jet = evaluate(best_s_);
    const Vec<2> gradient = jet.first.transpose() * jet.offset;
    Mat<2> hessian = jet.first.transpose() * jet.first;
    hessian(0, 0) += jet.offset.dot(jet.second[0]);
    hessian(1, 1) += jet.offset.dot(jet.second[2]);
    hessian(0, 1) = hessian(1, 0) += jet.offset.dot(jet.second[1]);
    bool fixed[2];
    for (int a = 0; a < 2; ++a)
      fixed[a] = (best_s_[a] == 0 && gradient[a] >= 0) || (best_s_[a] == 1 && gradient[a] <= 0);
    if (!(fixed[0] || hessian(0, 0) > 0) || !(fixed[1] || hessian(1, 1) > 0) ||
        !(fixed[0] || fixed[1] || hessian.determinant() > 0))
      return false;
    const Vec<2> step = solve(hessian, gradient, fixed);
    const double length = step.cwiseAbs().maxCoeff();
    if (!(length > 1e-16 && length < 1e-4)) return false;
    const Vec<2> next = (best_s_ - step).cwiseMax(0.0).cwiseMin(1.0);
    if (region_ && !region_->contains(global(next))) return false;
    const Vec<3> offset = evaluate(next).offset;
    if (!(offset.norm() <= best_.distance + 1e-15 * (best_.distance + size_))) return false;
    set_best(next, offset);
    return length > 1e-9;
  }

  static Vec<2> solve(const Mat<2>& A, const Vec<2>& b, const bool* fixed) {
    if (fixed[0] && fixed[1]) return Vec<2>::Zero();
    if (fixed[0]) return {0, b[1] / A(1, 1)};
    if (fixed[1]) return {b[0] / A(0, 0), 0};
    return A.inverse() * b;
  }

  void offer(const Vec<2>& s, const Vec<3>& offset) {
    const double distance = offset.norm();
    if (!(distance <= least_) || distance == best_.distance) return;
    if (region_ && !region_->contains(global(s))) return;
    least_ = distance;
    set_best(s, offset);
  }

  void set_best(const Vec<2>& s, const Vec<3>& offset) {
    best_piece_ = piece_;
    best_s_ = s;
    best_.distance = offset.norm();
    best_.point = X_ + offset;
    best_.u = global(s);
  }

  // The part's parameters at s of the piece.
  Param<2> global(const Vec<2>& s) const {
    Param<2> u;
    for (int a = 0; a < 2; ++a)
      u[a] = s[a] == 1 ? piece_->upper[a] : piece_->lower[a] + s[a] * (piece_->upper[a] - piece_->lower[a]);
    return u;
  }

  const PreparedNurbs<2, 3>& part_;
  const Region<2, 3>* region_;  // null: all of the part
  const Vec<3> X_;
  Scratch& scratch_;
  double least_, size_;
  ClosestPoint<3> best_;
  const BezierPiece<2, 3>*piece_ = nullptr, *best_piece_ = nullptr;
  Vec<2> best_s_, split_at_;
  int n_ = 0;
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
