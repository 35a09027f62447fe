#include "sem/solve/integrators.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sem/base/error.h"

namespace sem {

namespace {
// |A x - b| / |b| of a step's linear system: beyond it x is rounding (bodies of 1e-9 of their
// length).
constexpr double largest_linear_residual = 1e-4;

constexpr Integrator all_integrators[] = {
    Integrator::linearly_implicit_euler, Integrator::implicit_euler, Integrator::implicit_midpoint};
}  // namespace

const char* name(Integrator integrator) {
  switch (integrator) {
    case Integrator::linearly_implicit_euler:
      return "linearly_implicit_euler";
    case Integrator::implicit_euler:
      return "implicit_euler";
    case Integrator::implicit_midpoint:
      return "implicit_midpoint";
  }
  return "";
}

Integrator integrator(const std::string& text, const std::string& file, const std::string& field) {
  std::string allowed;
  for (const Integrator candidate : all_integrators) {
    if (text == name(candidate)) return candidate;
    allowed += (allowed.empty() ? "" : ", ") + std::string(name(candidate));
  }
  throw InputError(file, field, "'" + text + "'", allowed);
}

TimeStepper::TimeStepper(const System& system, double dt, Integrator integrator,
                         const StepOptions& options)
    : system_(system),
      dt_(dt),
      integrator_(integrator),
      options_(options),
      theta_(integrator == Integrator::implicit_midpoint ? 0.5 : 1),
      work_of_(system.potential->work()),
      quadratic_(system.potential->quadratic()),
      newton_(system),
      stiffness_(system.potential->new_hessian()),
      matrix_(stiffness_),
      cholesky_(stiffness_.plan(), stiffness_.components(), system.free) {
  assert(dt > 0);
  const int n = system.size();
  for (auto* v :
       {&rest_gradient_, &z_, &v_, &gradient_, &work_, &increment_, &drift_, &rhs_, &dv_, &travel_})
    v->setZero(n);
  if (system.motion) {
    std::vector<bool> pinned(n, true);
    for (const int i : system.free) pinned[i] = false;
    for (int i = 0; i < n; ++i)
      if (pinned[i]) led_.push_back(i);
  }
  if (!quadratic_) return;
  rest_energy_ = system.potential->energy(system.rest);
  system.potential->gradient(system.rest, rest_gradient_);
  counters_.hessians.run(work_of_.hessian,
                         [&] { system.potential->hessian(system.rest, false, stiffness_); });
}

Counters TimeStepper::counters() const {
  Counters total = counters_;
  total += newton_.counters();
  return total;
}

double TimeStepper::condition_estimate() const {
  return uses_newton() ? newton_.condition_estimate() : cholesky_.condition_estimate();
}

bool TimeStepper::uses_newton() const {
  return !quadratic_ && integrator_ != Integrator::linearly_implicit_euler;
}

StepReport TimeStepper::step(State& state) {
  StepReport report;
  end_energy_ = potential_energy(state.z);
  if (!std::isfinite(end_energy_)) {
    report.status = Status::not_finite;
    set_energies(state, end_energy_, report.energies);
    return report;
  }
  const double start_energy = end_energy_;
  for (int halvings = 0; halvings <= options_.max_halvings; ++halvings) {
    report.n_substeps = 1 << halvings;
    report.residual = 0;
    z_ = state.z;
    v_.setZero();
    for (const int i : system_.free) v_(i) = state.v(i);
    for (const int i : led_) v_(i) = state.v(i);
    const double dt = dt_ / report.n_substeps;
    report.status = Status::converged;
    for (int k = 0; k < report.n_substeps && report.status == Status::converged; ++k)
      report.status = advance(dt, state.time + (k + 1) * dt, report);
    if (report.status == Status::converged) {
      state.z.swap(z_);
      state.v.swap(v_);
      state.time += dt_;
      ++state.step;
      set_energies(state, end_energy_, report.energies);
      return report;
    }
  }
  set_energies(state, start_energy, report.energies);
  return report;
}

// One substep of z_, v_ to the time `end`.
Status TimeStepper::advance(double dt, double end, StepReport& report) {
  if (!led_.empty()) end_ = system_.motion(end);
  for (const int i : led_) travel_(i) = end_(i) - z_(i);
  const Status status = uses_newton() ? advance_newton(dt, report) : advance_linear(dt, report);
  if (status != Status::converged) return status;
  for (const int i : led_) z_(i) = end_(i);  // to the last bit
  if (!z_.allFinite() || !v_.allFinite()) return Status::not_finite;
  end_energy_ = potential_energy(z_);
  return std::isfinite(end_energy_) ? Status::converged : Status::not_finite;
}

// One linear system: exact for a quadratic potential, with theta = 1 or 1/2,
//   (M + theta^2 dt^2 K) dv = -dt (grad V(z) - f + theta dt K v),
//   z += dt (v + theta dv), v += dv,
// dv of led entries given by their way.
Status TimeStepper::advance_linear(double dt, StepReport& report) {
  const Status status = factorize(dt);
  if (status != Status::converged) return status;
  ++report.iterations;
  set_gradient(z_);
  stiffness_.multiply(v_, work_);
  rhs_.setZero();
  for (const int i : system_.free)
    rhs_(i) = -dt * (gradient_(i) - system_.load(i) + theta_ * dt * work_(i));
  increment_.setZero();
  for (const int i : led_) increment_(i) = (travel_(i) / dt - v_(i)) / theta_;
  dv_ = rhs_;
  if (!led_.empty()) {
    matrix_.multiply(increment_, work_);
    dv_ -= work_;
  }
  counters_.solves.run(cholesky_.solve_work(), [&] { cholesky_.solve_in_place(dv_); });
  dv_ += increment_;
  matrix_.multiply(dv_, work_);
  double error = 0;
  for (const int i : system_.free) {
    error += (work_(i) - rhs_(i)) * (work_(i) - rhs_(i));
    z_(i) += dt * (v_(i) + theta_ * dv_(i));
    v_(i) += dv_(i);
  }
  for (const int i : led_) v_(i) += dv_(i);
  const double size = rhs_.norm();
  const double residual = size > 0 ? std::sqrt(error) / size : 0;
  report.residual = std::max(report.residual, residual);
  return residual <= largest_linear_residual ? Status::converged : Status::singular;
}

// Newton on the increment u to the point where the force is taken: z0 + u = z1
// (Euler) or the midpoint; u = theta dt v_mean, so
//   grad V(z0 + u) - f + (u - theta dt v0) M / (theta dt)^2 = 0.
Status TimeStepper::advance_newton(double dt, StepReport& report) {
  const double h = theta_ * dt;
  drift_ = h * v_;
  travel_ *= theta_;
  const NewtonReport newton =
      newton_.minimize({z_, system_.load, 1 / (h * h), drift_, travel_},
                       {options_.tolerance, options_.max_iterations}, increment_);
  report.iterations += newton.iterations;
  report.residual = std::max(report.residual, newton.residual);
  if (newton.status != Status::converged) return newton.status;
  z_ += increment_ / theta_;
  v_ += (increment_ / h - v_) / theta_;
  return Status::converged;
}

// The factor of M + theta^2 dt^2 K(z_): kept while K is constant and dt the same.
Status TimeStepper::factorize(double dt) {
  if (quadratic_ && factorized_dt_ == dt) return Status::converged;
  factorized_dt_ = 0;
  if (!quadratic_) set_stiffness(false);
  if (!factorize_matrix(dt)) {
    if (!matrix_.all_finite()) return Status::not_finite;
    if (quadratic_) return Status::singular;
    set_stiffness(true);
    if (!factorize_matrix(dt)) return Status::singular;
  }
  factorized_dt_ = dt;
  return Status::converged;
}

bool TimeStepper::factorize_matrix(double dt) {
  matrix_.set_sum(theta_ * theta_ * dt * dt, stiffness_, 1, system_.mass);
  return counters_.factorizations.run(cholesky_.factor_work(),
                                      [&] { return cholesky_.compute(matrix_); });
}

void TimeStepper::set_stiffness(bool project_psd) {
  counters_.hessians.run(work_of_.hessian,
                         [&] { system_.potential->hessian(z_, project_psd, stiffness_); });
  if (project_psd) ++counters_.n_psd_projections;
}

void TimeStepper::set_gradient(const Eigen::VectorXd& z) {
  if (!quadratic_) {
    counters_.gradients.run(work_of_.gradient, [&] { system_.potential->gradient(z, gradient_); });
    return;
  }
  increment_ = z - system_.rest;
  stiffness_.multiply(increment_, gradient_);
  gradient_ += rest_gradient_;
}

double TimeStepper::potential_energy(const Eigen::VectorXd& z) {
  if (!quadratic_)
    return counters_.energies.run(work_of_.energy, [&] { return system_.potential->energy(z); });
  increment_ = z - system_.rest;
  stiffness_.multiply(increment_, work_);
  return rest_energy_ + rest_gradient_.dot(increment_) + increment_.dot(work_) / 2;
}

void TimeStepper::set_energies(const State& state, double potential, Energies& energies) {
  system_.mass.multiply(state.v, work_);
  energies.kinetic = state.v.dot(work_) / 2;
  energies.potential = potential;
  energies.load = -system_.load.dot(state.z);
  energies.total = energies.kinetic + energies.potential + energies.load;
}

}  // namespace sem
