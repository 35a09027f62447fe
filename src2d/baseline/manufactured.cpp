#include "src2d/baseline/manufactured.h"

#include <cmath>
#include <stdexcept>

#include "sem/mechanics/loads.h"
#include "sem/solve/cholesky.h"
#include "src2d/shapes/shapes.h"

namespace sem::baseline {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// u and its derivatives to order 2.
struct Jet {
  Vec<2> u, x, y, xx, xy, yy;
};
Jet jet(double k, const Vec<2>& X) {
  const double c = 0.7 * k, h = 0.5 * k;
  const double sx = std::sin(k * X[0]), cx = std::cos(k * X[0]), sy = std::sin(c * X[1]), cy = std::cos(c * X[1]);
  const double e = std::exp(h * X[0]), s = e * std::sin(k * X[1] + 0.3), t = e * std::cos(k * X[1] + 0.3);
  return {{sx * cy, s},           {k * cx * cy, h * s},         {-c * sx * sy, k * t},
          {-k * k * sx * cy, h * h * s}, {-k * c * cx * sy, h * k * t}, {-c * c * sx * cy, -k * k * s}};
}

}  // namespace

Vec<2> Manufactured::displacement(const Vec<2>& X) const { return jet(wave_number, X).u; }

Mat<2> Manufactured::gradient(const Vec<2>& X) const {
  const Jet j = jet(wave_number, X);
  Mat<2> G;
  G << j.x, j.y;
  return G;
}

Mat<2> Manufactured::stress(const Vec<2>& X) const {
  return first_piola<2>(material, Mat<2>(Mat<2>::Identity() + gradient(X)));
}

// Navier's equations: -(lambda + mu) grad div u - mu laplace u.
Vec<2> Manufactured::body_force(const Vec<2>& X) const {
  const Jet j = jet(wave_number, X);
  const Vec<2> grad_div(j.xx[0] + j.xy[1], j.xy[0] + j.yy[1]);
  const double lambda = material.lame_lambda(), mu = material.lame_mu();
  return -(lambda + mu) * grad_div - mu * (j.xx + j.yy);
}

std::vector<ScenePart<2>> manufactured_body(bool convex, int m) {
  if (convex) return shapes2d::make_parts(shapes2d::Rectangle{{0, 0}, {1, 1}, {m, m, m, m}, 3});
  shapes2d::Polygon polygon;
  polygon.vertices.resize(2, 6);
  polygon.vertices << 0, 1, 1, 0.5, 0.5, 0,  //
      0, 0, 0.5, 0.5, 1, 1;
  polygon.n_parts = {2 * m, m, m, m, m, 2 * m};
  polygon.degree = 3;
  return shapes2d::make_parts(polygon);
}

VectorXd manufactured_load(const Discretization<2>& body, const Manufactured& exact) {
  VectorXd f = VectorXd::Zero(2 * body.unknowns.size());
  Points<2> force(2, body.quadrature.size());
  for (int k = 0; k < force.cols(); ++k)
    force.col(k) = body.quadrature.weight[k] * exact.body_force(body.quadrature.position.col(k));
  Eigen::Map<Points<2>>(f.data(), 2, body.unknowns.size()) = evaluate_transposed(body.interior, force);
  add_traction<2>(
      body, [&](int, const Vec<2>& X, const Vec<2>& N) -> Vec<2> { return exact.stress(X) * N; }, f);
  return f;
}

VectorXd manufactured_stress(const Discretization<2>& body, const Manufactured& exact) {
  VectorXd f = VectorXd::Zero(2 * body.unknowns.size());
  Points<2> nodal = Points<2>::Zero(2, body.interior.n_columns + body.interior.n_shared());
  for (const auto& block : body.interior.blocks)
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int point = block.points[k];
      const Mat<2> P = body.quadrature.weight[point] * exact.stress(body.quadrature.position.col(point));
      for (size_t j = 0; j < block.columns.size(); ++j)
        for (int b = 0; b < 2; ++b) nodal.col(block.columns[j]) += block.gradient[b](k, j) * P.col(b);
    }
  add_shared(body.interior, nodal);
  Eigen::Map<Points<2>>(f.data(), 2, body.unknowns.size()) = nodal.leftCols(body.unknowns.size());
  return f;
}

ManufacturedSolution solve_manufactured(const Discretization<2>& body, Potential& V, const VectorXd& f,
                                        const Manufactured& exact) {
  const int n = V.size();
  // Mean displacement and, about the middle, rotation over the points: rows R of u, of the exact one r.
  const auto& rule = body.quadrature;
  const Vec<2> middle = (body.boundary.box.lower + body.boundary.box.upper) / 2;
  MatrixXd R = MatrixXd::Zero(3, n);
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
  Points<2> turn(2, rule.size());
  for (int k = 0; k < rule.size(); ++k) {
    const Vec<2> arm = rule.position.col(k) - middle, u = exact.displacement(rule.position.col(k));
    turn.col(k) = rule.weight[k] / body.boundary.box.diagonal() * Vec<2>(-arm[1], arm[0]);
    r += Eigen::Vector3d(rule.weight[k] * u[0], rule.weight[k] * u[1], turn.col(k).dot(u));
  }
  for (int a = 0; a < 3; ++a) {
    Points<2> values = turn;
    if (a < 2) values = Vec<2>::Unit(a) * rule.weight.transpose();
    const Points<2> row = evaluate_transposed(body.interior, values);
    R.row(a) = Eigen::Map<const VectorXd>(row.data(), n);
  }
  MatrixXd K = V.dense_hessian(affine_field<2>(body.unknowns, Mat<2>::Identity(), Vec<2>::Zero()));
  const double area = rule.weight.sum();
  K += exact.material.youngs_modulus / (area * area) * R.transpose() * R;
  ManufacturedSolution solution{f + exact.material.youngs_modulus / (area * area) * R.transpose() * r};
  Cholesky cholesky(n);
  if (!cholesky.compute(K)) throw std::runtime_error("manufactured solution: singular stiffness");
  cholesky.solve_in_place(solution.u);

  const auto energy = [&](const Mat<2>& G) { return energy_density<2>(exact.material, Mat<2>(Mat<2>::Identity() + G)); };
  double error = 0, norm = 0;
  const Points<2> y = coefficients(body.interior, solution.u);
  for (const auto& block : body.interior.blocks)
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int point = block.points[k];
      const Mat<2> G = exact.gradient(rule.position.col(point));
      error += rule.weight[point] * energy(deformation_gradient(block, int(k), y) - G);
      norm += rule.weight[point] * energy(G);
    }
  solution.energy = std::sqrt(error / norm);
  return solution;
}

ManufacturedError solve_manufactured(const std::vector<ScenePart<2>>& parts, const MethodOptions& method,
                                     const Manufactured& exact) {
  Scene<2> scene;
  scene.solids.push_back({"body", exact.material, parts});
  scene.method = method;
  const auto model = build_model(scene, "");
  const auto& body = model->discretization;
  const auto solution = solve_manufactured(body, *model->energy, manufactured_load(body, exact), exact);
  return {solution.energy, 2 * body.unknowns.size() - 3, body.quadrature.size()};
}

}  // namespace sem::baseline
