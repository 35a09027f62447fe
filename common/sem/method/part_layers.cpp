#include "sem/method/part_layers.h"

#include <algorithm>
#include <cmath>

#include "sem/method/boundary_integrals.h"
#include "sem/method/sided_weight.h"

namespace sem {
namespace {

constexpr double least_extents = 2;  // what a part sees beside it anyway
constexpr double shortest_share = 1. / 64, longest_share = 1. / 2;  // of the cutoff

}  // namespace

template <int Dim>
std::vector<PartLayer> find_part_layers(const Boundary<Dim>& boundary, double cutoff, int n_layers) {
  std::vector<PartLayer> layers;
  if (n_layers == 0) return layers;
  const auto measures = part_measures(boundary);
  for (int i = 0; i < boundary.n_parts(); ++i) {
    const double extent = std::pow(measures[size_t(i)], 1.0 / (Dim - 1));
    const double least = std::max(least_extents * extent, shortest_share * cutoff), range = longest_share * cutoff / least;
    if (range < 1) continue;
    const int n = std::min(n_layers, 1 + int(std::log2(range) + 1e-9));
    const double ratio = n > 1 && n == n_layers ? std::pow(range, 1. / (n - 1)) : 2;
    for (int k = 0; k < n; ++k) layers.push_back({i, least * std::pow(ratio, k)});
  }
  return layers;
}

template <int Dim>
void add_part_layers(const std::vector<PartLayer>& layers, const Boundary<Dim>& boundary,
                     const Distances<Dim>& distances, const Points<Dim>& position, DistanceWeights<Dim>& theta) {
  if (layers.empty()) return;
  const bool with_gradient = !theta.gradient.empty();
  std::vector<int> first(size_t(boundary.n_parts()) + 1, 0);  // layers of each part
  for (const auto& layer : layers) ++first[size_t(layer.part) + 1];
  for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];

  DistanceWeights<Dim> all;
  all.cutoff = theta.cutoff;
  all.side_ramp = theta.side_ramp;
  all.n_parts = theta.n_parts + int(layers.size());
  all.begin.push_back(0);
  for (int k = 0; k < position.cols(); ++k) {
    all.append_row(theta, k);
    for (int pair = distances.begin[k]; pair < distances.begin[k + 1]; ++pair) {
      const size_t part = size_t(distances.part[pair]);
      for (int l = first[part]; l < first[part + 1]; ++l) {
        const double reach = layers[size_t(l)].reach;
        const double value = distance_profile(distances.closest[pair] / reach).value *
                             side_step(distances.side[pair], theta.side_ramp).value;
        if (!(value > 0)) continue;
        all.part.push_back(theta.n_parts + l);
        all.theta.push_back(value);
        all.piece.push_back(-1);
        if (with_gradient)
          all.gradient.push_back(
              sided_gradient<Dim>(boundary.parts[part], distances, pair, position.col(k), reach, theta.side_ramp));
      }
    }
    all.begin.push_back(int(all.part.size()));
  }
  theta = std::move(all);
}

#define SEM_INSTANTIATE(Dim)                                                                            \
  template std::vector<PartLayer> find_part_layers<Dim>(const Boundary<Dim>&, double, int);             \
  template void add_part_layers<Dim>(const std::vector<PartLayer>&, const Boundary<Dim>&,               \
                                     const Distances<Dim>&, const Points<Dim>&, DistanceWeights<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
