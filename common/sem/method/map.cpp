#include "sem/method/map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "sem/base/parallel.h"

namespace sem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Points grouped by the set of parts that they follow.
template <int Dim>
std::map<std::vector<int>, std::vector<int>> group_by_parts(const BlendingWeights<Dim>& weights) {
  std::map<std::vector<int>, std::vector<int>> groups;
  for (int k = 0; k < weights.n_points(); ++k)
    groups[{weights.part.begin() + weights.begin[k], weights.part.begin() + weights.begin[k + 1]}]
        .push_back(k);
  return groups;
}

// m += diag(w) rows * fit, the fit's columns scattered among the block's.
void scatter_add(MatrixXd& m, const MatrixXd& rows, const std::vector<int>& at) {
  for (size_t c = 0; c < at.size(); ++c) m.col(at[c]) += rows.col(c);
}

template <int Dim>
MapBlock<Dim> make_block(const std::vector<int>& parts, const std::vector<int>& points,
                         const Points<Dim>& position, const BlendingWeights<Dim>& weights,
                         const Origins<Dim>& origins, const Projection<Dim>& projection,
                         bool with_gradient) {
  MapBlock<Dim> block;
  block.points = points;
  for (const int i : parts)
    block.columns.insert(block.columns.end(), projection.parts[i].columns.begin(),
                         projection.parts[i].columns.end());
  std::sort(block.columns.begin(), block.columns.end());
  block.columns.erase(std::unique(block.columns.begin(), block.columns.end()), block.columns.end());

  const int n = int(points.size()), n_columns = int(block.columns.size());
  const auto& monomials = projection.monomials;
  block.value = MatrixXd::Zero(n, n_columns);
  if (with_gradient) block.gradient.fill(block.value);
  MatrixXd m(n, monomials.size());
  VectorXd w(n);
  for (size_t p = 0; p < parts.size(); ++p) {
    const PartFit& fit = projection.parts[parts[p]];
    const Vec<Dim> origin = origins.position.col(origins.of_part[parts[p]]);
    std::vector<int> at(fit.columns.size());
    for (size_t c = 0; c < at.size(); ++c)
      at[c] = int(std::lower_bound(block.columns.begin(), block.columns.end(), fit.columns[c]) -
                  block.columns.begin());
    const auto local = [&](int k) -> Vec<Dim> { return (position.col(points[k]) - origin) / fit.scale; };
    for (int k = 0; k < n; ++k) {
      w[k] = weights.w[weights.begin[points[k]] + p];
      monomials.values(local(k), m.row(k));
    }
    const MatrixXd x_i = m * fit.coefficients + VectorXd::Ones(n) * fit.translation;
    // x += w_i [m(X - Xbar_i) c_i + t_i]
    scatter_add(block.value, w.asDiagonal() * x_i, at);
    if (!with_gradient) continue;
    for (int axis = 0; axis < Dim; ++axis) {
      if (!weights.gradient.empty()) {
        VectorXd dw(n);
        for (int k = 0; k < n; ++k) dw[k] = weights.gradient[weights.begin[points[k]] + p][axis];
        // F_.axis += dw_i/dX_axis [m c_i + t_i]
        scatter_add(block.gradient[axis], dw.asDiagonal() * x_i, at);
      }
      for (int k = 0; k < n; ++k) monomials.derivatives(local(k), axis, m.row(k));
      // F_.axis += w_i dm/dX_axis c_i
      scatter_add(block.gradient[axis], (w / fit.scale).asDiagonal() * (m * fit.coefficients), at);
    }
  }
  return block;
}

}  // namespace

template <int Dim>
double Map<Dim>::fill() const {
  double entries = 0;
  for (const auto& block : blocks) entries += double(block.points.size()) * block.columns.size();
  return n_points > 0 ? entries / (double(n_points) * n_columns) : 0;
}

template <int Dim>
Map<Dim> blended_map(const Points<Dim>& position, const BlendingWeights<Dim>& weights,
                     const Origins<Dim>& origins, const Projection<Dim>& projection, int n_columns,
                     bool with_gradient, int n_threads) {
  Map<Dim> map;
  map.n_points = int(position.cols());
  map.n_columns = n_columns;
  const auto groups = group_by_parts(weights);
  const std::vector<std::pair<std::vector<int>, std::vector<int>>> list(groups.begin(), groups.end());
  map.blocks.resize(list.size());
  parallel_for(int(list.size()), n_threads, [&](int begin, int end) {
    for (int b = begin; b < end; ++b)
      map.blocks[b] = make_block<Dim>(list[b].first, list[b].second, position, weights, origins,
                                      projection, with_gradient);
  });
  return map;
}

template <int Dim>
PruneReport prune(Map<Dim>& map, int n_keep, bool renormalise) {
  PruneReport report;
  report.kept = n_keep;
  double dropped = 0, total = 0;
  std::map<std::vector<int>, std::vector<std::pair<int, int>>> groups;  // columns -> (block, row)
  for (int b = 0; b < int(map.blocks.size()); ++b) {
    const auto& block = map.blocks[b];
    const int n_columns = int(block.columns.size()), keep = std::min(n_keep, n_columns);
    for (int k = 0; k < int(block.points.size()); ++k) {
      VectorXd size = VectorXd::Zero(n_columns);
      for (const auto& g : block.gradient) size = size.cwiseMax(g.row(k).transpose().cwiseAbs());
      std::vector<int> order(n_columns);
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return size[i] > size[j]; });
      order.resize(keep);
      std::sort(order.begin(), order.end());
      groups[order].push_back({b, k});
    }
  }
  // Sets of kept columns are local to a block: the same local set in two blocks makes two new ones.
  std::vector<MapBlock<Dim>> pruned;
  for (const auto& [kept, rows] : groups) {
    std::map<int, std::vector<int>> of_block;
    for (const auto& [b, k] : rows) of_block[b].push_back(k);
    for (const auto& [b, ks] : of_block) {
      const auto& block = map.blocks[b];
      MapBlock<Dim> next;
      for (const int c : kept) next.columns.push_back(block.columns[c]);
      for (const int k : ks) next.points.push_back(block.points[k]);
      const auto reduce = [&](const MatrixXd& full, double sum) {
        MatrixXd small = full(ks, kept);
        if (renormalise) small.colwise() += (sum - small.rowwise().sum().array()).matrix() / double(kept.size());
        return small;
      };
      next.value = reduce(block.value, 1);
      for (int a = 0; a < Dim; ++a) {
        next.gradient[a] = reduce(block.gradient[a], 0);
        const MatrixXd full = block.gradient[a](ks, Eigen::all);
        MatrixXd difference = full;
        difference(Eigen::all, kept) -= next.gradient[a];
        dropped += difference.squaredNorm();
        total += full.squaredNorm();
      }
      pruned.push_back(std::move(next));
    }
  }
  map.blocks = std::move(pruned);
  report.relative_error = total > 0 ? std::sqrt(dropped / total) : 0;
  return report;
}

template <int Dim>
MatrixXd dense_value(const Map<Dim>& map) {
  MatrixXd dense = MatrixXd::Zero(map.n_points, map.n_columns);
  for (const auto& block : map.blocks) dense(block.points, block.columns) = block.value;
  return dense;
}

template <int Dim>
MatrixXd dense_gradient(const Map<Dim>& map, int axis) {
  MatrixXd dense = MatrixXd::Zero(map.n_points, map.n_columns);
  for (const auto& block : map.blocks) dense(block.points, block.columns) = block.gradient[axis];
  return dense;
}

template <int Dim>
Points<Dim> evaluate(const Map<Dim>& map, const Eigen::VectorXd& z) {
  const Eigen::Map<const Points<Dim>> nodes(z.data(), Dim, map.n_columns);
  Points<Dim> x(Dim, map.n_points);
  for (const auto& block : map.blocks) {
    const Points<Dim> local = nodes(Eigen::all, block.columns);
    const Points<Dim> values = local * block.value.transpose();
    for (size_t k = 0; k < block.points.size(); ++k) x.col(block.points[k]) = values.col(k);
  }
  return x;
}

template <int Dim>
Points<Dim> evaluate_transposed(const Map<Dim>& map, const Points<Dim>& values) {
  Points<Dim> sum = Points<Dim>::Zero(Dim, map.n_columns);
  for (const auto& block : map.blocks) {
    const Points<Dim> local = values(Eigen::all, block.points);
    for (size_t j = 0; j < block.columns.size(); ++j)
      sum.col(block.columns[j]) += local * block.value.col(j);
  }
  return sum;
}

template <int Dim>
Mat<Dim> deformation_gradient(const MapBlock<Dim>& block, int row, const VectorXd& z) {
  Mat<Dim> F = Mat<Dim>::Zero();
  for (size_t j = 0; j < block.columns.size(); ++j) {
    const Vec<Dim> z_j = z.segment<Dim>(Dim * block.columns[j]);
    for (int b = 0; b < Dim; ++b) F.col(b) += block.gradient[b](row, j) * z_j;
  }
  return F;
}

#define SEM_INSTANTIATE(Dim)                                                                      \
  template struct Map<Dim>;                                                                       \
  template Map<Dim> blended_map<Dim>(const Points<Dim>&, const BlendingWeights<Dim>&,             \
                                     const Origins<Dim>&, const Projection<Dim>&, int, bool, int); \
  template PruneReport prune<Dim>(Map<Dim>&, int, bool);                                          \
  template MatrixXd dense_value<Dim>(const Map<Dim>&);                                            \
  template MatrixXd dense_gradient<Dim>(const Map<Dim>&, int);                                    \
  template Points<Dim> evaluate<Dim>(const Map<Dim>&, const VectorXd&);                           \
  template Points<Dim> evaluate_transposed<Dim>(const Map<Dim>&, const Points<Dim>&);             \
  template Mat<Dim> deformation_gradient<Dim>(const MapBlock<Dim>&, int, const VectorXd&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
