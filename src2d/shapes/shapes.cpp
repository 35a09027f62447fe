#include "src2d/shapes/shapes.h"

#include <algorithm>
#include <cmath>

#include "sem/nurbs/bezier_curve.h"
#include "sem/nurbs/refine.h"

namespace sem::shapes2d {
namespace {

// a + (b - a) k / n: exact at both ends and where a = b.
Vec<2> interpolate(const Vec<2>& a, const Vec<2>& b, int k, int n) {
  return 2 * k <= n ? Vec<2>(a + double(k) / n * (b - a)) : Vec<2>(b + double(n - k) / n * (a - b));
}

std::string numbered(const std::string& group, int number) {
  return group + '.' + std::to_string(number);
}

void append_side(const std::string& name, const Vec<2>& from, const Vec<2>& to, int n_parts,
                 int degree, Parts& parts) {
  Points<2> points(2, degree + 1);
  for (int k = 0; k < n_parts; ++k) {
    for (int j = 0; j <= degree; ++j)
      points.col(j) = interpolate(from, to, k * degree + j, n_parts * degree);
    parts.push_back({n_parts > 1 ? numbered(name, k + 1) : name,
                     bezier_curve<2>(points, Eigen::VectorXd::Ones(degree + 1)),
                     {}});
  }
}

// The point of the unit circle after k / n of a turn; symmetric about the axes
// and diagonals bit for bit.
Vec<2> unit_circle_point(int k, int n) {
  const int quarter = 4 * (k % n) / n, rest = 4 * (k % n) % n;  // rest / n of a quarter turn
  const auto sine = [&](int r) {
    return 2 * r == n  ? std::sqrt(0.5)
           : 2 * r < n ? std::sin(M_PI / 2 * r / n)
                       : std::cos(M_PI / 2 * (n - r) / n);
  };
  const double c = sine(n - rest), s = sine(rest);
  switch (quarter) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

// Arcs of center + axes * (unit circle).
void append_circle(const std::string& group, const Vec<2>& center, const Mat<2>& axes, int n_arcs,
                   Parts& parts) {
  const double weight = unit_circle_point(1, 2 * n_arcs)[0];  // cos of half the angle
  for (int k = 0; k < n_arcs; ++k) {
    Points<2> points(2, 3);
    points << unit_circle_point(k, n_arcs), unit_circle_point(2 * k + 1, 2 * n_arcs) / weight,
        unit_circle_point(k + 1, n_arcs);
    for (int j = 0; j < 3; ++j) points.col(j) = center + axes * points.col(j);
    parts.push_back({numbered(group, k + 1), bezier_curve<2>(points, Eigen::Vector3d(1, weight, 1)), {}});
  }
}

Nurbs<1, 2> periodic_cubic(const Points<2>& control_points) {
  const int n = int(control_points.cols());
  Nurbs<1, 2> curve;
  curve.degree = {3};
  for (int k = -3; k <= n + 3; ++k) curve.knots[0].push_back(k);
  curve.control_points.resize(2, n + 3);
  curve.control_points << control_points, control_points.leftCols(3);
  curve.weights.setOnes(n + 3);
  return curve;
}

// Equal steps of the parameter, from 0. Where parts meet, rounding may differ: the start of one is the end
// of the one before.
Parts cut(const Nurbs<1, 2>& whole, const std::string& name, int n_parts, bool is_loop) {
  const double length = domain(whole, 0).upper;
  Nurbs<1, 2> rest = whole;
  Parts parts;
  for (int k = 1; k <= n_parts; ++k) {
    Nurbs<1, 2> part = rest;
    if (k < n_parts) {
      const auto halves = split_at(rest, 0, length * k / n_parts);
      part = halves[0];
      rest = halves[1];
    }
    parts.push_back({numbered(name, k), std::move(part), {}});
  }
  for (size_t k = is_loop ? 0 : 1; k < parts.size(); ++k) {
    const auto& before = parts[(k + parts.size() - 1) % parts.size()].shape.control_points;
    parts[k].shape.control_points.col(0) = Vec<2>(before.col(before.cols() - 1));
  }
  return parts;
}

}  // namespace

Parts make_parts(const Rectangle& r) {
  const Vec<2> corners[4] = {r.lower, {r.upper[0], r.lower[1]}, r.upper, {r.lower[0], r.upper[1]}};
  const char* names[4] = {"bottom", "right", "top", "left"};
  Parts parts;
  for (int s = 0; s < 4; ++s)
    append_side(names[s], corners[s], corners[(s + 1) % 4], r.n_parts[s], r.degree, parts);
  return parts;
}

Parts make_parts(const Polygon& polygon) {
  const int n = int(polygon.vertices.cols());
  Parts parts;
  for (int s = 0; s < n; ++s)
    append_side("side" + std::to_string(s + 1), polygon.vertices.col(s),
                polygon.vertices.col((s + 1) % n), polygon.n_parts.empty() ? 1 : polygon.n_parts[s],
                polygon.degree, parts);
  return parts;
}

Parts make_parts(const Disc& disc) {
  Parts parts;
  append_circle("arc", disc.center, disc.radius * Mat<2>::Identity(), disc.n_arcs, parts);
  return parts;
}

Parts make_parts(const Ellipse& ellipse) {
  const double c = std::cos(ellipse.rotation), s = std::sin(ellipse.rotation);
  Mat<2> axes;
  axes << c * ellipse.radii[0], -s * ellipse.radii[1],  //
      s * ellipse.radii[0], c * ellipse.radii[1];
  Parts parts;
  append_circle("arc", ellipse.center, axes, ellipse.n_arcs, parts);
  return parts;
}

Parts make_parts(const Annulus& annulus) {
  Parts parts;
  const Mat<2> one = Mat<2>::Identity();
  append_circle("inner", annulus.center, annulus.inner_radius * one, annulus.n_arcs, parts);
  append_circle("outer", annulus.center, annulus.outer_radius * one, annulus.n_arcs, parts);
  return parts;
}

Parts make_parts(const ClosedCurve& curve) {
  return {{"loop", periodic_cubic(curve.control_points), {}}};
}

Parts make_parts(const SplineLoop& loop) {
  const Nurbs<1, 2> whole = clamped(periodic_cubic(loop.control_points), 0);
  return cut(whole, "loop", loop.n_parts, true);
}

Parts make_parts(const Path& path) {
  const int n = int(path.control_points.cols()), p = path.degree;
  Nurbs<1, 2> whole;
  whole.degree = {p};
  for (int k = 0; k < n + p + 1; ++k) whole.knots[0].push_back(std::clamp(k - p, 0, n - p));
  whole.control_points = path.control_points;
  whole.weights.setOnes(n);
  return cut(whole, "path", path.n_parts, false);
}

}  // namespace sem::shapes2d
