#pragma once
// Plane shapes as named parts with exact geometry. Where two parts of a shape
// meet, their end points are the same bit for bit.

#include <array>
#include <vector>

#include "sem/scene/scene.h"

namespace sem::shapes2d {

using Parts = std::vector<ScenePart<2>>;

/// Straight sides. Each is cut into equal parts, "left" if it is one, "left.1",
/// "left.2", ... along the way if not; every part is a Bezier curve of the given
/// degree with equally spaced control points, so it is run through at constant speed.
struct Rectangle {
  Vec<2> lower{0, 0}, upper{1, 1};            ///< m, lower < upper
  std::array<int, 4> n_parts = {1, 1, 1, 1};  ///< of bottom, right, top, left; >= 1
  int degree = 1;                             ///< of the parts, 1 to 9
};
/// "bottom", "right", "top", "left", anticlockwise from the lower corner.
Parts make_parts(const Rectangle& rectangle);

struct Polygon {
  Points<2> vertices;        ///< m, at least 3, in order; the last is joined to the first
  std::vector<int> n_parts;  ///< of each side, >= 1; empty: 1 each
  int degree = 1;
};
/// "side1" from vertex 1 to 2, "side2", ...; cut and named as a rectangle's.
Parts make_parts(const Polygon& polygon);

/// Rational quadratic arcs "arc.1", "arc.2", ... of equal angle, anticlockwise
/// from the point at +x. Points on the axes are exact.
struct Disc {
  Vec<2> center{0, 0};
  double radius = 1;  ///< m, > 0
  int n_arcs = 4;     ///< >= 3
};
Parts make_parts(const Disc& disc);

/// The affine image of the unit disc: arcs as of a disc, from the end of the first axis.
struct Ellipse {
  Vec<2> center{0, 0};
  Vec<2> radii{2, 1};   ///< m, > 0
  int n_arcs = 4;       ///< >= 3
  double rotation = 0;  ///< rad, of the first axis from x
};
Parts make_parts(const Ellipse& ellipse);

/// Two concentric circles: "inner.1", ..., "outer.1", ..., both anticlockwise, so
/// that arcs of the same number face each other.
struct Annulus {
  Vec<2> center{0, 0};
  double inner_radius = 1, outer_radius = 2;  ///< m, 0 < inner < outer
  int n_arcs = 4;                             ///< of each circle, >= 3
};
Parts make_parts(const Annulus& annulus);

/// One part, "loop": the uniform cubic B-spline of the closed control polygon,
/// twice continuously differentiable everywhere. Its knots are not clamped: they
/// run on past the domain [0, n], and the first three control points are repeated at the end.
struct ClosedCurve {
  Points<2> control_points;  ///< m, n >= 3, each once
};
Parts make_parts(const ClosedCurve& curve);

/// The same curve cut at n k / n_parts into clamped parts "loop.1", "loop.2", ...
/// that keep its parameter.
struct SplineLoop {
  Points<2> control_points;  ///< m, n >= 3, each once
  int n_parts = 4;           ///< >= 1
};
Parts make_parts(const SplineLoop& loop);

/// An open curve: the B-spline of the control polygon with clamped ends and uniform knots, cut at equal steps of
/// its parameter into "path.1", "path.2", ... It bounds nothing by itself.
struct Path {
  Points<2> control_points;  ///< m, n >= degree + 1
  int degree = 3;            ///< 1 to 9; 1: straight from point to point
  int n_parts = 1;           ///< >= 1
};
Parts make_parts(const Path& path);

}  // namespace sem::shapes2d
