#include <cmath>
#include <numbers>

#include "sem/method/fan.h"
#include "sem/nurbs/basis.h"

namespace sem {
namespace {

// A stretch of a curve; turn: +1 if it runs anticlockwise about the loop's inside.
struct FanStretch {
  const PreparedNurbs<1, 2>* curve;
  double lower, upper;
  double turn;
};

Derivatives<1, 2> on_curve(const FanStretch& stretch, double u) {
  return derivatives(stretch.curve->nurbs, Param<1>(u), 1);
}

// z component of a x b.
double turn_from(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

// All stretches that bound the loop; empty if the side of one is not known.
std::vector<FanStretch> stretches_of(const Component<2>& component) {
  std::vector<FanStretch> result;
  const auto add = [&](const PreparedNurbs<1, 2>& curve, int orientation) {
    for (const auto& piece : curve.pieces)
      result.push_back({&curve, piece.lower[0], piece.upper[0], double(orientation)});
  };
  const double rounding = 1e-13 * component.boundary.box.diagonal();
  for (int i = 0; i < component.boundary.n_parts(); ++i)
    add(component.boundary.parts[i], component.loops.orientation[i]);
  for (size_t c = 0; c < component.loops.caps.size(); ++c)
    if (component.loops.cap_length[c] > rounding)
      add(component.loops.caps[c], component.loops.cap_orientation[c]);
  for (const auto& stretch : result)
    if (stretch.turn == 0) return {};
  return result;
}

// Points along the boundary with the area that they stand for as seen from a point:
// turn_from(X - point, tangent) / 2.
struct FanSample {
  Vec<2> X, tangent;  // tangent: times du, anticlockwise
};

std::vector<FanSample> sample_stretches(const std::vector<FanStretch>& stretches) {
  static const LineRule rule = gauss_legendre(24);
  std::vector<FanSample> samples;
  for (const auto& stretch : stretches)
    for (size_t k = 0; k < rule.node.size(); ++k) {
      const double half = (stretch.upper - stretch.lower) / 2;
      const auto at = on_curve(stretch, stretch.lower + half * (1 + rule.node[k]));
      samples.push_back({at.point, stretch.turn * half * rule.weight[k] * at.first});
    }
  return samples;
}

// The ellipse {center + axes y : |y| <= 1}.
struct FanCore {
  Vec<2> center;
  Mat<2> axes;
};

// Square root of a symmetric positive definite matrix: (A + sqrt(det A) I) / sqrt(tr A + 2 sqrt(det
// A)).
Mat<2> root_of_spd(const Mat<2>& A) {
  const double root = std::sqrt(std::max(0.0, A.determinant()));
  return (A + root * Mat<2>::Identity()) / std::sqrt(A.trace() + 2 * root);
}

// The smallest angle (its sine) at which a ray from the center meets the boundary, in coordinates
// in which the core is round; > 0: the boundary is star-shaped about the center.
double least_incidence(const std::vector<FanSample>& samples, const FanCore& core) {
  const Mat<2> inverse = core.axes.inverse();
  double least = 1;
  for (const auto& s : samples) {
    const Vec<2> out = inverse * (s.X - core.center), along = inverse * s.tangent;
    if (along.norm() > 0)
      least = std::min(least, turn_from(out, along) / (out.norm() * along.norm()));
  }
  return least;
}

// Moves the center to where the core of the same shape can be largest, and lets it grow till it
// nearly touches.
FanCore largest_core(const std::vector<FanStretch>& stretches,
                     const std::vector<FanSample>& samples, FanCore core) {
  constexpr double clearance = 0.999;
  constexpr int n_dense = 200;
  const Mat<2> inverse = core.axes.inverse();
  const auto radius = [&](const Vec<2>& center) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& s : samples) least = std::min(least, (inverse * (s.X - center)).squaredNorm());
    return std::sqrt(least);
  };
  double best = radius(core.center);
  for (double step = 0.2; step > 1e-4; step /= 2)
    for (bool moved = true; moved;) {
      moved = false;
      for (int k = 0; k < 12; ++k) {
        const double angle = 2 * std::numbers::pi * k / 12;
        const Vec<2> next =
            core.center + step * core.axes * Vec<2>(std::cos(angle), std::sin(angle));
        if (const double r = radius(next); r > best && r < 2) {
          best = r;
          core.center = next;
          moved = true;
        }
      }
    }
  best = std::numeric_limits<double>::infinity();
  for (const auto& stretch : stretches)
    for (int k = 0; k <= n_dense; ++k) {
      const double u = stretch.lower + double(k) / n_dense * (stretch.upper - stretch.lower);
      const Vec<2> X = on_curve(stretch, u).point;
      best = std::min(best, (inverse * (X - core.center)).norm());
    }
  core.axes *= clearance * best;
  return core;
}

// Area, centroid and the ellipse with the same second moments, from the fan about any point
// (signed).
std::optional<FanCore> equivalent_ellipse(const std::vector<FanSample>& samples) {
  const Vec<2> about = samples.front().X;
  double area = 0;
  Vec<2> first = Vec<2>::Zero();
  Mat<2> second = Mat<2>::Zero();
  for (const auto& s : samples) {
    const Vec<2> r = s.X - about;
    const double swept = turn_from(r, s.tangent) / 2;
    area += swept;
    first += swept * 2 / 3 * r;
    second += swept / 2 * r * r.transpose();
  }
  if (!(area > 0)) return {};
  const Vec<2> mean = first / area;
  const Mat<2> covariance = second / area - mean * mean.transpose();
  if (!(covariance.determinant() > 1e-8 * covariance.squaredNorm())) return {};
  return FanCore{about + mean, 2 * root_of_spd(covariance)};
}

// The boundary turns about the center by one full angle.
bool surrounds_once(const std::vector<FanStretch>& stretches, const Vec<2>& center) {
  constexpr int n_steps = 24;
  double angle = 0;
  for (const auto& stretch : stretches) {
    Vec<2> previous = on_curve(stretch, stretch.lower).point - center;
    for (int k = 1; k <= n_steps; ++k) {
      const double u = stretch.lower + double(k) / n_steps * (stretch.upper - stretch.lower);
      // The last point from the left, where the curve may jump.
      const Vec<2> next =
          on_curve(stretch, k == n_steps ? std::nexttoward(u, stretch.lower) : u).point - center;
      angle += stretch.turn * std::atan2(turn_from(previous, next), previous.dot(next));
      previous = next;
    }
  }
  return std::abs(angle / (2 * std::numbers::pi) - 1) < 1e-6;
}

Strands<2> chords_of_core(const FanCore& core, int solid, int n) {
  const LineRule rule = rule_between(EndKind::closing, EndKind::closing, n);
  Strands<2> strands;
  for (int k = 0; k < n; ++k) {
    const double y = rule.node[k], x = std::sqrt(1 - y * y);
    strands.push_back({core.center + core.axes * Vec<2>(-x, y),
                       core.center + core.axes * Vec<2>(x, y),
                       rule.weight[k] * 2 * x * core.axes.determinant(), 1, solid});
  }
  return strands;
}

Strands<2> strands_to_stretch(const FanStretch& stretch, const FanCore& core, int solid, int n) {
  const LineRule rule = gauss_legendre(n);
  const Mat<2> inverse = core.axes.inverse();
  const double half = (stretch.upper - stretch.lower) / 2;
  Strands<2> strands;
  for (int k = 0; k < n; ++k) {
    const auto at = on_curve(stretch, stretch.lower + half * (1 + rule.node[k]));
    const Vec<2> out = at.point - core.center;
    const double from_center = half * rule.weight[k] * stretch.turn * turn_from(out, at.first) / 2;
    const double start = 1 / (inverse * out).norm();  // of the way out, the core takes this
    if (!(from_center > 0) || !(start < 1)) return {};
    strands.push_back(
        {core.center + start * out, at.point, from_center * (1 - start * start), start, solid});
  }
  return strands;
}

// Appends the cell of a stretch or, where it takes too many strands, its halves.
void append_fan(const FanStretch& stretch, const FanCore& core, int solid,
                const Yardstick<2>& yardstick, int halvings_left, std::vector<Cell<2>>& cells) {
  auto cell = fit_cell<2>([&](int n) { return strands_to_stretch(stretch, core, solid, n); },
                          yardstick, most_strands);
  if (cell.fitted || halvings_left == 0) {
    cells.push_back(std::move(cell));
    return;
  }
  FanStretch lower = stretch, upper = stretch;
  lower.upper = upper.lower = (stretch.lower + stretch.upper) / 2;
  append_fan(lower, core, solid, yardstick, halvings_left - 1, cells);
  append_fan(upper, core, solid, yardstick, halvings_left - 1, cells);
}

}  // namespace

template <>
std::vector<Cell<2>> fan_cells<2>(const Component<2>& component, const Yardstick<2>& yardstick) {
  constexpr double least_sine = 0.05;  // of the angle between a strand and the boundary
  if (component.loops.loops.size() != 1) return {};
  const auto stretches = stretches_of(component);
  if (stretches.empty()) return {};
  const auto samples = sample_stretches(stretches);
  const auto ellipse = equivalent_ellipse(samples);
  if (!ellipse) return {};
  const FanCore core = largest_core(stretches, samples, *ellipse);
  if (least_incidence(samples, core) < least_sine || !surrounds_once(stretches, core.center))
    return {};
  const int solid = component.loops.loops.front().solid;
  std::vector<Cell<2>> cells;
  cells.push_back(fit_cell<2>([&](int n) { return chords_of_core(core, solid, n); }, yardstick,
                              2 * most_strands));
  for (const auto& stretch : stretches) append_fan(stretch, core, solid, yardstick, 6, cells);
  return cells;
}

}  // namespace sem
