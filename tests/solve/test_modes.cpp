#include <doctest/doctest.h>

#include <cmath>

#include "sem/solve/modes.h"
#include "springs.h"

using namespace sem;
using namespace sem_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
const double pi = std::acos(-1.);
constexpr double k = 40, m = 0.7;

void check_orthonormal(const Modes& modes, const MatrixXd& M) {
  const auto n = modes.omega.size();
  CHECK((modes.shapes.transpose() * M * modes.shapes - MatrixXd::Identity(n, n)).norm() <= 1e-9);
  CHECK(modes.residuals.maxCoeff() <= 1e-12);
}
}  // namespace

TEST_CASE("frequencies of a chain between walls are 2 sqrt(k/m) sin(j pi / (2n + 2))") {
  const int n = 15;
  Quadratic chain = make_quadratic(chain_stiffness(n, k, true));
  System system = make_system(chain, VectorXd::Zero(n));
  system.mass *= m;
  const Modes modes = vibration_modes(system, system.rest, 6);
  REQUIRE(modes.status == Status::converged);
  REQUIRE(modes.omega.size() == 6);
  for (int j = 1; j <= 6; ++j)
    CHECK(modes.omega(j - 1) ==
          doctest::Approx(2 * std::sqrt(k / m) * std::sin(j * pi / (2 * n + 2))).epsilon(1e-12));
  check_orthonormal(modes, system.mass.dense());
  CHECK(modes.n_massless == 0);
}

TEST_CASE("pinning the ends of a longer chain gives the same frequencies and zeros there") {
  const int n = 15;
  Quadratic chain = make_quadratic(chain_stiffness(n + 2, k, false));
  System system = make_system(chain, VectorXd::Zero(n + 2));
  system.mass *= m;
  system.free.erase(system.free.begin());
  system.free.pop_back();
  const Modes modes = vibration_modes(system, system.rest, 3);
  CHECK(modes.omega(0) ==
        doctest::Approx(2 * std::sqrt(k / m) * std::sin(pi / (2 * n + 2))).epsilon(1e-12));
  CHECK(modes.shapes.row(0).isZero(0));
  CHECK(modes.shapes.row(n + 1).isZero(0));
  check_orthonormal(modes, system.mass.dense());
}

TEST_CASE("a chain free at both ends has a rigid mode and 2 sqrt(k/m) sin(j pi / 2n)") {
  const int n = 9;
  Quadratic chain = make_quadratic(chain_stiffness(n, k, false));
  System system = make_system(chain, VectorXd::Zero(n));
  system.mass *= m;
  const Modes modes = vibration_modes(system, system.rest, 5);
  REQUIRE(modes.status == Status::converged);
  CHECK(std::abs(modes.omega(0)) <= 1e-6 * std::sqrt(k / m));
  const VectorXd shape = modes.shapes.col(0);
  CHECK((shape.array() - shape(0)).matrix().norm() <= 1e-7 * shape.norm());
  for (int j = 1; j < 5; ++j)
    CHECK(modes.omega(j) ==
          doctest::Approx(2 * std::sqrt(k / m) * std::sin(j * pi / (2 * n))).epsilon(1e-10));
  check_orthonormal(modes, system.mass.dense());
}

TEST_CASE("massless joints between the masses act as springs in series") {
  const int n = 5, n_all = 2 * n + 1;  // joint, mass, joint, ..., mass, joint
  Quadratic chain = make_quadratic(chain_stiffness(n_all, 2 * k, true));
  System system = make_system(chain, VectorXd::Zero(n_all));
  for (int i = 0; i < n_all; ++i) system.mass(i, i) = i % 2 == 1 ? m : 0;
  const Modes modes = vibration_modes(system, system.rest, n_all);
  REQUIRE(modes.status == Status::converged);
  CHECK(modes.n_massless == n + 1);
  REQUIRE(modes.omega.size() == n);
  for (int j = 1; j <= n; ++j)
    CHECK(modes.omega(j - 1) ==
          doctest::Approx(2 * std::sqrt(k / m) * std::sin(j * pi / (2 * n + 2))).epsilon(1e-12));
  check_orthonormal(modes, system.mass.dense());
}

TEST_CASE("massless joints and rigid motion together") {
  const int n_all = 3;  // mass, joint, mass
  Quadratic chain = make_quadratic(chain_stiffness(n_all, 2 * k, false));
  System system = make_system(chain, VectorXd::Zero(n_all));
  system.mass = Eigen::Vector3d(m, 0, m).asDiagonal().toDenseMatrix();
  const Modes modes = vibration_modes(system, system.rest, 3);
  REQUIRE(modes.status == Status::converged);
  REQUIRE(modes.omega.size() == 2);
  CHECK(std::abs(modes.omega(0)) <= 1e-6 * std::sqrt(k / m));
  CHECK(modes.omega(1) == doctest::Approx(std::sqrt(2 * k / m)).epsilon(1e-10));
}

TEST_CASE("a direction with neither mass nor stiffness is singular") {
  Quadratic potential = make_quadratic(Eigen::Vector2d(k, 0).asDiagonal());
  System system = make_system(potential, VectorXd::Zero(2));
  system.mass = Eigen::Vector2d(m, 0).asDiagonal().toDenseMatrix();
  const Modes modes = vibration_modes(system, system.rest, 2);
  CHECK(modes.status == Status::singular);
  CHECK(modes.omega.size() == 0);
}

TEST_CASE("an unstable direction has a negative frequency") {
  Quadratic potential = make_quadratic(Eigen::Vector2d(-k, 3 * k).asDiagonal());
  System system = make_system(potential, VectorXd::Zero(2));
  system.mass *= m;
  const Modes modes = vibration_modes(system, system.rest, 2);
  REQUIRE(modes.status == Status::converged);
  CHECK(modes.omega(0) == doctest::Approx(-std::sqrt(k / m)));
  CHECK(modes.omega(1) == doctest::Approx(std::sqrt(3 * k / m)));
}

TEST_CASE("a free cluster in space has six rigid modes") {
  VectorXd rest;
  Springs<3> cluster = random_cluster<3>(7, rest, 2);
  const System system = make_system(cluster, rest);
  const Modes modes = vibration_modes(system, rest, 8);
  REQUIRE(modes.status == Status::converged);
  for (int j = 0; j < 6; ++j) CHECK(std::abs(modes.omega(j)) <= 1e-5 * modes.omega(6));
  CHECK(modes.omega(6) > 0.1);
  CHECK(modes.residuals.maxCoeff() <= 1e-12);
}
