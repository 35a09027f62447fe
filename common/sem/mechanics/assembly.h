#pragma once
// From symmetric matrices on the coefficients of a map's blocks to one on the unknowns.

#include <memory>

#include "sem/method/map.h"
#include "sem/solve/symmetric_matrix.h"
#include "sem/solve/work.h"

namespace sem {

/// Unknowns that meet in the energy of a map, for plan_elimination.
template <int Dim>
std::vector<std::vector<int>> couplings(const Map<Dim>& map);

/// K += Pi^T H Pi with y = Pi z = (z, T z), H the sum of the blocks' matrices. What H has on the unknowns themselves
/// goes straight to its place. The rest is gathered for each group o of shared rows,
///   E_o = H_oz + sum_o' H_oo' T_o' (half of it for o' = o), and added at the end, K += sum_o T_o^T E_o + E_o^T T_o:
/// for each panel and component two products with the rows of all the groups that touch its columns.
template <int Dim>
class Assembly {
 public:
  /// `components` entries per node in K: Dim, or 1 for a matrix that acts on every component. The plan has the
  /// map's couplings. Does not keep the map.
  Assembly(const Map<Dim>& map, std::shared_ptr<const Elimination> plan, int components);

  const std::shared_ptr<const Elimination>& plan() const { return plan_; }
  /// Columns of a block (indices into block.columns) in the order that `add` wants.
  const std::vector<int>& order(int block) const { return blocks_[block].order; }
  /// Adds the lower triangle of `local`: #columns of the block in that order, components interleaved.
  void add(int block, const Eigen::Ref<const Eigen::MatrixXd>& local, SymmetricMatrix& K);
  /// Of `finish`, zeros of the panels included.
  Work finish_work() const;
  /// Adds what was gathered, and forgets it.
  void finish(SymmetricMatrix& K);

 private:
  struct Block {
    std::vector<int> order;
    std::vector<int> positions;               // of the unknowns among its columns, ascending
    std::vector<int> shared;                  // then its shared rows
    std::vector<std::vector<int>> in_group;   // for each of these: where its group has the unknowns
  };
  struct Group {
    int first_row = 0;           // among all shared rows
    std::vector<int> positions;  // touched unknowns, ascending
    Eigen::MatrixXd T;           // #rows by #touched
    Eigen::MatrixXd E;           // rows of component 0, then of 1, ..; columns: touched unknowns, components interleaved
  };
  struct SharedPlace {
    int group, row;
  };

  void add_transformed(int row, int other);
  void add_shared_to_panel(int p, SymmetricMatrix& K);

  int components_;
  std::shared_ptr<const Elimination> plan_;
  std::vector<Block> blocks_;
  std::vector<Group> groups_;
  std::vector<SharedPlace> places_;  // of every shared row
  Eigen::MatrixXd shared_;           // H on the shared rows, lower triangle
  std::vector<std::vector<int>> met_;       // per shared row: earlier ones that it meets
  std::vector<std::vector<int>> touching_;  // per panel: groups
  Eigen::VectorXd T_rows_, E_rows_, product_;  // room for the largest panel
};

}  // namespace sem
