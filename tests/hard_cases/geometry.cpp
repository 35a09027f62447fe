// Hard shapes.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/hard_cases/body_cases.h"

namespace sem::stability {
namespace {

std::string power(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0e", value);
  return text;
}

// y = sign (x / length)^degree height over [0, length], lifted.
Curve monomial(int degree, double height, double lift) {
  std::vector<Vec<2>> points;
  for (int k = 0; k <= degree; ++k) points.push_back({double(k) / degree, lift + (k == degree ? height : 0)});
  return bezier(points);
}

// Straight, as a Bezier curve of some degree at constant speed.
Curve straight(const Vec<2>& a, const Vec<2>& b, int degree, const std::vector<double>& weights = {}) {
  std::vector<Vec<2>> points;
  for (int k = 0; k <= degree; ++k) points.push_back(a + double(k) / degree * (b - a));
  return bezier(points, weights);
}

// Between the chord from (0, 0) to (1, 0) and the conic with weights 1, w, 1 and middle control point (1/2, 1).
// Its height y and half width x, by symmetry, obey y^2 = w^2 ((1 - y)^2 - 4 x^2).
PlaneShape conic_segment(double w) {
  const double top = w / (1 + w);
  constexpr int n = 200000;  // Simpson's rule for s, y = top (1 - s^2)
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double s = double(k) / n, y = top * (1 - s * s);
    const double width = 2 * s * s * std::sqrt(1 - y + y / w);
    sum += width * (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) / (3.0 * n);
  }
  const std::vector<double> weights = {1, w, 1};
  return ruled(straight({0, 0}, {1, 0}, 2, weights), bezier({{0, 0}, {0.5, 1}, {1, 0}}, weights), top * sum);
}

PlaneShape bow_tie() {
  const Vec<2> middle(0.5, 0.5);
  PlaneShape shape{{{polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
                     {quad({0, 0}, middle, middle, {0, 1}), quad({1, 1}, middle, middle, {1, 0})}}}, 0.5, false};
  return shape;
}

// A square frame: hole from a to b on the diagonal.
PlaneSolid frame(double a, double b) {
  PlaneSolid solid{polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), {}};
  const Vec<2> outer[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, inner[] = {{a, a}, {b, a}, {b, b}, {a, b}};
  for (const auto& side : polygon({inner, inner + 4})) solid.boundary.push_back(side);
  for (int k = 0; k < 4; ++k) solid.cells.push_back(quad(outer[k], outer[(k + 1) % 4], inner[(k + 1) % 4], inner[k]));
  return solid;
}

PlaneShape nested() {
  const PlaneShape ring{{frame(0.2, 0.8)}, 1 - 0.36};
  return as_one_solid(together(ring, rectangle({0.35, 0.35}, {0.65, 0.65}), 1 - 0.36 + 0.09, false));
}

// A diamond-shaped hole whose corner lies on the left side.
PlaneShape touching_hole() {
  PlaneShape shape{{{polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), {}}}, 0.875};
  for (const auto& side : polygon({{0, 0.5}, {0.25, 0.25}, {0.5, 0.5}, {0.25, 0.75}}))
    shape.solids[0].boundary.push_back(side);
  return shape;
}

PlaneShape gap_between(double gap) {
  return together(rectangle({0, 0}, {0.5, 1}), rectangle({0.5 + gap, 0}, {1 + gap, 1}), 1, false);
}

// The right side stands away from the ends of its neighbours: caps close the loop.
PlaneShape open_joint(double gap) {
  PlaneShape shape = rectangle({0, 0}, {1, 1});
  shape.solids[0].boundary[1].control_points.row(0).array() += gap;
  shape.solids[0].cells.clear();
  shape.area += gap;
  return shape;
}

PlaneShape with_corners(const std::vector<Vec<2>>& corners, double area, const Cell& cell) {
  return {{{polygon(corners), {cell}}}, area};
}

PlaneShape side_twice() {
  PlaneShape shape = rectangle({0, 0}, {1, 1});
  shape.solids[0].boundary.push_back(shape.solids[0].boundary[1]);
  return shape;
}

// A rectangle whose top (and bottom, so that both run alike) is one curve with a knot of full multiplicity.
PlaneShape torn_top(int degree, double step) {
  const auto torn = [&](double y_left, double y_right) {
    Curve curve;
    curve.degree = {degree};
    for (const double u : {0.0, 0.5, 1.0}) curve.knots[0].insert(curve.knots[0].end(), degree + 1, u);
    curve.control_points.resize(2, 2 * degree + 2);
    for (int k = 0; k <= degree; ++k) {
      curve.control_points.col(k) = Vec<2>(0.5 * k / degree, y_left);
      curve.control_points.col(degree + 1 + k) = Vec<2>(0.5 + 0.5 * k / degree, y_right);
    }
    curve.weights.setOnes(2 * degree + 2);
    return curve;
  };
  PlaneShape shape = ruled(torn(0, 0), torn(1, 1 - step), 1 - step / 2);
  if (step > 0) shape.solids[0].cells.clear();  // the prism would have no wall at the step
  return shape;
}

// A unit square whose bottom and top have knots that run on beyond their ends.
PlaneShape unclamped_sides(int degree) {
  const auto side = [&](double y) {
    Curve curve;
    curve.degree = {degree};
    for (int k = -degree; k <= degree + 1; ++k) curve.knots[0].push_back(k);
    curve.control_points.resize(2, degree + 1);
    for (int k = 0; k <= degree; ++k) {  // at the means of `degree` knots: x(u) = u
      double mean = 0;
      for (int j = 1; j <= degree; ++j) mean += curve.knots[0][size_t(k + j)] / degree;
      curve.control_points.col(k) = Vec<2>(mean, y);
    }
    curve.weights.setOnes(degree + 1);
    return curve;
  };
  return ruled(side(0), side(1), 1);
}

PlaneShape diamond() {
  return with_corners({{0, 0.5}, {0.5, 0}, {1, 0.5}, {0.5, 1}}, 0.5,
                      quad({0, 0.5}, {0.5, 0}, {1, 0.5}, {0.5, 1}));
}

// Chords at y = 1/4 and 3/4 run along edges: 1 or 1/2 long.
PlaneShape i_beam() {
  PlaneShape shape{{{polygon({{0, 0}, {1, 0}, {1, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {1, 0.75}, {1, 1}, {0, 1},
                              {0, 0.75}, {0.25, 0.75}, {0.25, 0.25}, {0, 0.25}}), {}}}, 0.75};
  auto& cells = shape.solids[0].cells;
  cells.push_back(quad({0, 0}, {1, 0}, {1, 0.25}, {0, 0.25}));
  cells.push_back(quad({0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}));
  cells.push_back(quad({0, 0.75}, {1, 0.75}, {1, 1}, {0, 1}));
  return shape;
}

// A square with a round hole whose lowest and highest points are 1/8 from the sides.
PlaneShape round_hole(double radius) {
  PlaneShape shape{{{polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), {}}}, 1 - M_PI * radius * radius};
  const PlaneShape hole = disc({0.5, 0.5}, radius);
  auto& boundary = shape.solids[0].boundary;
  boundary.insert(boundary.end(), hole.solids[0].boundary.begin(), hole.solids[0].boundary.end());
  return shape;
}

// 24 by 1 with 240 parts along and 10 at each end.
PlaneShape many_parts() {
  std::vector<Vec<2>> corners;
  const Vec<2> turns[] = {{0, 0}, {24, 0}, {24, 1}, {0, 1}, {0, 0}};
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < (side % 2 ? 10 : 240); ++k)
      corners.push_back(turns[side] + k / (side % 2 ? 10.0 : 240.0) * (turns[side + 1] - turns[side]));
  return {{{polygon(corners), {}}}, 24};
}

// What n midpoint rays along x make of a shape: the mean of its chords.
template <class Chord>
double strips(int n, const Chord& chord) {
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += chord((k + 0.5) / n) / n;
  return sum;
}

// The paper's rays, with Gauss points on each: the shape's area becomes that of the strips.
BodyCase on_rays(const std::string& name, PlaneShape shape, int n_rays, double strip_area, double doubt = 0) {
  shape.area = strip_area;
  shape.connected = false;  // so few points do not carry the weight of every body
  BodyCase one{name, shape};
  one.fast = true;
  one.bounds.volume += doubt / strip_area;
  one.method = [n_rays](MethodOptions& method) {
    method.interior_rule.rule = InteriorRule::rays;
    method.rays.n_rays = n_rays;
    method.interval = {IntervalRule::gauss, 12};
  };
  return one;
}

std::vector<BodyCase> ray_cases() {
  std::vector<BodyCase> cases;
  cases.push_back(on_rays("rays through joints", diamond(), 9, strips(9, [](double y) { return 1 - std::abs(1 - 2 * y); })));
  cases.push_back(on_rays("rays along straight edges", i_beam(), 6, 0.75, 0.5 / 6));
  cases.push_back(on_rays("tangent rays", round_hole(0.375), 12, strips(12, [](double y) {
    return 1 - 2 * std::sqrt(std::max(0.0, 0.375 * 0.375 - (y - 0.5) * (y - 0.5)));
  })));
  return cases;
}

std::vector<BodyCase> thin_cases() {
  std::vector<BodyCase> cases;
  for (const double eps : {1e-12, 1e-9, 1e-6, 1e-3, 1e-1}) {
    const Rule rule = eps < 1e-9 ? Rule::may_refuse : Rule::must_solve;
    cases.push_back({"sliver " + power(eps), rectangle({0, 0}, {1, eps}), rule});
    cases.push_back({"wedge " + power(eps), ruled(straight({0, 0}, {1, 0}, 1), straight({0, 0}, {1, eps}, 1), eps / 2), rule});
    cases.push_back({"gap between solids " + power(eps), gap_between(eps), rule});
    cases.push_back({"gap within a solid " + power(eps), as_one_solid(gap_between(eps)), rule});
    cases.push_back({"open joint " + power(eps), open_joint(eps), rule});
    // Positions are rounded to 1e-16 of the size, strains across a thin solid to that by its thickness; a
    // sag below the thinner ones is as small as that.
    for (size_t k = cases.size() - 5; k < cases.size() - 3; ++k) {
      cases[k].bounds.identity = std::max(1e-8, 1e-14 / eps);
      cases[k].bounds.energy = std::max(1e-8, 1e-12 / eps);
      cases[k].bounds.balance = 1e-3;
      if (eps < 1e-3) cases[k].shape.connected = false;
    }
  }
  for (auto& one : cases) {
    one.fast = true;
    one.fast_3d = one.name.starts_with("sliver");
  }
  return cases;
}

std::vector<BodyCase> shape_cases() {
  std::vector<BodyCase> cases;
  const PlaneShape square = rectangle({0, 0}, {1, 1});
  const PlaneShape shifted = rectangle({0.5, 0.5}, {1.5, 1.5});
  cases.push_back({.name = "cusp at a joint", .shape = ruled(monomial(2, -1, 0), monomial(2, 1, 0), 2.0 / 3), .fast = true});
  cases.push_back({.name = "cusp inside a part", .shape = ruled(straight({0, 0}, {1, 0}, 3), bezier({{0, 0}, {1, 1}, {0, 1}, {1, 0}}), 0.3)});
  cases.back().bounds.volume = 1e-4;  // in 3D rays are not split at the cusp's edge
  cases.push_back({.name = "self-crossing", .shape = bow_tie(), .fast = true, .fast_3d = true});
  cases.push_back({.name = "a side twice", .shape = side_twice()});
  cases.push_back({.name = "coincident solids", .shape = together(square, square, 1, false), .fast = true});
  cases.push_back({.name = "solids share a side", .shape = together(square, rectangle({1, 0}, {2, 1}), 2, false)});
  cases.push_back({.name = "solids share part of a side", .shape = together(square, rectangle({1, 0.25}, {1.5, 0.75}), 1.25, false)});
  cases.push_back({.name = "overlapping solids", .shape = together(square, shifted, 1.75, false), .fast = true});
  cases.push_back({.name = "overlapping loops of a solid", .shape = as_one_solid(together(square, shifted, 1.75, false))});
  cases.push_back({.name = "hole", .shape = {{frame(0.2, 0.8)}, 1 - 0.36}});
  cases.push_back({.name = "island in a hole", .shape = nested()});
  cases.push_back({.name = "hole touches the side", .shape = touching_hole()});
  cases.push_back({.name = "part 1e-6 of its neighbour", .shape = with_corners({{1e-6, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}, 1, quad({0, 0}, {1, 0}, {1, 1}, {0, 1})), .fast = true, .method = [](MethodOptions& method) {
    method.projection.rank_tolerance = 1e-6;
  }});
  cases.push_back({.name = "500 parts", .shape = many_parts(), .method = [](MethodOptions& method) {
    method.projection.degree = 1;
    method.weights.cutoff = 0.55;
    if (method.formulation == Formulation::condensed) return;
    // Points between all parts: the cheapest rule that is exact for polynomials has fewer than parts.
    method.interior_rule.rule = InteriorRule::rays;
    method.rays = {.axis = 1, .n_rays = 240, .grid = RayGrid::midpoint};
    method.interval.points = 10;
  }});
  return cases;
}

std::vector<BodyCase> curve_cases() {
  std::vector<BodyCase> cases;
  for (const double w : {1e-6, 1e-3, 1e3, 1e6}) {
    cases.push_back({"weight " + power(w) + " in the middle", conic_segment(w)});
    cases.back().fast = true;
    cases.back().bounds.volume = 1e-3;  // in 3D rays are not split where the surface turns back
    cases.back().bounds.balance = 1e-4;
    if (w > 1e-6) continue;
    cases.back().bounds.energy = 1e-6;  // half a millionth thin
    cases.back().shape.connected = false;
  }
  for (const double stretch : {1e-3, 1e3})
    cases.push_back({"weights 1 to " + power(stretch * stretch) + " along arcs", disc({0, 0}, 1, stretch), Rule::must_solve, {.volume = 1e-4}});
  for (int degree = 1; degree <= 9; ++degree)
    cases.push_back({.name = "degree " + std::to_string(degree),
                     .shape = ruled(straight({0, 0}, {1, 0}, degree), monomial(degree, 0.5, 0.5), 0.5 + 0.5 / (degree + 1)),
                     .fast = degree == 1 || degree == 9});
  for (const int degree : {1, 3}) cases.push_back({"knot to discontinuity degree " + std::to_string(degree), torn_top(degree, 0)});
  cases.push_back({"part with a step", torn_top(1, 0.5)});
  for (const int degree : {2, 3, 5}) cases.push_back({"unclamped degree " + std::to_string(degree), unclamped_sides(degree)});
  return cases;
}

std::vector<BodyCase> transformed_cases() {
  // Not symmetric, curved, with joints of all kinds.
  const PlaneShape shape = ruled(monomial(3, 0.2, 0), monomial(3, -0.3, 1), 0.875);
  std::vector<BodyCase> cases;
  cases.push_back(changed_by({.name = "mixed orientation", .shape = shape, .fast = true},
                            [](const auto& body) { return with_mixed_orientation(body); }));
  for (const double factor : {1e-6, 1e6})
    cases.push_back(changed_by({.name = "scale " + power(factor), .shape = shape, .fast = true},
                              [=](const auto& body) { return scaled(body, factor); }));
  BodyCase far{.name = "1e6 sizes from zero", .shape = shape, .fast = true};
  far.bounds = {0, 1e-7, 1e-7, 1e-7, 1e-3};  // strains of 1e-4 on positions rounded to 1e-10
  cases.push_back(changed_by(far, []<int Dim>(const Body<Dim>& body) { return moved<Dim>(body, Vec<Dim>::Constant(1e6)); }));
  return cases;
}

}  // namespace

std::vector<Case> geometry_cases() {
  std::vector<Case> cases;
  for (const auto& group : {shape_cases(), ray_cases(), thin_cases(), curve_cases(), transformed_cases()})
    for (const auto& one : group) add_body_case(cases, "geometry", one);
  return cases;
}

}  // namespace sem::stability
