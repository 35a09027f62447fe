#include "sem/method/loops.h"

#include "sem/method/find_loops.h"
#include "sem/nurbs/basis.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"

namespace sem {
namespace {

// Directions that no edge is likely to share, spread evenly over all (3D: turned by the golden angle).
template <int Dim>
Vec<Dim> generic_direction(int k, int n) {
  Vec<Dim> direction;
  for (int a = 0; a < Dim; ++a) direction[a] = 1 / std::sqrt(1.7 + 3.1 * a);
  if (k > 0) {
    const double height = 1 - 2.0 * k / n, angle = 2.399963229728653 * k;
    direction[0] = std::sqrt(1 - height * height) * std::cos(angle);
    direction[1] = std::sqrt(1 - height * height) * std::sin(angle);
    direction[Dim - 1] = height;
  }
  return direction.normalized();
}

template <int Dim>
int count_crossings(const PreparedNurbs<Dim - 1, Dim>& shape, const Line<Dim>& line) {
  thread_local std::vector<Hit<Dim>> hits;
  hits.clear();
  append_hits(shape, line, 0, std::numeric_limits<double>::infinity(), hits);
  int n = 0;
  for (const auto& hit : hits) n += hit.crosses;
  return n;
}

}  // namespace

template <int Dim>
bool inside_loop(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int l, const Vec<Dim>& X) {
  const Loop<Dim>& loop = loops.loops[l];
  const int n_lines = loop.closed() && loop.gap == 0 ? 1 : 9;
  int n_inside = 0;
  for (int k = 0; k < n_lines; ++k) {
    const Line<Dim> line{X, generic_direction<Dim>(k, n_lines)};
    int n = 0;
    for (const int part : loop.parts) n += count_crossings<Dim>(boundary.parts[part], line);
    for (const int cap : loop.caps) n += count_crossings<Dim>(loops.caps[cap], line);
    n_inside += n % 2;
  }
  return 2 * n_inside > n_lines;
}

namespace {

// Points on a part, some in each Bezier piece, away from its edges.
template <int Dim>
std::vector<Param<Dim - 1>> inner_parameters(const PreparedNurbs<Dim - 1, Dim>& part) {
  if (part.region) return part.region->rule(1).u;
  std::vector<Param<Dim - 1>> result;
  for (const auto& piece : part.pieces)
    for (const double s : {0.47, 0.19, 0.83})
      result.push_back(piece.lower + s * (piece.upper - piece.lower));
  return result;
}

// True if outer contains every point of inner that is not on outer's own parts.
template <int Dim>
bool contains(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int outer, int inner) {
  const double tolerance = boundary.tolerance();
  bool any = false;
  for (const int part : loops.loops[inner].parts)
    for (const auto& u : inner_parameters<Dim>(boundary.parts[part])) {
      const Vec<Dim> X = point(boundary.parts[part].nurbs, u);
      bool on_outer = false;
      for (const int other : loops.loops[outer].parts)
        on_outer |= closest_point(boundary.parts[other], X, 2 * tolerance).distance <= tolerance;
      if (on_outer) continue;
      if (!inside_loop(boundary, loops, outer, X)) return false;
      any = true;
    }
  return any;
}

// Which side of a part its own solid is on: +1 if its normal points outward. Steps become shorter, for
// solids thinner than they are.
template <int Dim>
int orientation(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int solid,
                const PreparedNurbs<Dim - 1, Dim>& part) {
  for (const double share : {1e-6, 1e-8, 1e-10, 1e-12})
    for (const auto& u : inner_parameters<Dim>(part)) {
      const auto at = derivatives(part.nurbs, u, 1);
      const Vec<Dim> normal = DimTraits<Dim>::area_normal(at.first).normalized();
      if (!normal.allFinite()) continue;
      const Vec<Dim> step = share * part.box.diagonal() * normal;
      const bool before = inside(boundary, loops, Vec<Dim>(at.point - step), solid);
      const bool behind = inside(boundary, loops, Vec<Dim>(at.point + step), solid);
      if (before != behind) return before ? 1 : -1;
    }
  return 0;
}

}  // namespace

template <int Dim>
bool inside(const Boundary<Dim>& boundary, const Loops<Dim>& loops, const Vec<Dim>& X, int solid) {
  for (int s = 0; s < boundary.n_solids; ++s) {
    if (solid >= 0 && s != solid) continue;
    int deepest = -1;
    for (int l = 0; l < int(loops.loops.size()); ++l)
      if (loops.loops[l].solid == s && loops.loops[l].depth > deepest &&
          inside_loop(boundary, loops, l, X))
        deepest = loops.loops[l].depth;
    if (deepest >= 0 && deepest % 2 == 0) return true;
  }
  return false;
}

template <int Dim>
Loops<Dim> find_loops(const Boundary<Dim>& boundary) {
  Loops<Dim> loops = detail::join_parts(boundary);
  const int n_loops = int(loops.loops.size());
  for (int inner = 0; inner < n_loops; ++inner)
    for (int outer = 0; outer < n_loops; ++outer)
      if (inner != outer && loops.loops[inner].solid == loops.loops[outer].solid &&
          contains(boundary, loops, outer, inner))
        ++loops.loops[inner].depth;
  for (int i = 0; i < boundary.n_parts(); ++i)
    loops.orientation.push_back(orientation(boundary, loops, boundary.solid[i], boundary.parts[i]));
  loops.cap_orientation.resize(loops.caps.size());
  for (const auto& loop : loops.loops)
    for (const int cap : loop.caps)
      loops.cap_orientation[cap] = orientation(boundary, loops, loop.solid, loops.caps[cap]);
  for (const double length : loops.cap_length) {
    loops.longest_gap = std::max(loops.longest_gap, length);
    loops.n_gaps += length > boundary.tolerance();
  }
  return loops;
}

template Loops<2> find_loops<2>(const Boundary<2>&);
template Loops<3> find_loops<3>(const Boundary<3>&);
template bool inside_loop<2>(const Boundary<2>&, const Loops<2>&, int, const Vec<2>&);
template bool inside_loop<3>(const Boundary<3>&, const Loops<3>&, int, const Vec<3>&);
template bool inside<2>(const Boundary<2>&, const Loops<2>&, const Vec<2>&, int);
template bool inside<3>(const Boundary<3>&, const Loops<3>&, const Vec<3>&, int);

}  // namespace sem
