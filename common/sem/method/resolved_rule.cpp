#include "sem/method/resolved_rule.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sem/base/error.h"
#include "sem/method/critical_values.h"
#include "sem/method/line_rules.h"

namespace sem {
namespace {

// Changes of cells that mirror each other differ by rounding alone. They are told apart from others, so
// that the cells do not depend on it.
constexpr double change_tie = 1e-6;

// A box in the coordinates sigma of the cells, [0, 1] each: across the rays (Dim - 1), then along.
template <int Dim>
struct Patch {
  int block = 0, interval = 0;  // between which critical values; which of a ray's intervals
  std::array<double, Dim> lower{}, upper{};
  std::array<int, Dim> depth{};
};

// A patch with its rule and integrals.
template <int Dim>
struct Piece {
  Patch<Dim> patch;
  Points<Dim> position;
  Eigen::VectorXd weight;
  std::vector<int> solid;
  Eigen::VectorXd integral;
};

// A leaf of the subdivision: its rule, and the two halves across its worst direction.
template <int Dim>
struct Leaf {
  Piece<Dim> whole;
  std::array<Piece<Dim>, 2> halves;
  double error = 0;       // the largest change by halving
  bool refinable = true;  // false: halved as often as allowed
};

// t^2 (3 - 2 t) takes a square root at either end, as a chord has it at an extremum, to a smooth
// function.
double bend(double t) { return t * t * (3 - 2 * t); }
double bend_slope(double t) { return 6 * t * (1 - t); }

template <int Dim>
class Refiner {
 public:
  Refiner(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
          const IndicatorsAt<Dim>& indicators, const ResolvedOptions& options, int n_threads)
      : boundary_(boundary),
        loops_(loops),
        indicators_(indicators),
        options_(options),
        n_threads_(n_threads),
        rule_(gauss_legendre(options.points)) {
    for (int b = 0; b < Dim - 1; ++b) across_[b] = (options.axis + 1 + b) % Dim;
  }

  ResolvedRule<Dim> run() {
    add_leaves(integrate(first_patches()));
    ResolvedRule<Dim> result;
    while (true) {
      double total = 0, error = 0, stuck = 0;
      size_t n_points = 0;
      bool refinable = false;
      for (const auto& leaf : leaves_) {
        total += leaf.whole.integral.sum();
        (leaf.refinable ? error : stuck) += leaf.error;
        n_points += leaf.whole.weight.size();
        refinable |= leaf.refinable;
      }
      result.error = total > 0 ? (error + stuck) / total : 0;
      result.reached = error + stuck <= options_.tolerance * total;
      const bool few = int(n_points) < options_.min_points;
      if (!refinable || (error <= options_.tolerance * total && !few)) break;
      if (int(n_points) > options_.max_points) break;
      refine(error);
    }
    collect(result);
    return result;
  }

 private:
  // The blocks between critical values, and in each as many intervals as any ray there has.
  std::vector<Patch<Dim>> first_patches() {
    std::array<std::vector<double>, Dim - 1> cuts;
    int n_blocks = 1;
    for (int b = 0; b < Dim - 1; ++b) {
      cuts[b] = critical_values<Dim>(boundary_, loops_, options_.axis, across_[b]);
      n_blocks *= std::max(0, int(cuts[b].size()) - 1);
    }
    std::vector<Patch<Dim>> patches;
    for (int block = 0; block < n_blocks; ++block) {
      Box<Dim> box;
      box.lower.setZero();
      box.upper.setZero();
      for (int b = 0, rest = block; b < Dim - 1; ++b) {
        const int n = int(cuts[b].size()) - 1;
        box.lower[across_[b]] = cuts[b][rest % n];
        box.upper[across_[b]] = cuts[b][rest % n + 1];
        rest /= n;
      }
      blocks_.push_back(box);
      Patch<Dim> patch;
      patch.block = block;
      patch.upper.fill(1);
      size_t n_intervals = 0;
      for (const auto& ray : cast_through({patch}).rays)
        n_intervals = std::max(n_intervals, ray.intervals.size());
      for (patch.interval = 0; patch.interval < int(n_intervals); ++patch.interval)
        patches.push_back(patch);
    }
    return patches;
  }

  // Rays through the transverse Gauss points of every patch, with the area (length) they stand for.
  Rays<Dim> cast_through(const std::vector<Patch<Dim>>& patches) const {
    Rays<Dim> rays;
    rays.axis = options_.axis;
    const int n = int(rule_.node.size());
    const int per_patch = int(std::lround(std::pow(n, Dim - 1)));
    for (const auto& patch : patches) {
      const auto& box = blocks_[patch.block];
      for (int r = 0; r < per_patch; ++r) {
        Ray<Dim> ray;
        ray.origin.setZero();
        ray.weight = 1;
        for (int b = 0, rest = r; b < Dim - 1; ++b, rest /= n) {
          const double width = (patch.upper[b] - patch.lower[b]) / 2;
          const double sigma = patch.lower[b] + width * (1 + rule_.node[rest % n]);
          const double size = box.upper[across_[b]] - box.lower[across_[b]];
          ray.origin[across_[b]] = box.lower[across_[b]] + size * bend(sigma);
          ray.weight *= size * bend_slope(sigma) * width * rule_.weight[rest % n];
        }
        rays.rays.push_back(ray);
      }
    }
    cast(boundary_, loops_, rays, n_threads_);
    return rays;
  }

  // The rules of the patches and their integrals.
  std::vector<Piece<Dim>> integrate(const std::vector<Patch<Dim>>& patches) const {
    const Rays<Dim> rays = cast_through(patches);
    const int n = int(rule_.node.size());
    const size_t per_patch = patches.empty() ? 0 : rays.rays.size() / patches.size();
    std::vector<Piece<Dim>> pieces(patches.size());
    std::vector<Vec<Dim>> all;
    for (size_t p = 0; p < patches.size(); ++p) {
      Piece<Dim>& piece = pieces[p];
      piece.patch = patches[p];
      std::vector<double> weight;
      const size_t first = all.size();
      for (size_t r = p * per_patch; r < (p + 1) * per_patch; ++r) {
        const Ray<Dim>& ray = rays.rays[r];
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
    size_t point = 0;
    for (auto& piece : pieces) {
      piece.integral = Eigen::VectorXd::Zero(values.n);
      for (int k = 0; k < piece.weight.size(); ++k, ++point)
        for (int e = values.begin[point]; e < values.begin[point + 1]; ++e)
          piece.integral[values.index[e]] += piece.weight[k] * values.value[e];
    }
    return pieces;
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
    for (size_t p = 0; p < wholes.size(); ++p) {
      Leaf<Dim> leaf;
      leaf.whole = std::move(wholes[p]);
      int worst = -1;
      double best = -1;
      for (int axis = 0; axis < Dim; ++axis) {
        const auto& a = pieces[2 * (Dim * p + axis)];
        const auto& b = pieces[2 * (Dim * p + axis) + 1];
        const double change = (a.integral + b.integral - leaf.whole.integral).cwiseAbs().sum();
        if (change > leaf.error) leaf.error = change;
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

  const Boundary<Dim>& boundary_;
  const Loops<Dim>& loops_;
  const IndicatorsAt<Dim>& indicators_;
  ResolvedOptions options_;
  int n_threads_;
  LineRule rule_;
  std::array<int, Dim - 1> across_;
  std::vector<Box<Dim>> blocks_;
  std::vector<Leaf<Dim>> leaves_;
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
