#include "sem/method/moment_rules.h"

#include "sem/method/least_squares.h"
#include "sem/method/monomials.h"
#include "sem/method/nnls.h"

namespace sem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double moments_met = 1e-11;  // relative

// Monomials at the points, #points by 1 + #monomials.
template <int Dim>
MatrixXd monomials_at(const Points<Dim>& position, int degree, const Vec<Dim>& center,
                      double size) {
  const Monomials<Dim> monomials(degree);
  MatrixXd V(position.cols(), 1 + monomials.size());
  Eigen::RowVectorXd row(monomials.size());
  for (int k = 0; k < V.rows(); ++k) {
    monomials.values((position.col(k) - center) / (size / 2), row);
    V(k, 0) = 1;
    V.row(k).tail(row.size()) = row;
  }
  return V;
}

// Largest difference of moments, relative to the integrals of the monomials' magnitudes.
double largest_error(const MatrixXd& V, const VectorXd& weight, const VectorXd& target,
                     const VectorXd& scale) {
  return (V.transpose() * weight - target).cwiseAbs().cwiseQuotient(scale).maxCoeff();
}

// The monomials made orthonormal in a rule.
struct OrthonormalBasis {
  MatrixXd values;        // #points by rank
  MatrixXd of_monomials;  // moments of the monomials = of_monomials * moments of the basis

  OrthonormalBasis(const MatrixXd& V, const VectorXd& weight) {
    const MatrixXd scaled = weight.cwiseSqrt().asDiagonal() * V, Q = orthonormal_columns(scaled);
    values = weight.cwiseSqrt().cwiseInverse().asDiagonal() * Q;
    of_monomials = scaled.transpose() * Q;
  }
  // Moments of the basis from those of the monomials.
  VectorXd moments(const VectorXd& monomials) const { return least_squares(of_monomials, monomials); }
};

template <int Dim>
void keep_positive(Quadrature<Dim>& rule, const VectorXd& weight) {
  int kept = 0;
  for (int k = 0; k < rule.size(); ++k) {
    if (!(weight[k] > 0)) continue;
    rule.position.col(kept) = rule.position.col(k);
    rule.solid[kept] = rule.solid[k];
    rule.weight[kept++] = weight[k];
  }
  rule.position.conservativeResize(Dim, kept);
  rule.weight.conservativeResize(kept);
  rule.solid.resize(kept);
}

}  // namespace

template <int Dim>
VectorXd moments_to_degree(const Quadrature<Dim>& rule, int degree, const Vec<Dim>& center,
                           double size) {
  return monomials_at<Dim>(rule.position, degree, center, size).transpose() * rule.weight;
}

template <int Dim>
double moment_error(const Quadrature<Dim>& rule, int degree, const Vec<Dim>& center, double size,
                    const VectorXd& target) {
  const MatrixXd V = monomials_at<Dim>(rule.position, degree, center, size);
  return largest_error(V, rule.weight, target, V.cwiseAbs().transpose() * rule.weight);
}

template <int Dim>
MomentReport fit_moments(Quadrature<Dim>& rule, int degree, const Vec<Dim>& center, double size,
                         const VectorXd& target) {
  const MatrixXd V = monomials_at<Dim>(rule.position, degree, center, size);
  const VectorXd scale = V.cwiseAbs().transpose() * rule.weight;
  const OrthonormalBasis basis(V, rule.weight);
  const VectorXd wanted = basis.moments(target);
  MomentReport report{degree, rule.size(), rule.size(),
                      largest_error(V, rule.weight, target, scale), 0};
  report.error_after = report.error_before;
  VectorXd lambda = VectorXd::Zero(wanted.size());
  const auto weights = [&](const VectorXd& at) -> VectorXd {
    return rule.weight.array() * (1 + (basis.values * at).array()).max(0);
  };
  VectorXd weight = rule.weight, misfit = wanted - basis.values.transpose() * weight;
  for (int iteration = 0; iteration < 50 && misfit.norm() > 1e-15 * wanted.norm(); ++iteration) {
    const VectorXd active = (weight.array() > 0).select(rule.weight, 0.0);
    MatrixXd H = gram_matrix(basis.values, active);
    H.diagonal().array() += 1e-14;
    const VectorXd direction = least_squares(H, misfit);
    double step = 1;
    VectorXd next, next_misfit;
    for (; step > 1e-6; step /= 2) {
      next = weights(lambda + step * direction);
      next_misfit = wanted - basis.values.transpose() * next;
      if (next_misfit.norm() < misfit.norm()) break;
    }
    if (step <= 1e-6) break;
    lambda += step * direction;
    weight = next;
    misfit = next_misfit;
  }
  const double error = largest_error(V, weight, target, scale);
  if (!(error < report.error_before) || error > std::max(moments_met, 1e-3 * report.error_before))
    return report;
  keep_positive(rule, weight);
  report.points_after = rule.size();
  report.error_after = error;
  return report;
}

template <int Dim>
MomentReport compress(Quadrature<Dim>& rule, int degree, const Vec<Dim>& center, double size) {
  MomentReport report{degree, rule.size(), rule.size(), 0, 0};
  const int n_solids =
      rule.size() ? *std::max_element(rule.solid.begin(), rule.solid.end()) + 1 : 0;
  VectorXd weight = VectorXd::Zero(rule.size());
  for (int solid = 0; solid < n_solids; ++solid) {
    std::vector<int> own;
    for (int k = 0; k < rule.size(); ++k)
      if (rule.solid[k] == solid) own.push_back(k);
    if (own.empty()) continue;
    const MatrixXd V = monomials_at<Dim>(rule.position(Eigen::all, own), degree, center, size);
    const VectorXd old = rule.weight(own), target = V.transpose() * old;
    const OrthonormalBasis basis(V, old);
    const auto found = solve_non_negative(basis.values.transpose(), basis.values.transpose() * old);
    const double error = largest_error(V, found.x, target, V.cwiseAbs().transpose() * old);
    const bool smaller = (found.x.array() > 0).count() < long(own.size());
    const bool right = error <= moments_met;
    weight(own) = smaller && right ? found.x : old;
    if (smaller && right) report.error_after = std::max(report.error_after, error);
  }
  keep_positive(rule, weight);
  report.points_after = rule.size();
  return report;
}

#define SEM_INSTANTIATE(Dim)                                                                      \
  template VectorXd moments_to_degree<Dim>(const Quadrature<Dim>&, int, const Vec<Dim>&, double); \
  template double moment_error<Dim>(const Quadrature<Dim>&, int, const Vec<Dim>&, double,         \
                                    const VectorXd&);                                             \
  template MomentReport fit_moments<Dim>(Quadrature<Dim>&, int, const Vec<Dim>&, double,          \
                                         const VectorXd&);                                        \
  template MomentReport compress<Dim>(Quadrature<Dim>&, int, const Vec<Dim>&, double);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
