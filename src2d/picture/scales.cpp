#include "src2d/picture/scales.h"

#include <algorithm>
#include <cmath>

#include "sem/solve/sparse_cholesky.h"

namespace sem {
namespace {

using Eigen::VectorXd;

void enlarge(Box<2>& box, double margin) {
  box.lower -= Vec<2>::Constant(margin);
  box.upper += Vec<2>::Constant(margin);
}

// Rest positions of the control points that a pin holds.
std::vector<Vec<2>> pinned_points(const Model<2>& model) {
  const Points<2> rest = rest_controls(model.discretization.boundary);
  std::vector<Vec<2>> points;
  for (const auto& held : model.held)
    for (const int c : held.controls) points.push_back(rest.col(c));
  return points;
}

// The body's box on the way of a free body.
Box<2> ballistic_box(const Scene<2>& scene, const Box<2>& rest) {
  constexpr int n_times = 64;
  Box<2> box = rest;
  for (int k = 1; k <= n_times; ++k) {
    const double t = scene.analysis.duration * k / n_times;
    const Vec<2> path = t * scene.velocity + t * t / 2 * scene.gravity;
    box.include(Box<2>{rest.lower + path, rest.upper + path});
  }
  enlarge(box, 0.12 * rest.diagonal());
  return box;
}

// What a body hung by a point can reach: as far as at rest in every direction but up, and farther
// along gravity, which stretches it.
Box<2> swing_box(const Scene<2>& scene, const Box<2>& rest, const Vec<2>& pivot) {
  double reach = 0;
  for (const double x : {rest.lower[0], rest.upper[0]})
    for (const double y : {rest.lower[1], rest.upper[1]})
      reach = std::max(reach, (Vec<2>(x, y) - pivot).norm());
  Box<2> box{pivot, pivot};
  enlarge(box, 1.2 * reach);
  const double room = 0.08 * rest.diagonal(), stretched = 2.6 * reach;
  for (int a = 0; a < 2; ++a) {
    if (std::abs(scene.gravity[a]) < 0.9 * scene.gravity.norm()) continue;
    if (scene.gravity[a] < 0) {
      box.lower[a] = pivot[a] - stretched;
      box.upper[a] = rest.upper[a] + room;
    } else if (scene.gravity[a] > 0) {
      box.lower[a] = rest.lower[a] - room;
      box.upper[a] = pivot[a] + stretched;
    }
  }
  return box;
}

// dx/dX at every quadrature point.
std::vector<Mat<2>> deformation_gradients(const Map<2>& map, const VectorXd& z) {
  std::vector<Mat<2>> F(map.n_points);
  const Points<2> y = coefficients(map, z);
  for (const auto& block : map.blocks) {
    const Points<2> local = y(Eigen::all, block.columns);
    for (int b = 0; b < 2; ++b) {
      const Points<2> column = local * block.gradient[b].transpose();
      for (size_t k = 0; k < block.points.size(); ++k) F[block.points[k]].col(b) = column.col(k);
    }
  }
  return F;
}

double von_mises(const Material& material, const Mat<2>& F) {
  if (!std::isfinite(energy_density<2>(material, F)) || F.determinant() == 0)
    return std::numeric_limits<double>::quiet_NaN();
  const Mat<2> s = cauchy_stress<2>(material, F);
  const double szz = material.poisson_ratio * (s(0, 0) + s(1, 1));
  const Vec<3> differences(s(0, 0) - s(1, 1), s(1, 1) - szz, szz - s(0, 0));
  return std::sqrt(differences.squaredNorm() / 2 + 3 * s(0, 1) * s(0, 1));
}

// The linear static answer; motions without stiffness are held by a little of the mass matrix: they
// come out large, but carry no stress.
VectorXd linear_displacement(const Model<2>& model) {
  const System& system = model.system;
  SymmetricMatrix K = system.potential->new_hessian();
  system.potential->hessian(system.rest, true, K);
  VectorXd u = model.target - system.rest;
  VectorXd residual = system.load - K * u;
  const double largest_mass = system.mass.diagonal().maxCoeff();
  if (largest_mass > 0) K.add(1e-8 * K.diagonal().maxCoeff() / largest_mass, system.mass);
  SparseCholesky cholesky(K.plan(), K.components(), system.free);
  if (!cholesky.compute(K)) return VectorXd::Zero(system.size());
  cholesky.solve_in_place(residual);
  return u + residual;
}

}  // namespace

Box<2> view_box(const Scene<2>& scene, const Model<2>& model) {
  if (scene.output.view) return *scene.output.view;
  Box<2> rest = model.discretization.boundary.box;
  const double size = rest.diagonal();
  if (scene.analysis.kind != AnalysisKind::dynamics) {
    const Points<2> target = control_points(model.discretization.unknowns, model.target);
    for (int c = 0; c < target.cols(); ++c) rest.include(Vec<2>(target.col(c)));
    enlarge(rest, 0.12 * size);
    return rest;
  }
  const auto points = pinned_points(model);
  if (points.empty()) return ballistic_box(scene, rest);
  Box<2> held;
  for (const auto& x : points) held.include(x);
  if (held.diagonal() < 0.05 * size) return swing_box(scene, rest, (held.lower + held.upper) / 2);
  enlarge(rest, 0.3 * size);
  return rest;
}

double expected_stress(const Model<2>& model) {
  const auto F = deformation_gradients(model.discretization.interior, linear_displacement(model));
  std::vector<double> stress;
  for (size_t k = 0; k < F.size(); ++k) {
    Material material = model.materials.materials[model.materials.of_point[k]];
    material.model = MaterialModel::linear;
    stress.push_back(von_mises(material, Mat<2>(F[k] + Mat<2>::Identity())));
  }
  const auto high = stress.begin() + std::ptrdiff_t(0.98 * double(stress.size() - 1));
  std::nth_element(stress.begin(), high, stress.end());
  const auto& v = model.initial.v;
  const Eigen::Map<const Points<2>> rates(v.data(), 2, v.size() / 2);
  const Vec<2> mean = rates.rowwise().mean();
  double density = 0;
  for (const auto& material : model.materials.materials)
    density = std::max(density, material.density);
  return 2 * *high + density / 2 * (rates.colwise() - mean).colwise().squaredNorm().maxCoeff();
}

VectorXd von_mises(const Model<2>& model, const VectorXd& z) {
  const auto F = deformation_gradients(model.discretization.interior, z);
  VectorXd result(F.size());
  for (size_t k = 0; k < F.size(); ++k)
    result[k] = von_mises(model.materials.materials[model.materials.of_point[k]], F[k]);
  return result;
}

}  // namespace sem
