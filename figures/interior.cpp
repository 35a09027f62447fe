#include "figures/interior.h"

#include <array>
#include <cmath>
#include <map>

#include "sem/nurbs/closest.h"

namespace sem::figures {
namespace {

Points<2> as_points(const std::vector<Vec<2>>& list) {
  Points<2> points(2, list.size());
  for (size_t k = 0; k < list.size(); ++k) points.col(k) = list[k];
  return points;
}

template <int Dim>
DistanceWeights<Dim> weights_of(const Discretization<Dim>& body, const Points<Dim>& position,
                                DistanceWeight variant) {
  WeightOptions options = body.options.weights;
  options.variant = variant;
  return distance_weights(
      measure_distances(body.boundary, body.loops, position, variant, options.cutoff, 2), options);
}

Eigen::MatrixXd dense(int n_parts, const std::vector<int>& begin, const std::vector<int>& part,
                      const std::vector<double>& value) {
  Eigen::MatrixXd field = Eigen::MatrixXd::Zero(begin.size() - 1, n_parts);
  for (int k = 0; k < field.rows(); ++k)
    for (int e = begin[k]; e < begin[k + 1]; ++e) field(k, part[e]) = value[e];
  return field;
}

Vec<2> closest_boundary_point(const Boundary<2>& boundary, const Vec<2>& X) {
  ClosestPoint<2> best{{}, X, std::numeric_limits<double>::infinity()};
  for (const auto& part : boundary.parts) {
    const auto candidate = closest_point<2>(part, X, best.distance);
    if (candidate.distance < best.distance) best = candidate;
  }
  return best.point;
}

}  // namespace

Points<2> cells_inside(const Discretization<2>& body, int n_cells) {
  const Box<2>& box = body.boundary.box;
  const CellGrid grid = empty_grid(box, (box.upper - box.lower).maxCoeff() / n_cells);
  std::vector<Vec<2>> cells;
  for (int j = 0; j < grid.n_y; ++j)
    for (int i = 0; i < grid.n_x; ++i)
      if (inside(body.boundary, body.loops, grid.center(i, j))) cells.push_back(grid.center(i, j));
  return as_points(cells);
}

Eigen::MatrixXd theta_field(const Discretization<2>& body, const Points<2>& position,
                            DistanceWeight variant) {
  const auto theta = weights_of(body, position, variant);
  return dense(theta.n_parts, theta.begin, theta.part, theta.theta);
}

template <int Dim>
Eigen::MatrixXd weight_field(const Discretization<Dim>& body, const Points<Dim>& position,
                             DistanceWeight variant) {
  const auto w = blending_weights(weights_of(body, position, variant), body.boundary, position);
  return dense(w.n_parts, w.begin, w.part, w.w);
}

template Eigen::MatrixXd weight_field(const Discretization<2>&, const Points<2>&, DistanceWeight);
template Eigen::MatrixXd weight_field(const Discretization<3>&, const Points<3>&, DistanceWeight);

Slice slice_inside(const Discretization<3>& body, double z, int n_cells) {
  const Box<3>& box = body.boundary.box;
  const Vec<3> size = box.upper - box.lower;
  const double step = std::max(size[0], size[1]) / n_cells;
  const int n_x = int(std::ceil(size[0] / step)) + 1, n_y = int(std::ceil(size[1] / step)) + 1;
  const auto is_inside = [&](const Vec<3>& X) { return inside(body.boundary, body.loops, X); };
  const auto node = [&](int i, int j) {
    return Vec<3>(box.lower[0] + (i - 0.5) * step, box.lower[1] + (j - 0.5) * step, z);
  };
  std::vector<Vec<3>> points;
  std::map<std::array<int, 3>, int> made;  // node (i, j, -1), or where the edge after it is cut
  const auto add = [&](const std::array<int, 3>& key, const Vec<3>& X) {
    const auto [at, is_new] = made.try_emplace(key, int(points.size()));
    if (is_new) points.push_back(X);
    return at->second;
  };
  std::vector<char> is_in((n_x + 1) * (n_y + 1));
  for (int j = 0; j <= n_y; ++j)
    for (int i = 0; i <= n_x; ++i) is_in[j * (n_x + 1) + i] = is_inside(node(i, j));
  const auto in = [&](int i, int j) { return is_in[j * (n_x + 1) + i] != 0; };
  // The last place inside on the edge from node (i, j) along an axis.
  const auto cut = [&](int i, int j, int axis) {
    Vec<3> a = node(i, j), b = axis == 0 ? node(i + 1, j) : node(i, j + 1);
    if (!in(i, j)) std::swap(a, b);
    for (int k = 0; k < 12; ++k) {
      const Vec<3> middle = (a + b) / 2;
      (is_inside(middle) ? a : b) = middle;
    }
    return add({i, j, axis}, a);
  };
  Slice slice;
  for (int j = 0; j < n_y; ++j)
    for (int i = 0; i < n_x; ++i) {
      const int corner[4][2] = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}};
      const int edge[4][3] = {{i, j, 0}, {i + 1, j, 1}, {i, j + 1, 0}, {i, j, 1}};
      std::vector<int> polygon;
      for (int c = 0; c < 4; ++c) {
        const int *a = corner[c], *b = corner[(c + 1) % 4];
        if (in(a[0], a[1])) polygon.push_back(add({a[0], a[1], -1}, node(a[0], a[1])));
        if (in(a[0], a[1]) != in(b[0], b[1]))
          polygon.push_back(cut(edge[c][0], edge[c][1], edge[c][2]));
      }
      for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        slice.triangles.push_back({polygon[0], polygon[k], polygon[k + 1]});
    }
  slice.position.resize(3, points.size());
  for (std::size_t k = 0; k < points.size(); ++k) slice.position.col(Eigen::Index(k)) = points[k];
  return slice;
}

Quads fitted_quads(const Discretization<2>& body, double size) {
  const Box<2>& box = body.boundary.box;
  const CellGrid grid = empty_grid(box, size);
  std::vector<Vec<2>> corners;
  std::map<std::pair<int, int>, std::pair<int, bool>> known;  // of a corner: index, whether inside
  const auto corner = [&](int i, int j) {
    const auto [at, is_new] = known.insert({{i, j}, {int(corners.size()), false}});
    if (!is_new) return at->second;
    Vec<2> X = grid.box.lower + Vec<2>(i * (grid.box.upper[0] - grid.box.lower[0]) / grid.n_x,
                                       j * (grid.box.upper[1] - grid.box.lower[1]) / grid.n_y);
    at->second.second = inside(body.boundary, body.loops, X);
    if (!at->second.second) X = closest_boundary_point(body.boundary, X);
    corners.push_back(X);
    return at->second;
  };
  Quads result;
  for (int j = 0; j < grid.n_y; ++j)
    for (int i = 0; i < grid.n_x; ++i) {
      const auto a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                 d = corner(i, j + 1);
      if (a.second || b.second || c.second || d.second)
        result.quads.push_back({a.first, b.first, c.first, d.first});
    }
  result.corner = as_points(corners);
  return result;
}

}  // namespace sem::figures
