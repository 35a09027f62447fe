#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "allocations.h"
#include "sem/base/error.h"
#include "sem/solve/integrators.h"
#include "springs.h"

using namespace sem;
using namespace sem_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Dim2 = std::integral_constant<int, 2>;
using Dim3 = std::integral_constant<int, 3>;
TYPE_TO_STRING_AS("2D", Dim2);
TYPE_TO_STRING_AS("3D", Dim3);

namespace {

constexpr Integrator integrators[] = {Integrator::linearly_implicit_euler,
                                      Integrator::implicit_euler, Integrator::implicit_midpoint};

// A mass on an elastic rope under gravity, swinging from the horizontal.
struct Pendulum {
  Pendulum() {
    springs.n_particles = 2;
    springs.springs = {{0, 1, 60, 1}};
    system = make_system(springs, Eigen::Vector4d(0, 0, 1, 0));
    system.free = {2, 3};
    system.mass *= 1.5;
    system.load(3) = -1.5 * 9.81;
  }
  State run(Integrator integrator, double dt, int n_steps) const {
    TimeStepper stepper(system, dt, integrator);
    State state = at_rest(system);
    for (int k = 0; k < n_steps; ++k) REQUIRE(stepper.step(state).status == Status::converged);
    return state;
  }
  // Classical Runge-Kutta, as an independent truth.
  State truth(double end, int n_steps) {
    State state = at_rest(system);
    const double h = end / n_steps;
    VectorXd g(4);
    const auto rate = [&](const VectorXd& z) {
      springs.gradient(z, g);
      VectorXd a = (system.load - g) / 1.5;
      a.head(2).setZero();
      return a;
    };
    for (int k = 0; k < n_steps; ++k) {
      const VectorXd v1 = state.v, a1 = rate(state.z);
      const VectorXd v2 = state.v + h / 2 * a1, a2 = rate(state.z + h / 2 * v1);
      const VectorXd v3 = state.v + h / 2 * a2, a3 = rate(state.z + h / 2 * v2);
      const VectorXd v4 = state.v + h * a3, a4 = rate(state.z + h * v3);
      state.z += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
      state.v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    return state;
  }
  Springs<2> springs;
  System system;
};

// A free cluster of particles with different masses and random velocities.
template <int Dim>
struct Cluster {
  Cluster() {
    VectorXd rest;
    springs = random_cluster<Dim>(6, rest, 17);
    system = make_system(springs, rest);
    for (int i = 0; i < 6; ++i)
      for (int c = 0; c < Dim; ++c) system.mass(Dim * i + c, Dim * i + c) = 0.5 + 0.3 * i;
    state = at_rest(system);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (double& v : state.v) v = uniform(random);
  }
  VectorXd linear_momentum() const {
    const VectorXd p = system.mass * state.v;
    return p.reshaped(Dim, 6).rowwise().sum();
  }
  // x_i p_j - x_j p_i, all i, j.
  MatrixXd angular_momentum() const {
    const VectorXd p = system.mass * state.v;
    const MatrixXd moment = state.z.reshaped(Dim, 6) * p.reshaped(Dim, 6).transpose();
    return moment - moment.transpose();
  }
  Springs<Dim> springs;
  System system;
  State state;
};

Quadratic random_quadratic(int n) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  MatrixXd A(n, n);
  for (double& a : A.reshaped()) a = uniform(random);
  Quadratic potential = make_quadratic(A * A.transpose());
  for (double& g : potential.g) g = uniform(random);
  return potential;
}

}  // namespace

TEST_CASE("observed orders on an elastic pendulum: 1, 1 and 2") {
  Pendulum pendulum;
  const State truth = pendulum.truth(1, 20000);
  for (const Integrator integrator : integrators) {
    const auto error = [&](int n_steps) {
      const State state = pendulum.run(integrator, 1. / n_steps, n_steps);
      return (state.z - truth.z).norm() + (state.v - truth.v).norm();
    };
    const double order = std::log2(error(1000) / error(2000));
    INFO(std::string(name(integrator)), " order ", order);
    const double expected = integrator == Integrator::implicit_midpoint ? 2 : 1;
    CHECK(std::abs(order - expected) <= 0.1);
  }
}

TEST_CASE_TEMPLATE("linear momentum follows the load to 1e-10 over 1000 steps", T, Dim2, Dim3) {
  constexpr int Dim = T::value;
  for (const Integrator integrator : integrators)
    for (const double gravity : {0.0, -9.81}) {
      Cluster<Dim> cluster;
      for (int i = 1; i < Dim * 6; i += Dim)
        cluster.system.load(i) = gravity * cluster.system.mass(i, i);
      const VectorXd start = cluster.linear_momentum();
      TimeStepper stepper(cluster.system, 0.01, integrator);
      for (int k = 0; k < 1000; ++k)
        REQUIRE(stepper.step(cluster.state).status == Status::converged);
      VectorXd expected = start;
      for (int i = 1; i < Dim * 6; i += Dim) expected(1) += 10 * cluster.system.load(i);
      INFO(std::string(name(integrator)), " gravity ", gravity);
      CHECK((cluster.linear_momentum() - expected).norm() <= 1e-10 * (1 + expected.norm()));
      CHECK(cluster.state.step == 1000);
      CHECK(cluster.state.time == doctest::Approx(10).epsilon(1e-12));
    }
}

TEST_CASE_TEMPLATE("implicit midpoint keeps angular momentum to 1e-10 over 1000 steps", T, Dim2,
                   Dim3) {
  for (const double dt : {0.05, 0.001}) {
    Cluster<T::value> cluster;
    const MatrixXd start = cluster.angular_momentum();
    TimeStepper stepper(cluster.system, dt, Integrator::implicit_midpoint);
    for (int k = 0; k < 1000; ++k) REQUIRE(stepper.step(cluster.state).status == Status::converged);
    INFO("dt ", dt);
    CHECK((cluster.angular_momentum() - start).norm() <= 1e-10 * start.norm());
  }
}

TEST_CASE("implicit midpoint keeps a quadratic energy, the Euler methods lose some") {
  Quadratic potential = random_quadratic(10);
  System system = make_system(potential, VectorXd::Zero(10));
  system.load.setConstant(0.2);
  for (const Integrator integrator : integrators) {
    State state = at_rest(system);
    state.v.setOnes();
    const double start = energies(system, state).total;
    TimeStepper stepper(system, 0.05, integrator);
    double previous = start;
    for (int k = 0; k < 1000; ++k) {
      const StepReport report = stepper.step(state);
      REQUIRE(report.status == Status::converged);
      if (integrator == Integrator::implicit_midpoint)
        CHECK(std::abs(report.energies.total - start) <= 1e-11 * std::abs(start));
      else
        CHECK(report.energies.total <= previous + 1e-12 * std::abs(start));
      previous = report.energies.total;
    }
    CHECK(previous == doctest::Approx(energies(system, state).total).epsilon(1e-11));
  }
}

TEST_CASE("a quadratic potential: one Hessian, one factorisation, a second when dt changes") {
  Quadratic potential = random_quadratic(12);
  const System system = make_system(potential, VectorXd::Zero(12));
  for (const Integrator integrator : integrators) {
    TimeStepper stepper(system, 0.02, integrator);
    State state = at_rest(system);
    for (int k = 0; k < 100; ++k) CHECK(stepper.step(state).iterations == 1);
    CHECK(stepper.counters().factorizations.n == 1);
    CHECK(stepper.counters().hessians.n == 1);
    stepper.set_time_step(0.01);
    for (int k = 0; k < 10; ++k) stepper.step(state);
    CHECK(stepper.counters().factorizations.n == 2);
    CHECK(stepper.counters().hessians.n == 1);
    CHECK(stepper.condition_estimate() >= 1);
  }
}

TEST_CASE("both Euler methods agree with the closed form of one step of an oscillator") {
  Quadratic potential = make_quadratic(MatrixXd::Constant(1, 1, 5));
  System system = make_system(potential, VectorXd::Zero(1));
  system.mass(0, 0) = 2;
  system.load(0) = 3;
  const double dt = 0.3, v1 = (2 * 0.7 - dt * (5 * 0.4 - 3)) / (2 + dt * dt * 5);
  for (const Integrator method :
       {Integrator::linearly_implicit_euler, Integrator::implicit_euler}) {
    State state{VectorXd::Constant(1, 0.4), VectorXd::Constant(1, 0.7)};
    TimeStepper(system, dt, method).step(state);
    CHECK(state.v(0) == doctest::Approx(v1).epsilon(1e-14));
    CHECK(state.z(0) == doctest::Approx(0.4 + dt * v1).epsilon(1e-14));
  }
}

TEST_CASE("Newton's integrators satisfy their defining equations on springs") {
  Cluster<3> cluster;
  const double dt = 0.1;
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::implicit_midpoint}) {
    State next = cluster.state;
    TimeStepper stepper(cluster.system, dt, integrator);
    REQUIRE(stepper.step(next).status == Status::converged);
    const bool midpoint = integrator == Integrator::implicit_midpoint;
    const VectorXd z = midpoint ? (cluster.state.z + next.z) / 2 : next.z;
    const VectorXd v = midpoint ? (cluster.state.v + next.v) / 2 : next.v;
    VectorXd g(18);
    cluster.springs.gradient(z, g);
    const VectorXd balance = cluster.system.mass * (next.v - cluster.state.v) + dt * g;
    CHECK(balance.norm() <= 1e-12);
    CHECK((next.z - cluster.state.z - dt * v).norm() <= 1e-13);
  }
}

TEST_CASE("directions without mass follow the stiffness and do not disturb the rest") {
  // mass, massless joint, mass between walls; against the condensed chain.
  Quadratic chain = make_quadratic(chain_stiffness(3, 20, true));
  Quadratic condensed = make_quadratic(MatrixXd{{30, -10}, {-10, 30}});
  System system = make_system(chain, VectorXd::Zero(3));
  System small = make_system(condensed, VectorXd::Zero(2));
  system.mass(1, 1) = 0;
  for (const Integrator integrator : integrators) {
    State state{Eigen::Vector3d(0.3, 0.1, -0.1), Eigen::Vector3d(1, 0.25, -0.5)};
    State reduced{Eigen::Vector2d(0.3, -0.1), Eigen::Vector2d(1, -0.5)};
    TimeStepper stepper(system, 0.02, integrator), stepper2(small, 0.02, integrator);
    for (int k = 0; k < 200; ++k) {
      REQUIRE(stepper.step(state).status == Status::converged);
      stepper2.step(reduced);
    }
    INFO(std::string(name(integrator)));
    CHECK(std::abs(state.z(0) - reduced.z(0)) <= 1e-12);
    CHECK(std::abs(state.z(2) - reduced.z(1)) <= 1e-12);
  }
}

TEST_CASE("pinned entries stay, with zero velocity") {
  Cluster<2> cluster;
  cluster.system.free = {4, 5, 6, 7, 8, 9, 10, 11};
  for (const Integrator integrator : integrators) {
    State state = cluster.state;
    TimeStepper stepper(cluster.system, 0.02, integrator);
    for (int k = 0; k < 20; ++k) stepper.step(state);
    CHECK(state.z.head(4) == cluster.state.z.head(4));
    CHECK(state.v.head(4).isZero(0));
    CHECK((state.z - cluster.state.z).norm() > 0.01);
  }
}

TEST_CASE("no step allocates: linear algebra, springs, any integrator") {
  if (!can_count_allocations()) return;
  Quadratic potential = random_quadratic(48);
  const System linear = make_system(potential, VectorXd::Zero(48));
  Cluster<3> cluster;
  for (const Integrator integrator : integrators) {
    TimeStepper first(linear, 0.01, integrator), second(cluster.system, 0.01, integrator);
    State linear_state = at_rest(linear), state = cluster.state;
    const long before = n_allocations();
    for (int k = 0; k < 10; ++k) first.step(linear_state);
    first.set_time_step(0.005);
    first.step(linear_state);
    for (int k = 0; k < 10; ++k) second.step(state);
    const long after = n_allocations();
    INFO(std::string(name(integrator)));
    CHECK(after - before == 0);
    CHECK(state.step == 10);
  }
  const long before = n_allocations();
  const VectorXd counted = VectorXd::Ones(before > 0 ? 3 : 4);
  CHECK(counted.sum() == 3);
  CHECK(n_allocations() > before);  // the counter counts
}

TEST_CASE("an indefinite system matrix is replaced by a projected one and counted") {
  for (const Integrator integrator : integrators) {
    Cluster<2> cluster;
    cluster.state.z *= 0.3;  // compressed: every spring is unstable sideways
    cluster.state.v.setZero();
    TimeStepper stepper(cluster.system, 1, integrator);
    const StepReport report = stepper.step(cluster.state);
    INFO(std::string(name(integrator)));
    CHECK(report.status == Status::converged);
    CHECK(stepper.counters().n_psd_projections > 0);
    CHECK(cluster.state.z.allFinite());
  }
}

TEST_CASE("a step over a barrier is retried in substeps") {
  Scalar barrier;  // a repelling wall at 0
  barrier.V = [](double x) { return x > 0 ? -std::log(x) : infinity; };
  barrier.dV = [](double x) { return -1 / x; };
  barrier.ddV = [](double x) { return 1 / (x * x); };
  const System system = make_system(barrier, VectorXd::Ones(1));
  State state = at_rest(system);
  state.v(0) = -3;
  TimeStepper stepper(system, 0.6, Integrator::linearly_implicit_euler);
  const StepReport report = stepper.step(state);
  CHECK(report.status == Status::converged);
  CHECK(report.n_substeps > 1);
  CHECK(state.z(0) > 0);
  CHECK(state.time == 0.6);
  CHECK(state.step == 1);
}

TEST_CASE("a motion as small as a hundred roundings of its forces dies down, it is no failure") {
  constexpr double stiffness = 1e5, noise = 3 * std::numeric_limits<double>::epsilon() * stiffness;
  Scalar spring;
  spring.V = [](double x) { return stiffness / 2 * (x - 1) * (x - 1); };
  spring.dV = [](double x) { return stiffness * (x - 1) + std::copysign(noise, std::sin(1e18 * x)); };
  spring.ddV = [](double) { return stiffness; };
  const System system = make_system(spring, VectorXd::Ones(1));
  TimeStepper stepper(system, 0.1, Integrator::implicit_euler);
  State state = at_rest(system);
  state.z(0) += 1e-13;
  for (int k = 0; k < 100; ++k) REQUIRE(stepper.step(state).status == Status::converged);
  CHECK(std::abs(state.z(0) - 1) < 1e-14);
}

TEST_CASE("a step that cannot succeed has a status and leaves the state alone") {
  Scalar wall;  // free flight into a region where the energy is not finite
  wall.V = [](double x) { return x < 1 ? 0 : infinity; };
  wall.dV = wall.ddV = [](double) { return 0; };
  const System system = make_system(wall, VectorXd::Zero(1));
  for (const Integrator integrator : integrators) {
    State state = at_rest(system);
    state.v(0) = 5;
    TimeStepper stepper(system, 0.15, integrator);
    CHECK(stepper.step(state).status == Status::converged);
    const State before = state;
    const StepReport report = stepper.step(state);
    INFO(std::string(name(integrator)), " ", std::string(name(report.status)));
    CHECK(report.status != Status::converged);
    CHECK(report.n_substeps == 64);
    CHECK(state.z == before.z);
    CHECK(state.v == before.v);
    CHECK(state.time == before.time);
    CHECK(state.step == before.step);
    CHECK(std::isfinite(report.energies.total));
  }
}

TEST_CASE("too few iterations, an energy at odds with its gradient and NaN are told apart") {
  const auto attempt = [](const Scalar& potential, const StepOptions& options) {
    Scalar copy = potential;
    const System system = make_system(copy, VectorXd::Ones(1));
    State state = at_rest(system);
    state.v(0) = 2;
    const Status status =
        TimeStepper(system, 1, Integrator::implicit_euler, options).step(state).status;
    CHECK(state.z(0) == 1);
    return status;
  };
  Scalar quartic;
  quartic.V = [](double x) { return 10 * x * x * x * x; };
  quartic.dV = [](double x) { return 40 * x * x * x; };
  quartic.ddV = [](double x) { return 120 * x * x; };
  StepOptions options;
  options.max_halvings = 0;
  options.max_iterations = 1;
  CHECK(attempt(quartic, options) == Status::max_iterations);
  options.max_iterations = 30;
  Scalar wrong = quartic;
  wrong.dV = [](double x) { return -40 * x * x * x; };
  CHECK(attempt(wrong, options) == Status::line_search_failed);
  Scalar broken = quartic;
  broken.dV = [](double) { return std::nan(""); };
  CHECK(attempt(broken, options) == Status::not_finite);
  broken = quartic;
  broken.ddV = [](double) { return std::nan(""); };
  CHECK(attempt(broken, options) == Status::not_finite);
}

TEST_CASE("neither mass nor stiffness is singular, in every integrator") {
  Quadratic potential = make_quadratic(Eigen::Vector2d(3, 0).asDiagonal());
  System system = make_system(potential, VectorXd::Zero(2));
  system.mass(1, 1) = 0;
  Springs<2> springs;
  springs.n_particles = 2;
  springs.springs = {{0, 1, 1, 1}};
  System loose = make_system(springs, Eigen::Vector4d(0, 0, 1, 0));
  loose.mass.set_zero();
  loose.load(2) = 1;
  for (const Integrator integrator : integrators) {
    State state = at_rest(system), loose_state = at_rest(loose);
    CHECK(TimeStepper(system, 0.1, integrator).step(state).status == Status::singular);
    CHECK(TimeStepper(loose, 0.1, integrator).step(loose_state).status == Status::singular);
    CHECK(loose_state.z == loose.rest);
  }
}

TEST_CASE("a run repeats its bits, also when a new stepper takes over half-way") {
  for (const Integrator integrator : integrators) {
    Cluster<3> cluster;
    State whole = cluster.state, resumed = cluster.state;
    TimeStepper stepper(cluster.system, 0.03, integrator);
    for (int k = 0; k < 60; ++k) stepper.step(whole);
    for (int half = 0; half < 2; ++half) {
      TimeStepper other(cluster.system, 0.03, integrator);
      for (int k = 0; k < 30; ++k) other.step(resumed);
    }
    CHECK(whole.z == resumed.z);
    CHECK(whole.v == resumed.v);
    CHECK(whole.time == resumed.time);
  }
}

TEST_CASE("names of integrators go both ways, an unknown one is an input error") {
  for (const Integrator method : integrators) CHECK(integrator(name(method)) == method);
  CHECK_THROWS_AS(integrator("explicit_euler", "a.json", "analysis.integrator"), InputError);
}

TEST_CASE("led pins: a mass on a led spring moves as its closed form says, with the orders of the schemes") {
  // m z'' + k z = k a - c a'': spring and mass couple z to the led entry a(t) = A (1 - cos w t).
  const double m = 2, c = 0.3, k = 50, A = 0.2, w = 3, end = 2;
  struct AnyPotential : Quadratic {  // as one that is not known to be quadratic: by Newton's method
    bool known = true;
    bool quadratic() const override { return known; }
  } potential;
  static_cast<Quadratic&>(potential) = make_quadratic((MatrixXd(2, 2) << k, -k, -k, k).finished());
  System system = make_system(potential, VectorXd::Zero(2));
  system.free = {1};
  system.mass = (MatrixXd(2, 2) << 1, c, c, m).finished();
  system.motion = [&](double t) { return VectorXd(VectorXd::Constant(2, A * (1 - std::cos(w * t)))); };
  // z = A + B cos w t + C cos W t with z(0) = z'(0) = 0.
  const double W = std::sqrt(k / m), B = -A * (k + c * w * w) / (k - m * w * w), C = -A - B;
  const double z = A + B * std::cos(w * end) + C * std::cos(W * end);
  const double v = -B * w * std::sin(w * end) - C * W * std::sin(W * end);
  for (const bool known : {true, false})
    for (const Integrator integrator : integrators) {
      CAPTURE(name(integrator));
      CAPTURE(known);
      potential.known = known;
      const auto errors = [&](int n) {
        TimeStepper stepper(system, end / n, integrator);
        State state = at_rest(system);
        for (int s = 0; s < n; ++s) REQUIRE(stepper.step(state).status == Status::converged);
        CHECK(state.z[0] == system.motion(state.time)[0]);
        return Eigen::Vector3d(state.z[1] - z, state.v[1] - v, state.v[0] - A * w * std::sin(w * end));
      };
      const Eigen::Vector3d coarse = errors(1000), fine = errors(2000);
      const double order = integrator == Integrator::implicit_midpoint ? 2 : 1;
      for (int i = 0; i < 3; ++i) CHECK(std::log2(coarse[i] / fine[i]) == doctest::Approx(order).epsilon(0.05));
    }
}
