#include "src2d/picture/outline.h"

#include <algorithm>

#include "sem/nurbs/basis.h"

namespace sem {
namespace {

constexpr int points_per_piece = 32;  // a quarter of a circle deviates by 1/3300 of its radius

Vec<2> first_point(const PreparedNurbs<1, 2>& part) { return part.pieces.front().points.col(0); }
Vec<2> last_point(const PreparedNurbs<1, 2>& part) {
  const auto& points = part.pieces.back().points;
  return points.col(points.cols() - 1);
}

}  // namespace

Outline::Outline(const Discretization<2>& discretization) {
  const auto& boundary = discretization.boundary;
  for (int i = 0; i < boundary.n_parts(); ++i)
    curves_.push_back(sample(boundary.parts[i], boundary.first_control[i]));
  const auto& loops = discretization.loops.loops;
  for (const auto& outer : loops) {
    if (outer.depth % 2 == 1) continue;
    WalkRegion region{outer.solid, {walk(discretization, outer)}};
    const int o = int(&outer - loops.data());
    for (const auto& hole : loops)
      if (hole.solid == outer.solid && hole.depth == outer.depth + 1 &&
          inside_loop(boundary, discretization.loops, o,
                      first_point(boundary.parts[hole.parts[0]])))
        region.walks.push_back(walk(discretization, hole));
    regions_.push_back(std::move(region));
  }
}

Outline::Curve Outline::sample(const PreparedNurbs<1, 2>& part, int first_control) {
  Curve curve;
  curve.row = {0};
  BasisValues<1> basis;
  const int n = part.nurbs.degree[0] == 1 ? 1 : points_per_piece;
  for (size_t piece = 0; piece < part.pieces.size(); ++piece)
    for (int k = piece == 0 ? 0 : 1; k <= n; ++k) {
      const double s = double(k) / n;
      const Param<1> u = (1 - s) * part.pieces[piece].lower + s * part.pieces[piece].upper;
      evaluate_basis(part.nurbs, u, 0, basis);
      for (size_t e = 0; e < basis.column.size(); ++e) {
        curve.column.push_back(first_control + basis.column[e]);
        curve.value.push_back(basis.value[e]);
      }
      curve.row.push_back(int(curve.column.size()));
    }
  return curve;
}

// The parts stand in their order along the loop, the first one forward. The next begins where the
// last one ends, or at the other end of the cap that closes the gap between them.
Outline::Walk Outline::walk(const Discretization<2>& discretization, const Loop<2>& loop) {
  const auto& parts = discretization.boundary.parts;
  Walk walk;
  auto cap = loop.caps.begin();
  Vec<2> entry = first_point(parts[loop.parts[0]]);
  for (const int part : loop.parts) {
    const bool backward = first_point(parts[part]) != entry;
    walk.push_back({part, backward});
    entry = backward ? first_point(parts[part]) : last_point(parts[part]);
    if (cap == loop.caps.end()) continue;
    const auto& closure = discretization.loops.caps[*cap];
    if (first_point(closure) != entry) continue;
    entry = last_point(closure);
    ++cap;
  }
  return walk;
}

Polyline Outline::part(int part, const Points<2>& p) const {
  const Curve& curve = curves_[part];
  Polyline line(curve.row.size() - 1, Vec<2>::Zero());
  for (size_t k = 0; k < line.size(); ++k)
    for (int e = curve.row[k]; e < curve.row[k + 1]; ++e)
      line[k] += curve.value[e] * p.col(curve.column[e]);
  return line;
}

Polyline Outline::loop(const Walk& walk, const Points<2>& p) const {
  Polyline all;
  for (const auto& [index, backward] : walk) {
    Polyline line = part(index, p);
    if (backward) std::reverse(line.begin(), line.end());
    all.insert(all.end(), line.begin(), line.end());
  }
  return all;
}

std::vector<Outline::Region> Outline::regions(const Points<2>& p) const {
  std::vector<Region> result;
  for (const auto& region : regions_) {
    auto& loops = result.emplace_back(Region{region.solid, {}}).loops;
    for (const auto& walk : region.walks) loops.push_back(loop(walk, p));
  }
  return result;
}

}  // namespace sem
