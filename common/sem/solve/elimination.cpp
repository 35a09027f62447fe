#include "sem/solve/elimination.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

namespace sem {
namespace {

// A set of groups.
class Bits {
 public:
  explicit Bits(int n = 0) : words_((n + 63) / 64) {}
  void set(int i) { words_[i / 64] |= bit(i); }
  void reset(int i) { words_[i / 64] &= ~bit(i); }
  void add(const Bits& other) {
    for (size_t w = 0; w < words_.size(); ++w) words_[w] |= other.words_[w];
  }
  std::vector<int> list() const {
    std::vector<int> members;
    for (size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t left = words_[w]; left; left &= left - 1) members.push_back(int(64 * w) + __builtin_ctzll(left));
    return members;
  }

 private:
  static std::uint64_t bit(int i) { return std::uint64_t(1) << (i % 64); }
  std::vector<std::uint64_t> words_;
};

// Nodes that are in the same cliques.
struct Groups {
  std::vector<std::vector<int>> nodes;  // held ones last
  int n_free = 0;
  std::vector<Bits> meets;  // other groups
  int size(int g) const { return int(nodes[g].size()); }
  int size(const std::vector<int>& groups) const {
    return std::accumulate(groups.begin(), groups.end(), 0, [&](int sum, int g) { return sum + size(g); });
  }
};

Groups group_nodes(int n_nodes, const std::vector<std::vector<int>>& cliques, const std::vector<int>& held) {
  std::vector<std::vector<int>> of_node(n_nodes);
  for (const int i : held) of_node[i].push_back(-1);
  for (int c = 0; c < int(cliques.size()); ++c)
    for (const int i : cliques[c]) of_node[i].push_back(c);
  const auto is_held = [&](int i) { return !of_node[i].empty() && of_node[i][0] == -1; };
  Groups groups;
  std::vector<int> group_of(n_nodes);
  for (const bool take_held : {false, true}) {
    std::map<std::vector<int>, int> known;
    for (int i = 0; i < n_nodes; ++i) {
      if (is_held(i) != take_held) continue;
      const auto [at, is_new] = known.try_emplace(of_node[i], int(groups.nodes.size()));
      // What meets nothing else stands alone.
      if (is_new || of_node[i].empty()) groups.nodes.emplace_back();
      group_of[i] = of_node[i].empty() ? int(groups.nodes.size()) - 1 : at->second;
      groups.nodes[group_of[i]].push_back(i);
    }
    if (!take_held) groups.n_free = int(groups.nodes.size());
  }
  const int n = int(groups.nodes.size());
  groups.meets.assign(n, Bits(n));
  for (const auto& clique : cliques) {
    Bits all(n);
    for (const int i : clique) all.set(group_of[i]);
    for (const int g : all.list()) groups.meets[g].add(all);
  }
  for (int g = 0; g < n; ++g) groups.meets[g].reset(g);
  return groups;
}

// Columns of the factor that become one panel: a node of the elimination tree.
struct Supernode {
  std::vector<int> groups;    // in the order of elimination
  std::vector<int> rows;      // groups eliminated later
  std::vector<int> children;  // in the tree
  int n = 0, n_rows = 0;      // in nodes
  long zeros = 0;             // that joining has stored
};

// Eliminates group by group, always one that meets the fewest nodes; fills `groups.meets` in.
std::vector<Supernode> minimum_degree(Groups& groups) {
  std::vector<Supernode> tree(groups.n_free);
  std::vector<int> degree(groups.n_free), order(groups.n_free, -1), sequence;
  for (int g = 0; g < groups.n_free; ++g) degree[g] = groups.size(groups.meets[g].list());
  for (int step = 0; step < groups.n_free; ++step) {
    int next = -1;
    for (int g = 0; g < groups.n_free; ++g)
      if (order[g] < 0 && (next < 0 || degree[g] < degree[next])) next = g;
    order[next] = step;
    sequence.push_back(next);
    Supernode& s = tree[next];
    s.groups = {next};
    s.rows = groups.meets[next].list();
    s.n = groups.size(next);
    s.n_rows = groups.size(s.rows);
    for (const int g : s.rows) {
      groups.meets[g].add(groups.meets[next]);
      groups.meets[g].reset(g);
      groups.meets[g].reset(next);
      if (g < groups.n_free) degree[g] = groups.size(groups.meets[g].list());
    }
  }
  for (const int g : sequence) {
    int parent = -1;
    for (const int row : tree[g].rows)
      if (row < groups.n_free && (parent < 0 || order[row] < order[parent])) parent = row;
    if (parent >= 0) tree[parent].children.push_back(g);
  }
  return tree;
}

// Zeros that joining a child to its parent would store: the child's columns get the parent's rows.
long added_zeros(const Supernode& child, const Supernode& parent) {
  return long(child.n) * (parent.n + parent.n_rows - child.n_rows);
}

// Joins children to a supernode, the cheapest first, while few of its entries are zeros or it is narrow.
void absorb_children(std::vector<Supernode>& tree, Supernode& s) {
  constexpr double few = 0.1;
  constexpr int narrow = 12;
  while (!s.children.empty()) {
    const auto cheapest = std::min_element(s.children.begin(), s.children.end(), [&](int a, int b) {
      return added_zeros(tree[a], s) < added_zeros(tree[b], s);
    });
    Supernode& child = tree[*cheapest];
    const double entries = double(child.n + s.n) * (child.n + s.n + s.n_rows);
    const long zeros = s.zeros + added_zeros(child, s);
    if (zeros > few * entries && child.n + s.n > narrow) return;
    s.zeros = zeros;
    std::vector<int> joined = child.groups;
    joined.insert(joined.end(), s.groups.begin(), s.groups.end());
    s.groups = std::move(joined);
    s.n += child.n;
    const std::vector<int> grandchildren = child.children;
    s.children.erase(cheapest);
    s.children.insert(s.children.end(), grandchildren.begin(), grandchildren.end());
  }
}

class Planner {
 public:
  Planner(int n_nodes, Groups groups, std::vector<Supernode> tree)
      : groups_(std::move(groups)), tree_(std::move(tree)), plan_(std::make_shared<Elimination>()) {
    plan_->position.assign(n_nodes, -1);
  }

  std::shared_ptr<const Elimination> plan() {
    std::vector<char> is_root(tree_.size(), 1);
    for (const auto& s : tree_)
      for (const int child : s.children) is_root[child] = 0;
    for (int s = 0; s < int(tree_.size()); ++s)
      if (is_root[s]) visit(s);
    plan_->n_free_panels = int(plan_->panels.size());
    std::vector<int> held;
    for (int g = groups_.n_free; g < int(groups_.nodes.size()); ++g) held.push_back(g);
    if (!held.empty()) add_panel(held, {});
    for (auto& panel : plan_->panels) {
      panel.offset = plan_->n_entries;
      plan_->n_entries += long(panel.height()) * panel.width();
    }
    for (size_t p = 0; p < plan_->panels.size(); ++p) set_rows(int(p));
    return plan_;
  }

 private:
  // Children first; their rows are then known to come later.
  void visit(int s) {
    absorb_children(tree_, tree_[s]);
    const Supernode supernode = tree_[s];
    for (const int child : supernode.children) visit(child);
    add_panel(supernode.groups, supernode.rows);
  }

  void add_panel(const std::vector<int>& own, const std::vector<int>& row_groups) {
    Elimination::Panel panel;
    panel.begin = plan_->n_nodes();
    for (const int g : own)
      for (const int i : groups_.nodes[g]) {
        plan_->position[i] = plan_->n_nodes();
        plan_->node.push_back(i);
        plan_->panel_of.push_back(int(plan_->panels.size()));
      }
    panel.end = plan_->n_nodes();
    panel.rows.resize(groups_.size(row_groups));  // their positions are not known yet
    row_groups_.push_back(row_groups);
    plan_->panels.push_back(std::move(panel));
  }

  void set_rows(int p) {
    auto& rows = plan_->panels[p].rows;
    rows.clear();
    for (const int g : row_groups_[p])
      for (const int i : groups_.nodes[g]) rows.push_back(plan_->position[i]);
    std::sort(rows.begin(), rows.end());
  }

  Groups groups_;
  std::vector<Supernode> tree_;
  std::vector<std::vector<int>> row_groups_;  // of every panel
  std::shared_ptr<Elimination> plan_;
};

}  // namespace

int Elimination::Panel::row_of(int at) const {
  if (at < end) return at - begin;
  return width() + int(std::lower_bound(rows.begin(), rows.end(), at) - rows.begin());
}

double Elimination::fill() const {
  const double n = n_nodes();
  double stored = 0;
  for (const auto& panel : panels) stored += panel.width() * (panel.width() + 1) / 2. + double(panel.width()) * panel.rows.size();
  return n > 0 ? stored / (n * (n + 1) / 2) : 1;
}

std::shared_ptr<const Elimination> plan_elimination(int n_nodes, const std::vector<std::vector<int>>& cliques,
                                                    const std::vector<int>& held) {
  Groups groups = group_nodes(n_nodes, cliques, held);
  std::vector<Supernode> tree = minimum_degree(groups);
  return Planner(n_nodes, std::move(groups), std::move(tree)).plan();
}

std::shared_ptr<const Elimination> dense_elimination(int n_nodes) {
  std::vector<int> all(n_nodes);
  std::iota(all.begin(), all.end(), 0);
  return plan_elimination(n_nodes, {all});
}

}  // namespace sem
