#include "tests/hard_cases/shapes.h"

#include <algorithm>
#include <cmath>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/refine.h"

namespace sem::stability {
namespace {

using Surface = Nurbs<2, 3>;

// Straight along the second parameter, from one curve to another with the same knots.
Surface ruled_surface(const Curve& from, double z_from, const Curve& to, double z_to) {
  Surface surface;
  surface.degree = {from.degree[0], 1};
  surface.knots = {from.knots[0], {0, 0, 1, 1}};
  const Eigen::Index n = from.control_points.cols();
  surface.control_points.resize(3, 2 * n);
  surface.control_points.topRows(2) << from.control_points, to.control_points;
  surface.control_points.row(2) << Eigen::RowVectorXd::Constant(n, z_from), Eigen::RowVectorXd::Constant(n, z_to);
  surface.weights.resize(2 * n);
  surface.weights << from.weights, to.weights;
  return surface;
}

Vec<2> end(const Curve& curve, bool last) {
  const Interval range = domain(curve, 0);
  return point(curve, Param<1>(last ? range.upper : range.lower));
}

// Largest side of the box of some points of each knot span: near enough for lengths that scale with it.
double extent(const PlaneShape& shape) {
  Box<2> box;
  for (const auto& solid : shape.solids)
    for (const auto& curve : solid.boundary)
      for (const auto& [a, b] : spans(curve, 0))
        for (int k = 0; k <= 4; ++k) box.include(point(curve, Param<1>(a + k * (b - a) / 4)));
  return (box.upper - box.lower).maxCoeff();
}

}  // namespace

template <>
Body<2> body_of<2>(const PlaneShape& shape) {
  Body<2> body{{}, shape.area, extent(shape), shape.connected};
  for (const auto& solid : shape.solids) body.solids.push_back(solid.boundary);
  return body;
}

template <>
Body<3> body_of<3>(const PlaneShape& shape) {
  Body<3> body{{}, shape.area, std::max(1.0, extent(shape)), shape.connected};
  for (const auto& solid : shape.solids) {
    auto& parts = body.solids.emplace_back();
    for (const auto& curve : solid.boundary) parts.push_back(ruled_surface(curve, 0, curve, 1));
    for (const auto& cell : solid.cells)
      for (const double z : {0.0, 1.0}) parts.push_back(ruled_surface(cell.lower, z, cell.upper, z));
  }
  return body;
}

template <int Dim>
Body<Dim> changed(Body<Dim> body, const std::function<void(Nurbs<Dim - 1, Dim>&, int)>& change) {
  int index = 0;
  for (auto& solid : body.solids)
    for (auto& part : solid) change(part, index++);
  return body;
}

template <int Dim>
Body<Dim> scaled(const Body<Dim>& body, double factor) {
  Body<Dim> result = changed<Dim>(body, [&](auto& part, int) { part.control_points *= factor; });
  result.volume *= std::pow(factor, Dim);
  result.size *= factor;
  return result;
}

template <int Dim>
Body<Dim> moved(const Body<Dim>& body, const Vec<Dim>& by) {
  return changed<Dim>(body, [&](auto& part, int) { part.control_points.colwise() += by; });
}

template <int Dim>
Body<Dim> elevated(const Body<Dim>& body, int times) {
  return changed<Dim>(body, [&](auto& part, int) {
    for (int axis = 0; axis < Dim - 1; ++axis) part = elevate_degree(part, axis, times);
  });
}

template <int Dim>
Body<Dim> with_mixed_orientation(const Body<Dim>& body) {
  return changed<Dim>(body, [&](auto& part, int index) {
    if (index % 2) part = reversed(part, 0);
  });
}

std::vector<Curve> polygon(const std::vector<Vec<2>>& corners) {
  std::vector<Curve> sides;
  for (size_t i = 0; i < corners.size(); ++i)
    sides.push_back(segment<2>(corners[i], corners[(i + 1) % corners.size()]));
  return sides;
}

Cell quad(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d) {
  return {segment<2>(a, b), segment<2>(d, c)};
}

Curve bezier(const std::vector<Vec<2>>& points, const std::vector<double>& weights) {
  Points<2> p(2, points.size());
  Eigen::VectorXd w = Eigen::VectorXd::Ones(Eigen::Index(points.size()));
  for (size_t i = 0; i < points.size(); ++i) {
    p.col(Eigen::Index(i)) = points[i];
    if (!weights.empty()) w[Eigen::Index(i)] = weights[i];
  }
  return bezier_curve<2>(p, w);
}

Curve arc(const Vec<2>& center, double radius, double from, double to, double stretch) {
  const double half = (to - from) / 2;
  const auto at = [&](double angle, double r) { return Vec<2>(center + r * Vec<2>(std::cos(angle), std::sin(angle))); };
  return bezier({at(from, radius), at(from + half, radius / std::cos(half)), at(to, radius)},
                {1, stretch * std::cos(half), stretch * stretch});
}

PlaneShape rectangle(const Vec<2>& lower, const Vec<2>& upper, int n_parts) {
  const Vec<2> corners[] = {lower, {upper[0], lower[1]}, upper, {lower[0], upper[1]}};
  std::vector<Vec<2>> points;
  for (int c = 0; c < 4; ++c)
    for (int k = 0; k < n_parts; ++k)
      points.push_back(corners[c] + double(k) / n_parts * (corners[(c + 1) % 4] - corners[c]));
  return {{{polygon(points), {quad(corners[0], corners[1], corners[2], corners[3])}}}, (upper - lower).prod()};
}

PlaneShape ruled(const Curve& lower, const Curve& upper, double area) {
  PlaneShape shape{{{{lower}, {{lower, upper}}}}, area};
  auto& boundary = shape.solids[0].boundary;
  if (end(lower, true) != end(upper, true)) boundary.push_back(segment<2>(end(lower, true), end(upper, true)));
  boundary.push_back(upper);
  if (end(lower, false) != end(upper, false)) boundary.push_back(segment<2>(end(upper, false), end(lower, false)));
  return shape;
}

PlaneShape disc(const Vec<2>& center, double radius, double stretch) {
  const auto quarter = [&](double from, double to) { return arc(center, radius, from * M_PI / 2, to * M_PI / 2, stretch); };
  const Curve lower_left = quarter(-2, -1), upper_left = quarter(2, 1), lower_right = quarter(-1, 0), upper_right = quarter(1, 0);
  return {{{{lower_left, lower_right, upper_right, upper_left}, {{lower_left, upper_left}, {lower_right, upper_right}}}},
          M_PI * radius * radius};
}

PlaneShape together(PlaneShape a, const PlaneShape& b, double area, bool connected) {
  a.solids.insert(a.solids.end(), b.solids.begin(), b.solids.end());
  a.area = area;
  a.connected = connected;
  return a;
}

PlaneShape as_one_solid(const PlaneShape& shape) {
  PlaneShape result{{{}}, shape.area, shape.connected};
  for (const auto& solid : shape.solids) {
    auto& all = result.solids[0];
    all.boundary.insert(all.boundary.end(), solid.boundary.begin(), solid.boundary.end());
    all.cells.insert(all.cells.end(), solid.cells.begin(), solid.cells.end());
  }
  return result;
}

#define SEM_INSTANTIATE(Dim)                                                                                     \
  template Body<Dim> changed<Dim>(Body<Dim>, const std::function<void(Nurbs<Dim - 1, Dim>&, int)>&);             \
  template Body<Dim> scaled<Dim>(const Body<Dim>&, double);                                                      \
  template Body<Dim> moved<Dim>(const Body<Dim>&, const Vec<Dim>&);                                              \
  template Body<Dim> elevated<Dim>(const Body<Dim>&, int);                                                       \
  template Body<Dim> with_mixed_orientation<Dim>(const Body<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem::stability
