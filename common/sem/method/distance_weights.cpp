#include "sem/method/distance_weights.h"

#include <algorithm>
#include <cmath>

#include "sem/base/error.h"
#include "sem/base/parallel.h"
#include "sem/method/near_parts.h"
#include "sem/method/sided_weight.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"

namespace sem {
namespace {

template <int Dim>
struct Pair {
  int part;
  double closest, reach;
  Vec<Dim> foot;
  Param<Dim - 1> foot_u;
  int hit_part;
  Param<Dim - 1> hit_u = Param<Dim - 1>::Zero();
  double side = 1;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int Dim>
class Meter {
 public:
  Meter(const Boundary<Dim>& boundary, const Loops<Dim>& loops, DistanceWeight variant,
        double max_distance)
      : boundary_(boundary), loops_(loops), variant_(variant), max_distance_(max_distance),
        near_(boundary, std::max(max_distance, boundary.tolerance())),
        closed_loop_(boundary.n_parts(), -1) {
    if (variant == DistanceWeight::distance_only || variant == DistanceWeight::sided) return;
    for (int l = 0; l < int(loops.loops.size()); ++l) {
      const auto& loop = loops.loops[l];
      bool closed = loop.parts.size() == 1 && loop.closed();
      for (const int cap : loop.caps) closed &= loops.cap_length[cap] <= boundary.tolerance();
      if (closed) closed_loop_[loop.parts[0]] = l;
    }
  }

  // All pairs of X that can have theta > 0.
  void measure(const Vec<Dim>& X, std::vector<Pair<Dim>>& pairs) const {
    pairs.clear();
    bool on_boundary = false;
    near_.visit(X, [&](int i) {
      const bool enclosed = closed_loop_[i] >= 0 && inside_loop(boundary_, loops_, closed_loop_[i], X);
      const auto closest = closest_point(boundary_.parts[i], X, enclosed ? infinity : max_distance_);
      const bool on_part = closest.distance <= boundary_.tolerance();
      on_boundary |= on_part;
      if (!on_part && !enclosed && !(closest.distance < max_distance_)) return;
      pairs.push_back({i, on_part || enclosed ? 0 : closest.distance, infinity, closest.point,
                       closest.u, on_part ? i : -1});
    });
    if (variant_ == DistanceWeight::sided) {
      for (auto& pair : pairs) find_side(X, pair);
      return;
    }
    if (variant_ == DistanceWeight::distance_only) {
      for (auto& pair : pairs) pair.hit_part = -1;
      return;
    }
    if (on_boundary) {
      std::erase_if(pairs, [](const auto& pair) { return pair.hit_part != pair.part; });
      for (auto& pair : pairs) pair.hit_part = -1;
      return;
    }
    for (auto& pair : pairs)
      if (pair.closest > 0) shoot(X, pair);
    std::erase_if(pairs, [&](const auto& pair) { return !(pair.closest < pair.reach); });
  }

 private:
  void find_side(const Vec<Dim>& X, Pair<Dim>& pair) const {
    pair.hit_part = -1;
    const int outward = loops_.orientation[pair.part];
    if (pair.closest == 0 || outward == 0) return;
    const Vec<Dim> normal = unit_normal(boundary_.parts[pair.part].nurbs, pair.foot_u);
    pair.side = -outward * normal.dot(X - pair.foot) / pair.closest;
  }

  // The ray from X* through X: reach and the part that is hit.
  void shoot(const Vec<Dim>& X, Pair<Dim>& pair) const {
    const double joint = 1e-7 * boundary_.box.diagonal();
    const bool draft = variant_ == DistanceWeight::draft;
    // The draft's variant looks from X on, the published one from X*.
    const double t_min = draft ? pair.closest - boundary_.tolerance() : joint;
    const Line<Dim> line{pair.foot, (X - pair.foot) / pair.closest};
    thread_local std::vector<Hit<Dim>> hits;
    double t_max = draft ? pair.closest + max_distance_ : max_distance_;
    for (int j = 0; j < boundary_.n_parts(); ++j) {
      if (j == pair.part) continue;
      hits.clear();
      append_hits(boundary_.parts[j], line, t_min, t_max, hits);
      for (const auto& hit : hits) {
        if (hit.t <= joint || hit.t >= t_max) continue;
        t_max = hit.t;
        pair.reach = draft ? std::max(0.0, hit.t - pair.closest) : hit.t;
        pair.hit_part = j;
        pair.hit_u = hit.u;
      }
    }
  }

  const Boundary<Dim>& boundary_;
  const Loops<Dim>& loops_;
  DistanceWeight variant_;
  double max_distance_;
  NearParts<Dim> near_;
  std::vector<int> closed_loop_;  // the loop that the part is alone, -1
};

// alpha that lies below exactly the wanted number of pairs' distances, as far as there are so many.
template <int Dim>
double cutoff_of_sparsity(const Distances<Dim>& distances, double share) {
  std::vector<double> closest = distances.closest;
  std::sort(closest.begin(), closest.end());
  const double all = double(distances.n_points) * distances.n_parts;
  const size_t wanted = size_t(std::llround(share * all));
  if (closest.empty() || wanted >= closest.size()) {
    const double largest = closest.empty() ? 0 : closest.back();
    return largest > 0 ? 2 * largest : 1;
  }
  const double below = wanted == 0 ? 0 : closest[wanted - 1];
  const double middle = (below + closest[wanted]) / 2;
  return middle > 0 ? middle : std::numeric_limits<double>::min();
}

}  // namespace

template <int Dim>
Distances<Dim> measure_distances(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                 const Points<Dim>& position, DistanceWeight variant,
                                 double max_distance, int n_threads) {
  const int n = int(position.cols());
  const Meter<Dim> meter(boundary, loops, variant, max_distance);
  std::vector<std::vector<Pair<Dim>>> rows(n);
  parallel_for(n, n_threads, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) meter.measure(position.col(k), rows[k]);
  });
  Distances<Dim> distances;
  distances.variant = variant;
  distances.n_points = n;
  distances.n_parts = boundary.n_parts();
  distances.outward = loops.orientation;
  distances.begin.push_back(0);
  for (const auto& row : rows) {
    for (const auto& pair : row) {
      distances.part.push_back(pair.part);
      distances.closest.push_back(pair.closest);
      distances.reach.push_back(pair.reach);
      distances.foot.push_back(pair.foot);
      distances.foot_u.push_back(pair.foot_u);
      distances.hit_part.push_back(pair.hit_part);
      distances.hit_u.push_back(pair.hit_u);
      if (variant == DistanceWeight::sided) distances.side.push_back(pair.side);
    }
    distances.begin.push_back(int(distances.part.size()));
  }
  return distances;
}

template <int Dim>
DistanceWeights<Dim> distance_weights(const Distances<Dim>& distances, const WeightOptions& options) {
  if (options.sparsity && !(*options.sparsity > 0 && *options.sparsity <= 1))
    throw InputError("", "method.weights.sparsity", std::to_string(*options.sparsity),
                     "a share in (0, 1]");
  if (!options.sparsity && !(options.cutoff > 0))
    throw InputError("", "method.weights.cutoff", std::to_string(options.cutoff),
                     "a positive length");
  if (!(options.side_ramp > 0 && options.side_ramp <= 1))
    throw InputError("", "method.weights.side_ramp", std::to_string(options.side_ramp), "a number in (0, 1]");
  DistanceWeights<Dim> weights;
  weights.n_parts = distances.n_parts;
  weights.side_ramp = options.side_ramp;
  weights.cutoff =
      options.sparsity ? cutoff_of_sparsity(distances, *options.sparsity) : options.cutoff;
  weights.begin.push_back(0);
  for (int k = 0; k < distances.n_points; ++k) {
    for (int e = distances.begin[k]; e < distances.begin[k + 1]; ++e) {
      const double t = distances.closest[e] / std::min(distances.reach[e], weights.cutoff);
      const double theta = distances.variant == DistanceWeight::sided
                               ? distance_profile(t).value * side_step(distances.side[e], options.side_ramp).value
                               : 1 - t;
      if (!(theta > 0)) continue;
      weights.part.push_back(distances.part[e]);
      weights.theta.push_back(theta);
      weights.piece.push_back(distances.reach[e] < weights.cutoff ? distances.hit_part[e] : -1);
    }
    weights.begin.push_back(int(weights.part.size()));
  }
  return weights;
}

#define SEM_INSTANTIATE(Dim)                                                                     \
  template Distances<Dim> measure_distances<Dim>(const Boundary<Dim>&, const Loops<Dim>&,        \
                                                 const Points<Dim>&, DistanceWeight, double,     \
                                                 int);                                           \
  template DistanceWeights<Dim> distance_weights<Dim>(const Distances<Dim>&, const WeightOptions&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
