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

void sort_unique(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Entries of y that a part's polynomial depends on.
std::vector<int> columns_of(const PartFit& fit, int n_columns) {
  std::vector<int> columns = fit.columns;
  for (const int row : fit.shared) columns.push_back(n_columns + row);
  return columns;
}

template <int Dim>
MapBlock<Dim> make_block(const std::vector<int>& parts, const std::vector<int>& points,
                         const Points<Dim>& position, const BlendingWeights<Dim>& weights,
                         const Origins<Dim>& origins, const Projection<Dim>& projection,
                         int n_unknowns, bool with_gradient) {
  MapBlock<Dim> block;
  block.points = points;
  for (const int i : parts) {
    const auto columns = columns_of(projection.parts[i], n_unknowns);
    block.columns.insert(block.columns.end(), columns.begin(), columns.end());
  }
  sort_unique(block.columns);

  const int n = int(points.size()), n_columns = int(block.columns.size());
  const auto& monomials = projection.monomials;
  block.value = MatrixXd::Zero(n, n_columns);
  if (with_gradient) block.gradient.fill(block.value);
  MatrixXd m(n, monomials.size());
  VectorXd w(n);
  for (size_t p = 0; p < parts.size(); ++p) {
    const PartFit& fit = projection.parts[parts[p]];
    const Vec<Dim> origin = origins.position.col(origins.of_part[parts[p]]);
    std::vector<int> at = columns_of(fit, n_unknowns);
    for (int& column : at)
      column = int(std::lower_bound(block.columns.begin(), block.columns.end(), column) - block.columns.begin());
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

// The shared rows as a dense matrix, #shared by n_columns.
template <int Dim>
MatrixXd dense_shared(const Map<Dim>& map) {
  MatrixXd T = MatrixXd::Zero(map.n_shared(), map.n_columns);
  int row = 0;
  for (const auto& group : map.shared) {
    T(Eigen::seqN(row, group.rows.rows()), group.columns) = group.rows;
    row += int(group.rows.rows());
  }
  return T;
}

// The map on its unknowns alone.
template <int Dim>
Map<Dim> written_out(Map<Dim> map) {
  if (map.shared.empty()) return map;
  const MatrixXd T = dense_shared(map);
  for (auto& block : map.blocks) {
    const std::vector<int> columns = unknowns_of(map, block);
    MatrixXd to_unknowns(block.columns.size(), columns.size());
    for (size_t j = 0; j < block.columns.size(); ++j)
      for (size_t c = 0; c < columns.size(); ++c) {
        const int column = block.columns[j];
        to_unknowns(j, c) = column < map.n_columns ? column == columns[c] : T(column - map.n_columns, columns[c]);
      }
    block.value *= to_unknowns;
    for (auto& gradient : block.gradient)
      if (gradient.size() > 0) gradient *= to_unknowns;
    block.columns = columns;
  }
  map.shared.clear();
  return map;
}

}  // namespace

template <int Dim>
void set_coefficients(const Map<Dim>& map, const VectorXd& z, Points<Dim>& y) {
  y.resize(Dim, map.n_columns + map.n_shared());
  y.leftCols(map.n_columns) = Eigen::Map<const Points<Dim>>(z.data(), Dim, map.n_columns);
  int next = map.n_columns;
  for (const auto& group : map.shared)
    for (int row = 0; row < group.rows.rows(); ++row, ++next) {
      Vec<Dim> sum = Vec<Dim>::Zero();
      for (size_t c = 0; c < group.columns.size(); ++c) sum += group.rows(row, c) * y.col(group.columns[c]);
      y.col(next) = sum;
    }
}

template <int Dim>
Points<Dim> coefficients(const Map<Dim>& map, const VectorXd& z) {
  Points<Dim> y;
  set_coefficients(map, z, y);
  return y;
}

template <int Dim>
std::vector<int> unknowns_of(const Map<Dim>& map, const MapBlock<Dim>& block) {
  std::vector<int> columns;
  for (const int column : block.columns) {
    if (column < map.n_columns) {
      columns.push_back(column);
      continue;
    }
    int row = column - map.n_columns;
    const auto group = std::find_if(map.shared.begin(), map.shared.end(), [&](const SharedRows& g) {
      row -= int(g.rows.rows());
      return row < 0;
    });
    columns.insert(columns.end(), group->columns.begin(), group->columns.end());
  }
  sort_unique(columns);
  return columns;
}

template <int Dim>
int Map<Dim>::n_shared() const {
  int n = 0;
  for (const auto& group : shared) n += int(group.rows.rows());
  return n;
}

template <int Dim>
double Map<Dim>::fill() const {
  double entries = 0;
  for (const auto& block : blocks) entries += double(block.points.size()) * unknowns_of(*this, block).size();
  return n_points > 0 ? entries / (double(n_points) * n_columns) : 0;
}

template <int Dim>
Map<Dim> blended_map(const Points<Dim>& position, const BlendingWeights<Dim>& weights,
                     const Origins<Dim>& origins, const Projection<Dim>& projection, int n_columns,
                     bool with_gradient, int n_threads) {
  Map<Dim> map;
  map.n_points = int(position.cols());
  map.n_columns = n_columns;
  map.shared = projection.shared;
  const auto groups = group_by_parts(weights);
  const std::vector<std::pair<std::vector<int>, std::vector<int>>> list(groups.begin(), groups.end());
  map.blocks.resize(list.size());
  parallel_for(int(list.size()), n_threads, [&](int begin, int end) {
    for (int b = begin; b < end; ++b)
      map.blocks[b] = make_block<Dim>(list[b].first, list[b].second, position, weights, origins,
                                      projection, n_columns, with_gradient);
  });
  return map;
}

template <int Dim>
PruneReport prune(Map<Dim>& map, int n_keep, bool renormalise) {
  map = written_out(std::move(map));
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
  for (const auto& block : written_out(map).blocks) dense(block.points, block.columns) = block.value;
  return dense;
}

template <int Dim>
MatrixXd dense_gradient(const Map<Dim>& map, int axis) {
  MatrixXd dense = MatrixXd::Zero(map.n_points, map.n_columns);
  for (const auto& block : written_out(map).blocks) dense(block.points, block.columns) = block.gradient[axis];
  return dense;
}

template <int Dim>
Points<Dim> evaluate(const Map<Dim>& map, const Eigen::VectorXd& z) {
  const Points<Dim> y = coefficients(map, z);
  Points<Dim> x(Dim, map.n_points);
  for (const auto& block : map.blocks) {
    const Points<Dim> local = y(Eigen::all, block.columns);
    const Points<Dim> values = local * block.value.transpose();
    for (size_t k = 0; k < block.points.size(); ++k) x.col(block.points[k]) = values.col(k);
  }
  return x;
}

template <int Dim>
Points<Dim> evaluate_transposed(const Map<Dim>& map, const Points<Dim>& values) {
  Points<Dim> sum = Points<Dim>::Zero(Dim, map.n_columns + map.n_shared());
  for (const auto& block : map.blocks) {
    const Points<Dim> local = values(Eigen::all, block.points);
    for (size_t j = 0; j < block.columns.size(); ++j)
      sum.col(block.columns[j]) += local * block.value.col(j);
  }
  add_shared(map, sum);
  return sum.leftCols(map.n_columns);
}

template <int Dim>
void add_shared(const Map<Dim>& map, Points<Dim>& sum) {
  int next = map.n_columns;
  for (const auto& group : map.shared)
    for (int row = 0; row < group.rows.rows(); ++row, ++next)
      for (size_t c = 0; c < group.columns.size(); ++c) sum.col(group.columns[c]) += group.rows(row, c) * sum.col(next);
}

template <int Dim>
Mat<Dim> deformation_gradient(const MapBlock<Dim>& block, int row, const Points<Dim>& y) {
  Mat<Dim> F = Mat<Dim>::Zero();
  for (size_t j = 0; j < block.columns.size(); ++j)
    for (int b = 0; b < Dim; ++b) F.col(b) += block.gradient[b](row, j) * y.col(block.columns[j]);
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
  template Mat<Dim> deformation_gradient<Dim>(const MapBlock<Dim>&, int, const Points<Dim>&);     \
  template Points<Dim> coefficients<Dim>(const Map<Dim>&, const VectorXd&);                       \
  template std::vector<int> unknowns_of<Dim>(const Map<Dim>&, const MapBlock<Dim>&);              \
  template void set_coefficients<Dim>(const Map<Dim>&, const VectorXd&, Points<Dim>&);            \
  template void add_shared<Dim>(const Map<Dim>&, Points<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
