#include "sem/method/fan.h"

#include <cmath>
#include <numbers>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/closest.h"

namespace sem {
namespace {

// A box of parameters of a shape, or all of a trimmed one; turn * area_normal points out of the
// body.
template <int Dim>
struct FanPiece {
  const PreparedNurbs<Dim - 1, Dim>* shape;
  Param<Dim - 1> lower, upper;
  double turn;
};

// A point of the boundary with the outward normal times the area (length) it stands for.
template <int Dim>
struct FanSample {
  Vec<Dim> X, normal;
};

// All that bounds the loop; empty if the side of a piece is not known.
template <int Dim>
std::vector<FanPiece<Dim>> fan_pieces(const Component<Dim>& component) {
  std::vector<FanPiece<Dim>> result;
  const auto add = [&](const PreparedNurbs<Dim - 1, Dim>& shape, int orientation) {
    if (shape.region)
      result.push_back(
          {&shape, shape.pieces.front().lower, shape.pieces.back().upper, double(orientation)});
    else
      for (const auto& piece : shape.pieces)
        result.push_back({&shape, piece.lower, piece.upper, double(orientation)});
  };
  const double rounding = 1e-13 * component.boundary.box.diagonal();
  for (int i = 0; i < component.boundary.n_parts(); ++i)
    add(component.boundary.parts[i], component.loops.orientation[i]);
  for (size_t c = 0; c < component.loops.caps.size(); ++c)
    if (component.loops.cap_length[c] > rounding)
      add(component.loops.caps[c], component.loops.cap_orientation[c]);
  for (const auto& piece : result)
    if (piece.turn == 0) return {};
  return result;
}

// Gauss points in every direction of a box of parameters, or of the region of a trimmed part.
template <int Dim>
ParameterRule<Dim - 1> rule_on(const FanPiece<Dim>& piece, int n) {
  if (piece.shape->region) return piece.shape->region->rule(n);
  const LineRule& rule = gauss_on_strand(n);
  ParameterRule<Dim - 1> result;
  result.u.push_back(piece.lower);
  result.weight.push_back(1);
  for (int axis = 0; axis < Dim - 1; ++axis) {
    const double length = piece.upper[axis] - piece.lower[axis];
    ParameterRule<Dim - 1> next;
    for (size_t p = 0; p < result.u.size(); ++p)
      for (int k = 0; k < n; ++k) {
        next.u.push_back(result.u[p]);
        next.u.back()[axis] += length * rule.node[k];
        next.weight.push_back(result.weight[p] * length * rule.weight[k]);
      }
    result = std::move(next);
  }
  return result;
}

template <int Dim>
void append_samples(const FanPiece<Dim>& piece, int n, std::vector<FanSample<Dim>>& samples) {
  const auto rule = rule_on(piece, n);
  for (size_t k = 0; k < rule.u.size(); ++k) {
    const auto at = derivatives(piece.shape->nurbs, rule.u[k], 1);
    samples.push_back(
        {at.point, piece.turn * rule.weight[k] * DimTraits<Dim>::area_normal(at.first)});
  }
}

// The ellipsoid {center + axes y : |y| <= 1}.
template <int Dim>
struct FanCore {
  Vec<Dim> center;
  Mat<Dim> axes;
};

// Square root of a symmetric positive definite matrix, by the iteration of Denman and Beavers.
template <int Dim>
Mat<Dim> root_of_spd(const Mat<Dim>& A) {
  const double scale = A.trace();
  Mat<Dim> root = A / scale, inverse_root = Mat<Dim>::Identity();
  for (int iteration = 0; iteration < 40; ++iteration) {
    const Mat<Dim> next = (root + inverse_root.inverse()) / 2;
    inverse_root = ((inverse_root + root.inverse()) / 2).eval();
    const double step = (next - root).norm();
    root = next;
    if (step < 1e-15) break;
  }
  return std::sqrt(scale) * (root + root.transpose()) / 2;
}

// Centroid and the ellipsoid with the same second moments, from the fan about any point (signed).
template <int Dim>
std::optional<FanCore<Dim>> equivalent_ellipsoid(const std::vector<FanSample<Dim>>& samples) {
  const Vec<Dim> about = samples.front().X;
  double measure = 0;
  Vec<Dim> first = Vec<Dim>::Zero();
  Mat<Dim> second = Mat<Dim>::Zero();
  for (const auto& s : samples) {
    const Vec<Dim> r = s.X - about;
    const double swept = r.dot(s.normal) / Dim;
    measure += swept;
    first += swept * Dim / (Dim + 1) * r;
    second += swept * Dim / (Dim + 2) * r * r.transpose();
  }
  if (!(measure > 0)) return {};
  const Vec<Dim> mean = first / measure;
  const Mat<Dim> covariance = second / measure - mean * mean.transpose();
  if (!(covariance.determinant() > 1e-8 * std::pow(covariance.norm(), Dim))) return {};
  return FanCore<Dim>{about + mean, std::sqrt(Dim + 2.0) * root_of_spd<Dim>(covariance)};
}

// Steps to the neighbours of a point in a grid.
template <int Dim>
std::vector<Vec<Dim>> search_directions() {
  std::vector<Vec<Dim>> directions = {Vec<Dim>::Zero()};
  for (int a = 0; a < Dim; ++a)
    for (size_t k = 0, n = directions.size(); k < n; ++k)
      for (const double sign : {-1.0, 1.0})
        directions.push_back(directions[k] + sign * Vec<Dim>::Unit(a));
  directions.erase(directions.begin());
  for (auto& direction : directions) direction.normalize();
  return directions;
}

// The distance from the center to a shape, in coordinates in which the core is round.
template <int Dim>
double clear_radius(const PreparedNurbs<Dim - 1, Dim>& shape, const FanCore<Dim>& core) {
  Nurbs<Dim - 1, Dim> round = shape.nurbs;
  round.control_points = core.axes.inverse() * (round.control_points.colwise() - core.center);
  return closest_point(prepare(round), Vec<Dim>(Vec<Dim>::Zero())).distance;
}

// Moves the center to where the core of the same shape can be largest, and lets it grow till it
// nearly touches.
template <int Dim>
FanCore<Dim> largest_core(const std::vector<FanPiece<Dim>>& pieces,
                          const std::vector<FanSample<Dim>>& samples, FanCore<Dim> core) {
  constexpr double clearance = 0.999;
  const Mat<Dim> inverse = core.axes.inverse();
  const auto radius = [&](const Vec<Dim>& center) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& s : samples) least = std::min(least, (inverse * (s.X - center)).squaredNorm());
    return std::sqrt(least);
  };
  double best = radius(core.center);
  for (double step = 0.2; step > 1e-4; step /= 2)
    for (bool moved = true; moved;) {
      moved = false;
      for (const auto& direction : search_directions<Dim>()) {
        const Vec<Dim> next = core.center + step * core.axes * direction;
        if (const double r = radius(next); r > best && r < 2) {
          best = r;
          core.center = next;
          moved = true;
        }
      }
    }
  const PreparedNurbs<Dim - 1, Dim>* shape = nullptr;
  best = std::numeric_limits<double>::infinity();
  for (const auto& piece : pieces)
    if (piece.shape != shape) best = std::min(best, clear_radius(*(shape = piece.shape), core));
  core.axes *= clearance * best;
  return core;
}

// Whether the boundary is closed, surrounds the center once, and is met by every ray from there at
// an angle whose sine, where the core is round, is at least least_sine.
template <int Dim>
bool is_star(const std::vector<FanSample<Dim>>& samples, const FanCore<Dim>& core,
             double least_sine) {
  const Mat<Dim> inverse = core.axes.inverse();
  const double shrink = std::abs(inverse.determinant());
  double angle = 0, area = 0;
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const auto& s : samples) {
    const Vec<Dim> out = inverse * (s.X - core.center);
    const Vec<Dim> normal = shrink * core.axes.transpose() * s.normal;
    if (out.dot(normal) < least_sine * out.norm() * normal.norm()) return false;
    angle += out.dot(normal) / std::pow(out.norm(), Dim);
    area += normal.norm();
    sum += normal;
  }
  const double full_angle = 2 * (Dim - 1) * std::numbers::pi;
  return sum.norm() < 1e-8 * area && std::abs(angle / full_angle - 1) < 1e-2;
}

// Chords along the first axis through points of the ball across it: its sections by the last
// coordinate shrink like (1 - y^2)^(k / 2), k the number of coordinates that are left.
template <int Dim>
Strands<Dim> chords_of_core(const FanCore<Dim>& core, int solid, int n) {
  const LineRule smooth = rule_between(EndKind::smooth, EndKind::smooth, n);
  const LineRule closing = rule_between(EndKind::closing, EndKind::closing, n);
  Strands<Dim> strands;
  const int n_chords = int(std::lround(std::pow(n, Dim - 1)));
  for (int chord = 0; chord < n_chords; ++chord) {
    Vec<Dim> y = Vec<Dim>::Zero();
    double half = 1, weight = std::abs(core.axes.determinant());
    for (int a = Dim - 1, rest = chord; a > 0; --a, rest /= n) {
      const LineRule& rule = a % 2 == 1 ? closing : smooth;
      y[a] = half * rule.node[rest % n];
      weight *= half * rule.weight[rest % n];
      half = std::sqrt(half * half - y[a] * y[a]);
    }
    const Vec<Dim> middle = core.center + core.axes * y, along = half * core.axes.col(0);
    strands.push_back({middle - along, middle + along, weight * 2 * half, 1, solid});
  }
  return strands;
}

template <int Dim>
Strands<Dim> strands_to_piece(const FanPiece<Dim>& piece, const FanCore<Dim>& core, int solid,
                              int n) {
  const Mat<Dim> inverse = core.axes.inverse();
  std::vector<FanSample<Dim>> samples;
  append_samples(piece, n, samples);
  Strands<Dim> strands;
  for (const auto& s : samples) {
    const Vec<Dim> out = s.X - core.center;
    const double from_center = out.dot(s.normal) / Dim;
    const double start = 1 / (inverse * out).norm();  // of the way out, the core takes this
    if (!(from_center > 0) || !(start < 1)) return {};
    strands.push_back(
        {core.center + start * out, s.X, from_center * (1 - std::pow(start, Dim)), start, solid});
  }
  return strands;
}

// The parameter along which the piece is longest, where the core is round.
template <int Dim>
int longest_axis(const FanPiece<Dim>& piece, const FanCore<Dim>& core) {
  const Param<Dim - 1> middle = (piece.lower + piece.upper) / 2;
  const Eigen::Matrix<double, Dim, Dim - 1> tangents =
      core.axes.inverse() * derivatives(piece.shape->nurbs, middle, 1).first;
  int axis;
  (tangents.colwise().norm().transpose().array() * (piece.upper - piece.lower).array())
      .maxCoeff(&axis);
  return axis;
}

// Appends the cell of a piece or, where it takes too many strands, its halves.
template <int Dim>
void append_fan(const FanPiece<Dim>& piece, const FanCore<Dim>& core, int solid,
                const Yardstick<Dim>& yardstick, int halvings_left, std::vector<Cell<Dim>>& cells) {
  auto cell = fit_cell<Dim>([&](int n) { return strands_to_piece(piece, core, solid, n); },
                            yardstick, most_strands);
  if (cell.fitted || halvings_left == 0 || piece.shape->region) {
    cells.push_back(std::move(cell));
    return;
  }
  const int axis = longest_axis(piece, core);
  FanPiece<Dim> lower = piece, upper = piece;
  lower.upper[axis] = upper.lower[axis] = (piece.lower[axis] + piece.upper[axis]) / 2;
  append_fan(lower, core, solid, yardstick, halvings_left - 1, cells);
  append_fan(upper, core, solid, yardstick, halvings_left - 1, cells);
}

}  // namespace

template <int Dim>
std::vector<Cell<Dim>> fan_cells(const Component<Dim>& component, const Yardstick<Dim>& yardstick) {
  constexpr double least_sine = 0.05;
  constexpr int n_samples = 24;
  if (component.loops.loops.size() != 1) return {};
  const auto pieces = fan_pieces(component);
  std::vector<FanSample<Dim>> samples;
  for (const auto& piece : pieces) append_samples(piece, n_samples, samples);
  if (samples.empty()) return {};
  const auto ellipsoid = equivalent_ellipsoid(samples);
  if (!ellipsoid) return {};
  const FanCore<Dim> core = largest_core(pieces, samples, *ellipsoid);
  if (!is_star(samples, core, least_sine)) return {};
  const int solid = component.loops.loops.front().solid;
  std::vector<Cell<Dim>> cells;
  cells.push_back(fit_cell<Dim>([&](int n) { return chords_of_core(core, solid, n); }, yardstick,
                                2 * most_strands));
  for (const auto& piece : pieces) append_fan(piece, core, solid, yardstick, 6, cells);
  return cells;
}

template std::vector<Cell<2>> fan_cells<2>(const Component<2>&, const Yardstick<2>&);
template std::vector<Cell<3>> fan_cells<3>(const Component<3>&, const Yardstick<3>&);

}  // namespace sem
