#include "sem/mechanics/assembly.h"

#include <algorithm>
#include <set>

#include "sem/solve/dense_kernels.h"

namespace sem {

using Eigen::MatrixXd;

namespace {

struct Place {
  int group, row;  // of a shared row
};

template <int Dim>
std::vector<Place> shared_places(const Map<Dim>& map) {
  std::vector<Place> places;
  for (size_t g = 0; g < map.shared.size(); ++g)
    for (int row = 0; row < map.shared[g].rows.rows(); ++row) places.push_back({int(g), row});
  return places;
}

// The unknowns that each group of shared rows meets, its own among them.
template <int Dim>
std::vector<std::set<int>> touched_unknowns(const Map<Dim>& map) {
  const auto places = shared_places(map);
  std::vector<std::set<int>> touched(map.shared.size());
  for (size_t g = 0; g < touched.size(); ++g) touched[g].insert(map.shared[g].columns.begin(), map.shared[g].columns.end());
  for (const auto& block : map.blocks) {
    const auto first_shared = std::lower_bound(block.columns.begin(), block.columns.end(), map.n_columns);
    std::set<int> groups;
    for (auto c = first_shared; c != block.columns.end(); ++c) groups.insert(places[*c - map.n_columns].group);
    for (const int g : groups) {
      touched[g].insert(block.columns.begin(), first_shared);
      for (const int other : groups) touched[g].insert(map.shared[other].columns.begin(), map.shared[other].columns.end());
    }
  }
  return touched;
}

int index_of(const std::vector<int>& sorted, int value) {
  return int(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

}  // namespace

template <int Dim>
std::vector<std::vector<int>> couplings(const Map<Dim>& map) {
  std::set<std::vector<int>> cliques;
  for (const auto& block : map.blocks)
    cliques.insert({block.columns.begin(), std::lower_bound(block.columns.begin(), block.columns.end(), map.n_columns)});
  for (const auto& touched : touched_unknowns(map)) cliques.insert({touched.begin(), touched.end()});
  return {cliques.begin(), cliques.end()};
}

template <int Dim>
Assembly<Dim>::Assembly(const Map<Dim>& map, std::shared_ptr<const Elimination> plan, int components)
    : components_(components), plan_(std::move(plan)) {
  for (const auto& [group, row] : shared_places(map)) places_.push_back({group, row});
  const auto positions_of = [&](const auto& nodes) {
    std::vector<int> positions;
    for (const int node : nodes) positions.push_back(plan_->position[node]);
    std::sort(positions.begin(), positions.end());
    return positions;
  };
  int n_rows = 0;
  for (const auto& touched : touched_unknowns(map)) {
    const SharedRows& shared = map.shared[groups_.size()];
    Group group;
    group.first_row = n_rows;
    group.positions = positions_of(touched);
    group.T = MatrixXd::Zero(shared.rows.rows(), group.positions.size());
    for (size_t c = 0; c < shared.columns.size(); ++c)
      group.T.col(index_of(group.positions, plan_->position[shared.columns[c]])) = shared.rows.col(c);
    group.E = MatrixXd::Zero(components * group.T.rows(), components * group.T.cols());
    n_rows += int(shared.rows.rows());
    groups_.push_back(std::move(group));
  }
  shared_ = MatrixXd::Zero(components * n_rows, components * n_rows);
  std::vector<std::set<int>> met(n_rows);
  for (const auto& source : map.blocks) {
    Block block;
    const int n_own = index_of(source.columns, map.n_columns), n = int(source.columns.size());
    for (int c = 0; c < n; ++c) block.order.push_back(c);
    const auto position = [&](int c) { return plan_->position[source.columns[c]]; };
    std::sort(block.order.begin(), block.order.begin() + n_own, [&](int a, int b) { return position(a) < position(b); });
    for (int c = 0; c < n_own; ++c) block.positions.push_back(position(block.order[c]));
    for (int c = n_own; c < n; ++c) {
      const int row = source.columns[c] - map.n_columns;
      for (const int earlier : block.shared) met[row].insert(earlier);
      met[row].insert(row);
      block.shared.push_back(row);
      block.in_group.emplace_back();
      for (const int at : block.positions)
        block.in_group.back().push_back(index_of(groups_[places_[row].group].positions, at));
    }
    blocks_.push_back(std::move(block));
  }
  for (const auto& set : met) met_.emplace_back(set.begin(), set.end());
  long most_left = 0, most_right = 0;
  for (const auto& panel : plan_->panels) {
    auto& touching = touching_.emplace_back();
    long k = 0;
    for (int g = 0; g < int(groups_.size()); ++g) {
      const auto& positions = groups_[g].positions;
      const auto first = std::lower_bound(positions.begin(), positions.end(), panel.begin);
      if (first == positions.end() || *first >= panel.end) continue;
      touching.push_back(g);
      k += groups_[g].E.rows();
    }
    most_left = std::max(most_left, 2 * k * components * panel.height());
    most_right = std::max(most_right, 2 * k * components * panel.width());
  }
  left_.resize(most_left);
  right_.resize(most_right);
}

template <int Dim>
void Assembly<Dim>::add(int b, const Eigen::Ref<const MatrixXd>& local, SymmetricMatrix& K) {
  const Block& block = blocks_[b];
  K.add_at(block.positions, local);
  const int C = components_, n_own = int(block.positions.size());
  for (size_t s = 0; s < block.shared.size(); ++s) {
    const auto& [g, group_row] = places_[block.shared[s]];
    MatrixXd& E = groups_[g].E;
    const int row = C * (n_own + int(s));
    for (int c = 0; c < n_own; ++c)
      E.block(C * group_row, C * block.in_group[s][c], C, C) += local.block(row, C * c, C, C);
    for (size_t t = 0; t <= s; ++t)
      shared_.block(C * block.shared[s], C * block.shared[t], C, C) += local.block(row, C * (n_own + int(t)), C, C);
  }
}

// E of the group of `row` += H T' where T' is the other shared row; half of it for the row itself.
template <int Dim>
void Assembly<Dim>::add_transformed(int row, int other) {
  const int C = components_;
  const auto& [g, group_row] = places_[row];
  const Group& from = groups_[places_[other].group];
  Group& to = groups_[g];
  const auto H = shared_.block(C * row, C * other, C, C);
  for (size_t c = 0; c < from.positions.size(); ++c) {
    const double t = from.T(places_[other].row, c);
    if (t == 0) continue;
    auto E = to.E.block(C * group_row, C * index_of(to.positions, from.positions[c]), C, C);
    for (int j = 0; j < C; ++j)
      for (int i = 0; i < C; ++i) E(i, j) += other == row ? t / 2 * H(std::max(i, j), std::min(i, j)) : t * H(i, j);
  }
}

template <int Dim>
void Assembly<Dim>::finish(SymmetricMatrix& K) {
  for (int row = 0; row < int(places_.size()); ++row)
    for (const int other : met_[row]) add_transformed(row, other);
  shared_.setZero();
  for (int p = 0; p < int(plan_->panels.size()); ++p) add_shared_to_panel(p, K);
  for (auto& group : groups_) group.E.setZero();
}

// K += T^T E + E^T T in the columns of a panel, as (T; E)^T (E; T) with the rows of all groups below each other.
template <int Dim>
void Assembly<Dim>::add_shared_to_panel(int p, SymmetricMatrix& K) {
  const int C = components_;
  const auto& panel = plan_->panels[p];
  const int width = C * panel.width(), height = C * panel.height();
  int k = 0;
  for (const int g : touching_[p]) k += int(groups_[g].E.rows());
  if (k == 0) return;
  Eigen::Map<MatrixXd> left(left_.data(), 2 * k, height), right(right_.data(), 2 * k, width);
  left.setZero();
  int row = 0;
  for (const int g : touching_[p]) {
    const Group& group = groups_[g];
    const int n_rows = int(group.T.rows());
    const auto first = std::lower_bound(group.positions.begin(), group.positions.end(), panel.begin);
    for (auto at = first; at != group.positions.end(); ++at) {
      const int c = int(at - group.positions.begin()), column = C * panel.row_of(*at);
      for (int r = 0; r < n_rows; ++r)
        for (int a = 0; a < C; ++a) left(row + C * r + a, column + a) = group.T(r, c);
      left.block(k + row, column, C * n_rows, C) = group.E.middleCols(C * c, C);
    }
    row += C * n_rows;
  }
  right.topRows(k) = left.block(k, 0, k, width);
  right.bottomRows(k) = left.block(0, 0, k, width);
  auto target = K.panel(p);
  const DenseKernels& kernels = dense_kernels();
  kernels.add_lower_product(target.data(), height, left.data(), 2 * k, right.data(), 2 * k, width, 2 * k);
  if (height > width)
    kernels.add_product(target.data() + width, height, left.data() + long(2 * k) * width, 2 * k, right.data(), 2 * k,
                        height - width, width, 2 * k);
}

#define SEM_INSTANTIATE(Dim)                                              \
  template class Assembly<Dim>;                                           \
  template std::vector<std::vector<int>> couplings<Dim>(const Map<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
