#include "sem/method/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sem/base/error.h"
#include "sem/method/least_squares.h"

namespace sem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Control points that the samples of the given parts depend on, ascending.
template <int Dim>
std::vector<int> controls_of(const Samples<Dim>& samples, const std::vector<int>& parts) {
  std::vector<int> controls;
  for (const int i : parts)
    controls.insert(controls.end(), samples.column.begin() + samples.row[samples.first[i]],
                    samples.column.begin() + samples.row[samples.first[i + 1]]);
  std::sort(controls.begin(), controls.end());
  controls.erase(std::unique(controls.begin(), controls.end()), controls.end());
  return controls;
}

// Dense rows of J of one part's samples, restricted to the given controls.
template <int Dim>
MatrixXd jacobian(const Samples<Dim>& samples, int part, const std::vector<int>& columns) {
  const int first = samples.first[part], n = samples.first[part + 1] - first;
  MatrixXd J = MatrixXd::Zero(n, columns.size());
  for (int s = 0; s < n; ++s)
    for (int e = samples.row[first + s]; e < samples.row[first + s + 1]; ++e) {
      const auto found = std::lower_bound(columns.begin(), columns.end(), samples.column[e]);
      J(s, found - columns.begin()) += samples.value[e];
    }
  return J;
}

// Weighted mean of the samples of a set of parts, as a row over the controls.
template <int Dim>
Eigen::RowVectorXd mean_row(const Samples<Dim>& samples, const std::vector<int>& set,
                            const std::vector<int>& columns) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(columns.size());
  double total = 0;
  for (const int i : set) {
    const int first = samples.first[i], n = samples.first[i + 1] - first;
    const auto weight = samples.weight.segment(first, n);
    row += weight.transpose() * jacobian(samples, i, columns);
    total += weight.sum();
  }
  return row / total;
}

// diag(root) (J - 1 t^T).
MatrixXd weighted_offsets(const VectorXd& root, MatrixXd J, const Eigen::RowVectorXd& t) {
  for (int s = 0; s < J.rows(); ++s) J.row(s) = root[s] * (J.row(s) - t);
  return J;
}

// The linear part fitted to all samples of a set of parts, in the monomials of (X - origin) / fit.scale.
template <int Dim>
MatrixXd linear_fit_of_set(const Samples<Dim>& samples, const std::vector<int>& set,
                           const Vec<Dim>& origin, const PartFit& fit, double tolerance) {
  int n = 0;
  for (const int i : set) n += samples.first[i + 1] - samples.first[i];
  MatrixXd A(n, Dim), rest(n, fit.columns.size());
  int row = 0;
  for (const int i : set) {
    const int first = samples.first[i], size = samples.first[i + 1] - first;
    const VectorXd root = samples.weight.segment(first, size).cwiseSqrt();
    for (int s = 0; s < size; ++s)
      A.row(row + s) = root[s] / fit.scale * (samples.position.col(first + s) - origin);
    rest.middleRows(row, size) =
        weighted_offsets(root, jacobian(samples, i, fit.columns), fit.translation);
    row += size;
  }
  return pseudo_inverse(A, tolerance).matrix * rest;
}

template <int Dim>
PartFit fit_part(const Samples<Dim>& samples, int part, const std::vector<int>& set,
                 const Vec<Dim>& origin, const Monomials<Dim>& monomials,
                 const ProjectionOptions& options) {
  PartFit fit;
  std::vector<int> parts = set;
  parts.push_back(part);
  fit.columns = controls_of(samples, parts);
  fit.translation = mean_row(samples, set, fit.columns);

  const int first = samples.first[part], n = samples.first[part + 1] - first;
  const VectorXd root = samples.weight.segment(first, n).cwiseSqrt();
  const Points<Dim> offset = samples.position.middleCols(first, n).colwise() - origin;
  if (options.fit == FitKind::degree_by_degree) {
    const VectorXd distance2 = offset.colwise().squaredNorm();
    fit.scale = std::sqrt(root.cwiseAbs2().dot(distance2) / root.squaredNorm());
    if (!(fit.scale > 0)) fit.scale = 1;
  }
  MatrixXd A(n, monomials.size());
  for (int s = 0; s < n; ++s) {
    monomials.values(offset.col(s) / fit.scale, A.row(s));
    A.row(s) *= root[s];
  }
  MatrixXd rest = weighted_offsets(root, jacobian(samples, part, fit.columns), fit.translation);

  const double rounding = std::numeric_limits<double>::epsilon() * std::max(n, monomials.size());
  const double tolerance =
      options.fit == FitKind::degree_by_degree ? options.rank_tolerance : rounding;
  fit.coefficients = MatrixXd::Zero(monomials.size(), fit.columns.size());
  const int n_fits = options.fit == FitKind::pseudo_inverse ? 1 : monomials.degree();
  for (int k = 1; k <= n_fits; ++k) {
    const int begin = n_fits == 1 ? 0 : monomials.first(k);
    const int size = (n_fits == 1 ? monomials.size() : monomials.first(k + 1)) - begin;
    const MatrixXd A_k = A.middleCols(begin, size);
    const PseudoInverse inverse = pseudo_inverse(A_k, tolerance);
    MatrixXd c_k = inverse.matrix * rest;
    if (k == 1 && options.fit == FitKind::degree_by_degree && inverse.rank < Dim) {
      // All of the set counts that is more than the rounding of positions: a thin solid has no better.
      const double noise = std::max(rounding, 8 * std::numeric_limits<double>::epsilon() *
                                                  samples.position.cwiseAbs().maxCoeff() / fit.scale);
      const MatrixXd undetermined = MatrixXd::Identity(Dim, Dim) - inverse.matrix * A_k;
      c_k += undetermined * linear_fit_of_set(samples, set, origin, fit, noise);
      fit.borrowed = true;
    }
    rest -= A_k * c_k;
    fit.coefficients.middleRows(begin, size) = c_k;
    fit.rank.push_back(inverse.rank);
    if (k == 1) fit.condition = inverse.condition;
  }
  return fit;
}

}  // namespace

template <int Dim>
Projection<Dim> project(const Samples<Dim>& samples, const Origins<Dim>& origins,
                        const ProjectionOptions& options) {
  if (options.degree < 1 || options.degree > 4)
    throw InputError("", "method.degree", std::to_string(options.degree), "1 to 4");
  Projection<Dim> projection;
  projection.monomials = Monomials<Dim>(options.degree);
  for (int i = 0; i < int(origins.of_part.size()); ++i) {
    const int o = origins.of_part[i];
    projection.parts.push_back(fit_part<Dim>(samples, i, origins.members[o], origins.position.col(o),
                                             projection.monomials, options));
  }
  return projection;
}

template Projection<2> project<2>(const Samples<2>&, const Origins<2>&, const ProjectionOptions&);
template Projection<3> project<3>(const Samples<3>&, const Origins<3>&, const ProjectionOptions&);

}  // namespace sem
