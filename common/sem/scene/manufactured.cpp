#include "sem/scene/manufactured.h"

#include <cmath>
#include <stdexcept>

#include "sem/mechanics/loads.h"
#include "sem/solve/cholesky.h"

namespace sem {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// sin(rate s + phase), or exp(rate s).
struct Factor {
  double rate, phase = 0;
  bool exponential = false;
};
constexpr double quarter = M_PI / 2;
constexpr Factor factors[3][3] = {{{1}, {0.7, quarter}, {0.5, 0.2 + quarter}},
                                  {{0.5, 0, true}, {1, 0.3}, {0.6, quarter}},
                                  {{0.8, quarter}, {0.5, 0.4}, {-0.5, 0, true}}};

// A factor at s = k X and its first two derivatives by X.
std::array<double, 3> values(const Factor& f, double k, double X) {
  const double r = f.rate * k, s = f.exponential ? std::exp(r * X) : std::sin(r * X + f.phase);
  if (f.exponential) return {s, r * s, r * r * s};
  return {s, r * std::cos(r * X + f.phase), -r * r * s};
}

// u and its derivatives: second[a](b, c) = d2 u_a / dX_b dX_c.
template <int Dim>
struct Jet {
  Vec<Dim> u;
  Mat<Dim> first;
  std::array<Mat<Dim>, Dim> second;
};

template <int Dim>
Jet<Dim> smooth_jet(double k, const Vec<Dim>& X) {
  Jet<Dim> jet;
  for (int a = 0; a < Dim; ++a) {
    std::array<std::array<double, 3>, Dim> f;
    for (int b = 0; b < Dim; ++b) f[b] = values(factors[a][b], k, X[b]);
    const auto product = [&](const std::array<int, Dim>& order) {
      double p = 1;
      for (int b = 0; b < Dim; ++b) p *= f[b][order[b]];
      return p;
    };
    std::array<int, Dim> order{};
    jet.u[a] = product(order);
    for (int b = 0; b < Dim; ++b) {
      ++order[b];
      jet.first(a, b) = product(order);
      for (int c = 0; c < Dim; ++c) {
        ++order[c];
        jet.second[a](b, c) = product(order);
        --order[c];
      }
      --order[b];
    }
  }
  return jet;
}

template <int Dim>
Jet<Dim> jet_at(const Manufactured<Dim>& exact, const Vec<Dim>& X) {
  if (exact.taylor == 0) return smooth_jet<Dim>(exact.wave_number, X);
  Jet<Dim> jet = smooth_jet<Dim>(exact.wave_number, Vec<Dim>::Zero());
  jet.u += jet.first * X;
  for (int a = 0; a < Dim; ++a) {
    if (exact.taylor == 1) jet.second[a].setZero();
    const Vec<Dim> slope = jet.second[a] * X;
    jet.u[a] += slope.dot(X) / 2;
    jet.first.row(a) += slope.transpose();
  }
  return jet;
}

// Linear functionals of a field at the rule's points, those that rigid motions alone change: its
// mean and, about the middle of the body, its mean rotation, both times the volume. As values to be
// summed against the field.
template <int Dim>
std::vector<Points<Dim>> rigid_functionals(const Discretization<Dim>& body) {
  constexpr int n_rotations = DimTraits<Dim>::n_rotations;
  const auto& rule = body.quadrature;
  const Vec<Dim> middle = (body.boundary.box.lower + body.boundary.box.upper) / 2;
  std::vector<Points<Dim>> functionals(Dim + n_rotations, Points<Dim>::Zero(Dim, rule.size()));
  for (int k = 0; k < rule.size(); ++k) {
    const Vec<Dim> arm = (rule.position.col(k) - middle) / body.boundary.box.diagonal();
    for (int b = 0; b < Dim; ++b) {
      functionals[b](b, k) = rule.weight[k];
      const auto turn = DimTraits<Dim>::cross(arm, Vec<Dim>::Unit(b));
      for (int r = 0; r < n_rotations; ++r) functionals[Dim + r](b, k) = rule.weight[k] * turn[r];
    }
  }
  return functionals;
}

}  // namespace

template <int Dim>
Vec<Dim> Manufactured<Dim>::displacement(const Vec<Dim>& X) const {
  return jet_at(*this, X).u;
}

template <int Dim>
Mat<Dim> Manufactured<Dim>::gradient(const Vec<Dim>& X) const {
  return jet_at(*this, X).first;
}

template <int Dim>
Mat<Dim> Manufactured<Dim>::stress(const Vec<Dim>& X) const {
  return first_piola<Dim>(material, Mat<Dim>(Mat<Dim>::Identity() + gradient(X)));
}

template <int Dim>
Vec<Dim> Manufactured<Dim>::body_force(const Vec<Dim>& X) const {
  const Jet<Dim> jet = jet_at(*this, X);
  const auto C = stress_derivative<Dim>(material, Mat<Dim>(Mat<Dim>::Identity() + jet.first));
  Vec<Dim> force = Vec<Dim>::Zero();
  for (int b = 0; b < Dim; ++b)
    for (int c = 0; c < Dim; ++c)
      for (int d = 0; d < Dim; ++d)
        force -= jet.second[c](d, b) * C.template block<Dim, 1>(Dim * b, c + Dim * d);
  return force;
}

template <int Dim>
VectorXd manufactured_load(const Discretization<Dim>& body, const Manufactured<Dim>& exact) {
  VectorXd f = VectorXd::Zero(Dim * body.unknowns.size());
  Points<Dim> force(Dim, body.quadrature.size());
  for (int k = 0; k < force.cols(); ++k)
    force.col(k) = body.quadrature.weight[k] * exact.body_force(body.quadrature.position.col(k));
  Eigen::Map<Points<Dim>>(f.data(), Dim, body.unknowns.size()) =
      evaluate_transposed(body.interior, force);
  add_traction<Dim>(
      body, [&](int, const Vec<Dim>& X, const Vec<Dim>& N) { return exact.traction(X, N); }, f);
  return f;
}

template <int Dim>
VectorXd manufactured_stress(const Discretization<Dim>& body, const Manufactured<Dim>& exact) {
  VectorXd f = VectorXd::Zero(Dim * body.unknowns.size());
  Points<Dim> nodal = Points<Dim>::Zero(Dim, body.interior.n_columns + body.interior.n_shared());
  for (const auto& block : body.interior.blocks)
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int point = block.points[k];
      const Mat<Dim> P =
          body.quadrature.weight[point] * exact.stress(body.quadrature.position.col(point));
      for (size_t j = 0; j < block.columns.size(); ++j)
        for (int b = 0; b < Dim; ++b)
          nodal.col(block.columns[j]) += block.gradient[b](k, j) * P.col(b);
    }
  add_shared(body.interior, nodal);
  Eigen::Map<Points<Dim>>(f.data(), Dim, body.unknowns.size()) =
      nodal.leftCols(body.unknowns.size());
  return f;
}

template <int Dim>
ManufacturedSolution solve_manufactured(const Discretization<Dim>& body, Potential& V,
                                        const VectorXd& f, const Manufactured<Dim>& exact) {
  const int n = V.size();
  const auto& rule = body.quadrature;
  Points<Dim> truth(Dim, rule.size());
  for (int k = 0; k < rule.size(); ++k) truth.col(k) = exact.displacement(rule.position.col(k));

  // Rows R of u, of the exact one r: stiff springs there make K regular and leave the rest of u as
  // it is.
  const auto functionals = rigid_functionals(body);
  MatrixXd R(functionals.size(), n);
  VectorXd r(functionals.size());
  for (size_t a = 0; a < functionals.size(); ++a) {
    const Points<Dim> row = evaluate_transposed(body.interior, functionals[a]);
    R.row(a) = Eigen::Map<const VectorXd>(row.data(), n);
    r[a] = functionals[a].cwiseProduct(truth).sum();
  }
  const VectorXd rest = affine_field<Dim>(body.unknowns, Mat<Dim>::Identity(), Vec<Dim>::Zero());
  MatrixXd K = V.dense_hessian(rest);
  const double volume = rule.weight.sum(),
               spring = exact.material.youngs_modulus / (volume * volume);
  K += spring * R.transpose() * R;
  ManufacturedSolution solution{f + spring * R.transpose() * r};
  Cholesky cholesky(n);
  if (!cholesky.compute(K)) throw std::runtime_error("manufactured solution: singular stiffness");
  cholesky.solve_in_place(solution.u);

  const auto energy = [&](const Mat<Dim>& G) {
    return energy_density<Dim>(exact.material, Mat<Dim>(Mat<Dim>::Identity() + G));
  };
  double error = 0, norm = 0;
  const Points<Dim> y = coefficients(body.interior, solution.u);
  for (const auto& block : body.interior.blocks)
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int point = block.points[k];
      const Mat<Dim> G = exact.gradient(rule.position.col(point));
      error += rule.weight[point] * energy(deformation_gradient(block, int(k), y) - G);
      norm += rule.weight[point] * energy(G);
    }
  solution.energy = std::sqrt(error / norm);
  const Points<Dim> wrong = evaluate(body.interior, solution.u) - truth;
  solution.displacement = std::sqrt(rule.weight.dot(wrong.colwise().squaredNorm()) /
                                    rule.weight.dot(truth.colwise().squaredNorm()));
  return solution;
}

template <int Dim>
ManufacturedError solve_manufactured(const std::vector<ScenePart<Dim>>& parts,
                                     const MethodOptions& method, const Manufactured<Dim>& exact) {
  Scene<Dim> scene;
  scene.solids.push_back({"body", exact.material, parts});
  scene.method = method;
  const auto model = build_model(scene, "");
  const auto& body = model->discretization;
  const auto solution =
      solve_manufactured(body, *model->energy, manufactured_load(body, exact), exact);
  constexpr int n_rigid = Dim + DimTraits<Dim>::n_rotations;
  return {solution.energy, solution.displacement, Dim * body.unknowns.size() - n_rigid,
          body.quadrature.size()};
}

#define INSTANTIATE(Dim)                                                                       \
  template struct Manufactured<Dim>;                                                           \
  template VectorXd manufactured_load(const Discretization<Dim>&, const Manufactured<Dim>&);   \
  template VectorXd manufactured_stress(const Discretization<Dim>&, const Manufactured<Dim>&); \
  template ManufacturedSolution solve_manufactured(const Discretization<Dim>&, Potential&,     \
                                                   const VectorXd&, const Manufactured<Dim>&); \
  template ManufacturedError solve_manufactured(const std::vector<ScenePart<Dim>>&,            \
                                                const MethodOptions&, const Manufactured<Dim>&);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace sem
