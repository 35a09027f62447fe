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

std::vector<Vec<3>> corners(const PreparedNurbs<2, 3>& part) {
  if (part.region) return part.region->corners();
  const int nu = n_control(part.nurbs, 0), nv = n_control(part.nurbs, 1);
  std::vector<Vec<3>> result;
  for (const int corner : {0, nu - 1, nu * (nv - 1), nu * nv - 1}) result.push_back(part.nurbs.control_points.col(corner));
  return result;
}

// True if a corner of one patch lies on an edge of the other: shells grow across shared edges, also of
// unequal patches, but not where two faces merely lie in each other.
bool touch(const Boundary<3>& boundary, int i, int j) {
  const double tolerance = boundary.tolerance();
  for (const auto& [a, b] : {std::pair{i, j}, std::pair{j, i}})
    for (const Vec<3>& X : corners(boundary.parts[a])) {
      const auto foot = closest_point(boundary.parts[b], X, 2 * tolerance);
      if (foot.distance <= tolerance && on_border(boundary.parts[b], foot.u, 1e-6)) return true;
    }
  return false;
}

}  // namespace

// Shells: patches that share a corner belong together (trimmed ones: an end of a trim curve). Gaps between patches
// are not capped; rays count what they cannot pair.
template <>
Loops<3> join_parts<3>(const Boundary<3>& boundary) {
  std::vector<int> parent(boundary.n_parts());
  std::iota(parent.begin(), parent.end(), 0);
  for (int i = 0; i < boundary.n_parts(); ++i)
    for (int j = 0; j < i; ++j)
      if (boundary.solid[i] == boundary.solid[j] && root(parent, i) != root(parent, j) &&
          touch(boundary, i, j))
        parent[root(parent, i)] = root(parent, j);
  Loops<3> result;
  std::vector<int> loop_of_root(boundary.n_parts(), -1);
  for (int i = 0; i < boundary.n_parts(); ++i) {
    int& loop = loop_of_root[root(parent, i)];
    if (loop < 0) {
      loop = int(result.loops.size());
      result.loops.push_back({boundary.solid[i], {}, {}, 0});
    }
    result.loops[loop].parts.push_back(i);
  }
  return result;
}

}  // namespace sem::detail
