#pragma once
// Small energies with known answers, for the tests of the solvers.

#include <Eigen/Dense>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "sem/solve/system.h"

namespace sem_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Particles in R^Dim, z = stacked positions, joined by springs: sum k/2 (l - L)^2.
template <int Dim>
class Springs : public sem::Potential {
 public:
  struct Spring {
    int a, b;
    double stiffness, length;
  };
  int n_particles = 0;
  std::vector<Spring> springs;

  int size() const override { return Dim * n_particles; }
  bool quadratic() const override { return false; }
  double energy(const Eigen::VectorXd& z) override {
    double sum = 0;
    for (const Spring& s : springs) {
      const double stretch = edge(z, s).norm() - s.length;
      sum += s.stiffness / 2 * stretch * stretch;
    }
    return sum;
  }
  void gradient(const Eigen::VectorXd& z, Eigen::VectorXd& g) override {
    g.setZero();
    for (const Spring& s : springs) {
      const auto d = edge(z, s);
      const Eigen::Matrix<double, Dim, 1> force = s.stiffness * (1 - s.length / d.norm()) * d;
      g.template segment<Dim>(Dim * s.b) += force;
      g.template segment<Dim>(Dim * s.a) -= force;
    }
  }
  void hessian(const Eigen::VectorXd& z, bool project_psd, sem::SymmetricMatrix& matrix) override {
    H.setZero(size(), size());
    for (const Spring& s : springs) {
      const auto d = edge(z, s);
      double across = 1 - s.length / d.norm();
      if (project_psd) across = std::max(across, 0.);
      using Block = Eigen::Matrix<double, Dim, Dim>;
      const Block along = d * d.transpose() / d.squaredNorm();
      const Block k = s.stiffness * (along + across * (Block::Identity() - along));
      H.template block<Dim, Dim>(Dim * s.a, Dim * s.a) += k;
      H.template block<Dim, Dim>(Dim * s.b, Dim * s.b) += k;
      H.template block<Dim, Dim>(Dim * s.a, Dim * s.b) -= k;
      H.template block<Dim, Dim>(Dim * s.b, Dim * s.a) -= k;
    }
    matrix.set(H);
  }

  Eigen::MatrixXd H;  // kept: the solvers' steps are to allocate nothing

 private:
  static Eigen::Matrix<double, Dim, 1> edge(const Eigen::VectorXd& z, const Spring& s) {
    return z.segment<Dim>(Dim * s.b) - z.segment<Dim>(Dim * s.a);
  }
};

/// 1/2 (z - z0) . K (z - z0) + g . (z - z0).
class Quadratic : public sem::Potential {
 public:
  Eigen::MatrixXd K;
  Eigen::VectorXd z0, g;
  int size() const override { return int(z0.size()); }
  bool quadratic() const override { return true; }
  double energy(const Eigen::VectorXd& z) override {
    return 0.5 * (z - z0).dot(K * (z - z0)) + g.dot(z - z0);
  }
  void gradient(const Eigen::VectorXd& z, Eigen::VectorXd& out) override { out = K * (z - z0) + g; }
  void hessian(const Eigen::VectorXd&, bool, sem::SymmetricMatrix& H) override { H.set(K); }
};

/// One unknown, given V, V', V''.
class Scalar : public sem::Potential {
 public:
  std::function<double(double)> V, dV, ddV;
  int size() const override { return 1; }
  bool quadratic() const override { return false; }
  double energy(const Eigen::VectorXd& z) override { return V(z(0)); }
  void gradient(const Eigen::VectorXd& z, Eigen::VectorXd& g) override { g(0) = dV(z(0)); }
  void hessian(const Eigen::VectorXd& z, bool project_psd, sem::SymmetricMatrix& H) override {
    H(0, 0) = project_psd ? std::max(ddV(z(0)), 0.) : ddV(z(0));
  }
};

/// All n unknowns free, unit mass, no load, rest at `rest`.
inline sem::System make_system(sem::Potential& potential, const Eigen::VectorXd& rest) {
  const int n = int(rest.size());
  sem::System system{
      &potential, Eigen::MatrixXd::Identity(n, n), Eigen::VectorXd::Zero(n), {}, rest};
  for (int i = 0; i < n; ++i) system.free.push_back(i);
  return system;
}

inline sem::State at_rest(const sem::System& system) {
  return {system.rest, Eigen::VectorXd::Zero(system.size())};
}

/// Random particles in the unit cube, every pair joined at its rest length.
template <int Dim>
Springs<Dim> random_cluster(int n_particles, Eigen::VectorXd& rest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Springs<Dim> springs;
  springs.n_particles = n_particles;
  springs.H.resize(Dim * n_particles, Dim * n_particles);
  rest.resize(Dim * n_particles);
  for (double& x : rest) x = uniform(random);
  for (int a = 0; a < n_particles; ++a)
    for (int b = a + 1; b < n_particles; ++b) {
      const double length = (rest.segment<Dim>(Dim * a) - rest.segment<Dim>(Dim * b)).norm();
      springs.springs.push_back({a, b, 20 + 80 * uniform(random), length});
    }
  return springs;
}

/// Stiffness of n + 1 springs k in a row on n masses; an open end has no spring.
inline Eigen::MatrixXd chain_stiffness(int n, double k, bool fixed_ends) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    K(i, i) += k, K(i + 1, i + 1) += k;
    K(i, i + 1) -= k, K(i + 1, i) -= k;
  }
  if (fixed_ends) K(0, 0) += k, K(n - 1, n - 1) += k;
  return K;
}

inline Quadratic make_quadratic(const Eigen::MatrixXd& K) {
  Quadratic potential;
  potential.K = K;
  potential.z0 = potential.g = Eigen::VectorXd::Zero(K.rows());
  return potential;
}

}  // namespace sem_test
