#include "sem/solve/system.h"

namespace sem {

SymmetricMatrix Potential::new_hessian() const { return {dense_elimination(size()), 1}; }

Eigen::MatrixXd Potential::dense_hessian(const Eigen::VectorXd& z, bool project_psd) {
  SymmetricMatrix H = new_hessian();
  hessian(z, project_psd, H);
  return H.dense();
}

const char* name(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::max_iterations:
      return "max_iterations";
    case Status::line_search_failed:
      return "line_search_failed";
    case Status::singular:
      return "singular";
    case Status::not_finite:
      return "not_finite";
  }
  return "";
}

const char* describe(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::max_iterations:
      return "the iterations ran out before the residual was small: the step is too large, or "
             "there is no equilibrium nearby";
    case Status::line_search_failed:
      return "no step along the search direction lowers the energy: energy and gradient disagree, "
             "or the tolerance is below the rounding of the forces";
    case Status::singular:
      return "the system matrix is singular: a motion without stiffness is left (too few pins, a "
             "loose part), the load is critical, or stiffnesses differ by more than rounding allows";
    case Status::not_finite:
      return "an energy or force is not finite: the solid is inverted, or the motion blew up";
  }
  return "";
}

Energies energies(const System& system, const State& state) {
  Energies result;
  result.kinetic = state.v.dot(system.mass * state.v) / 2;
  result.potential = system.potential->energy(state.z);
  result.load = -system.load.dot(state.z);
  result.total = result.kinetic + result.potential + result.load;
  return result;
}

Eigen::VectorXd reaction(const System& system, const Eigen::VectorXd& z,
                         const Eigen::VectorXd& acceleration) {
  Eigen::VectorXd force(system.size());
  system.potential->gradient(z, force);
  force -= system.load;
  if (acceleration.size() > 0) force += system.mass * acceleration;
  for (const int i : system.free) force(i) = 0;
  return force;
}

}  // namespace sem
