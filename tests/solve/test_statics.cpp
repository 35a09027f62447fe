#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "linear_algebra.h"
#include "sem/solve/cholesky.h"
#include "sem/solve/modes.h"
#include "sem/solve/statics.h"
#include "springs.h"

using namespace sem;
using namespace sem_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A bar of one unknown: c (x^2/2 - ln x), so that c (x - 1/x) = f.
Scalar log_bar(double c) {
  Scalar bar;
  bar.V = [=](double x) { return x > 0 ? c * (x * x / 2 - std::log(x)) : infinity; };
  bar.dV = [=](double x) { return c * (x - 1 / x); };
  bar.ddV = [=](double x) { return c * (1 + 1 / (x * x)); };
  return bar;
}

// Two springs of this stiffness from (-a, 0) and (a, 0) to the apex (0, h), unstressed there.
struct Truss {
  explicit Truss(double a, double h, double stiffness) {
    springs.n_particles = 3;
    const double length = std::hypot(a, h);
    springs.springs = {{0, 2, stiffness, length}, {1, 2, stiffness, length}};
    VectorXd rest(6);
    rest << -a, 0, a, 0, 0, h;
    system = make_system(springs, rest);
    system.free = {4, 5};
  }
  Springs<2> springs;
  System system;
};

// Bars of rest length 1 from 0 to z_0 to z_1, the second 9 times as stiff as the first:
// sum c (l^2/2 - ln l).
class LogBars : public Potential {
 public:
  int size() const override { return 2; }
  bool quadratic() const override { return false; }
  double energy(const VectorXd& z) override {
    const double a = z(0), b = z(1) - z(0);
    if (a <= 0 || b <= 0) return infinity;
    return a * a / 2 - std::log(a) + 9 * (b * b / 2 - std::log(b));
  }
  void gradient(const VectorXd& z, VectorXd& g) override {
    const double a = z(0), b = z(1) - z(0);
    g(1) = 9 * (b - 1 / b);
    g(0) = a - 1 / a - g(1);
  }
  void hessian(const VectorXd& z, bool, SymmetricMatrix& H) override {
    const double a = z(0), b = z(1) - z(0), kb = 9 * (1 + 1 / (b * b));
    H.set(MatrixXd{{1 + 1 / (a * a) + kb, -kb}, {-kb, kb}});
  }
};

double smallest_eigenvalue(const MatrixXd& A) { return test::eigenvalues(A)(0); }

}  // namespace

TEST_CASE("a quadratic potential takes one factorisation, one Hessian and one iteration") {
  Quadratic chain = make_quadratic(chain_stiffness(12, 7.0, true));
  chain.g.setLinSpaced(12, -1, 2);
  System system = make_system(chain, VectorXd::Zero(12));
  system.load.setConstant(0.3);
  system.free = {1, 2, 3, 4, 6, 7, 8, 9, 10};
  State state = at_rest(system);
  StaticOptions options;
  options.n_load_steps = 5;
  options.target = VectorXd::Zero(12);
  options.target(0) = 1.5;
  options.target(11) = -0.5;
  options.target(3) = 99;  // free: ignored
  const StaticReport report = solve_static(system, state, options);
  CHECK(report.status == Status::converged);
  CHECK(report.iterations == 1);
  CHECK(report.counters.factorizations.n == 1);
  CHECK(report.counters.hessians.n == 1);
  CHECK(report.load_factor == 1);
  CHECK(state.z(0) == 1.5);
  CHECK(state.z(11) == -0.5);
  CHECK(state.z(5) == 0);
  VectorXd g(12);
  chain.gradient(state.z, g);
  for (const int i : system.free) CHECK(std::abs(g(i) - system.load(i)) <= 1e-13);
}

TEST_CASE("reactions of a pinned chain balance its load") {
  Quadratic chain = make_quadratic(chain_stiffness(6, 3.0, false));
  System system = make_system(chain, VectorXd::Zero(6));
  system.load.setConstant(2);
  system.free = {1, 2, 3, 4, 5};
  State state = at_rest(system);
  CHECK(solve_static(system, state).status == Status::converged);
  const VectorXd force = reaction(system, state.z);
  CHECK(force(0) == doctest::Approx(-12).epsilon(1e-13));
  CHECK(force.tail(5).isZero(0));
  const VectorXd accelerated = reaction(system, state.z, VectorXd::Constant(6, 0.5));
  CHECK(accelerated(0) == doctest::Approx(-11.5).epsilon(1e-13));
}

TEST_CASE("a stretched and a crushed nonlinear bar take the length of the closed form") {
  for (const double load : {-400.0, -3.0, -1e-6, 1e-9, 0.5, 50.0}) {
    Scalar bar = log_bar(2);
    System system = make_system(bar, VectorXd::Ones(1));
    system.load(0) = load;
    State state = at_rest(system);
    const StaticReport report = solve_static(system, state);
    const double f = load / 2, root = std::sqrt(f * f + 4);
    const double expected = f > 0 ? (f + root) / 2 : 2 / (root - f);
    INFO("load ", load, " residual ", report.residual);
    CHECK(report.status == Status::converged);
    CHECK(report.residual <= 1e-6);
    CHECK(state.z(0) == doctest::Approx(expected).epsilon(1e-10));
    CHECK(report.energies.total == doctest::Approx(bar.V(expected) - load * expected));
  }
}

TEST_CASE("a pulled truss satisfies equilibrium in closed form, pins led away in load steps") {
  Truss truss(1, 0.5, 10);
  truss.system.load(5) = 4;
  StaticOptions options;
  options.n_load_steps = 3;
  options.target = truss.system.rest;
  options.target(0) = -1.5;
  options.target(2) = 1.5;
  State state = at_rest(truss.system);
  const StaticReport report = solve_static(truss.system, state, options);
  REQUIRE(report.status == Status::converged);
  CHECK(report.n_load_steps == 3);
  CHECK(state.z(0) == -1.5);
  CHECK(state.z(2) == 1.5);
  const double y = state.z(5), length = std::hypot(1.5, y);
  CHECK(std::abs(state.z(4)) <= 1e-12);
  CHECK(2 * 10 * (length - std::hypot(1, 0.5)) * y / length == doctest::Approx(4).epsilon(1e-10));
}

TEST_CASE("a truss pushed past its limit load snaps through to a stable equilibrium") {
  Truss truss(1, 0.4, 100);
  truss.system.load(5) = -8;  // the limit load is about 2.3
  State state = at_rest(truss.system);
  StaticOptions options;
  options.n_load_steps = 10;
  const StaticReport report = solve_static(truss.system, state, options);
  CHECK(report.status == Status::converged);
  CHECK(report.load_factor == 1);
  CHECK(state.z(5) < -0.4);
  CHECK(report.counters.n_psd_projections > 0);
  const MatrixXd H = truss.springs.dense_hessian(state.z);
  CHECK(smallest_eigenvalue(H.bottomRightCorner(2, 2)) > 0);
  const VectorXd force = reaction(truss.system, state.z);
  CHECK(force(1) + force(3) == doctest::Approx(8).epsilon(1e-9));
}

TEST_CASE("an indefinite start finds its way to a minimum") {
  for (const double start : {1e-9, 1e-3, 0.1}) {
    Truss truss(1, 0.4, 100);
    State state = at_rest(truss.system);
    state.z(5) = start;  // compressed: unstable upwards and downwards
    const StaticReport report = solve_static(truss.system, state);
    INFO("start ", start);
    CHECK(report.status == Status::converged);
    CHECK(std::abs(state.z(5)) == doctest::Approx(0.4).epsilon(1e-9));
    CHECK(report.counters.n_psd_projections > 0);
  }
}

TEST_CASE("where the projection leaves nothing of the Hessian a shift finds the way down") {
  Scalar well;  // minima at -1 and 1, concave between +-1/sqrt(3)
  well.V = [](double x) { return (x * x - 1) * (x * x - 1) / 4; };
  well.dV = [](double x) { return x * (x * x - 1); };
  well.ddV = [](double x) { return 3 * x * x - 1; };
  for (const double start : {-0.3, 1e-8, 0.5}) {
    System system = make_system(well, VectorXd::Constant(1, start));
    State state = at_rest(system);
    const StaticReport report = solve_static(system, state);
    INFO("start ", start);
    CHECK(report.status == Status::converged);
    CHECK(std::abs(state.z(0)) == doctest::Approx(1).epsilon(1e-9));
    CHECK(report.counters.n_shifts > 0);
  }
}

TEST_CASE("rigid motions left free are reported as singular and the state is kept") {
  VectorXd rest;
  Springs<3> cluster = random_cluster<3>(6, rest, 5);
  System system = make_system(cluster, rest);
  system.load(0) = 1;
  State state = at_rest(system);
  const StaticReport report = solve_static(system, state);
  CHECK(report.status == Status::singular);
  CHECK(std::string(describe(report.status)).find("pins") != std::string::npos);
  CHECK(report.load_factor == 0);
  CHECK(state.z == rest);
  CHECK(report.iterations == 0);

  Quadratic chain = make_quadratic(chain_stiffness(5, 1, false));
  System loose = make_system(chain, VectorXd::Zero(5));
  loose.load.setOnes();
  State chain_state = at_rest(loose);
  CHECK(solve_static(loose, chain_state).status == Status::singular);
  CHECK(chain_state.z.isZero(0));
}

TEST_CASE("with just enough pins the same cluster has an equilibrium") {
  VectorXd rest;
  Springs<3> cluster = random_cluster<3>(6, rest, 5);
  System system = make_system(cluster, rest);
  system.free.erase(system.free.begin(), system.free.begin() + 9);
  system.load(17) = 3;
  State state = at_rest(system);
  const StaticReport report = solve_static(system, state);
  CHECK(report.status == Status::converged);
  CHECK(report.condition_estimate > 1);
  CHECK(report.condition_estimate < 1e8);
  double pull = 0;
  const VectorXd force = reaction(system, state.z);
  for (int i = 2; i < 9; i += 3) pull += force(i);
  CHECK(pull == doctest::Approx(-3).epsilon(1e-9));
}

TEST_CASE("beyond the largest load there is, the last equilibrium on the way is kept") {
  Scalar pendulum;
  pendulum.V = [](double x) { return -std::cos(x); };
  pendulum.dV = [](double x) { return std::sin(x); };
  pendulum.ddV = [](double x) { return std::cos(x); };
  System system = make_system(pendulum, VectorXd::Zero(1));
  system.load(0) = 1.5;
  State state = at_rest(system);
  StaticOptions options;
  options.n_load_steps = 4;
  const StaticReport report = solve_static(system, state, options);
  CHECK(report.status != Status::converged);
  CHECK(report.n_halvings > 0);
  CHECK(report.load_factor > 0.6);
  CHECK(report.load_factor <= 2. / 3);
  CHECK(std::sin(state.z(0)) == doctest::Approx(1.5 * report.load_factor).epsilon(1e-8));
}

TEST_CASE("a prescribed motion whose tangent would invert a bar is halved until it succeeds") {
  LogBars bars;
  System system = make_system(bars, Eigen::Vector2d(1, 2));
  system.free = {0};
  State state = at_rest(system);
  StaticOptions options;
  options.target = Eigen::Vector2d(0, 0.05);
  const StaticReport report = solve_static(system, state, options);
  CHECK(report.status == Status::converged);
  CHECK(report.n_halvings > 0);
  CHECK(report.n_load_steps > 1);
  CHECK(state.z(1) == doctest::Approx(0.05).epsilon(1e-14));
  VectorXd g(2);
  bars.gradient(state.z, g);
  CHECK(std::abs(g(0)) <= 1e-9 * std::abs(g(1)));
}

TEST_CASE("running out of iterations is a status") {
  Scalar bar = log_bar(1);
  System system = make_system(bar, VectorXd::Ones(1));
  system.load(0) = -100;
  State state = at_rest(system);
  StaticOptions options;
  options.max_iterations = 1;
  options.max_halvings = 2;
  const StaticReport report = solve_static(system, state, options);
  CHECK(report.status == Status::max_iterations);
  CHECK(report.n_halvings == 2);
  CHECK(report.residual > options.tolerance);
  CHECK(state.z(0) == 1);
}

TEST_CASE("a gradient that contradicts the energy ends in a failed line search") {
  Scalar bar = log_bar(1);
  bar.dV = [](double x) { return -5 * x; };
  System system = make_system(bar, VectorXd::Ones(1));
  State state = at_rest(system);
  const StaticReport report = solve_static(system, state);
  CHECK(report.status == Status::line_search_failed);
  CHECK(state.z(0) == 1);
}

TEST_CASE("energies, gradients and Hessians that are not finite are a status, never a NaN state") {
  const auto not_a_number = [](double) { return std::nan(""); };
  for (int which = 0; which < 3; ++which) {
    Scalar bar = log_bar(1);
    if (which == 0) bar.V = not_a_number;
    if (which == 1) bar.dV = not_a_number;
    if (which == 2) bar.ddV = not_a_number;
    System system = make_system(bar, VectorXd::Ones(1));
    system.load(0) = 1;
    State state = at_rest(system);
    const StaticReport report = solve_static(system, state);
    INFO("which ", which);
    CHECK(report.status == Status::not_finite);
    CHECK(state.z(0) == 1);
    CHECK(std::isfinite(report.residual));
  }
}

TEST_CASE("nothing free and nothing loaded are solved without iterations") {
  Quadratic chain = make_quadratic(chain_stiffness(4, 1, true));
  System system = make_system(chain, VectorXd::Zero(4));
  State state = at_rest(system);
  CHECK(solve_static(system, state).iterations == 0);
  system.free.clear();
  system.load.setOnes();
  const StaticReport report = solve_static(system, state);
  CHECK(report.status == Status::converged);
  CHECK(report.iterations == 0);
}

TEST_CASE("factor and singularity test do not depend on the units of the unknowns") {
  const int n = 20;
  VectorXd units(n);
  for (int i = 0; i < n; ++i) units(i) = std::pow(10., (i * 7) % 13 - 6);
  const MatrixXd fixed = units.asDiagonal() * chain_stiffness(n, 1, true) * units.asDiagonal();
  const MatrixXd loose = units.asDiagonal() * chain_stiffness(n, 1, false) * units.asDiagonal();
  Cholesky cholesky(n);
  CHECK(cholesky.compute(fixed));
  CHECK(cholesky.condition_estimate() < 100);
  CHECK_FALSE(is_singular(fixed));
  VectorXd b = fixed * VectorXd::Ones(n);
  cholesky.solve_in_place(b);
  CHECK(units.cwiseProduct(b - VectorXd::Ones(n)).norm() <= 1e-12 * units.norm());
  CHECK_FALSE(cholesky.compute(loose));
  CHECK(cholesky.condition_estimate() == infinity);
  CHECK(is_singular(loose));
  CHECK_FALSE(is_singular(-fixed));
}

TEST_CASE("statics repeat the same bits") {
  const auto solve = [] {
    Truss truss(1, 0.4, 100);
    truss.system.load(4) = 0.3;
    truss.system.load(5) = -8;
    State state = at_rest(truss.system);
    solve_static(truss.system, state);
    return state.z;
  };
  CHECK(solve() == solve());
}
