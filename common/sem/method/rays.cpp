#include "sem/method/rays.h"

#include <algorithm>
#include <cmath>

#include "sem/base/error.h"
#include "sem/base/parallel.h"
#include "sem/method/edge_hits.h"
#include "sem/method/line_rules.h"

namespace sem {
namespace {

// What a crossing on a ray belongs to.
struct Crossing {
  double t;
  int loop;
  int cap;  // index of the cap, -1: a part
};

// Drops the last crossing of every loop that is crossed an odd number of times.
bool drop_unpaired(std::vector<Crossing>& crossings, int n_loops) {
  std::vector<int> count(n_loops, 0);
  for (const auto& crossing : crossings) ++count[crossing.loop];
  bool any = false;
  for (auto it = crossings.rbegin(); it != crossings.rend();) {
    if (count[it->loop] % 2 == 1) {
      count[it->loop] = 0;
      it = std::make_reverse_iterator(crossings.erase(std::next(it).base()));
      any = true;
    } else {
      ++it;
    }
  }
  return any;
}

template <int Dim>
class RayCaster {
 public:
  RayCaster(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int axis)
      : boundary_(boundary), loops_(loops), axis_(axis), loop_of_part_(boundary.n_parts()),
        loop_of_cap_(loops.caps.size()) {
    for (int l = 0; l < int(loops.loops.size()); ++l) {
      for (const int part : loops.loops[l].parts) loop_of_part_[part] = l;
      for (const int cap : loops.loops[l].caps) loop_of_cap_[cap] = l;
    }
  }

  // Fills the ray's hits and intervals. A ray through an edge that parts share is cast a little beside
  // it: by 1e-8 of the model, then by more, on both sides; its intervals are the mean.
  void cast(Ray<Dim>& ray, bool& unpaired, double& capped_length) const {
    const Vec<Dim> origin = ray.origin;
    double aside = 0;
    bool sure = cast_beside(ray, origin, 0, unpaired, capped_length);
    for (int attempt = 0; attempt < 4 && !sure; ++attempt) {
      aside = attempt == 0 ? 1e-8 * boundary_.box.diagonal() : 5 * aside;
      sure = cast_beside(ray, origin, aside, unpaired, capped_length);
    }
    if (aside == 0) return;
    Ray<Dim> other = ray;
    bool other_unpaired = false;
    double other_length = 0;
    if (!cast_beside(other, origin, -aside, other_unpaired, other_length) || other_unpaired ||
        other.intervals.size() != ray.intervals.size())
      return;
    for (size_t k = 0; k < ray.intervals.size(); ++k) {
      ray.intervals[k].begin = (ray.intervals[k].begin + other.intervals[k].begin) / 2;
      ray.intervals[k].end = (ray.intervals[k].end + other.intervals[k].end) / 2;
    }
  }

 private:
  // False if a hit is in doubt.
  bool cast_beside(Ray<Dim>& ray, const Vec<Dim>& origin, double aside, bool& unpaired,
                   double& capped_length) const {
    std::vector<Crossing> crossings;
    for (int a = 0; a < Dim; ++a)
      if (a != axis_) ray.origin[a] = origin[a] + aside / (1.7 + 3.1 * a);
    const bool sure = collect_all(ray, crossings);
    ray.origin = origin;
    ray.intervals.clear();
    capped_length = 0;
    std::stable_sort(ray.hits.begin(), ray.hits.end(),
                     [](const RayHit& a, const RayHit& b) { return a.t < b.t; });
    std::stable_sort(crossings.begin(), crossings.end(),
                     [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
    unpaired = drop_unpaired(crossings, int(loops_.loops.size()));
    unite(crossings, ray, capped_length);
    return sure;
  }

  // False if a hit is in doubt.
  bool collect_all(Ray<Dim>& ray, std::vector<Crossing>& crossings) const {
    ray.hits.clear();
    crossings.clear();
    bool sure = true;
    for (int i = 0; i < boundary_.n_parts(); ++i)
      sure &= collect(boundary_.parts[i], i, loop_of_part_[i], -1, ray, crossings);
    for (int c = 0; c < int(loops_.caps.size()); ++c)
      sure &= collect(loops_.caps[c], boundary_.n_parts() + c, loop_of_cap_[c], c, ray, crossings);
    return sure;
  }

  bool collect(const PreparedNurbs<Dim - 1, Dim>& shape, int index, int loop, int cap, Ray<Dim>& ray,
               std::vector<Crossing>& crossings) const {
    for (int a = 0; a < Dim; ++a)
      if (a != axis_ && (ray.origin[a] < shape.box.lower[a] || ray.origin[a] > shape.box.upper[a]))
        return true;
    thread_local std::vector<Hit<Dim>> hits;
    hits.clear();
    const double infinity = std::numeric_limits<double>::infinity();
    append_hits(shape, Line<Dim>{ray.origin, Vec<Dim>::Unit(axis_)}, -infinity, infinity, hits);
    bool sure = true;
    for (const auto& hit : hits) {
      sure &= !is_in_doubt(shape, hit);
      ray.hits.push_back({hit.t, index, hit.crosses});
      if (hit.crosses) crossings.push_back({hit.t, loop, cap});
    }
    return sure;
  }

  // The first solid whose deepest loop around the present place has even depth, -1: outside.
  int solid_here(const std::vector<char>& in_loop) const {
    int best = -1;
    std::vector<int> deepest(boundary_.n_solids, -1);
    for (size_t l = 0; l < in_loop.size(); ++l)
      if (in_loop[l])
        deepest[loops_.loops[l].solid] = std::max(deepest[loops_.loops[l].solid], loops_.loops[l].depth);
    for (int s = boundary_.n_solids - 1; s >= 0; --s)
      if (deepest[s] >= 0 && deepest[s] % 2 == 0) best = s;
    return best;
  }

  void unite(const std::vector<Crossing>& crossings, Ray<Dim>& ray, double& capped_length) const {
    const auto is_gap = [&](const Crossing& c) {
      return c.cap >= 0 && loops_.cap_length[c.cap] > boundary_.tolerance();
    };
    const double rounding = 1e-12 * boundary_.box.diagonal();  // a part and the cap that closes it
    std::vector<char> in_loop(loops_.loops.size(), 0);
    for (size_t k = 0; k + 1 < crossings.size(); ++k) {
      in_loop[crossings[k].loop] ^= 1;
      const double begin = crossings[k].t, end = crossings[k + 1].t;
      const int solid = solid_here(in_loop);
      if (solid < 0 || !(end - begin > rounding)) continue;
      if (is_gap(crossings[k]) || is_gap(crossings[k + 1])) capped_length += end - begin;
      if (!ray.intervals.empty() && ray.intervals.back().end == begin &&
          ray.intervals.back().solid == solid)
        ray.intervals.back().end = end;
      else
        ray.intervals.push_back({begin, end, solid});
    }
  }

  const Boundary<Dim>& boundary_;
  const Loops<Dim>& loops_;
  int axis_;
  std::vector<int> loop_of_part_, loop_of_cap_;
};

// Rays at the tensor product of a line rule over the transverse extents of the box.
template <int Dim>
std::vector<Ray<Dim>> ray_grid(const Box<Dim>& box, const RayOptions& options) {
  const LineRule rule = options.grid == RayGrid::gauss ? gauss_legendre(options.n_rays)
                                                            : midpoint_rule(options.n_rays);
  int n = 1;
  for (int a = 0; a < Dim - 1; ++a) n *= options.n_rays;
  std::vector<Ray<Dim>> rays(n);
  for (int k = 0; k < n; ++k) {
    rays[k].origin = Vec<Dim>::Zero();
    rays[k].weight = 1;
    int rest = k;
    for (int a = 0; a < Dim; ++a) {
      if (a == options.axis) continue;
      const double half = (box.upper[a] - box.lower[a]) / 2;
      rays[k].origin[a] = (box.upper[a] + box.lower[a]) / 2 + half * rule.node[rest % options.n_rays];
      rays[k].weight *= half * rule.weight[rest % options.n_rays];
      rest /= options.n_rays;
    }
  }
  return rays;
}

}  // namespace

template <int Dim>
void cast(const Boundary<Dim>& boundary, const Loops<Dim>& loops, Rays<Dim>& rays, int n_threads) {
  const RayCaster<Dim> caster(boundary, loops, rays.axis);
  const int n = int(rays.rays.size());
  std::vector<char> unpaired(n, 0);
  std::vector<double> capped(n, 0);
  parallel_for(n, n_threads, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      bool doubt = false;
      caster.cast(rays.rays[k], doubt, capped[k]);
      unpaired[k] = doubt;
    }
  });
  for (int k = 0; k < n; ++k) {
    rays.n_unpaired += unpaired[k];
    rays.capped_length += capped[k] * rays.rays[k].weight;
  }
}

template <int Dim>
Rays<Dim> cast_rays(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                    const RayOptions& options, int n_threads) {
  if (options.n_rays < 1)
    throw InputError("", "method.quadrature.rays", std::to_string(options.n_rays), "at least 1");
  if (options.axis < 0 || options.axis >= Dim)
    throw InputError("", "method.quadrature.axis", std::to_string(options.axis),
                     std::string("one of the axes ") + DimTraits<Dim>::axis_name);
  Rays<Dim> result;
  result.axis = options.axis;
  result.rays = ray_grid(boundary.box, options);
  cast(boundary, loops, result, n_threads);
  return result;
}

template void cast<2>(const Boundary<2>&, const Loops<2>&, Rays<2>&, int);
template void cast<3>(const Boundary<3>&, const Loops<3>&, Rays<3>&, int);
template Rays<2> cast_rays<2>(const Boundary<2>&, const Loops<2>&, const RayOptions&, int);
template Rays<3> cast_rays<3>(const Boundary<3>&, const Loops<3>&, const RayOptions&, int);

}  // namespace sem
