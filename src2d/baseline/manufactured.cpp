#include "src2d/baseline/manufactured.h"

#include <cmath>
#include <stdexcept>

#include "sem/mechanics/loads.h"
#include "sem/solve/cholesky.h"

namespace sem::baseline {
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

ManufacturedError solve_manufactured(const std::vector<ScenePart<2>>& parts, const MethodOptions& method,
                                     const Manufactured& exact) {
  Scene<2> scene;
  scene.solids.push_back({"body", exact.material, parts});
  scene.method = method;
  const auto model = build_model(scene, "");
  const auto& d = model->discretization;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model->system.size());
  Eigen::Map<Points<2>> nodal(load.data(), 2, load.size() / 2);
  for (const auto& block : d.interior.blocks)
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int point = block.points[k];
      const Vec<2> force = d.quadrature.weight[point] * exact.body_force(d.quadrature.position.col(point));
      for (size_t j = 0; j < block.columns.size(); ++j) nodal.col(block.columns[j]) += block.value(k, j) * force;
    }
  add_traction<2>(
      d, [&](int, const Vec<2>& X, const Vec<2>& N) -> Vec<2> { return exact.stress(X) * N; }, load);

  // z_0 is the translation, z_1 and z_2 the affine field's columns along x and y: held are entries 0, 1 and
  // the rotation's share of z_1.
  std::vector<int> free = {2};
  for (int entry = 4; entry < load.size(); ++entry) free.push_back(entry);
  Eigen::MatrixXd K(load.size(), load.size());
  model->energy->hessian(model->system.rest, false, K);
  const int n = int(free.size());
  Eigen::MatrixXd A(n, n);
  Eigen::VectorXd x(n), z = Eigen::VectorXd::Zero(load.size());
  for (int j = 0; j < n; ++j) {
    x[j] = load[free[j]];
    for (int i = 0; i < n; ++i) A(i, j) = K(free[i], free[j]);
  }
  Cholesky cholesky(n);
  if (!cholesky.compute(A)) throw std::runtime_error("manufactured solution: singular stiffness");
  cholesky.solve_in_place(x);
  for (int j = 0; j < n; ++j) z[free[j]] = x[j];

  const auto energy = [&](const Mat<2>& G) { return energy_density<2>(exact.material, Mat<2>(Mat<2>::Identity() + G)); };
  double error = 0, norm = 0;
  for (const auto& block : d.interior.blocks)
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int point = block.points[k];
      const Mat<2> G = exact.gradient(d.quadrature.position.col(point));
      error += d.quadrature.weight[point] * energy(deformation_gradient(block, int(k), z) - G);
      norm += d.quadrature.weight[point] * energy(G);
    }
  return {std::sqrt(error / norm), n, d.quadrature.size()};
}

}  // namespace sem::baseline
