#pragma once
// A symmetric matrix in the panels of an elimination plan.

#include <Eigen/Core>

#include "sem/solve/elimination.h"

namespace sem {

/// The lower triangle, panel by panel: rows and columns in the plan's order, components interleaved, panels
/// one after the other, each stored by columns; entries above the diagonal of a panel are zero and unused.
/// Indices of entries are those of z, not of the order.
class SymmetricMatrix {
 public:
  SymmetricMatrix() = default;
  /// Zero; n = components times the plan's nodes.
  SymmetricMatrix(std::shared_ptr<const Elimination> plan, int components);
  /// A dense matrix (its lower triangle read), one component.
  SymmetricMatrix(const Eigen::MatrixXd& dense);
  template <class Derived>
  SymmetricMatrix(const Eigen::MatrixBase<Derived>& dense) : SymmetricMatrix(Eigen::MatrixXd(dense)) {}

  int size() const { return plan_ ? components_ * plan_->n_nodes() : 0; }
  int components() const { return components_; }
  const std::shared_ptr<const Elimination>& plan() const { return plan_; }

  void set_zero() { values_.setZero(); }
  /// The entries that the plan has room for.
  void set(const Eigen::MatrixXd& dense);
  SymmetricMatrix& operator*=(double factor);
  /// = a A + b B in one pass; A of the same plan and components, B as in add.
  void set_sum(double a, const SymmetricMatrix& A, double b, const SymmetricMatrix& B);
  /// += factor * other, of the same plan or both dense; where that has one component, of its Kronecker product
  /// with the identity of this one's components.
  void add(double factor, const SymmetricMatrix& other);
  /// += a symmetric `local` (all of it) on nodes that meet: components * #nodes rows, components interleaved.
  void add(const std::vector<int>& nodes, const Eigen::MatrixXd& local);
  /// The same for positions instead of nodes, ascending; of `local` the lower triangle is read.
  void add_at(const std::vector<int>& positions, const Eigen::Ref<const Eigen::MatrixXd>& local);
  void add_to_diagonal(const Eigen::VectorXd& d);

  /// Entry (i, j); a reference only to what the plan has room for.
  double& operator()(int i, int j);
  double operator()(int i, int j) const;
  Eigen::VectorXd diagonal() const;
  Eigen::MatrixXd dense() const;
  /// Rows and columns of these entries.
  Eigen::MatrixXd dense(const std::vector<int>& entries) const;
  bool all_finite() const { return values_.allFinite(); }

  /// y = A x; x may have k times as many entries: of the Kronecker product with the identity of size k.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;
  /// y = |A| |x|, entry by entry; x as for multiply.
  void absolute_product(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  /// A panel: components times its height by components times its width.
  Eigen::Map<Eigen::MatrixXd> panel(int p);
  Eigen::Map<const Eigen::MatrixXd> panel(int p) const;

 private:
  const double* find(int i, int j) const;  // null: no room
  int position(int entry) const { return components_ * plan_->position[entry / components_] + entry % components_; }

  std::shared_ptr<const Elimination> plan_;
  int components_ = 1;
  Eigen::VectorXd values_;
};

SymmetricMatrix operator*(double factor, SymmetricMatrix A);

}  // namespace sem
