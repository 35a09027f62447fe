#include "sem/mechanics/assembly.h"

#include <algorithm>
#include <set>

#include "sem/solve/dense_kernels.h"

namespace sem {

using Eigen::MatrixXd;

namespace {

constexpr int columns_at_once = 32;  // nodes

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
  long most_T = 0, most_product = 0;
  for (const auto& panel : plan_->panels) {
    auto& touching = touching_.emplace_back();
    long k = 0;
    for (int g = 0; g < int(groups_.size()); ++g) {
      const auto& positions = groups_[g].positions;
      const auto first = std::lower_bound(positions.begin(), positions.end(), panel.begin);
      if (first == positions.end() || *first >= panel.end) continue;
      touching.push_back(g);
      k += groups_[g].T.rows();
    }
    most_T = std::max(most_T, k * panel.height());
    most_product = std::max(most_product, long(panel.height()) * components * std::min(columns_at_once, panel.width()));
  }
  T_rows_.resize(most_T);
  E_rows_.resize(components * components * most_T);
  product_.resize(most_product);
}

template <int Dim>
void Assembly<Dim>::add(int b, const Eigen::Ref<const MatrixXd>& local, SymmetricMatrix& K) {
  const Block& block = blocks_[b];
  K.add_at(block.positions, local);
  const int C = components_, n_own = int(block.positions.size());
  for (size_t s = 0; s < block.shared.size(); ++s) {
    const auto& [g, group_row] = places_[block.shared[s]];
    MatrixXd& E = groups_[g].E;
    const int row = C * (n_own + int(s)), n_rows = int(groups_[g].T.rows());
    for (int c = 0; c < n_own; ++c)
      for (int j = 0; j < C; ++j)
        for (int a = 0; a < C; ++a) E(a * n_rows + group_row, C * block.in_group[s][c] + j) += local(row + a, C * c + j);
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
    const int column = C * index_of(to.positions, from.positions[c]), n_rows = int(to.T.rows());
    for (int j = 0; j < C; ++j)
      for (int i = 0; i < C; ++i)
        to.E(i * n_rows + group_row, column + j) += other == row ? t / 2 * H(std::max(i, j), std::min(i, j)) : t * H(i, j);
  }
}

template <int Dim>
Work Assembly<Dim>::finish_work() const {
  Work work;
  for (size_t p = 0; p < touching_.size(); ++p) {
    const double w = plan_->panels[p].width(), h = plan_->panels[p].height();
    double k = 0;
    for (const int g : touching_[p]) k += double(groups_[g].T.rows());
    work.flops += 4 * k * components_ * components_ * (w * (w + 1) / 2 + w * (h - w));
    work.bytes += sizeof(double) * k * h * (1 + components_ * components_);
  }
  return work;
}

template <int Dim>
void Assembly<Dim>::finish(SymmetricMatrix& K) {
  for (int row = 0; row < int(places_.size()); ++row)
    for (const int other : met_[row]) add_transformed(row, other);
  shared_.setZero();
  for (int p = 0; p < int(plan_->panels.size()); ++p) add_shared_to_panel(p, K);
  for (auto& group : groups_) group.E.setZero();
}

// K += T^T E + E^T T in the columns of a panel. T acts on every component alone, so for component a the rows
// C i + a of T^T E are T^T E_a, and the columns C j + a of E^T T are E_a^T T: each with the rows of all groups
// below each other, a few columns at a time so that little above the diagonal is computed.
template <int Dim>
void Assembly<Dim>::add_shared_to_panel(int p, SymmetricMatrix& K) {
  const int C = components_;
  const auto& panel = plan_->panels[p];
  int k = 0;
  for (const int g : touching_[p]) k += int(groups_[g].T.rows());
  if (k == 0) return;
  const int height = panel.height(), width = panel.width();
  Eigen::Map<MatrixXd> T(T_rows_.data(), k, height), E(E_rows_.data(), k, C * C * height);
  T.setZero();
  E.setZero();
  int row = 0;
  for (const int g : touching_[p]) {
    const Group& group = groups_[g];
    const int n_rows = int(group.T.rows());
    const auto first = std::lower_bound(group.positions.begin(), group.positions.end(), panel.begin);
    for (auto at = first; at != group.positions.end(); ++at) {
      const int c = int(at - group.positions.begin()), node = panel.row_of(*at);
      T.col(node).segment(row, n_rows) = group.T.col(c);
      for (int a = 0; a < C; ++a)
        E.block(row, C * (a * height + node), n_rows, C) = group.E.block(a * n_rows, C * c, n_rows, C);
    }
    row += n_rows;
  }
  const DenseKernels& kernels = dense_kernels();
  auto target = K.panel(p);
  const int ld = C * height;
  for (int first = 0; first < width; first += columns_at_once) {
    const int n = std::min(columns_at_once, width - first), below = height - first;
    for (int a = 0; a < C; ++a) {
      const double* E_a = E.col(C * (a * height + first)).data();
      kernels.add_product(&target(C * first, C * first + a), C * ld, E_a, k, T.col(first).data(), k, C * below, n, k);
      Eigen::Map<MatrixXd> rows(product_.data(), below, C * n);
      rows.setZero();
      kernels.add_product(rows.data(), below, T.col(first).data(), k, E_a, k, below, C * n, k);
      for (int j = 0; j < C * n; ++j) {
        double* column = &target(C * first, C * first + j);
        for (int i = 0; i < below; ++i) column[C * i + a] += rows(i, j);
      }
    }
  }
}

#define SEM_INSTANTIATE(Dim)                                              \
  template class Assembly<Dim>;                                           \
  template std::vector<std::vector<int>> couplings<Dim>(const Map<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
