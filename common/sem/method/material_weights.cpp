#include "sem/method/material_weights.h"

#include <algorithm>
#include <limits>

namespace sem {
namespace {

// The largest theta of some entries, and its gradient.
template <int Dim>
struct Largest {
  double theta = 0;
  Vec<Dim> gradient = Vec<Dim>::Zero();
};

// What keeps out which entries of one point.
template <int Dim>
class Entries {
 public:
  Entries(const std::vector<double>& stiffness, const std::vector<double>& softest, const Boundary<Dim>& boundary,
          const DistanceWeights<Dim>& theta, int point)
      : stiffness_(stiffness), softest_(softest), boundary_(boundary), theta_(theta), begin_(theta.begin[point]),
        end_(theta.begin[point + 1]) {}

  // 1 - S / O of entry e and its gradient.
  Largest<Dim> factor(int e) const {
    Largest<Dim> stiff, soft;
    for (int f = begin_; f < end_; ++f) {
      Largest<Dim>& largest = stiffer(f, e) ? stiff : soft;
      if (!(theta_.theta[f] > largest.theta) || is_patch(f)) continue;
      largest.theta = theta_.theta[f];
      if (!theta_.gradient.empty()) largest.gradient = theta_.gradient[f];
    }
    if (stiff.theta == 0) return {1, Vec<Dim>::Zero()};
    if (!(stiff.theta < soft.theta)) return {};
    const double ratio = stiff.theta / soft.theta;
    return {1 - ratio, (ratio * soft.gradient - stiff.gradient) / soft.theta};
  }

 private:
  bool is_patch(int e) const { return theta_.part[e] >= boundary_.n_parts(); }

  bool stiffer(int f, int e) const {
    if (is_patch(f)) return false;
    const int i = theta_.part[f], j = theta_.part[e], solid = boundary_.solid[i];
    if (is_patch(e)) return stiffness_[i] > softest_[solid];
    return boundary_.solid[j] == solid && stiffness_[i] > stiffness_[j];
  }

  const std::vector<double>& stiffness_;
  const std::vector<double>& softest_;
  const Boundary<Dim>& boundary_;
  const DistanceWeights<Dim>& theta_;
  int begin_, end_;
};

}  // namespace

template <int Dim>
void keep_out_of_stiffer(const std::vector<double>& stiffness, const Boundary<Dim>& boundary,
                         DistanceWeights<Dim>& theta) {
  if (stiffness.empty()) return;
  std::vector<double> softest(boundary.n_solids, std::numeric_limits<double>::infinity());
  for (int i = 0; i < boundary.n_parts(); ++i)
    softest[boundary.solid[i]] = std::min(softest[boundary.solid[i]], stiffness[i]);
  DistanceWeights<Dim> kept = theta;
  kept.begin = {0};
  kept.part.clear();
  kept.theta.clear();
  kept.gradient.clear();
  kept.piece.clear();
  for (size_t k = 0; k + 1 < theta.begin.size(); ++k) {
    const Entries<Dim> entries(stiffness, softest, boundary, theta, int(k));
    for (int e = theta.begin[k]; e < theta.begin[k + 1]; ++e) {
      const Largest<Dim> factor = entries.factor(e);
      if (!(factor.theta > 0)) continue;
      kept.part.push_back(theta.part[e]);
      kept.theta.push_back(factor.theta * theta.theta[e]);
      kept.piece.push_back(theta.piece[e]);
      if (!theta.gradient.empty())
        kept.gradient.push_back(factor.theta * theta.gradient[e] + theta.theta[e] * factor.gradient);
    }
    kept.begin.push_back(int(kept.part.size()));
  }
  theta = std::move(kept);
}

int part_of_region(const std::vector<double>& stiffness, const std::vector<int>& solid, const int* part,
                   const double* w, int n) {
  int best = int(std::max_element(w, w + n) - w);
  if (stiffness.empty()) return part[best];
  for (int e = 0; e < n; ++e) {
    if (solid[part[e]] != solid[part[best]]) continue;
    const double s = stiffness[part[e]], least = stiffness[part[best]];
    if (s < least || (s == least && w[e] > w[best])) best = e;
  }
  return part[best];
}

template void keep_out_of_stiffer<2>(const std::vector<double>&, const Boundary<2>&, DistanceWeights<2>&);
template void keep_out_of_stiffer<3>(const std::vector<double>&, const Boundary<3>&, DistanceWeights<3>&);

}  // namespace sem
