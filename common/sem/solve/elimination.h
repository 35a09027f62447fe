#pragma once
// Which unknowns meet in a symmetric matrix, and the order in which its Cholesky factorisation takes them.

#include <memory>
#include <vector>

namespace sem {

/// A plan for the matrices and factors of one system. The unknowns come in nodes, as many entries each as a
/// vector has components: z = (z_0x, z_0y, z_1x, ...). Nodes are put in an order that keeps the factor sparse;
/// neighbours in that order whose columns of the factor have nearly the same rows form a panel (a supernode),
/// dense from its diagonal down.
struct Elimination {
  struct Panel {
    int begin = 0, end = 0;  ///< positions of its nodes
    std::vector<int> rows;   ///< positions of its further rows, >= end, ascending
    long offset = 0;         ///< entries stored before it, for one component

    int width() const { return end - begin; }
    int height() const { return width() + int(rows.size()); }
    /// Row of the panel at which a position >= begin stands; it must be one of its rows.
    int row_of(int position) const;
  };
  std::vector<int> position, node;  ///< of a node in the order, and back
  std::vector<Panel> panels;
  std::vector<int> panel_of;  ///< position -> panel
  int n_free_panels = 0;      ///< those from here on hold the nodes that never are eliminated
  long n_entries = 0;         ///< stored, for one component

  int n_nodes() const { return int(node.size()); }
  /// Share of the n (n + 1) / 2 entries of the lower triangle that are stored, zeros of the panels included.
  double fill() const;
};

/// `cliques`: lists of nodes that meet pairwise, each list ascending. `held`: nodes that no factorisation takes,
/// ascending. The order is by minimum degree (Rose 1972) on groups of nodes that are in the same cliques, ties to
/// the group of the lowest node; a panel is joined to the one above it where that adds few zeros.
std::shared_ptr<const Elimination> plan_elimination(int n_nodes, const std::vector<std::vector<int>>& cliques,
                                                    const std::vector<int>& held = {});

/// Every node meets every other: one panel, in the given order.
std::shared_ptr<const Elimination> dense_elimination(int n_nodes);

}  // namespace sem
