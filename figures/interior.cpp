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

DistanceWeights<2> weights_of(const Discretization<2>& body, const Points<2>& position,
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

Eigen::MatrixXd weight_field(const Discretization<2>& body, const Points<2>& position,
                             DistanceWeight variant) {
  const auto w = blending_weights(weights_of(body, position, variant), body.boundary, position);
  return dense(w.n_parts, w.begin, w.part, w.w);
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
