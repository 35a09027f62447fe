#include "sem/picture/scales.h"

#include <algorithm>
#include <cmath>

#include "sem/solve/sparse_cholesky.h"

namespace sem {
namespace {

using Eigen::VectorXd;

template <int Dim>
void enlarge(Box<Dim>& box, double margin) {
  box.lower -= Vec<Dim>::Constant(margin);
  box.upper += Vec<Dim>::Constant(margin);
}

// Rest positions of the control points that a pin holds.
template <int Dim>
std::vector<Vec<Dim>> pinned_points(const Model<Dim>& model) {
  const Points<Dim> rest = rest_controls(model.discretization.boundary);
  std::vector<Vec<Dim>> points;
  for (const auto& held : model.held)
    for (const int c : held.controls) points.push_back(rest.col(c));
  return points;
}

// The body's box on the way of a free body.
template <int Dim>
Box<Dim> ballistic_box(const Scene<Dim>& scene, const Box<Dim>& rest) {
  constexpr int n_times = 64;
  Box<Dim> box = rest;
  for (int k = 1; k <= n_times; ++k) {
    const double t = scene.analysis.duration * k / n_times;
    const Vec<Dim> path = t * scene.velocity + t * t / 2 * scene.gravity;
    box.include(Box<Dim>{rest.lower + path, rest.upper + path});
  }
  return box;
}

// How far from a point the box reaches.
template <int Dim>
double reach_from(const Vec<Dim>& pivot, const Box<Dim>& box) {
  return (pivot - box.lower).cwiseAbs().cwiseMax((box.upper - pivot).cwiseAbs()).norm();
}

// What a body hung by a point can reach: as far as at rest in every direction but up, and farther
// along gravity, which stretches it.
template <int Dim>
Box<Dim> swing_box(const Scene<Dim>& scene, const Box<Dim>& rest, const Vec<Dim>& pivot) {
  const double reach = reach_from(pivot, rest);
  Box<Dim> box{pivot, pivot};
  enlarge(box, 1.2 * reach);
  const double stretched = 2.6 * reach;
  for (int a = 0; a < Dim; ++a) {
    if (std::abs(scene.gravity[a]) < 0.9 * scene.gravity.norm()) continue;
    if (scene.gravity[a] < 0) {
      box.lower[a] = pivot[a] - stretched;
      box.upper[a] = rest.upper[a];
    } else if (scene.gravity[a] > 0) {
      box.lower[a] = rest.lower[a];
      box.upper[a] = pivot[a] + stretched;
    }
  }
  return box;
}

// dx/dX at every quadrature point.
template <int Dim>
std::vector<Mat<Dim>> deformation_gradients(const Map<Dim>& map, const VectorXd& z) {
  std::vector<Mat<Dim>> F(map.n_points);
  const Points<Dim> y = coefficients(map, z);
  for (const auto& block : map.blocks) {
    const Points<Dim> local = y(Eigen::all, block.columns);
    for (int b = 0; b < Dim; ++b) {
      const Points<Dim> column = local * block.gradient[b].transpose();
      for (size_t k = 0; k < block.points.size(); ++k) F[block.points[k]].col(b) = column.col(k);
    }
  }
  return F;
}

// The whole stress; in plane strain that across the plane to first order.
Mat<3> in_space(const Mat<2>& s, const Material& material) {
  Mat<3> all = Mat<3>::Zero();
  all.topLeftCorner<2, 2>() = s;
  all(2, 2) = material.poisson_ratio * (s(0, 0) + s(1, 1));
  return all;
}
const Mat<3>& in_space(const Mat<3>& s, const Material&) { return s; }

template <int Dim>
double von_mises(const Material& material, const Mat<Dim>& F) {
  if (!std::isfinite(energy_density<Dim>(material, F)) || F.determinant() == 0)
    return std::numeric_limits<double>::quiet_NaN();
  const Mat<Dim> in_plane = cauchy_stress<Dim>(material, F);
  const Mat<3> s = in_space(in_plane, material);
  const Vec<3> differences(s(0, 0) - s(1, 1), s(1, 1) - s(2, 2), s(2, 2) - s(0, 0)),
      shears(s(0, 1), s(1, 2), s(2, 0));
  return std::sqrt(differences.squaredNorm() / 2 + 3 * shears.squaredNorm());
}

// The linear static answer; motions without stiffness are held by a little of the mass matrix: they
// come out large, but carry no stress.
template <int Dim>
VectorXd linear_displacement(const Model<Dim>& model) {
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

// The control points of rest + u, no farther from the pivot than the body reaches at rest: a linear
// answer stretches what turns.
template <int Dim>
void include_moved(Box<Dim>& box, const Model<Dim>& model, const VectorXd& u,
                   const Box<Dim>& reached) {
  const Points<Dim> p =
      control_points(model.discretization.unknowns, VectorXd(model.system.rest + u));
  for (int c = 0; c < p.cols(); ++c)
    box.include(Vec<Dim>(Vec<Dim>(p.col(c)).cwiseMax(reached.lower).cwiseMin(reached.upper)));
}

// The box that a run of the linearised body visits, at most 200 steps of implicit Euler: with K the
// stiffness at rest, M/h^2 = A - K and d the increment of a step, A d = f(t) - K u + (A - K)
// d_before.
template <int Dim>
void include_linear_run(Box<Dim>& box, const Scene<Dim>& scene, const Model<Dim>& model,
                        const Box<Dim>& reached) {
  const System& system = model.system;
  const int n_steps =
      int(std::clamp(scene.analysis.duration / scene.analysis.time_step, 1.0, 200.0));
  const double h = scene.analysis.duration / n_steps;
  SymmetricMatrix K = system.potential->new_hessian();
  system.potential->hessian(system.rest, true, K);
  SymmetricMatrix A = K;
  A.add(1 / (h * h), system.mass);
  SparseCholesky cholesky(A.plan(), A.components(), system.free);
  if (!cholesky.compute(A)) return;
  VectorXd u = VectorXd::Zero(system.size()), d = u;
  for (const int i : system.free) d[i] = h * model.initial.v[i];
  for (int step = 1; step <= n_steps; ++step) {
    d = A * d - K * (u + d);
    d += model.load.periodic.empty() ? system.load : model.load.at(step * h);
    cholesky.solve_in_place(d);
    u += d;
    include_moved(box, model, u, reached);
  }
}

}  // namespace

template <int Dim>
Box<Dim> visited_box(const Scene<Dim>& scene, const Model<Dim>& model) {
  Box<Dim> box = model.discretization.boundary.box;
  const auto points = pinned_points(model);
  if (scene.analysis.kind == AnalysisKind::modes) return box;
  const bool dynamic = scene.analysis.kind == AnalysisKind::dynamics;
  if (points.empty()) return dynamic ? ballistic_box(scene, box) : box;
  Box<Dim> held;
  for (const auto& x : points) held.include(x);
  const Vec<Dim> pivot = (held.lower + held.upper) / 2;
  if (dynamic && held.diagonal() < 0.05 * box.diagonal()) return swing_box(scene, box, pivot);
  const Points<Dim> target = control_points(model.discretization.unknowns, model.target);
  for (int c = 0; c < target.cols(); ++c) box.include(Vec<Dim>(target.col(c)));
  Box<Dim> reached{pivot, pivot};
  enlarge(reached, 1.1 * reach_from(pivot, box));
  if (dynamic)
    include_linear_run(box, scene, model, reached);
  else
    include_moved(box, model, linear_displacement(model), reached);
  return box;
}

template <int Dim>
Box<Dim> motion_box(const Scene<Dim>& scene, const Model<Dim>& model) {
  Box<Dim> box = visited_box(scene, model);
  enlarge(box, 0.12 * model.discretization.boundary.box.diagonal());
  return box;
}

Box<2> view_box(const Scene<2>& scene, const Model<2>& model) {
  return scene.output.view ? *scene.output.view : motion_box(scene, model);
}

template <int Dim>
double expected_stress(const Model<Dim>& model) {
  const auto F = deformation_gradients(model.discretization.interior, linear_displacement(model));
  std::vector<double> stress;
  for (size_t k = 0; k < F.size(); ++k) {
    Material material = model.materials.materials[model.materials.of_point[k]];
    material.model = MaterialModel::linear;
    stress.push_back(von_mises<Dim>(material, Mat<Dim>(F[k] + Mat<Dim>::Identity())));
  }
  const auto high = stress.begin() + std::ptrdiff_t(0.98 * double(stress.size() - 1));
  std::nth_element(stress.begin(), high, stress.end());
  const auto& v = model.initial.v;
  const Eigen::Map<const Points<Dim>> rates(v.data(), Dim, v.size() / Dim);
  const Vec<Dim> mean = rates.rowwise().mean();
  double density = 0;
  for (const auto& material : model.materials.materials)
    density = std::max(density, material.density);
  return 2 * *high + density / 2 * (rates.colwise() - mean).colwise().squaredNorm().maxCoeff();
}

template <int Dim>
VectorXd von_mises(const Model<Dim>& model, const VectorXd& z) {
  const auto F = deformation_gradients(model.discretization.interior, z);
  VectorXd result(F.size());
  for (size_t k = 0; k < F.size(); ++k)
    result[k] = von_mises<Dim>(model.materials.materials[model.materials.of_point[k]], F[k]);
  return result;
}

template <int Dim>
double stress_limit(const Scene<Dim>& scene, const Model<Dim>& model) {
  const double expected =
      scene.analysis.kind == AnalysisKind::dynamics ? expected_stress(model) : 0;
  return expected > 0 ? round_up(expected) : 0;
}

StressScale stress_scale(const Eigen::VectorXd& stress, double limit) {
  StressScale scale{limit};
  for (const double value : stress) {
    if (std::isnan(value))
      ++scale.n_inverted;
    else
      scale.largest = std::max(scale.largest, value);
  }
  if (!(limit > 0) && scale.largest > 0) scale.limit = round_up(scale.largest);
  return scale;
}

double round_up(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (factor * decade >= value) return factor * decade;
  return 10 * decade;
}

#define SEM_INSTANTIATE(Dim)                                                \
  template Box<Dim> visited_box<Dim>(const Scene<Dim>&, const Model<Dim>&); \
  template Box<Dim> motion_box<Dim>(const Scene<Dim>&, const Model<Dim>&);  \
  template double expected_stress<Dim>(const Model<Dim>&);                  \
  template VectorXd von_mises<Dim>(const Model<Dim>&, const VectorXd&);     \
  template double stress_limit<Dim>(const Scene<Dim>&, const Model<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
