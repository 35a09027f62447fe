#include "src2d/tutorials/hung_body.h"

#include <algorithm>
#include <cmath>

#include "sem/lesson/numbers.h"
#include "sem/mechanics/loads.h"
#include "sem/mechanics/quadratic_forms.h"
#include "src2d/shapes/shapes.h"
#include "src2d/tutorials/matrices.h"

namespace sem::tutorial {

Discretization<2> make_body(int degree) {
  Points<2> p(2, 8);
  p << -0.1, 0.9, 1.9, 2.8, 2.4, 1.2, 0.3, -0.5,  //
      0.0, -0.3, 0.0, 0.5, 1.4, 0.9, 1.5, 0.9;
  std::vector<Nurbs<1, 2>> parts;
  for (const auto& part : shapes2d::make_parts(shapes2d::SplineLoop{p, 4}))
    parts.push_back(part.shape);
  MethodOptions options;
  options.projection.degree = degree;
  options.weights.cutoff = 2;
  options.rays.n_rays = 12;
  options.sampling.points_per_span = 8;  // more than needed: pictures join the samples by lines
  return discretize<2>({parts}, options);
}

std::vector<int> free_entries(const Discretization<2>& body) {
  std::vector<int> free;
  for (int i = 0; i < body.unknowns.size(); ++i)
    if (body.unknowns.rest(0, i) < 2.3)
      for (const int axis : {0, 1}) free.push_back(2 * i + axis);
  return free;
}

std::vector<int> all_entries(const Discretization<2>& body) {
  std::vector<int> all;
  for (int i = 0; i < 2 * body.unknowns.size(); ++i) all.push_back(i);
  return all;
}

std::unique_ptr<InternalEnergy<2>> make_energy(const Discretization<2>& body,
                                               const Material& material,
                                               const Eigen::MatrixXd& stability) {
  const MaterialField field{{material}, std::vector<int>(body.quadrature.size(), 0)};
  return std::make_unique<InternalEnergy<2>>(body.interior, body.quadrature.weight, field,
                                             stability);
}

System make_system(const Discretization<2>& body, InternalEnergy<2>& energy,
                   const Eigen::MatrixXd& M, double density, const Vec<2>& gravity,
                   const std::vector<int>& free) {
  System system{&energy, expand(M, 2), VectorXd::Zero(energy.size()), free, rest_state(body).z};
  add_body_force<2>(body.interior, density * body.quadrature.weight, gravity, system.load);
  return system;
}

State rest_state(const Discretization<2>& body, const Vec<2>& v, double spin) {
  const Mat<2> W = (Mat<2>() << 0, -spin, spin, 0).finished();
  return {affine_field<2>(body.unknowns, Mat<2>::Identity(), {0, 0}),
          affine_field<2>(body.unknowns, W, v), 0, 0};
}

VectorXd heaviest_motion(const Discretization<2>& body, const Eigen::MatrixXd& M2,
                         const Eigen::MatrixXd& motions) {
  Eigen::MatrixXd rigid(M2.rows(), 3);
  rigid << rest_state(body, {1, 0}).v, rest_state(body, {0, 1}).v, rest_state(body, {0, 0}, 1).v;
  const Eigen::MatrixXd P = motions.transpose() * M2 * rigid;
  const Eigen::MatrixXd free = motions * kernel(P * P.transpose(), 1e-9);
  if (free.cols() == 0) return VectorXd::Zero(M2.rows());
  const VectorXd motion = free * last_eigenvector(free.transpose() * M2 * free);
  int largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  return motion * 0.7 / motion[largest];
}

Run simulate(const System& system, const Eigen::MatrixXd& M, State state, double dt,
             double duration, Integrator scheme) {
  Run run;
  TimeStepper stepper(system, dt, scheme);
  for (;;) {
    const Eigen::Map<const Points<2>> z(state.z.data(), 2, M.rows()),
        v(state.v.data(), 2, M.rows());
    const Mat<2> A = z * M * v.transpose();
    run.time.push_back(state.time);
    run.energy.push_back(energies(system, state).total);
    run.momentum.push_back((v * M).rowwise().sum().norm());
    run.angular.push_back(A(0, 1) - A(1, 0));
    run.z.push_back(state.z);
    if (state.time > duration - dt / 2) return run;
    const StepReport report = stepper.step(state);
    run.status = report.status;
    if (run.status != Status::converged) return run;
    run.n_cut += report.n_substeps > 1;
  }
}

std::string change(const std::vector<double>& values, double scale) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value - values[0]));
  return error_text(largest / (scale > 0 ? scale : std::abs(values[0])), 1e-9);
}

}  // namespace sem::tutorial
