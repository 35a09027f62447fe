// Cells of surfaces against the surface itself: boxes, bounds of the squared distance's second
// derivatives.
#include "sem/nurbs/surface_cells.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "sem/nurbs/bernstein.h"
#include "shapes.h"

using namespace sem;
using namespace sem::test;

namespace {

// w (C - origin), w of a cell without children at t.
detail::Vec4 homogeneous(const detail::SurfaceCells& cells, const detail::SurfaceCell& cell,
                         const std::array<int, 2>& degree, const Vec<2>& t) {
  double B[2][max_nurbs_functions];
  for (int a = 0; a < 2; ++a)
    detail::bernstein_basis(degree[a], t[a], 0, max_nurbs_functions, B[a]);
  detail::Vec4 sum = detail::Vec4::Zero();
  const detail::Vec4* c = &cells.coefficients[cell.first_coefficient];
  for (int j = 0; j <= degree[1]; ++j)
    for (int i = 0; i <= degree[0]; ++i) sum += B[0][i] * B[1][j] * *c++;
  return sum;
}

}  // namespace

TEST_CASE("cells of a rational surface hold it, and bound the second derivatives of q - m v") {
  std::mt19937 random(21);
  for (int sample = 0; sample < 20; ++sample) {
    auto surface = random_nurbs<2, 3>(random, 1 + sample % 4, 2, true, true);
    const auto part = prepare(surface);
    const auto& cells = *part.cells;
    int n_leaves = 0;
    for (const auto& cell : cells.cells) {
      if (cell.first_child >= 0) continue;
      ++n_leaves;
      const auto& piece = part.pieces[cell.piece];
      const Vec<3> X(uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2));
      const double m = 4 * uniform(random);
      const auto bounds = cell.curvature(X, m);
      const auto f = [&](double u, double v) {
        const detail::Vec4 H = homogeneous(cells, cell, piece.degree, {u, v});
        return (H.head<3>() - H[3] * X).squaredNorm() - m * H[3] * H[3];
      };
      for (int k = 0; k < 5; ++k) {
        const Vec<2> t(0.01 + 0.98 * uniform(random), 0.01 + 0.98 * uniform(random));
        const detail::Vec4 H = homogeneous(cells, cell, piece.degree, t);
        const Vec<3> C = H.head<3>() / H[3];
        const Vec<3> direct = point(piece, Param<2>(cell.patch.parameter(t))) - cells.origin;
        CHECK((C - direct).norm() < 1e-12);
        CHECK((cell.patch.place(cell.patch.parameter(t)) - t).norm() < 1e-12);
        CHECK(cell.distance(C) < 1e-13);
        CHECK(H[3] * H[3] > bounds.least_v * (1 - 1e-12));
        CHECK(H[3] * H[3] < bounds.largest_v * (1 + 1e-12));
        const double h = 1e-4, u = t[0], v = t[1],
                     room = 1e-4 * (std::abs(bounds.uu) + std::abs(bounds.vv) + bounds.uv);
        CHECK((f(u + h, v) - 2 * f(u, v) + f(u - h, v)) / (h * h) > bounds.uu - room);
        CHECK((f(u, v + h) - 2 * f(u, v) + f(u, v - h)) / (h * h) > bounds.vv - room);
        CHECK(std::abs(f(u + h, v + h) - f(u + h, v - h) - f(u - h, v + h) + f(u - h, v - h)) /
                  (4 * h * h) <
              bounds.uv + room);
      }
    }
    CHECK(n_leaves > 4);
  }
}

TEST_CASE("a flat piece is one cell") {
  Nurbs<2, 3> flat;
  flat.degree = {1, 1};
  flat.knots = {std::vector<double>{0, 0, 1, 1}, {0, 0, 1, 1}};
  flat.control_points.resize(3, 4);
  flat.control_points << 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0;
  flat.weights = Eigen::VectorXd::Ones(4);
  CHECK(prepare(flat).cells->cells.size() == 1);
}
