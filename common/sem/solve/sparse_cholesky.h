#pragma once
// Cholesky factorisation of a symmetric matrix in panels that tells a singular matrix from a regular one.

#include "sem/solve/symmetric_matrix.h"
#include "sem/solve/work.h"

namespace sem {

/// The factor of the rows and columns of A that are free, scaled as in cholesky.h. Panel by panel, to the right
/// (multifrontal without fronts): each is factorised and its product subtracted from the panels that its rows
/// belong to, by dense kernels (dense_kernels.h). Storage is taken once.
class SparseCholesky {
 public:
  SparseCholesky() = default;
  /// `free`: entries of z, ascending. Nodes of the plan's held panels must have no free entry.
  SparseCholesky(std::shared_ptr<const Elimination> plan, int components, const std::vector<int>& free);

  /// A has the plan given. False, and no factor, unless its free block is finite and positive definite with every
  /// squared pivot above 8 n eps, n free entries.
  bool compute(const SymmetricMatrix& A);
  /// b := A^-1 b on the free entries, 0 on the others; b has size n.
  void solve_in_place(Eigen::VectorXd& b) const;
  /// As Cholesky::condition_estimate.
  double condition_estimate() const;
  /// Of a factorisation, and of forward and back substitution; zeros of the panels included.
  const Work& factor_work() const { return factor_work_; }
  const Work& solve_work() const { return solve_work_; }

 private:
  bool set_scale(const SymmetricMatrix& A);
  void copy_scaled(const SymmetricMatrix& A);
  void update_ancestors(int p);
  int rows_below(int p) const { return components_ * n_rows_[p]; }

  std::shared_ptr<const Elimination> plan_;
  int components_ = 1, n_free_ = 0;
  std::vector<char> is_free_;          // by position
  std::vector<int> n_rows_;            // per panel: its rows that are not held, in nodes
  SymmetricMatrix factor_;
  Eigen::VectorXd scale_;              // by position; 1 / sqrt(A_ii), 0: not free
  mutable Eigen::VectorXd ordered_, rows_;  // workspaces, as large as needed
  Eigen::VectorXd row_scale_, product_;
  Work factor_work_, solve_work_;
  bool ok_ = false;
};

}  // namespace sem
