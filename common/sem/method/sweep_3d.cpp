#include "sem/method/sweep_3d.h"

#include <algorithm>
#include <cmath>

#include "sem/nurbs/hits.h"

namespace sem {
namespace {

using detail::Bivariate;

constexpr int n_edge_samples = 24;

// The root of f between a and b, where its signs differ.
template <class F>
double bisected(const F& f, double a, double b) {
  const bool positive = f(a) > 0;
  for (int halving = 0; halving < 60 && a != (a + b) / 2 && b != (a + b) / 2; ++halving)
    ((f((a + b) / 2) > 0) == positive ? a : b) = (a + b) / 2;
  return (a + b) / 2;
}

Bivariate jacobian(const Bivariate& a, const Bivariate& b) {
  return sum(product(derivative(a, 0), derivative(b, 1)),
             product(derivative(a, 1), derivative(b, 0)), -1);
}

// Component of the normal across coordinates a and b, each times w: the determinant of (a, b, w)
// and its derivatives, or of a and b alone where w is constant.
Bivariate normal_component(const Bivariate& a, const Bivariate& b, const Bivariate& w,
                           bool rational) {
  if (!rational) return jacobian(a, b);
  return sum(sum(product(a, jacobian(b, w)), product(b, jacobian(a, w)), -1),
             product(w, jacobian(a, b)));
}

double largest_of(const Bivariate& f) {
  double largest = 0;
  for (const double c : f.c) largest = std::max(largest, std::abs(c));
  return largest;
}

// Whether the surface is curved to one side at an extremum of the height. A pole, where an edge of
// the patch is one point and has no normal, counts as such.
bool closes_like_ellipse(const PreparedNurbs<2, 3>& shape, const Param<2>& u) {
  const auto at = derivatives(shape.nurbs, u, 2);
  const Vec<3> normal = DimTraits<3>::area_normal(at.first);
  if (normal.norm() < 1e-7 * at.first.squaredNorm()) return true;
  const double L = normal.dot(at.second[0]), M = normal.dot(at.second[1]),
               N = normal.dot(at.second[2]);
  return L * N - M * M > 1e-6 * (L * L + N * N + M * M);
}

// The place nearest to the origin where the line meets the boundary, NaN if that is farther than
// `most`.
double nearest_hit(const Boundary<3>& boundary, const Line<3>& line, double most) {
  std::vector<Hit<3>> hits;
  for (const auto& part : boundary.parts)
    if ((line.origin.array() >= part.box.lower.array() - most).all() &&
        (line.origin.array() <= part.box.upper.array() + most).all())
      append_hits(part, line, -most, most, hits);
  double best = NAN;
  for (const auto& hit : hits)
    if (!(std::abs(hit.t) >= std::abs(best))) best = hit.t;
  return best;
}

// Whether the boundary goes on analytically across the border of a piece, near X on it: its height
// over the tangent plane, interpolated by a polynomial of degree 7 from both sides.
bool is_analytic_at(const Boundary<3>& boundary, const Vec<3>& X, const Vec<3>& normal,
                    const Vec<3>& across, double reach) {
  constexpr double node[] = {-1, -0.7, -0.4, -0.15, 0.15, 0.4, 0.7, 1},
                   check[] = {-0.85, -0.27, 0.27, 0.85};
  const auto height_at = [&](double x) {
    return nearest_hit(boundary, {X + x * reach * across, normal}, reach / 2);
  };
  double height[8];
  for (int i = 0; i < 8; ++i) height[i] = height_at(node[i]);
  for (const double x : check) {
    double interpolated = 0;
    for (int i = 0; i < 8; ++i) {
      double value = height[i];
      for (int j = 0; j < 8; ++j)
        if (j != i) value *= (x - node[j]) / (node[i] - node[j]);
      interpolated += value;
    }
    if (!(std::abs(interpolated - height_at(x)) < 1e-8 * reach)) return false;
  }
  return true;
}

}  // namespace

Vec<3> Sweep::SweptEdge::at(double s) const {
  Param<2> u;
  u[along] = s;
  u[1 - along] = side;
  return point(*piece, u);
}

Sweep::Sweep(const Component<3>& component, int axis, int across, int height)
    : component_(component),
      axis_(axis),
      across_(across),
      height_(height),
      size_(component.boundary.box.diagonal()) {
  for (const auto& part : component.boundary.parts)
    for (const auto& piece : part.pieces) {
      add_piece(part, piece);
      if (!part.region) add_edges(part, piece);
    }
  find_heights();
}

void Sweep::add_piece(const PreparedNurbs<2, 3>& shape, const BezierPiece<2, 3>& piece) {
  const Vec<3> middle = (piece.box.lower + piece.box.upper) / 2;
  const std::array<int, 2> degree = {piece.degree[0], piece.degree[1]};
  const int n = int(piece.weights.size());
  const bool rational = piece.weights.minCoeff() < piece.weights.maxCoeff();
  Bivariate w{degree, {piece.weights.data(), piece.weights.data() + n}};
  std::array<Bivariate, 3> X;
  for (int a = 0; a < 3; ++a) {
    X[a].degree = degree;
    for (int i = 0; i < n; ++i)
      X[a].c.push_back(piece.weights[i] * (piece.points(a, i) - middle[a]));
  }
  SweptPiece swept{&shape, &piece, {}, {}, {}, {}};
  const double size = piece.box.diagonal(), heaviest = piece.weights.maxCoeff();
  for (int a = 0; a < 3; ++a) {
    swept.normal[a] = normal_component(X[(a + 1) % 3], X[(a + 2) % 3], w, rational);
    swept.rounding[a] = 1e-13 * size * size * std::pow(heaviest, rational ? 3 : 2);
  }
  const auto& full = swept.normal[0].degree;
  for (int i = 0; i < n; ++i) X[height_].c[i] += middle[height_] * piece.weights[i];
  swept.height = raised(X[height_], full);
  swept.weight = raised(w, full);
  pieces_.push_back(std::move(swept));
}

void Sweep::add_edges(const PreparedNurbs<2, 3>& part, const BezierPiece<2, 3>& piece) {
  for (int along = 0; along < 2; ++along)
    for (const double side : {0.0, 1.0}) {
      SweptEdge edge{&piece, along, side, {}};
      if ((edge.at(0) - edge.at(1)).norm() + (edge.at(0) - edge.at(0.37)).norm() < 1e-12 * size_)
        continue;
      if (is_smooth(part, edge)) continue;
      const auto rise = [&](double s) {
        constexpr double d = 1e-6;
        return edge.at(std::min(1.0, s + d))[height_] - edge.at(std::max(0.0, s - d))[height_];
      };
      // An edge at one height rises by rounding alone, which tells nothing.
      const double farthest =
          std::max(std::abs(piece.box.lower[height_]), std::abs(piece.box.upper[height_]));
      const double rounding = 1e-14 * (size_ + farthest);
      edge.stops.push_back(0);
      double before = -1;  // the last sample that rises or falls
      for (int k = 0; k <= n_edge_samples; ++k) {
        const double s = double(k) / n_edge_samples;
        if (std::abs(rise(s)) <= rounding) continue;
        if (before >= 0 && (rise(before) > 0) != (rise(s) > 0))
          edge.stops.push_back(bisected(rise, before, s));
        before = s;
      }
      edge.stops.push_back(1);
      edges_.push_back(std::move(edge));
    }
}

// Borders that nothing shows of, as between the patches of a ball, need no split.
bool Sweep::is_smooth(const PreparedNurbs<2, 3>& part, const SweptEdge& edge) const {
  for (const double s : {0.31, 0.73}) {
    Param<2> u;
    u[edge.along] = s;
    u[1 - edge.along] = edge.side;
    const auto at = derivatives(
        part.nurbs,
        Param<2>(edge.piece->lower + u.cwiseProduct(edge.piece->upper - edge.piece->lower)), 1);
    const Vec<3> normal = DimTraits<3>::area_normal(at.first).normalized();
    const Vec<3> across = normal.cross(at.first.col(edge.along)).normalized();
    if (!is_analytic_at(component_.boundary, at.point, normal, across,
                        0.04 * edge.piece->box.diagonal()))
      return false;
  }
  return true;
}

void Sweep::find_heights() {
  std::vector<CriticalHeight> all;
  for (const auto& swept : pieces_) {
    const Vec<2> rounding(swept.rounding[axis_], swept.rounding[across_]);
    for (const auto& zero : common_zeros(swept.normal[axis_], swept.normal[across_], rounding)) {
      const Param<2> u =
          swept.piece->lower + zero.s.cwiseProduct(swept.piece->upper - swept.piece->lower);
      if (swept.shape->region && !swept.shape->region->contains(u)) continue;
      const bool smooth = closes_like_ellipse(*swept.shape, u);
      all.push_back(
          {point(*swept.piece, zero.s)[height_], smooth ? EndKind::smooth : EndKind::root});
    }
  }
  for (const auto& edge : edges_)
    for (size_t k = 0; k < edge.stops.size(); ++k) {
      const bool corner = k == 0 || k + 1 == edge.stops.size();
      all.push_back({edge.at(edge.stops[k])[height_], corner ? EndKind::smooth : EndKind::root});
    }
  for (const auto& part : component_.boundary.parts)
    if (part.region)
      for (const auto& border : part.region->borders())
        for (const Vec<3>& end : {border.front(), border.back()})
          all.push_back({end[height_], EndKind::smooth});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  for (const auto& height : all) {
    if (heights_.empty() || height.value - heights_.back().value > 1e-10 * size_)
      heights_.push_back(height);
    else if (height.kind != EndKind::smooth)
      heights_.back() = height;
  }
}

std::vector<double> Sweep::across_at(double height) const {
  std::vector<double> all;
  for (const auto& swept : pieces_) {
    const auto& box = swept.piece->box;
    if (height < box.lower[height_] || height > box.upper[height_]) continue;
    const Bivariate in_plane = sum(swept.height, swept.weight, -height);
    const Vec<2> rounding(1e-15 * size_ * largest_of(swept.weight), swept.rounding[axis_]);
    for (const auto& zero : common_zeros(in_plane, swept.normal[axis_], rounding)) {
      const Param<2> u =
          swept.piece->lower + zero.s.cwiseProduct(swept.piece->upper - swept.piece->lower);
      if (swept.shape->region && !swept.shape->region->contains(u)) continue;
      all.push_back(point(*swept.piece, zero.s)[across_]);
    }
  }
  for (const auto& edge : edges_)
    for (size_t k = 0; k + 1 < edge.stops.size(); ++k) {
      const auto above = [&](double s) { return edge.at(s)[height_] - height; };
      if ((above(edge.stops[k]) > 0) != (above(edge.stops[k + 1]) > 0))
        all.push_back(edge.at(bisected(above, edge.stops[k], edge.stops[k + 1]))[across_]);
    }
  std::sort(all.begin(), all.end());
  std::vector<double> distinct;
  for (const double value : all)
    if (distinct.empty() || value - distinct.back() > 1e-10 * size_) distinct.push_back(value);
  return distinct;
}

}  // namespace sem
