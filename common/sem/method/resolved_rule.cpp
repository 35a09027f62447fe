#include "sem/method/resolved_rule.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sem/base/error.h"
#include "sem/method/line_rules.h"
#include "sem/method/ray_blocks.h"

namespace sem {
namespace {

// Changes of cells that mirror each other differ by rounding alone. They are told apart from others, so
// that the cells do not depend on it.
constexpr double change_tie = 1e-6;

// Of the mean integral: what is smaller need not be known as well.
constexpr double least_scale = 1e-4;

// A box in the coordinates sigma of the cells, [0, 1] each: across the rays (Dim - 1), then along.
template <int Dim>
struct Patch {
  int block = 0, interval = 0;  // which of a ray's intervals
  std::array<double, Dim> lower{}, upper{};
  std::array<int, Dim> depth{};
};

// A row of which few entries are not zero.
struct SparseRow {
  std::vector<int> index;
  std::vector<double> value;
};

// Where sparse rows are added up.
class RowSum {
 public:
  explicit RowSum(int n) : sum_(Eigen::VectorXd::Zero(n)), seen_(n, false) {}
  void add(int index, double value) {
    if (!seen_[index]) touched_.push_back(index);
    seen_[index] = true;
    sum_[index] += value;
  }
  void add(double factor, const SparseRow& row) {
    for (size_t e = 0; e < row.index.size(); ++e) add(row.index[e], factor * row.value[e]);
  }
  // The sum; starts from zero again.
  SparseRow take() {
    SparseRow row{std::move(touched_), {}};
    touched_.clear();
    std::sort(row.index.begin(), row.index.end());
    for (const int i : row.index) {
      row.value.push_back(sum_[i]);
      sum_[i] = 0;
      seen_[i] = false;
    }
    return row;
  }

 private:
  Eigen::VectorXd sum_;
  std::vector<bool> seen_;
  std::vector<int> touched_;
};

// A patch with its rule and the integrals of the indicators.
template <int Dim>
struct Piece {
  Patch<Dim> patch;
  Points<Dim> position;
  Eigen::VectorXd weight;
  std::vector<int> solid;
  SparseRow integral;
};

// A leaf of the subdivision: its rule, and the two halves across its worst direction.
template <int Dim>
struct Leaf {
  Piece<Dim> whole;
  std::array<Piece<Dim>, 2> halves;
  SparseRow change;       // of the integrals by halving across that direction, absolute
  double error = 0;       // the changes by the indicators' scales
  bool refinable = true;  // false: halved as often as allowed
};

template <int Dim>
class Refiner {
 public:
  Refiner(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
          const IndicatorsAt<Dim>& indicators, const ResolvedOptions& options, int n_threads)
      : blocks_(boundary, loops, options.axis, n_threads),
        indicators_(indicators),
        options_(options),
        rule_(gauss_legendre(options.points)) {}

  ResolvedRule<Dim> run() {
    auto first = integrate(first_patches());
    measure_scales(first);
    add_leaves(std::move(first));
    ResolvedRule<Dim> result;
    while (true) {
      double error = 0, stuck = 0;
      size_t n_points = 0;
      bool refinable = false;
      measure_scales(leaves_);
      for (auto& leaf : leaves_) {
        leaf.error = relative(leaf.change);
        (leaf.refinable ? error : stuck) += leaf.error;
        n_points += leaf.whole.weight.size();
        refinable |= leaf.refinable;
      }
      result.error = error + stuck;
      result.reached = result.error <= options_.tolerance;
      const bool few = int(n_points) < options_.min_points;
      if (!refinable || (error <= options_.tolerance && !few)) break;
      if (int(n_points) > options_.max_points) break;
      refine(error);
    }
    collect(result);
    return result;
  }

 private:
  // All blocks, each with as many intervals as any ray there has.
  std::vector<Patch<Dim>> first_patches() {
    std::vector<Patch<Dim>> whole(blocks_.size());
    for (int b = 0; b < blocks_.size(); ++b) {
      whole[b].block = b;
      whole[b].upper.fill(1);
    }
    const auto rays = cast_through(whole);
    const size_t per_patch = rays.size() / std::max<size_t>(1, whole.size());
    std::vector<Patch<Dim>> patches;
    for (size_t b = 0; b < whole.size(); ++b) {
      size_t n_intervals = 0;
      for (size_t r = b * per_patch; r < (b + 1) * per_patch; ++r)
        n_intervals = std::max(n_intervals, rays[r].intervals.size());
      for (whole[b].interval = 0; whole[b].interval < int(n_intervals); ++whole[b].interval)
        patches.push_back(whole[b]);
    }
    return patches;
  }

  // Rays through the transverse Gauss points of every patch, with the area (length) they stand for.
  std::vector<Ray<Dim>> cast_through(const std::vector<Patch<Dim>>& patches) {
    const int n = int(rule_.node.size());
    const int per_patch = int(std::lround(std::pow(n, Dim - 1)));
    std::vector<BlockRay<Dim>> rays;
    for (const auto& patch : patches)
      for (int r = 0; r < per_patch; ++r) {
        BlockRay<Dim> ray{patch.block, {}, 1};
        for (int b = 0, rest = r; b < Dim - 1; ++b, rest /= n) {
          const double width = (patch.upper[b] - patch.lower[b]) / 2;
          ray.at[b] = patch.lower[b] + width * (1 + rule_.node[rest % n]);
          ray.weight *= width * rule_.weight[rest % n];
        }
        rays.push_back(ray);
      }
    return blocks_.cast(rays);
  }

  // The rules of the patches and their integrals.
  std::vector<Piece<Dim>> integrate(const std::vector<Patch<Dim>>& patches) {
    const std::vector<Ray<Dim>> rays = cast_through(patches);
    const int n = int(rule_.node.size());
    const size_t per_patch = rays.size() / std::max<size_t>(1, patches.size());
    std::vector<Piece<Dim>> pieces(patches.size());
    std::vector<Vec<Dim>> all;
    for (size_t p = 0; p < patches.size(); ++p) {
      Piece<Dim>& piece = pieces[p];
      piece.patch = patches[p];
      std::vector<double> weight;
      const size_t first = all.size();
      for (size_t r = p * per_patch; r < (p + 1) * per_patch; ++r) {
        const Ray<Dim>& ray = rays[r];
        if (piece.patch.interval >= int(ray.intervals.size())) continue;
        const RayInterval& interval = ray.intervals[piece.patch.interval];
        const double length = interval.end - interval.begin;
        const double width = (piece.patch.upper[Dim - 1] - piece.patch.lower[Dim - 1]) / 2;
        for (int k = 0; k < n; ++k) {
          Vec<Dim> X = ray.origin;
          X[options_.axis] =
              interval.begin + length * (piece.patch.lower[Dim - 1] + width * (1 + rule_.node[k]));
          all.push_back(X);
          weight.push_back(ray.weight * length * width * rule_.weight[k]);
          piece.solid.push_back(interval.solid);
        }
      }
      piece.weight = Eigen::Map<const Eigen::VectorXd>(weight.data(), Eigen::Index(weight.size()));
      piece.position.resize(Dim, weight.size());
      for (size_t k = 0; k < weight.size(); ++k) piece.position.col(k) = all[first + k];
    }
    Points<Dim> position(Dim, all.size());
    for (size_t k = 0; k < all.size(); ++k) position.col(k) = all[k];
    const Indicators values = indicators_(position);
    scale_.resize(values.n);
    RowSum sum(values.n);
    size_t point = 0;
    for (auto& piece : pieces) {
      for (int k = 0; k < piece.weight.size(); ++k, ++point)
        for (int e = values.begin[point]; e < values.begin[point + 1]; ++e)
          sum.add(values.index[e], piece.weight[k] * values.value[e]);
      piece.integral = sum.take();
    }
    return pieces;
  }

  static const SparseRow& integral_of(const Piece<Dim>& piece) { return piece.integral; }
  static const SparseRow& integral_of(const Leaf<Dim>& leaf) { return leaf.whole.integral; }

  // What each indicator's changes count relative to, from pieces or leaves of all the solid.
  template <class Cells>
  void measure_scales(const Cells& cells) {
    std::fill(scale_.begin(), scale_.end(), 0);
    double sum = 0;
    for (const auto& cell : cells) {
      const SparseRow& row = integral_of(cell);
      for (size_t e = 0; e < row.index.size(); ++e) {
        scale_[row.index[e]] += row.value[e];
        sum += row.value[e];
      }
    }
    const auto n = double(scale_.size());
    for (double& scale : scale_) scale = n * std::max(scale, least_scale * sum / n);
  }

  double relative(const SparseRow& change) const {
    double sum = 0;
    for (size_t e = 0; e < change.index.size(); ++e)
      if (change.value[e] != 0) sum += std::abs(change.value[e]) / scale_[change.index[e]];
    return sum;
  }

  // Makes leaves: tries the halves across every direction and keeps those that change most.
  void add_leaves(std::vector<Piece<Dim>> wholes) {
    std::vector<Patch<Dim>> halves;
    for (const auto& whole : wholes)
      for (int axis = 0; axis < Dim; ++axis)
        for (const int side : {0, 1}) {
          Patch<Dim> half = whole.patch;
          const double middle = (half.lower[axis] + half.upper[axis]) / 2;
          (side == 0 ? half.upper : half.lower)[axis] = middle;
          ++half.depth[axis];
          halves.push_back(half);
        }
    auto pieces = integrate(halves);
    RowSum sum(int(scale_.size()));
    for (size_t p = 0; p < wholes.size(); ++p) {
      Leaf<Dim> leaf;
      leaf.whole = std::move(wholes[p]);
      int worst = -1;
      double best = -1;
      for (int axis = 0; axis < Dim; ++axis) {
        const auto& a = pieces[2 * (Dim * p + axis)];
        const auto& b = pieces[2 * (Dim * p + axis) + 1];
        sum.add(1, a.integral);
        sum.add(1, b.integral);
        sum.add(-1, leaf.whole.integral);
        SparseRow row = sum.take();
        const double change = relative(row);
        if (change > leaf.error || axis == 0) {
          leaf.error = change;
          leaf.change = std::move(row);
        }
        if (leaf.whole.patch.depth[axis] >= options_.max_depth || change <= (1 + change_tie) * best) continue;
        worst = axis;
        best = change;
      }
      leaf.refinable = worst >= 0;
      for (const int side : {0, 1})
        if (worst >= 0) leaf.halves[side] = std::move(pieces[2 * (Dim * p + worst) + side]);
      leaves_.push_back(std::move(leaf));
    }
  }

  // Halves the leaves that make up most of the error, with all that tie with the last one.
  void refine(double error) {
    std::vector<int> order(leaves_.size());
    for (size_t l = 0; l < order.size(); ++l) order[l] = int(l);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return leaves_[a].error != leaves_[b].error ? leaves_[a].error > leaves_[b].error : a < b;
    });
    double marked = 0, least = 0;
    std::vector<Piece<Dim>> halves;
    std::vector<bool> gone(leaves_.size(), false);
    for (const int l : order) {
      if (marked > 0.7 * error && leaves_[l].error < (1 - change_tie) * least) break;
      if (!leaves_[l].refinable) continue;
      marked += leaves_[l].error;
      least = leaves_[l].error;
      gone[l] = true;
      for (auto& half : leaves_[l].halves) halves.push_back(std::move(half));
    }
    std::vector<Leaf<Dim>> kept;
    for (size_t l = 0; l < leaves_.size(); ++l)
      if (!gone[l]) kept.push_back(std::move(leaves_[l]));
    leaves_ = std::move(kept);
    add_leaves(std::move(halves));
  }

  void collect(ResolvedRule<Dim>& result) const {
    Eigen::Index n = 0;
    for (const auto& leaf : leaves_) n += leaf.whole.weight.size();
    if (n == 0)
      throw InputError("", "solids", "no interior on any ray", "parts that enclose an interior");
    auto& q = result.quadrature;
    q.position.resize(Dim, n);
    q.weight.resize(n);
    n = 0;
    for (const auto& leaf : leaves_) {
      const auto& whole = leaf.whole;
      q.position.middleCols(n, whole.weight.size()) = whole.position;
      q.weight.segment(n, whole.weight.size()) = whole.weight;
      q.solid.insert(q.solid.end(), whole.solid.begin(), whole.solid.end());
      n += whole.weight.size();
    }
    result.n_cells = int(leaves_.size());
  }

  RayBlocks<Dim> blocks_;
  const IndicatorsAt<Dim>& indicators_;
  ResolvedOptions options_;
  LineRule rule_;
  std::vector<Leaf<Dim>> leaves_;
  std::vector<double> scale_;  // per indicator: its integral, times their number
};

}  // namespace

template <int Dim>
ResolvedRule<Dim> resolved_rule(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                const IndicatorsAt<Dim>& indicators, const ResolvedOptions& options,
                                int n_threads) {
  return Refiner<Dim>(boundary, loops, indicators, options, n_threads).run();
}

#define SEM_INSTANTIATE(Dim)                                                                      \
  template ResolvedRule<Dim> resolved_rule<Dim>(const Boundary<Dim>&, const Loops<Dim>&,          \
                                                const IndicatorsAt<Dim>&, const ResolvedOptions&, \
                                                int);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
