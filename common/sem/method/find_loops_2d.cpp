#include <algorithm>
#include <map>
#include <numeric>

#include "sem/method/find_loops.h"
#include "sem/nurbs/bezier_curve.h"

namespace sem::detail {
namespace {

struct End {
  int part;
  bool last;  // the curve's last point, else its first
  Vec<2> position;
};

Vec<2> last_point(const BezierPiece<1, 2>& piece) { return piece.points.col(piece.points.cols() - 1); }

std::vector<End> open_ends(const Boundary<2>& boundary, int solid) {
  std::vector<End> ends;
  for (int i = 0; i < boundary.n_parts(); ++i) {
    if (boundary.solid[i] != solid) continue;
    const auto& pieces = boundary.parts[i].pieces;
    ends.push_back({i, false, pieces.front().points.col(0)});
    ends.push_back({i, true, last_point(pieces.back())});
  }
  return ends;
}

// Partner of every end: the closest pair first, ties by index.
std::vector<int> match_ends(const std::vector<End>& ends) {
  struct Pair {
    double distance;
    int a, b;
  };
  std::vector<Pair> pairs;
  for (int a = 0; a < int(ends.size()); ++a)
    for (int b = a + 1; b < int(ends.size()); ++b)
      pairs.push_back({(ends[a].position - ends[b].position).norm(), a, b});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& x, const Pair& y) { return x.distance < y.distance; });
  std::vector<int> partner(ends.size(), -1);
  for (const Pair& pair : pairs)
    if (partner[pair.a] < 0 && partner[pair.b] < 0) {
      partner[pair.a] = pair.b;
      partner[pair.b] = pair.a;
    }
  return partner;
}

// Closes the loop straight from one point to another, also where they differ by rounding only.
void add_cap(const Vec<2>& from, const Vec<2>& to, Loop<2>& loop, Loops<2>& all) {
  if (from == to) return;
  loop.caps.push_back(int(all.caps.size()));
  all.caps.push_back(prepare(segment<2>(from, to)));
  all.cap_length.push_back((to - from).norm());
}

}  // namespace

template <>
Loops<2> join_parts<2>(const Boundary<2>& boundary) {
  Loops<2> result;
  for (int solid = 0; solid < boundary.n_solids; ++solid) {
    const std::vector<End> ends = open_ends(boundary, solid);
    const std::vector<int> partner = match_ends(ends);
    std::vector<bool> visited(ends.size(), false);
    for (int start = 0; start < int(ends.size()); start += 2) {
      if (visited[start]) continue;
      Loop<2> loop;
      loop.solid = solid;
      // Leave each part by the other of its ends until the loop closes.
      for (int e = start; !visited[e]; e = partner[e ^ 1]) {
        visited[e] = visited[e ^ 1] = true;
        loop.parts.push_back(ends[e].part);
        const auto& pieces = boundary.parts[ends[e].part].pieces;
        for (size_t k = 0; k + 1 < pieces.size(); ++k)  // a part may jump at a knot
          add_cap(last_point(pieces[k]), pieces[k + 1].points.col(0), loop, result);
        add_cap(ends[e ^ 1].position, ends[partner[e ^ 1]].position, loop, result);
      }
      result.loops.push_back(std::move(loop));
    }
  }
  return result;
}

}  // namespace sem::detail
