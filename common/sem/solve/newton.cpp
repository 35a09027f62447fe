#include "sem/solve/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sem/solve/modes.h"

namespace sem {

namespace {
constexpr double armijo = 1e-4;     // share of the predicted decrease that is asked for
constexpr int max_backtracks = 40;  // 2^-40: the direction is useless
constexpr double energy_noise =
    1e-9;  // a predicted decrease below this share of its terms may be rounding
// |r| below this many roundings of the forces is zero, if it is small at all.
constexpr double rounding_margin = 32, small_residual = 1e-4;
constexpr double first_shift = 1e-3, last_shift = 10;  // shares of the diagonal
}  // namespace

Newton::Newton(const System& system)
    : system_(system),
      work_of_(system.potential->work()),
      hessian_(system.potential->new_hessian()),
      matrix_(hessian_),
      cholesky_(hessian_.plan(), hessian_.components(), system.free) {
  const int n = system.size();
  for (auto* v : {&z_, &gradient_, &inertial_, &residual_, &step_, &trial_, &mass_step_, &work_})
    v->setZero(n);
}

// Energy, gradient and residual at u; +infinity (and no gradient) if inadmissible.
double Newton::evaluate(const IncrementProblem& problem, const Eigen::VectorXd& u) {
  z_ = problem.base + u;
  const double energy = counters_.energies.run(work_of_.energy, [&] { return system_.potential->energy(z_); });
  if (!std::isfinite(energy)) return std::numeric_limits<double>::infinity();
  counters_.gradients.run(work_of_.gradient, [&] { system_.potential->gradient(z_, gradient_); });
  inertial_.setZero();
  if (problem.inertia > 0) {
    work_ = u - problem.drift;
    system_.mass.multiply(work_, inertial_);
    inertial_ *= problem.inertia;
  }
  residual_.setZero();
  for (const int i : system_.free) residual_(i) = gradient_(i) - problem.load(i) + inertial_(i);
  return energy;
}

// matrix_ = H(z_) + inertia M.
void Newton::assemble(double inertia, bool project_psd) {
  counters_.hessians.run(work_of_.hessian, [&] { system_.potential->hessian(z_, project_psd, hessian_); });
  if (project_psd) ++counters_.n_psd_projections;
  if (inertia > 0) matrix_.set_sum(1, hessian_, inertia, system_.mass);
  else matrix_ = hessian_;
}

bool Newton::factorize() {
  return counters_.factorizations.run(cholesky_.factor_work(), [&] { return cholesky_.compute(matrix_); });
}

// Adds a share of the raw matrix's diagonal, left in diagonal_.
void Newton::add_shift(double share) {
  double mean = 0;
  for (const int i : system_.free) mean += diagonal_(i) / double(system_.free.size());
  matrix_.add_to_diagonal(share * diagonal_.cwiseMax(1e-3 * mean));
  ++counters_.n_shifts;
}

// Leaves a factor of a positive definite matrix, and its potential part in hessian_.
Status Newton::direction(double inertia) {
  assemble(inertia, false);
  if (factorize()) return Status::converged;
  if (!matrix_.all_finite()) return Status::not_finite;
  assemble(inertia, true);
  if (factorize()) return Status::converged;
  // Singular: by the projection alone (a shift helps), or for want of stiffness?
  assemble(inertia, false);
  if (is_singular(matrix_.dense(system_.free))) return Status::singular;
  diagonal_ = matrix_.diagonal().cwiseAbs();
  assemble(inertia, true);
  if (!matrix_.all_finite()) return Status::not_finite;
  for (double share = first_shift; share <= last_shift; share *= 10) {
    add_shift(share);
    if (factorize()) return Status::converged;
  }
  return Status::singular;
}

// True if r is as small as the rounding of forces that are sums of H_ij z_j and M_ij (u - drift)_j, and small
// beside the largest forces or, where nothing is loaded, these are no more than that themselves or a body's that
// moves: what its motion loses then is as small as the rounding of its place.
bool Newton::is_rounding(const IncrementProblem& problem, const Eigen::VectorXd& u, double norm, double largest_force) {
  const bool loaded =
      std::any_of(system_.free.begin(), system_.free.end(), [&](int i) { return problem.load(i) != 0; });
  const bool small = norm <= small_residual * largest_force;
  if (loaded && !small) return false;
  hessian_.absolute_product(z_, work_);
  if (problem.inertia > 0) {
    step_ = u - problem.drift;
    system_.mass.absolute_product(step_, mass_step_);
    work_ += problem.inertia * mass_step_;
  }
  double sum = 0;
  for (const int i : system_.free) sum += work_(i) * work_(i);
  const double rounding = rounding_margin * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
  return norm <= rounding && (small || problem.inertia > 0 || largest_force <= rounding);
}

// Moves the pinned entries to their prescribed values and the free ones along
// the tangent: A_ff du = -(r + A_fp du_p), A = H + inertia M. Judged by its energy being finite.
bool Newton::predict(const IncrementProblem& problem, Eigen::VectorXd& u) {
  step_ = problem.prescribed - u;
  for (const int i : system_.free) step_(i) = 0;
  matrix_.multiply(step_, work_);
  work_ = -residual_ - work_;
  counters_.solves.run(cholesky_.solve_work(), [&] { cholesky_.solve_in_place(work_); });
  step_ += work_;
  trial_ = u + step_;
  energy_ = evaluate(problem, trial_);
  if (!std::isfinite(energy_) || !residual_.allFinite()) return false;
  u.swap(trial_);
  return true;
}

// Backtracks along the Newton direction from u, where energy_ and residual_ are
// known; leaves both at the new u.
bool Newton::line_search(const IncrementProblem& problem, Eigen::VectorXd& u) {
  step_ = -residual_;
  counters_.solves.run(cholesky_.solve_work(), [&] { cholesky_.solve_in_place(step_); });

  const double slope = residual_.dot(step_), old_norm = residual_.norm(), old_energy = energy_;
  // The part of the objective besides V, along the line: linear alpha + curvature alpha^2 / 2.
  const double linear = inertial_.dot(step_) - problem.load.dot(step_);
  double curvature = 0;
  if (problem.inertia > 0) {
    system_.mass.multiply(step_, mass_step_);
    curvature = problem.inertia * step_.dot(mass_step_);
  }
  if (!(slope < 0)) return false;
  double alpha = 1;
  for (int k = 0; k < max_backtracks; ++k, alpha /= 2) {
    trial_ = u + alpha * step_;
    if (!trial_.allFinite()) continue;
    energy_ = evaluate(problem, trial_);
    if (!std::isfinite(energy_) || !residual_.allFinite()) continue;
    const double change = energy_ - old_energy + alpha * (linear + alpha * curvature / 2);
    const double terms =
        std::max(std::abs(energy_), std::abs(old_energy)) + std::abs(alpha * linear);
    const bool in_noise = -alpha * slope <= energy_noise * terms;
    if (change <= armijo * alpha * slope || (in_noise && residual_.norm() < old_norm)) {
      u.swap(trial_);
      return true;
    }
  }
  return false;
}

double Newton::reference_force(const IncrementProblem& problem) {
  work_.setZero();
  if (problem.inertia > 0) {
    system_.mass.multiply(problem.drift, work_);
    work_ *= problem.inertia;
  }
  double load = 0, drift = 0;
  for (const int i : system_.free) {
    load += problem.load(i) * problem.load(i);
    drift += work_(i) * work_(i);
  }
  return std::max({gradient_.norm(), std::sqrt(load), std::sqrt(drift)});
}

bool Newton::pins_move(const IncrementProblem& problem) {
  step_ = problem.prescribed;
  for (const int i : system_.free) step_(i) = 0;
  return (step_.array() != 0).any();
}

NewtonReport Newton::minimize(const IncrementProblem& problem, const NewtonOptions& options,
                              Eigen::VectorXd& u) {
  NewtonReport report;
  u.setZero();
  energy_ = evaluate(problem, u);
  if (!std::isfinite(energy_) || !residual_.allFinite()) {
    report.status = Status::not_finite;
    return report;
  }
  const double start_force = reference_force(problem);
  double largest_force = start_force;
  bool moving = pins_move(problem);
  double last_norm = 0;
  bool rounding = false;

  for (;;) {
    const double norm = residual_.norm();
    report.reference_force = std::max(start_force, gradient_.norm());
    largest_force = std::max(largest_force, gradient_.norm());
    report.residual = norm > 0 ? norm / report.reference_force : 0;
    if (!moving && report.residual <= options.tolerance) break;
    // In statics, where no inertia bounds what forces that small move, on as long as it helps.
    rounding = !moving && report.iterations > 0 && is_rounding(problem, u, norm, largest_force);
    if (rounding && (problem.inertia > 0 || norm > last_norm / 2)) break;
    last_norm = norm;
    if (report.iterations == options.max_iterations) {
      report.status = Status::max_iterations;
      break;
    }
    report.status = direction(problem.inertia);
    if (report.status != Status::converged) break;
    if (!moving && report.iterations == 0 && is_rounding(problem, u, norm, largest_force)) break;
    ++report.iterations;
    if (moving) {
      moving = false;
      if (!predict(problem, u)) report.status = Status::not_finite;
    } else if (!line_search(problem, u)) {
      if (rounding) break;
      report.status = Status::line_search_failed;
    }
    if (report.status != Status::converged) break;
  }
  return report;
}

}  // namespace sem
