#include "sem/method/origins.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace sem {
namespace {

constexpr double shared_weight = 1e-4;  // a part belongs to a point's set above this weight
constexpr double flat = 1e-6;           // of a set on a line or plane: product of its relative extents
constexpr double tie = 1e-9;            // relative difference of two sums that are equal

using Set = std::vector<int>;

// Quadrature points grouped by their set of parts: for each set of two or more, sum of v_k w_i.
template <int Dim>
std::map<Set, std::map<int, double>> candidates(const BlendingWeights<Dim>& weights,
                                                const Eigen::VectorXd& quadrature_weight) {
  std::map<Set, std::map<int, double>> sums;
  for (int k = 0; k < weights.n_points(); ++k) {
    Set set;
    for (int e = weights.begin[k]; e < weights.begin[k + 1]; ++e)
      if (weights.w[e] > shared_weight) set.push_back(weights.part[e]);
    if (set.size() < 2) continue;
    auto& sum = sums[set];
    for (int e = weights.begin[k]; e < weights.begin[k + 1]; ++e)
      if (weights.w[e] > shared_weight) sum[weights.part[e]] += quadrature_weight[k] * weights.w[e];
  }
  return sums;
}

// True if all samples of the parts lie on one line (2D) or plane (3D).
template <int Dim>
bool is_flat(const Set& set, const Samples<Dim>& samples) {
  const Vec<Dim> center = origins_from_sets<Dim>({set}, {}, samples).position.col(0);
  Mat<Dim> second = Mat<Dim>::Zero();
  for (const int i : set)
    for (int s = samples.first[i]; s < samples.first[i + 1]; ++s) {
      const Vec<Dim> r = samples.position.col(s) - center;
      second += samples.weight[s] * r * r.transpose();
    }
  // The determinant is the product of the squared extents, of which the trace bounds each.
  return second.determinant() <= flat * flat * std::pow(second.trace(), Dim);
}

}  // namespace

template <int Dim>
Origins<Dim> origins_from_sets(const std::vector<std::vector<int>>& members,
                               const std::vector<int>& of_part, const Samples<Dim>& samples) {
  Origins<Dim> origins;
  origins.members = members;
  origins.of_part = of_part;
  origins.position.resize(Dim, members.size());
  for (size_t o = 0; o < members.size(); ++o) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    double total = 0;
    for (const int i : members[o])
      for (int s = samples.first[i]; s < samples.first[i + 1]; ++s) {
        sum += samples.weight[s] * samples.position.col(s);
        total += samples.weight[s];
      }
    origins.position.col(o) = sum / total;
  }
  return origins;
}

template <int Dim>
Origins<Dim> choose_origins(OriginChoice choice, const BlendingWeights<Dim>& weights,
                            const Eigen::VectorXd& quadrature_weight, const Samples<Dim>& samples) {
  const int n_parts = weights.n_parts;
  Set all(n_parts);
  std::iota(all.begin(), all.end(), 0);
  if (choice == OriginChoice::one)
    return origins_from_sets<Dim>({all}, std::vector<int>(n_parts, 0), samples);

  auto sums = candidates(weights, quadrature_weight);
  std::erase_if(sums, [&](const auto& candidate) { return is_flat(candidate.first, samples); });
  std::vector<Set> chosen(n_parts, all);
  Set ties, fallback;
  for (int i = 0; i < n_parts; ++i) {
    double best = 0;
    bool tied = false;
    for (const auto& [set, sum] : sums) {  // sets in lexicographical order
      const auto found = sum.find(i);
      if (found == sum.end()) continue;
      const double value = found->second;
      const bool equal = best > 0 && std::abs(value - best) <= tie * best;
      if (equal) tied = true;
      if (equal ? set.size() <= chosen[i].size() : value < best) continue;
      if (!equal) tied = false;
      best = std::max(best, value);
      chosen[i] = set;
    }
    if (best == 0) fallback.push_back(i);
    if (tied) ties.push_back(i);
  }
  std::vector<Set> members = chosen;
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  std::vector<int> of_part(n_parts);
  for (int i = 0; i < n_parts; ++i)
    of_part[i] = int(std::lower_bound(members.begin(), members.end(), chosen[i]) - members.begin());
  Origins<Dim> origins = origins_from_sets<Dim>(members, of_part, samples);
  origins.ties = ties;
  origins.fallback = fallback;
  return origins;
}

#define SEM_INSTANTIATE(Dim)                                                                   \
  template Origins<Dim> origins_from_sets<Dim>(const std::vector<std::vector<int>>&,           \
                                               const std::vector<int>&, const Samples<Dim>&);  \
  template Origins<Dim> choose_origins<Dim>(OriginChoice, const BlendingWeights<Dim>&,         \
                                            const Eigen::VectorXd&, const Samples<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
