#include "sem/draw/stroker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sem {
namespace {

Vec<2> left_normal(const Vec<2>& d) { return {-d[1], d[0]}; }
double cross(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Appends the triangles of one solid chain of distinct points.
class Outline {
 public:
  Outline(double width, double tolerance, std::vector<Vec<2>>& triangles)
      : r_(width / 2), triangles_(triangles) {
    // Deviation of a chord over the angle a from its arc: r (1 - cos(a / 2)).
    step_ = tolerance < r_ ? 2 * std::acos(1 - tolerance / r_) : std::numbers::pi / 2;
    step_ = std::min(step_, std::numbers::pi / 4);
  }

  void add(const std::vector<Vec<2>>& points, bool closed, Stroke::Cap cap) {
    const int n = int(points.size());
    if (n == 1) {
      if (cap == Stroke::Cap::round) arc(points[0], {1, 0}, 2 * std::numbers::pi);
      return;
    }
    const int n_segments = closed ? n : n - 1;
    std::vector<Vec<2>> directions(n_segments);
    for (int i = 0; i < n_segments; ++i)
      directions[i] = (points[(i + 1) % n] - points[i]).normalized();
    for (int i = 0; i < n_segments; ++i) segment(points[i], points[(i + 1) % n], directions[i]);
    for (int i = 1; i < n_segments; ++i) join(points[i], directions[i - 1], directions[i]);
    if (closed) {
      join(points[0], directions.back(), directions.front());
    } else if (cap == Stroke::Cap::round) {
      arc(points.front(), left_normal(directions.front()), std::numbers::pi);
      arc(points.back(), -left_normal(directions.back()), std::numbers::pi);
    }
  }

 private:
  void triangle(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) {
    triangles_.insert(triangles_.end(), {a, b, c});
  }

  void segment(const Vec<2>& a, const Vec<2>& b, const Vec<2>& direction) {
    const Vec<2> offset = r_ * left_normal(direction);
    triangle(a + offset, a - offset, b - offset);
    triangle(a + offset, b - offset, b + offset);
  }

  /// Sector of the circle about c from the unit vector `from` over `angle`, positive from x to y.
  void arc(const Vec<2>& c, const Vec<2>& from, double angle) {
    const int n = std::max(1, int(std::ceil(std::abs(angle) / step_)));
    const auto at = [&](int i) -> Vec<2> {
      return c + r_ * (Eigen::Rotation2Dd(angle * i / n) * from);
    };
    for (int i = 0; i < n; ++i) triangle(c, at(i), at(i + 1));
  }

  /// The wedge that the two segments leave open on the outer side of the corner c.
  void join(const Vec<2>& c, const Vec<2>& before, const Vec<2>& after) {
    const double turn = std::atan2(cross(before, after), before.dot(after));
    if (turn == 0) return;
    const double side = turn > 0 ? -1 : 1;  // the outer side
    const Vec<2> from = side * left_normal(before), to = side * left_normal(after);
    const double ratio = 1 / std::cos(turn / 2);
    if (!(ratio < miter_limit)) return arc(c, from, turn);
    const Vec<2> tip = c + r_ * ratio * (from + to).normalized();
    triangle(c, c + r_ * from, tip);
    triangle(c, tip, c + r_ * to);
  }

  double r_, step_;
  std::vector<Vec<2>>& triangles_;
};

/// The drawn pieces of a chain; the pattern repeats and starts at the first point.
std::vector<Chain> dashes(const Chain& chain, const std::vector<double>& pattern) {
  double total = 0;
  for (double length : pattern) total += length;
  if (!(total > 0)) return {chain};
  std::vector<Chain> pieces;
  std::size_t k = 0;
  double left = pattern[0];
  bool on = true;
  const int n = int(chain.points.size());
  if (on) pieces.push_back({{chain.points[0]}, false});
  for (int i = 0; i < (chain.closed ? n : n - 1); ++i) {
    const Vec<2>&a = chain.points[i], &b = chain.points[(i + 1) % n];
    const double length = (b - a).norm();
    double at = 0;
    while (length - at > left) {
      at += left;
      const Vec<2> x = a + at / length * (b - a);
      if (on && x != pieces.back().points.back()) pieces.back().points.push_back(x);
      on = !on;
      if (on) pieces.push_back({{x}, false});
      k = (k + 1) % pattern.size();
      left = pattern[k];
    }
    left -= length - at;
    if (on && b != pieces.back().points.back()) pieces.back().points.push_back(b);
  }
  return pieces;
}

}  // namespace

std::vector<Chain> split_at_gaps(std::span<const Vec<2>> points, bool closed) {
  std::vector<Chain> chains(1);
  bool gap = false;
  for (const auto& x : points) {
    auto& chain = chains.back().points;
    if (!x.allFinite()) {
      gap = true;
      if (!chain.empty()) chains.emplace_back();
    } else if (chain.empty() || x != chain.back()) {
      chain.push_back(x);
    }
  }
  if (chains.back().points.empty()) chains.pop_back();
  if (!closed || chains.empty()) return chains;
  const bool ends_finite = points.front().allFinite() && points.back().allFinite();
  if (!gap) {
    auto& chain = chains[0];
    if (chain.points.size() > 1 && chain.points.front() == chain.points.back())
      chain.points.pop_back();
    chain.closed = chain.points.size() > 1;
  } else if (ends_finite) {  // the last chain continues with the first
    auto& last = chains.back().points;
    const auto& first = chains.front().points;
    last.insert(last.end(), first.begin() + (last.back() == first.front()), first.end());
    chains.erase(chains.begin());
  }
  return chains;
}

std::vector<Vec<2>> stroke_triangles(std::span<const Vec<2>> points, const Stroke& style,
                                     double tolerance) {
  std::vector<Vec<2>> triangles;
  if (!(style.width > 0)) return triangles;
  Outline outline(style.width, tolerance, triangles);
  for (const auto& chain : split_at_gaps(points, style.closed)) {
    if (style.dash.empty()) {
      outline.add(chain.points, chain.closed, style.cap);
    } else {
      for (const auto& piece : dashes(chain, style.dash))
        outline.add(piece.points, piece.closed, style.cap);
    }
  }
  return triangles;
}

}  // namespace sem
