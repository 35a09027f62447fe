#include "src3d/render/tessellate.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sem::render {
namespace {

using Surface = PreparedNurbs<2, 3>;
using Piece = BezierPiece<2, 3>;

constexpr int most_cells = 128;

Param<2> at(const Piece& piece, double s, double t) {
  return {piece.lower[0] + s * (piece.upper[0] - piece.lower[0]),
          piece.lower[1] + t * (piece.upper[1] - piece.lower[1])};
}

double distance_to_segment(const Vec<3>& X, const Vec<3>& a, const Vec<3>& b) {
  const Vec<3> d = b - a;
  const double square = d.squaredNorm();
  const double t = square > 0 ? std::clamp((X - a).dot(d) / square, 0.0, 1.0) : 0;
  return (X - a - t * d).norm();
}

// Straight segments that a line of the piece needs: its points, checked between the ends of each.
int cells_along(const std::function<Vec<3>(double)>& X, const Flatness& flatness, double share) {
  for (int n = 1; n < most_cells; n *= 2) {
    double worst = 0, turn = 1;
    Vec<3> last = Vec<3>::Zero();
    for (int k = 0; k < n; ++k) {
      const Vec<3> a = X(double(k) / n), b = X((k + 1.0) / n);
      for (const double s : {0.25, 0.5, 0.75})
        worst = std::max(worst, distance_to_segment(X((k + s) / n), a, b));
      const Vec<3> direction = (b - a).stableNormalized();
      if (k > 0 && (b - a).norm() > flatness.distance) turn = std::min(turn, last.dot(direction));
      last = direction;
    }
    // A single segment shows no turn: its middle does.
    if (n == 1) {
      const Vec<3> a = X(0), m = X(0.5), b = X(1);
      if ((b - a).norm() > flatness.distance || (m - a).norm() > flatness.distance)
        turn = (m - a).stableNormalized().dot((b - m).stableNormalized());
    }
    if (worst <= share * flatness.distance && turn >= std::cos(flatness.max_turn)) return n;
  }
  return most_cells;
}

// Cells of a piece along both directions such that its lines and the twist of its cells keep to the
// tolerance.
std::array<int, 2> cells_of(const Surface& surface, const Piece& piece, const Flatness& flatness) {
  std::array<int, 2> n = {flatness.least_cells, flatness.least_cells};
  constexpr int n_lines = 9;
  for (int k = 0; k < n_lines; ++k) {
    const double other = double(k) / (n_lines - 1);
    const auto along_u = [&](double s) { return point(surface, at(piece, s, other)); };
    const auto along_v = [&](double s) { return point(surface, at(piece, other, s)); };
    n[0] = std::max(n[0], cells_along(along_u, flatness, 0.45));
    n[1] = std::max(n[1], cells_along(along_v, flatness, 0.45));
  }
  const auto twist = [&] {
    double worst = 0;
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const auto X = [&](double a, double b) {
          return point(surface, at(piece, (i + a) / n[0], (j + b) / n[1]));
        };
        worst = std::max(worst, distance_to_segment(X(0.5, 0.5), X(0, 0), X(1, 1)));
      }
    return worst;
  };
  while (twist() > 0.9 * flatness.distance && std::min(n[0], n[1]) < most_cells)
    for (int& count : n) count = std::min(2 * count, most_cells);
  return n;
}

// A grid on a piece: parameters (u fastest), cells along u and v.
struct PieceGrid {
  std::vector<Param<2>> u;
  int n_u = 1, n_v = 1;
};

// The piece's four edges: which parameter runs, the value of the other one.
struct Edge {
  int axis;
  int side;
};
constexpr Edge edges[] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};

Param<2> on_edge(const Piece& piece, const Edge& edge, double s) {
  return edge.axis == 0 ? at(piece, s, edge.side) : at(piece, edge.side, s);
}

// Moves the grid's vertices on an edge to the chain with the edge's own number of segments.
void straighten(const Surface& surface, const Piece& piece, const Edge& edge, const PieceGrid& grid,
                const Flatness& flatness, Vec<3>* X) {
  const auto line = [&](double s) { return point(surface, on_edge(piece, edge, s)); };
  const int n = edge.axis == 0 ? grid.n_u : grid.n_v,
            n_edge = std::min(n, std::max(flatness.least_cells, cells_along(line, flatness, 0.45))),
            step = n / n_edge;
  const int stride = edge.axis == 0 ? 1 : grid.n_u + 1,
            first = edge.axis == 0 ? edge.side * grid.n_v * (grid.n_u + 1) : edge.side * grid.n_u;
  for (int k = 0; k < n; k += step)
    for (int i = 1; i < step; ++i) {
      const Vec<3>&a = X[first + k * stride], &b = X[first + (k + step) * stride];
      X[first + (k + i) * stride] = a + double(i) / step * (b - a);
    }
}

PieceGrid grid_of(const Surface& surface, const Piece& piece, const Flatness& flatness) {
  PieceGrid grid;
  const auto n = cells_of(surface, piece, flatness);
  grid.n_u = n[0];
  grid.n_v = n[1];
  for (int j = 0; j <= n[1]; ++j)
    for (int i = 0; i <= n[0]; ++i) grid.u.push_back(at(piece, double(i) / n[0], double(j) / n[1]));
  return grid;
}

// A trimmed piece: triangles in the parameter plane, each with corners of its own, and the segments
// in which the trims cut them.
class TrimmedGrid {
 public:
  TrimmedGrid(const Surface& surface, const Piece& piece, const Flatness& flatness)
      : region_(*surface.region) {
    auto n = cells_of(surface, piece, flatness);
    for (int& count : n) count = std::max(count, least_cells);
    const Param<2> size = (piece.upper - piece.lower).cwiseQuotient(Param<2>(n[0], n[1]));
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        add_cell(piece.lower + size.cwiseProduct(Param<2>(i, j)), size);
  }

  std::vector<std::array<Param<2>, 3>> triangles;
  std::vector<std::array<Param<2>, 2>> border;

 private:
  static constexpr int least_cells = 16, pieces_of_cut_cell = 4;

  void add_cell(const Param<2>& lower, const Param<2>& size) {
    const Overlap overlap = region_.overlap(lower, lower + size);
    if (overlap == Overlap::none) return;
    const int n = overlap == Overlap::all ? 1 : pieces_of_cut_cell;
    const Param<2> step = size / n;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Param<2> a = lower + step.cwiseProduct(Param<2>(i, j)), c = a + step;
        for (const auto& corner : {Param<2>(c[0], a[1]), Param<2>(a[0], c[1])})
          add_triangle({a, corner, c}, overlap == Overlap::all);
      }
  }

  // The part of a triangle that is inside, cut straight between where its sides cross the border.
  void add_triangle(std::array<Param<2>, 3> u, bool whole) {
    const auto [a, b, c] = u;
    if ((b - a)[0] * (c - a)[1] < (b - a)[1] * (c - a)[0]) std::swap(u[1], u[2]);
    std::vector<Param<2>> polygon, cut;
    for (int k = 0; k < 3; ++k) {
      const Param<2>&from = u[k], &to = u[(k + 1) % 3];
      const bool in = whole || region_.contains(from), next_in = whole || region_.contains(to);
      if (in) polygon.push_back(from);
      if (in == next_in) continue;
      cut.push_back(in ? crossing(from, to) : crossing(to, from));
      polygon.push_back(cut.back());
    }
    for (size_t k = 2; k < polygon.size(); ++k)
      triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
    if (cut.size() == 2) border.push_back({cut[0], cut[1]});
  }

  Param<2> crossing(Param<2> in, Param<2> out) const {
    for (int halving = 0; halving < 12; ++halving) {
      const Param<2> middle = (in + out) / 2;
      (region_.contains(middle) ? in : out) = middle;
    }
    return in;
  }

  const Region<2, 3>& region_;
};

void append_trimmed(const Surface& surface, const Piece& piece, const Flatness& flatness,
                    Mesh& mesh) {
  for (const auto& triangle : TrimmedGrid(surface, piece, flatness).triangles) {
    const int first = int(mesh.position.size());
    for (const auto& u : triangle) {
      mesh.position.push_back(point(surface, u));
      mesh.normal.push_back(unit_normal(surface, u));
      mesh.uv.push_back(u);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

// Where an axis of the surface ends or has a knot.
std::vector<double> stations(const std::vector<Interval>& spans, int between, bool knots) {
  std::vector<double> values = {spans.front().lower};
  for (const auto& span : spans) {
    for (int k = 1; k <= between; ++k)
      values.push_back(span.lower + (span.upper - span.lower) * k / (between + 1));
    if (knots || &span == &spans.back()) values.push_back(span.upper);
  }
  return values;
}

// The line at `value` of the other axis, span by span.
Chain line_along(const Surface& surface, int axis, double value, const Flatness& flatness) {
  Chain chain;
  for (const auto& span : surface.spans[axis]) {
    const auto X = [&](double s) {
      Param<2> u;
      u[axis] = span.lower + s * (span.upper - span.lower);
      u[1 - axis] = value;
      return point(surface, u);
    };
    const int n = cells_along(X, flatness, 0.5);
    for (int k = chain.empty() ? 0 : 1; k <= n; ++k) chain.push_back(X(double(k) / n));
  }
  return chain;
}

bool is_point(const Chain& chain, double size) {
  return std::all_of(chain.begin(), chain.end(),
                     [&](const Vec<3>& X) { return (X - chain[0]).norm() <= 1e-9 * size; });
}

}  // namespace

Vec<3> unit_normal(const Surface& surface, const Param<2>& u) {
  const auto d = derivatives(surface.nurbs, u, 2);
  const Vec<3> du = d.first.col(0), dv = d.first.col(1), n = du.cross(dv);
  // Lengths of the derivatives over the whole domain, to compare with.
  const Interval range[] = {domain(surface.nurbs, 0), domain(surface.nurbs, 1)};
  const double size = surface.box.diagonal(), typical_u = size / (range[0].upper - range[0].lower),
               typical_v = size / (range[1].upper - range[1].lower);
  if (n.norm() > 1e-9 * typical_u * typical_v) return n.normalized();
  // Inwards from a side of the domain: du there is about a multiple of d2X/dudv, and so on.
  const auto inward = [&](int axis) {
    return u[axis] < (range[axis].lower + range[axis].upper) / 2 ? 1.0 : -1.0;
  };
  const Vec<3> limit_v = inward(1) * d.second[1].cross(dv),
               limit_u = inward(0) * du.cross(d.second[1]);
  const Vec<3>& limit = du.norm() / typical_u < dv.norm() / typical_v ? limit_v : limit_u;
  if (limit.norm() > 1e-9 * typical_u * typical_v / (range[0].upper - range[0].lower))
    return limit.normalized();
  const Param<2> middle((range[0].lower + range[0].upper) / 2,
                        (range[1].lower + range[1].upper) / 2);
  const Vec<3> near = DimTraits<3>::area_normal(
      derivatives(surface.nurbs, Param<2>(u + 1e-4 * (middle - u)), 1).first);
  return near.norm() > 0 ? Vec<3>(near.normalized()) : Vec<3>(0, 0, 1);
}

Mesh tessellate(const Surface& surface, const Flatness& flatness) {
  Mesh mesh;
  for (const auto& piece : surface.pieces) {
    if (surface.region) {
      append_trimmed(surface, piece, flatness, mesh);
      continue;
    }
    const PieceGrid grid = grid_of(surface, piece, flatness);
    const int base = int(mesh.position.size()), row = grid.n_u + 1;
    const Param<2> size = piece.upper - piece.lower;
    for (const auto& u : grid.u) {
      mesh.position.push_back(point(piece, Param<2>((u - piece.lower).cwiseQuotient(size))));
      // Across a crease, the piece's own side of it.
      const Param<2> inside = u + 1e-9 * (at(piece, 0.5, 0.5) - u);
      const Vec<3> n = unit_normal(surface, u), own = unit_normal(surface, inside);
      mesh.normal.push_back(n.dot(own) > 1 - 1e-6 ? n : own);
    }
    mesh.uv.insert(mesh.uv.end(), grid.u.begin(), grid.u.end());
    for (const auto& edge : edges)
      straighten(surface, piece, edge, grid, flatness, &mesh.position[base]);
    for (int j = 0; j < grid.n_v; ++j)
      for (int i = 0; i < grid.n_u; ++i) {
        const int a = base + j * row + i;
        mesh.triangles.push_back({a, a + 1, a + row + 1});
        mesh.triangles.push_back({a, a + row + 1, a + row});
      }
  }
  return mesh;
}

std::vector<Chain> isoparametric_lines(const Surface& surface, int between, bool knots,
                                       const Flatness& flatness) {
  std::vector<Chain> lines;
  for (int axis = 0; axis < 2; ++axis)
    for (const double value : stations(surface.spans[1 - axis], between, knots)) {
      Chain line = line_along(surface, axis, value, flatness);
      if (!is_point(line, surface.box.diagonal())) lines.push_back(std::move(line));
    }
  return lines;
}

std::vector<Chain> outline(const Surface& surface, const Flatness& flatness) {
  if (!surface.region) return isoparametric_lines(surface, 0, false, flatness);
  std::vector<Chain> segments;
  for (const auto& piece : surface.pieces)
    for (const auto& [a, b] : TrimmedGrid(surface, piece, flatness).border)
      segments.push_back({point(surface, a), point(surface, b)});
  return segments;
}

std::vector<Chain> control_net(const Nurbs<2, 3>& surface) {
  std::vector<Chain> net;
  const int n_u = n_control(surface, 0), n_v = n_control(surface, 1);
  for (int j = 0; j < n_v; ++j) {
    net.emplace_back();
    for (int i = 0; i < n_u; ++i) net.back().push_back(surface.control_points.col(i + j * n_u));
  }
  for (int i = 0; i < n_u; ++i) {
    net.emplace_back();
    for (int j = 0; j < n_v; ++j) net.back().push_back(surface.control_points.col(i + j * n_u));
  }
  return net;
}

}  // namespace sem::render
