#include "src2d/shapes/shape_fields.h"

#include <algorithm>

#include "sem/scene/files.h"
#include "src2d/shapes/shapes.h"

namespace sem::shapes2d {
namespace {

constexpr int max_parts = 10000;

std::string text(const Vec<2>& X) {
  std::string result = "[";
  result += exact_text(X[0]) + ", ";
  return result + exact_text(X[1]) + ']';
}

void describe_degree(Fields& fields, int& degree) {
  fields.integer("degree", degree, 1, 9, "rectangle, polygon: NURBS degree of the straight parts");
}

// Counts of parts, one for each of n sides.
void describe_counts(Fields& fields, std::vector<int>& counts, int n, const char* meaning) {
  fields.integers("parts", counts, 1, meaning);
  if (int(counts.size()) != n)
    fields.reject("parts", std::to_string(counts.size()) + " counts",
                  std::to_string(n) + ", one for each side");
  for (const int count : counts)
    if (count > max_parts)
      fields.reject("parts", std::to_string(count), "at most " + std::to_string(max_parts));
}

void describe(Fields& fields, Rectangle& r) {
  fields.vector<2>("lower", r.lower, "m", "rectangle: lower left corner");
  fields.vector<2>("upper", r.upper, "m",
                   "rectangle: upper right corner, above and right of 'lower'");
  if (!(r.lower.array() < r.upper.array()).all())
    fields.reject("upper", text(r.upper),
                  "more than 'lower', " + text(r.lower) + ", in x and in y");
  std::vector<int> counts(r.n_parts.begin(), r.n_parts.end());
  describe_counts(fields, counts, 4,
                  "rectangle: equal parts of the sides bottom, right, top, left");
  std::copy(counts.begin(), counts.end(), r.n_parts.begin());
  describe_degree(fields, r.degree);
}

void describe(Fields& fields, Polygon& polygon) {
  fields.require("vertices");
  fields.points<2>("vertices", polygon.vertices, "m", "polygon: at least 3, in order");
  const int n = int(polygon.vertices.cols());
  if (n < 3) fields.reject("vertices", std::to_string(n) + " vertices", "at least 3");
  for (int s = 0; s < n; ++s)
    if (polygon.vertices.col(s) == polygon.vertices.col((s + 1) % n))
      fields.reject("vertices", text(polygon.vertices.col(s)) + " twice in succession",
                    "sides that are not empty (the last vertex is joined to the first)");
  polygon.n_parts.assign(n, 1);
  describe_counts(fields, polygon.n_parts, n,
                  "polygon: equal parts of each side; 1 each if absent");
  describe_degree(fields, polygon.degree);
}

void describe_arcs(Fields& fields, int& n_arcs) {
  fields.integer("arcs", n_arcs, 3, max_parts,
                 "disc, ellipse, annulus: rational quadratic parts of a circle");
}

void describe(Fields& fields, Disc& disc) {
  fields.vector<2>("center", disc.center, "m", "disc, ellipse, annulus: center");
  fields.number("radius", disc.radius, positive, "m", "disc: radius");
  describe_arcs(fields, disc.n_arcs);
}

void describe(Fields& fields, Ellipse& ellipse) {
  fields.vector<2>("center", ellipse.center, "m", "ellipse: center");
  std::vector<double> radii(ellipse.radii.begin(), ellipse.radii.end());
  fields.numbers("radii", radii, 2, positive, "m", "ellipse: half of the two axes");
  ellipse.radii << radii[0], radii[1];
  fields.number("rotation", ellipse.rotation, any_number, "rad",
                "ellipse: angle of the first axis from x");
  describe_arcs(fields, ellipse.n_arcs);
}

void describe(Fields& fields, Annulus& annulus) {
  fields.vector<2>("center", annulus.center, "m", "annulus: center");
  fields.number("inner_radius", annulus.inner_radius, positive, "m", "annulus: radius of the hole");
  fields.number("outer_radius", annulus.outer_radius, positive, "m",
                "annulus: more than inner_radius");
  if (!(annulus.inner_radius < annulus.outer_radius))
    fields.reject("inner_radius", exact_text(annulus.inner_radius),
                  "less than outer_radius, " + exact_text(annulus.outer_radius));
  describe_arcs(fields, annulus.n_arcs);
}

void describe_control_points(Fields& fields, Points<2>& points) {
  fields.require("control_points");
  fields.points<2>("control_points", points, "m",
                   "closed_curve, spline_loop: closed control polygon of a uniform cubic B-spline, "
                   "at least 3");
  if (points.cols() < 3)
    fields.reject("control_points", std::to_string(points.cols()) + " control points",
                  "at least 3");
  else if ((points.colwise() - Vec<2>(points.col(0))).isZero(0))
    fields.reject("control_points", "the same point throughout", "points that differ");
}

void describe(Fields& fields, ClosedCurve& curve) {
  describe_control_points(fields, curve.control_points);
}

void describe(Fields& fields, SplineLoop& loop) {
  describe_control_points(fields, loop.control_points);
  fields.integer("parts", loop.n_parts, 1, max_parts,
                 "spline_loop: parts that the loop is cut into");
}

void describe(Fields& fields, Path& path) {
  fields.require("control_points");
  fields.points<2>("control_points", path.control_points, "m", "path: control polygon of an open uniform B-spline");
  path.degree = std::clamp(int(path.control_points.cols()) - 1, 1, 3);
  fields.integer("degree", path.degree, 1, 9, "path: NURBS degree; 3 if absent and there are points enough");
  const int n = int(path.control_points.cols());
  if (n <= path.degree)
    fields.reject("control_points", std::to_string(n) + " control points", "more than 'degree', " + std::to_string(path.degree));
  if (n > 0 && (path.control_points.colwise() - Vec<2>(path.control_points.col(0))).isZero(0))
    fields.reject("control_points", "the same point throughout", "points that differ");
  fields.integer("parts", path.n_parts, 1, max_parts, "path: parts that it is cut into");
}

template <class Shape>
void append(Fields& fields, Parts& parts) {
  Shape shape;
  describe(fields, shape);
  if (!fields.reading()) return;
  for (auto& part : make_parts(shape)) parts.push_back(std::move(part));
}

}  // namespace

void describe_shape(Fields& fields, std::vector<ScenePart<2>>& parts) {
  struct Type {
    const char* name;
    void (*append)(Fields&, Parts&);
  };
  static const Type types[] = {{"rectangle", append<Rectangle>},
                               {"polygon", append<Polygon>},
                               {"disc", append<Disc>},
                               {"ellipse", append<Ellipse>},
                               {"annulus", append<Annulus>},
                               {"closed_curve", append<ClosedCurve>},
                               {"spline_loop", append<SplineLoop>},
                               {"path", append<Path>}};
  std::vector<std::string> names;
  for (const Type& type : types) names.push_back(type.name);
  int chosen = 0;
  fields.require("type");
  fields.option("type", chosen, names,
                "which shape; the fields below belong to the types they name");
  for (int t = 0; t < int(names.size()); ++t)
    if (fields.documenting() || t == chosen) types[t].append(fields, parts);
}

}  // namespace sem::shapes2d
