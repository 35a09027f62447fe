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

// The linear part fitted to all samples of a set of parts, in the monomials of (X - origin) / scale.
template <int Dim>
MatrixXd linear_fit_of_set(const Samples<Dim>& samples, const std::vector<int>& set, const Vec<Dim>& origin,
                           double scale, const SharedRows& shared) {
  int n = 0;
  for (const int i : set) n += samples.first[i + 1] - samples.first[i];
  MatrixXd A(n, Dim), rest(n, shared.columns.size());
  int row = 0;
  for (const int i : set) {
    const int first = samples.first[i], size = samples.first[i + 1] - first;
    const VectorXd root = samples.weight.segment(first, size).cwiseSqrt();
    for (int s = 0; s < size; ++s) A.row(row + s) = root[s] / scale * (samples.position.col(first + s) - origin);
    rest.middleRows(row, size) = weighted_offsets(root, jacobian(samples, i, shared.columns), shared.rows.row(0));
    row += size;
  }
  // All of the set counts that is more than the rounding of positions: a thin solid has no better.
  const double epsilon = std::numeric_limits<double>::epsilon();
  const double noise = std::max(epsilon * std::max(n, Dim), 8 * epsilon * samples.position.cwiseAbs().maxCoeff() / scale);
  return pseudo_inverse(A, noise).matrix * rest;
}

// Root mean square distance of the samples of some parts from a point; 1 if that is 0.
template <int Dim>
double mean_distance(const Samples<Dim>& samples, const std::vector<int>& parts, const Vec<Dim>& origin) {
  double sum = 0, total = 0;
  for (const int i : parts)
    for (int s = samples.first[i]; s < samples.first[i + 1]; ++s) {
      sum += samples.weight[s] * (samples.position.col(s) - origin).squaredNorm();
      total += samples.weight[s];
    }
  const double distance = std::sqrt(sum / total);
  return distance > 0 ? distance : 1;
}

// Where a part's fit finds what its origin's set shares: row 0 is the centroid, 1 to Dim the linear fit.
template <int Dim>
class SetFit {
 public:
  SetFit(const Samples<Dim>& samples, const std::vector<int>& set, const Vec<Dim>& origin)
      : samples_(samples), set_(set), origin_(origin) {
    shared_.columns = controls_of(samples, set);
    shared_.rows = mean_row(samples, set, shared_.columns);
  }

  // The linear fit's rows are made when first asked for; they belong to monomials of this length.
  double linear_scale() {
    if (shared_.rows.rows() > 1) return scale_;
    scale_ = mean_distance(samples_, set_, origin_);
    const MatrixXd linear = linear_fit_of_set<Dim>(samples_, set_, origin_, scale_, shared_);
    shared_.rows.conservativeResize(1 + Dim, Eigen::NoChange);
    shared_.rows.bottomRows(Dim) = linear;
    return scale_;
  }
  const SharedRows& shared() const { return shared_; }

 private:
  const Samples<Dim>& samples_;
  const std::vector<int>& set_;
  Vec<Dim> origin_;
  SharedRows shared_;
  double scale_ = 1;
};

// The shared rows of the fit are counted from 0: those of its set.
template <int Dim>
PartFit fit_part(const Samples<Dim>& samples, int part, SetFit<Dim>& set, const Vec<Dim>& origin,
                 const Monomials<Dim>& monomials, const ProjectionOptions& options) {
  PartFit fit;
  fit.columns = controls_of(samples, {part});
  fit.shared = {0};
  const int first = samples.first[part], n = samples.first[part + 1] - first, n_own = int(fit.columns.size());
  const VectorXd root = samples.weight.segment(first, n).cwiseSqrt();
  const Points<Dim> offset = samples.position.middleCols(first, n).colwise() - origin;
  if (options.fit == FitKind::degree_by_degree) fit.scale = mean_distance(samples, {part}, origin);
  MatrixXd A(n, monomials.size());
  for (int s = 0; s < n; ++s) {
    monomials.values(offset.col(s) / fit.scale, A.row(s));
    A.row(s) *= root[s];
  }
  // diag(root) (J - 1 t) on (own control points, t).
  MatrixXd rest(n, n_own + 1);
  rest << root.asDiagonal() * jacobian(samples, part, fit.columns), -root;

  const double rounding = std::numeric_limits<double>::epsilon() * std::max(n, monomials.size());
  const double tolerance =
      options.fit == FitKind::degree_by_degree ? options.rank_tolerance : rounding;
  fit.coefficients = MatrixXd::Zero(monomials.size(), n_own + 1);
  const int n_fits = options.fit == FitKind::pseudo_inverse ? 1 : monomials.degree();
  for (int k = 1; k <= n_fits; ++k) {
    const int begin = n_fits == 1 ? 0 : monomials.first(k);
    const int size = (n_fits == 1 ? monomials.size() : monomials.first(k + 1)) - begin;
    const MatrixXd A_k = A.middleCols(begin, size);
    const PseudoInverse inverse = pseudo_inverse(A_k, tolerance);
    MatrixXd c_k = inverse.matrix * rest;
    if (k == 1 && options.fit == FitKind::degree_by_degree && inverse.rank < Dim) {
      fit.borrowed = true;
      for (int a = 0; a < Dim; ++a) fit.shared.push_back(1 + a);
      for (MatrixXd* m : {&rest, &fit.coefficients, &c_k})
        m->conservativeResizeLike(MatrixXd::Zero(m->rows(), n_own + 1 + Dim));
      const MatrixXd undetermined = MatrixXd::Identity(Dim, Dim) - inverse.matrix * A_k;
      c_k.rightCols(Dim) = fit.scale / set.linear_scale() * undetermined;
    }
    rest -= A_k * c_k;
    fit.coefficients.middleRows(begin, size) = c_k;
    fit.rank.push_back(inverse.rank);
    if (k == 1) fit.condition = inverse.condition;
  }
  fit.translation = Eigen::RowVectorXd::Unit(fit.coefficients.cols(), n_own);
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
  std::vector<SetFit<Dim>> sets;
  for (size_t o = 0; o < origins.members.size(); ++o)
    sets.emplace_back(samples, origins.members[o], origins.position.col(o));
  for (int i = 0; i < int(origins.of_part.size()); ++i) {
    const int o = origins.of_part[i];
    projection.parts.push_back(
        fit_part<Dim>(samples, i, sets[o], origins.position.col(o), projection.monomials, options));
  }
  std::vector<int> first_row;
  int n_rows = 0;
  for (const auto& set : sets) {
    first_row.push_back(n_rows);
    n_rows += int(set.shared().rows.rows());
    projection.shared.push_back(set.shared());
  }
  for (size_t i = 0; i < projection.parts.size(); ++i)
    for (int& row : projection.parts[i].shared) row += first_row[origins.of_part[i]];
  return projection;
}

template <int Dim>
PartFit fit_on_controls(const Projection<Dim>& projection, int i) {
  const PartFit& fit = projection.parts[i];
  PartFit full = fit;
  full.shared.clear();
  std::vector<std::pair<const SharedRows*, int>> places;  // of every shared row
  for (const auto& group : projection.shared)
    for (int row = 0; row < group.rows.rows(); ++row) places.push_back({&group, row});
  for (const int row : fit.shared)
    full.columns.insert(full.columns.end(), places[row].first->columns.begin(), places[row].first->columns.end());
  std::sort(full.columns.begin(), full.columns.end());
  full.columns.erase(std::unique(full.columns.begin(), full.columns.end()), full.columns.end());
  MatrixXd to_full = MatrixXd::Zero(fit.coefficients.cols(), full.columns.size());
  const auto at = [&](int column) { return std::lower_bound(full.columns.begin(), full.columns.end(), column) - full.columns.begin(); };
  const int n_own = int(fit.columns.size());
  for (int c = 0; c < n_own; ++c) to_full(c, at(fit.columns[c])) = 1;
  for (size_t s = 0; s < fit.shared.size(); ++s) {
    const auto& [group, row] = places[fit.shared[s]];
    for (size_t c = 0; c < group->columns.size(); ++c) to_full(n_own + s, at(group->columns[c])) = group->rows(row, c);
  }
  full.coefficients = fit.coefficients * to_full;
  full.translation = fit.translation * to_full;
  return full;
}

template PartFit fit_on_controls<2>(const Projection<2>&, int);
template PartFit fit_on_controls<3>(const Projection<3>&, int);
template Projection<2> project<2>(const Samples<2>&, const Origins<2>&, const ProjectionOptions&);
template Projection<3> project<3>(const Samples<3>&, const Origins<3>&, const ProjectionOptions&);

}  // namespace sem
