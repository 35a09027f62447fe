#include "sem/method/followers.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sem/method/least_squares.h"

namespace sem {
namespace {

constexpr double least_share =
    1e-6;  // of the square of a basis function that its samples have to add
constexpr double least_mean_square = 1e-8;  // of a basis function, by that of n equal ones

// Scalar J^T diag(a) J of one part, over its own control points.
template <int Dim>
Eigen::MatrixXd gram_of_part(const Boundary<Dim>& boundary, const Samples<Dim>& samples, int part) {
  const int first = boundary.first_control[part], n = boundary.first_control[part + 1] - first;
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n, n);
  for (int s = samples.first[part]; s < samples.first[part + 1]; ++s)
    for (int e = samples.row[s]; e < samples.row[s + 1]; ++e)
      for (int f = samples.row[s]; f < samples.row[s + 1]; ++f)
        G(samples.column[e] - first, samples.column[f] - first) +=
            samples.weight[s] * samples.value[e] * samples.value[f];
  return G;
}

// Marks the control points of an untrimmed part that show at points without area only.
template <int Dim>
void mark_unseen(const Boundary<Dim>& boundary, const Samples<Dim>& samples, int part, std::vector<bool>& unseen) {
  const int first = boundary.first_control[part], n = boundary.first_control[part + 1] - first;
  Eigen::VectorXd square = Eigen::VectorXd::Zero(n), at_points = square;
  double total = 0;
  for (int s = samples.first[part]; s < samples.first[part + 1]; ++s) total += samples.weight[s];
  for (int s = samples.first[part]; s < samples.first[part + 1]; ++s)
    for (int e = samples.row[s]; e < samples.row[s + 1]; ++e) {
      const int c = samples.column[e] - first;
      square[c] += samples.weight[s] / total * samples.value[e] * samples.value[e];
      if (samples.weight[s] <= 1e-12 * total) at_points[c] = std::max(at_points[c], samples.value[e]);
    }
  for (int c = 0; c < n; ++c)
    unseen[first + c] = at_points[c] > 0.5 && square[c] < least_mean_square / (double(n) * n);
}

// Diagonal that the part would have without trims.
template <int Dim>
Eigen::VectorXd untrimmed_diagonal(const Boundary<Dim>& boundary, int part) {
  Boundary<Dim> whole;
  whole.parts.push_back(boundary.parts[part]);
  whole.parts[0].region.reset();
  whole.first_control = {boundary.first_control[part], boundary.first_control[part + 1]};
  const auto samples = sample_boundary(whole, {});
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(whole.first_control[1] - whole.first_control[0]);
  for (int s = 0; s < samples.size(); ++s)
    for (int e = samples.row[s]; e < samples.row[s + 1]; ++e)
      diagonal[samples.column[e] - whole.first_control[0]] +=
          samples.weight[s] * samples.value[e] * samples.value[e];
  return diagonal;
}

// Shares of the leaders in the affine map that fits them best, at X.
template <int Dim>
Eigen::RowVectorXd affine_shares(const Points<Dim>& leaders, const Vec<Dim>& X) {
  const Vec<Dim> center = leaders.rowwise().mean();
  const Eigen::MatrixXd offsets = (leaders.colwise() - center).transpose();
  const Eigen::RowVectorXd linear = (X - center).transpose() * pseudo_inverse(offsets, 1e-9).matrix;
  return linear.array() + 1.0 / double(leaders.cols());
}

}  // namespace

template <int Dim>
Followers<Dim> find_followers(const Boundary<Dim>& boundary, const Samples<Dim>& samples) {
  Followers<Dim> followers;
  std::vector<bool> follows(boundary.n_controls(), false);
  for (int i = 0; i < boundary.n_parts(); ++i) {
    if (!boundary.parts[i].region) {
      mark_unseen(boundary, samples, i, follows);
      continue;
    }
    const Eigen::VectorXd scale =
        untrimmed_diagonal(boundary, i).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const int first = boundary.first_control[i];
    std::fill(follows.begin() + first, follows.begin() + boundary.first_control[i + 1], true);
    const Eigen::MatrixXd scaled = scale.asDiagonal() * gram_of_part(boundary, samples, i) * scale.asDiagonal();
    for (const int c : independent_rows(scaled, 0, least_share)) follows[first + c] = false;
  }
  const Points<Dim> p = rest_controls(boundary);
  const auto leaders_between = [&](int begin, int end) {
    std::vector<int> leaders;
    for (int c = begin; c < end; ++c)
      if (!follows[c]) leaders.push_back(c);
    return leaders;
  };
  for (int i = 0; i < boundary.n_parts(); ++i) {
    const int begin = boundary.first_control[i], end = boundary.first_control[i + 1];
    const auto own = leaders_between(begin, end);
    for (int c = begin; c < end; ++c) {
      if (!follows[c]) continue;
      followers.control.push_back(c);
      followers.leaders.push_back(own);
      followers.share.push_back(affine_shares<Dim>(p(Eigen::all, own), p.col(c)));
      const Vec<Dim> reached = p(Eigen::all, own) * followers.share.back().transpose();
      if ((reached - p.col(c)).norm() <= boundary.tolerance()) continue;
      followers.leaders.back() = leaders_between(0, boundary.n_controls());
      followers.share.back() =
          affine_shares<Dim>(p(Eigen::all, followers.leaders.back()), p.col(c));
    }
  }
  return followers;
}

template <int Dim>
void substitute(const Followers<Dim>& followers, Samples<Dim>& samples) {
  if (followers.empty()) return;
  Samples<Dim> result = samples;
  result.row = {0};
  result.column.clear();
  result.value.clear();
  for (int s = 0; s < samples.size(); ++s) {
    std::map<int, double> row;
    for (int e = samples.row[s]; e < samples.row[s + 1]; ++e) {
      const auto found =
          std::lower_bound(followers.control.begin(), followers.control.end(), samples.column[e]);
      if (found == followers.control.end() || *found != samples.column[e]) {
        row[samples.column[e]] += samples.value[e];
        continue;
      }
      const size_t f = found - followers.control.begin();
      for (size_t k = 0; k < followers.leaders[f].size(); ++k)
        row[followers.leaders[f][k]] += samples.value[e] * followers.share[f][k];
    }
    for (const auto& [column, value] : row) {
      result.column.push_back(column);
      result.value.push_back(value);
    }
    result.row.push_back(int(result.column.size()));
  }
  samples = std::move(result);
}

template <int Dim>
Unknowns<Dim> leading_unknowns(const Boundary<Dim>& boundary, const Followers<Dim>& followers,
                               std::vector<int>& unknown_of) {
  const int n = boundary.n_controls();
  unknown_of.assign(n, -1);
  std::vector<int> leading;
  for (int c = 0; c < n; ++c)
    if (!followers.follows(c)) {
      unknown_of[c] = int(leading.size());
      leading.push_back(c);
    }
  Unknowns<Dim> unknowns;
  unknowns.rest = rest_controls(boundary)(Eigen::all, leading);
  unknowns.one = Eigen::VectorXd::Ones(leading.size());
  unknowns.S = Eigen::MatrixXd::Zero(n, leading.size());
  for (size_t k = 0; k < leading.size(); ++k) unknowns.S(leading[k], k) = 1;
  follow(followers, unknowns.S);
  return unknowns;
}

template <int Dim>
void follow(const Followers<Dim>& followers, Eigen::MatrixXd& S) {
  for (size_t f = 0; f < followers.control.size(); ++f)
    S.row(followers.control[f]) = followers.share[f] * S(followers.leaders[f], Eigen::all);
}

#define SEM_INSTANTIATE(Dim)                                                                \
  template Followers<Dim> find_followers<Dim>(const Boundary<Dim>&, const Samples<Dim>&);   \
  template void substitute<Dim>(const Followers<Dim>&, Samples<Dim>&);                      \
  template Unknowns<Dim> leading_unknowns<Dim>(const Boundary<Dim>&, const Followers<Dim>&, \
                                               std::vector<int>&);                          \
  template void follow<Dim>(const Followers<Dim>&, Eigen::MatrixXd&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
