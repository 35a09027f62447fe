#include "src3d/render/trimmed.h"

#include <algorithm>

namespace sem::render {
namespace {

using Surface = PreparedNurbs<2, 3>;

constexpr int least_cells = 48;

// A corner of what is left of a cell.
struct Corner {
  Param<2> u;
  bool cut;   // on the region's border, else a corner of the cell
  bool ends;  // the next side runs along the border
};

// What the region leaves of the cells of a grid on each piece.
class Cutter {
 public:
  explicit Cutter(const Surface& surface) : surface_(surface) {
    for (const int axis : {0, 1}) domain_[axis] = domain(surface.nurbs, axis);
  }

  // Calls visit(corners in order) for every cell of which something is left.
  template <class Visit>
  void visit_cells(const BezierPiece<2, 3>& piece, int n, const Visit& visit) const {
    const Param<2> size = (piece.upper - piece.lower) / n;
    const auto at = [&](int i, int j) {
      return Param<2>(i == n ? piece.upper[0] : piece.lower[0] + i * size[0],
                      j == n ? piece.upper[1] : piece.lower[1] + j * size[1]);
    };
    std::vector<char> in;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) in.push_back(surface_.region->contains(at(i, j)));
    std::vector<Corner> corners;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Param<2> u[] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        const int first = i + j * (n + 1);
        const bool inside[] = {bool(in[first]), bool(in[first + 1]), bool(in[first + n + 2]),
                               bool(in[first + n + 1])};
        cut(u, inside, corners);
        if (corners.size() > 2) visit(corners);
      }
  }

 private:
  void cut(const Param<2> (&u)[4], const bool (&inside)[4], std::vector<Corner>& corners) const {
    corners.clear();
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      const bool ends = on_end(u[k], u[next]);
      if (inside[k]) corners.push_back({u[k], false, ends});
      if (inside[k] != inside[next]) {
        const bool leaves = inside[k];
        corners.push_back({crossing(u[k], u[next], leaves), true, leaves || ends});
      }
    }
  }

  // Where the side from a to b crosses the border.
  Param<2> crossing(Param<2> a, Param<2> b, bool leaves) const {
    for (int k = 0; k < 30; ++k) {
      const Param<2> middle = (a + b) / 2;
      (surface_.region->contains(middle) == leaves ? a : b) = middle;
    }
    return leaves ? a : b;
  }

  bool on_end(const Param<2>& a, const Param<2>& b) const {
    for (const int axis : {0, 1})
      for (const double end : {domain_[axis].lower, domain_[axis].upper})
        if (a[axis] == end && b[axis] == end) return true;
    return false;
  }

  const Surface& surface_;
  Interval domain_[2];
};

// Enough for the piece without trims.
int cells_a_side(const Surface& surface, const BezierPiece<2, 3>& piece, const Flatness& flatness) {
  int n = std::max(least_cells, flatness.least_cells);
  const auto X = [&](double s, double t) {
    return point(surface,
                 Param<2>(piece.lower + Param<2>(s, t).cwiseProduct(piece.upper - piece.lower)));
  };
  const auto sag = [&] {  // of the sides of the cells along both diagonals
    double worst = 0;
    for (int k = 0; k < n; ++k)
      for (const bool up : {true, false}) {
        const double s = double(k) / n, e = (k + 1.0) / n, m = (s + e) / 2;
        const auto y = [&](double t) { return up ? t : 1 - t; };
        worst = std::max(worst, (X(m, y(m)) - (X(s, y(s)) + X(e, y(e))) / 2).norm());
      }
    return worst;
  };
  while (n < 128 && sag() > flatness.distance) n *= 2;
  return n;
}

}  // namespace

Mesh tessellate_trimmed(const Surface& surface, const Flatness& flatness) {
  Mesh mesh;
  const Cutter cutter(surface);
  for (const auto& piece : surface.pieces)
    cutter.visit_cells(piece, cells_a_side(surface, piece, flatness),
                       [&](const std::vector<Corner>& corners) {
                         const int base = int(mesh.position.size());
                         for (const auto& corner : corners) {
                           mesh.position.push_back(point(surface, corner.u));
                           mesh.normal.push_back(unit_normal(surface, corner.u));
                           mesh.uv.push_back(corner.u);
                         }
                         for (int k = 1; k + 1 < int(corners.size()); ++k)
                           mesh.triangles.push_back({base, base + k, base + k + 1});
                       });
  return mesh;
}

std::vector<Chain> trimmed_outline(const Surface& surface) {
  std::vector<Chain> chains;
  const Cutter cutter(surface);
  for (const auto& piece : surface.pieces)
    cutter.visit_cells(piece, least_cells, [&](const std::vector<Corner>& corners) {
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Corner &a = corners[k], &b = corners[(k + 1) % corners.size()];
        if (a.ends) chains.push_back({point(surface, a.u), point(surface, b.u)});
      }
    });
  return chains;
}

}  // namespace sem::render
