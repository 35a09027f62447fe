#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sem/method/find_loops.h"
#include "sem/method/edge_hits.h"
#include "sem/nurbs/closest.h"

namespace sem::detail {
namespace {

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

constexpr double near = 0.05;  // of an edge's length: what is as close to it faces it across a gap

// An edge of a patch: points along it, ends included.
struct Edge {
  std::vector<Vec<3>> points;
  double length() const {
    double sum = 0;
    for (size_t k = 1; k < points.size(); ++k) sum += (points[k] - points[k - 1]).norm();
    return sum;
  }
};

// The edges of a part (trimmed ones: its trims) but those that are a point.
std::vector<Edge> edges_of(const PreparedNurbs<2, 3>& part, double tolerance) {
  std::vector<Edge> edges;
  if (part.region) {
    for (const auto& border : part.region->borders()) edges.push_back({border});
  } else {
    constexpr int n = 9;
    const Interval range[2] = {domain(part.nurbs, 0), domain(part.nurbs, 1)};
    for (int axis = 0; axis < 2; ++axis)
      for (const double end : {range[1 - axis].lower, range[1 - axis].upper}) {
        auto& points = edges.emplace_back().points;
        for (int k = 0; k < n; ++k) {
          const double s = double(k) / (n - 1);
          Param<2> u;
          u[axis] = (1 - s) * range[axis].lower + s * range[axis].upper;
          u[1 - axis] = end;
          points.push_back(point(part, u));
        }
      }
  }
  std::erase_if(edges, [&](const Edge& edge) { return edge.length() <= tolerance; });
  return edges;
}

bool is_near(const Box<3>& box, const Vec<3>& X, double distance) {
  return (box.lower - X).cwiseMax(X - box.upper).maxCoeff() <= distance;
}

// Distance of X to an edge of the part, infinity above the cutoff.
double distance_to_edge(const PreparedNurbs<2, 3>& part, const Vec<3>& X, double cutoff, double share) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!is_near(part.box, X, cutoff)) return infinity;
  const auto foot = closest_point(part, X, 2 * cutoff);
  return foot.distance <= cutoff && on_border(part, foot.u, share) ? foot.distance : infinity;
}

class ShellFinder {
 public:
  explicit ShellFinder(const Boundary<3>& boundary)
      : boundary_(boundary), parent_(boundary.n_parts()), tolerance_(boundary.tolerance()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const auto& part : boundary.parts) edges_.push_back(edges_of(part, tolerance_));
  }

  Loops<3> find() {
    for (int i = 0; i < boundary_.n_parts(); ++i)
      for (int j = 0; j < i; ++j)
        if (may_join(i, j) && (touches(i, j) || touches(j, i))) join(i, j);
    join_across_gaps();
    Loops<3> loops = loops_of_groups();
    for (auto& loop : loops.loops) measure_gaps(loop, loops);
    return loops;
  }

 private:
  bool may_join(int i, int j) {
    return boundary_.solid[i] == boundary_.solid[j] && root(parent_, i) != root(parent_, j);
  }
  void join(int i, int j) { parent_[root(parent_, i)] = root(parent_, j); }

  // True if a corner of the one lies on an edge of the other: shells grow across shared edges, also of unequal
  // patches, but not where two faces merely lie in each other.
  bool touches(int i, int j) const {
    for (const auto& edge : edges_[i])
      for (const Vec<3>& X : {edge.points.front(), edge.points.back()})
        if (distance_to_edge(boundary_.parts[j], X, tolerance_, 1e-6) <= tolerance_) return true;
    return false;
  }

  // The same for shells that have free edges, across gaps.
  void join_across_gaps() {
    const auto shells = loops_of_groups().loops;
    std::vector<std::vector<const Edge*>> free;
    for (const auto& shell : shells) free.push_back(free_edges(shell.parts));
    for (size_t a = 0; a < shells.size(); ++a)
      for (size_t b = 0; b < shells.size(); ++b)
        if (a != b && !free[b].empty() && may_join(shells[a].parts[0], shells[b].parts[0]) &&
            std::any_of(free[a].begin(), free[a].end(), [&](const Edge* edge) { return faces(*edge, shells[b].parts); }))
          join(shells[a].parts[0], shells[b].parts[0]);
  }

  std::vector<const Edge*> free_edges(const std::vector<int>& parts) const {
    std::vector<const Edge*> free;
    for (const int i : parts)
      for (size_t e = 0; e < edges_[i].size(); ++e)
        if (largest_distance(parts, i, int(e), tolerance_) > tolerance_) free.push_back(&edges_[i][e]);
    return free;
  }

  // True if the edge runs along edges of the parts, at least for half of its way: edges that cross do not count.
  bool faces(const Edge& edge, const std::vector<int>& parts) const {
    const double limit = near * edge.length();
    const auto n = std::count_if(edge.points.begin(), edge.points.end(), [&](const Vec<3>& X) {
      return std::any_of(parts.begin(), parts.end(), [&](int j) {
        return distance_to_edge(boundary_.parts[j], X, limit, near) <= limit;
      });
    });
    return 2 * n >= std::ssize(edge.points);
  }

  // Of the inner points of edge e of part i, the one farthest from the other parts and from the part's own edge
  // that runs alike (at a seam); infinity above the cutoff.
  double largest_distance(const std::vector<int>& parts, int i, int e, double cutoff) const {
    const auto& points = edges_[i][e].points;
    double largest = 0;
    for (size_t k = 1; k + 1 < points.size(); ++k) {
      double least = std::numeric_limits<double>::infinity();
      const auto try_distance = [&](double d) {
        if (d <= cutoff) least = std::min(least, d);
      };
      for (int other = 0; other < int(edges_[i].size()); ++other) {
        if (other == e) continue;
        const auto& alike = edges_[i][other].points;
        for (const Vec<3>& Y : {alike[k], alike[alike.size() - 1 - k]}) try_distance((points[k] - Y).norm());
      }
      for (const int j : parts)
        if (j != i && is_near(boundary_.parts[j].box, points[k], cutoff))
          try_distance(closest_point(boundary_.parts[j], points[k], 2 * cutoff).distance);
      largest = std::max(largest, least);
    }
    return largest;
  }

  void measure_gaps(Loop<3>& loop, Loops<3>& loops) const {
    for (const int i : loop.parts)
      for (size_t e = 0; e < edges_[i].size(); ++e) {
        const double widest = largest_distance(loop.parts, i, int(e), near * edges_[i][e].length());
        if (std::isinf(widest)) {
          ++loop.n_free_borders;
        } else if (widest > tolerance_) {
          loop.gap = std::max(loop.gap, widest);
          ++loops.n_gaps;
        }
      }
    loops.n_free_borders += loop.n_free_borders;
    loops.longest_gap = std::max(loops.longest_gap, loop.gap);
  }

  Loops<3> loops_of_groups() {
    Loops<3> result;
    std::vector<int> loop_of_root(boundary_.n_parts(), -1);
    for (int i = 0; i < boundary_.n_parts(); ++i) {
      int& loop = loop_of_root[root(parent_, i)];
      if (loop < 0) {
        loop = int(result.loops.size());
        result.loops.emplace_back().solid = boundary_.solid[i];
      }
      result.loops[loop].parts.push_back(i);
    }
    return result;
  }

  const Boundary<3>& boundary_;
  std::vector<int> parent_;
  double tolerance_;
  std::vector<std::vector<Edge>> edges_;  // of each part
};

}  // namespace

template <>
Loops<3> join_parts<3>(const Boundary<3>& boundary) {
  return ShellFinder(boundary).find();
}

}  // namespace sem::detail
