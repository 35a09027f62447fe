#include "sem/solve/symmetric_matrix.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "sem/solve/dense_kernels.h"

namespace sem {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Of this thread, kept: a step allocates nothing.
double* workspace(long n) {
  static thread_local std::vector<double> room;
  if (long(room.size()) < n) room.resize(n);
  return room.data();
}

}  // namespace

SymmetricMatrix::SymmetricMatrix(std::shared_ptr<const Elimination> plan, int components)
    : plan_(std::move(plan)), components_(components) {
  values_.setZero(plan_->n_entries * components * components);
  workspace(4 * size());
}

SymmetricMatrix::SymmetricMatrix(const MatrixXd& dense) : SymmetricMatrix(dense_elimination(int(dense.rows())), 1) {
  set(dense);
}

Eigen::Map<MatrixXd> SymmetricMatrix::panel(int p) {
  const auto& panel = plan_->panels[p];
  return {values_.data() + panel.offset * components_ * components_, components_ * panel.height(), components_ * panel.width()};
}

Eigen::Map<const MatrixXd> SymmetricMatrix::panel(int p) const {
  const auto& panel = plan_->panels[p];
  return {values_.data() + panel.offset * components_ * components_, components_ * panel.height(), components_ * panel.width()};
}

const double* SymmetricMatrix::find(int i, int j) const {
  const int a = std::max(position(i), position(j)), b = std::min(position(i), position(j));
  const int p = plan_->panel_of[b / components_], at = a / components_;
  const auto& panel = plan_->panels[p];
  const int row = panel.row_of(at);
  if (row == panel.height() || (at >= panel.end && panel.rows[row - panel.width()] != at)) return nullptr;
  return this->panel(p).data() + long(components_) * panel.height() * (b - components_ * panel.begin) + components_ * row + a % components_;
}

double& SymmetricMatrix::operator()(int i, int j) {
  const double* entry = find(i, j);
  assert(entry);
  return const_cast<double&>(*entry);
}

double SymmetricMatrix::operator()(int i, int j) const {
  const double* entry = find(i, j);
  return entry ? *entry : 0;
}

void SymmetricMatrix::set(const MatrixXd& dense) {
  assert(dense.rows() == size());
  for (int p = 0; p < int(plan_->panels.size()); ++p) {
    const auto& panel = plan_->panels[p];
    auto target = this->panel(p);
    const auto entry = [&](int position) { return components_ * plan_->node[position / components_] + position % components_; };
    for (int j = 0; j < target.cols(); ++j)
      for (int i = j; i < target.rows(); ++i) {
        const int row = i / components_;
        const int at = row < panel.width() ? panel.begin + row : panel.rows[row - panel.width()];
        target(i, j) = dense(entry(components_ * at + i % components_), entry(components_ * panel.begin + j));
      }
  }
}

SymmetricMatrix& SymmetricMatrix::operator*=(double factor) {
  values_ *= factor;
  return *this;
}

void SymmetricMatrix::set_sum(double a, const SymmetricMatrix& A, double b, const SymmetricMatrix& B) {
  assert(A.size() == size() && A.components_ == components_);
  assert(B.plan_ == plan_ || (plan_->panels.size() <= 1 && B.plan_->panels.size() <= 1));
  if (B.values_.size() == values_.size()) {
    values_ = a * A.values_ + b * B.values_;
    return;
  }
  const int C = components_;
  for (int p = 0; p < int(plan_->panels.size()); ++p) {
    const auto first = A.panel(p), second = B.panel(p);
    auto target = panel(p);
    for (int j = 0; j < second.cols(); ++j)
      for (int c = 0; c < C; ++c) {
        auto column = target.col(C * j + c);
        column = a * first.col(C * j + c);
        for (int i = j; i < second.rows(); ++i) column[C * i + c] += b * second(i, j);
      }
  }
}

void SymmetricMatrix::add(double factor, const SymmetricMatrix& other) {
  assert(other.plan_ == plan_ || (plan_->panels.size() <= 1 && other.plan_->panels.size() <= 1));
  if (other.values_.size() == values_.size()) {
    values_ += factor * other.values_;
    return;
  }
  for (int p = 0; p < int(plan_->panels.size()); ++p) {
    const auto source = other.panel(p);
    auto target = panel(p);
    for (int j = 0; j < source.cols(); ++j)
      for (int i = j; i < source.rows(); ++i)
        for (int a = 0; a < components_; ++a) target(components_ * i + a, components_ * j + a) += factor * source(i, j);
  }
}

void SymmetricMatrix::add(const std::vector<int>& nodes, const MatrixXd& local) {
  const int n = int(nodes.size());
  std::vector<int> order(n), positions(n), entries(components_ * n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return plan_->position[nodes[a]] < plan_->position[nodes[b]]; });
  for (int i = 0; i < n; ++i) {
    positions[i] = plan_->position[nodes[order[i]]];
    for (int a = 0; a < components_; ++a) entries[components_ * i + a] = components_ * order[i] + a;
  }
  add_at(positions, local(entries, entries));
}

void SymmetricMatrix::add_at(const std::vector<int>& positions, const Eigen::Ref<const MatrixXd>& local) {
  struct Run {
    int from, to, length;  // local rows that stand next to each other in the panel, in nodes
  };
  static thread_local std::vector<Run> runs;
  const int n = int(positions.size()), C = components_;
  for (int first = 0; first < n;) {
    const int p = plan_->panel_of[positions[first]];
    const auto& panel = plan_->panels[p];
    runs.clear();
    for (int i = first; i < n; ++i) {
      const int row = panel.row_of(positions[i]);
      assert(row < panel.height());
      if (!runs.empty() && runs.back().to + runs.back().length == row) ++runs.back().length;
      else runs.push_back({i, row, 1});
    }
    auto target = this->panel(p);
    size_t run = 0;  // that of the column's node
    int j = first;
    for (; j < n && positions[j] < panel.end; ++j) {
      while (runs[run].from + runs[run].length <= j) ++run;
      for (int c = 0; c < C; ++c) {
        auto column = target.col(C * (positions[j] - panel.begin) + c);
        const auto source = local.col(C * j + c);
        const auto add = [&](int from, int to, int size) { column.segment(to, size) += source.segment(from, size); };
        const int skipped = C * (j - runs[run].from) + c;  // of its run: above the diagonal
        add(C * runs[run].from + skipped, C * runs[run].to + skipped, C * runs[run].length - skipped);
        for (size_t r = run + 1; r < runs.size(); ++r) add(C * runs[r].from, C * runs[r].to, C * runs[r].length);
      }
    }
    first = j;
  }
}

void SymmetricMatrix::add_to_diagonal(const VectorXd& d) {
  for (int i = 0; i < size(); ++i) (*this)(i, i) += d[i];
}

VectorXd SymmetricMatrix::diagonal() const {
  VectorXd d(size());
  for (int i = 0; i < size(); ++i) d[i] = (*this)(i, i);
  return d;
}

MatrixXd SymmetricMatrix::dense(const std::vector<int>& entries) const {
  MatrixXd A(entries.size(), entries.size());
  for (size_t j = 0; j < entries.size(); ++j)
    for (size_t i = j; i < entries.size(); ++i) A(i, j) = A(j, i) = (*this)(entries[i], entries[j]);
  return A;
}

MatrixXd SymmetricMatrix::dense() const {
  std::vector<int> all(size());
  std::iota(all.begin(), all.end(), 0);
  return dense(all);
}

void SymmetricMatrix::multiply(const VectorXd& x, VectorXd& y) const {
  const int n = size(), C = components_, k = n > 0 ? int(x.size()) / n : 1;
  assert(x.size() == long(k) * n);
  // Entry (node, component of the matrix, copy of the matrix) -> row and column of these, in the plan's order.
  double* room = workspace(4 * x.size());
  Eigen::Map<MatrixXd> in(room, n, k), out(room + x.size(), n, k), rows(room + 2 * x.size(), n, k),
      row_sums(room + 3 * x.size(), n, k);
  out.setZero();
  for (int i = 0; i < plan_->n_nodes(); ++i)
    for (int a = 0; a < C; ++a)
      for (int b = 0; b < k; ++b) in(C * plan_->position[i] + a, b) = x[(C * i + a) * k + b];
  for (int p = 0; p < int(plan_->panels.size()); ++p) {
    const auto& panel = plan_->panels[p];
    const auto A = this->panel(p);
    const int first = C * panel.begin, width = C * panel.width(), below = C * int(panel.rows.size());
    for (size_t r = 0; r < panel.rows.size(); ++r) rows.middleRows(C * r, C) = in.middleRows(C * panel.rows[r], C);
    for (int b = 0; b < k; ++b)
      dense_kernels().multiply_panel(A.data(), int(A.rows()), width, below, &in(first, b), rows.col(b).data(), &out(first, b),
                                     row_sums.col(b).data());
    for (size_t r = 0; r < panel.rows.size(); ++r) out.middleRows(C * panel.rows[r], C) += row_sums.middleRows(C * r, C);
  }
  y.resize(x.size());
  for (int i = 0; i < plan_->n_nodes(); ++i)
    for (int a = 0; a < C; ++a)
      for (int b = 0; b < k; ++b) y[(C * i + a) * k + b] = out(C * plan_->position[i] + a, b);
}

VectorXd SymmetricMatrix::operator*(const VectorXd& x) const {
  VectorXd y;
  multiply(x, y);
  return y;
}

SymmetricMatrix operator*(double factor, SymmetricMatrix A) {
  A *= factor;
  return A;
}

void SymmetricMatrix::absolute_product(const VectorXd& x, VectorXd& y) const {
  const int n = size(), C = components_, k = n > 0 ? int(x.size()) / n : 1;
  assert(x.size() == long(k) * n);
  y.setZero(x.size());
  const auto entry = [&](int position, int a) { return C * plan_->node[position] + a; };
  for (int p = 0; p < int(plan_->panels.size()); ++p) {
    const auto& panel = plan_->panels[p];
    const auto A = this->panel(p);
    for (int j = 0; j < A.cols(); ++j) {
      const int column = entry(panel.begin + j / C, j % C);
      for (int i = j; i < A.rows(); ++i) {
        const int row = entry(i / C < panel.width() ? panel.begin + i / C : panel.rows[i / C - panel.width()], i % C);
        for (int b = 0; b < k; ++b) {
          y[k * row + b] += std::abs(A(i, j) * x[k * column + b]);
          if (i != j) y[k * column + b] += std::abs(A(i, j) * x[k * row + b]);
        }
      }
    }
  }
}

}  // namespace sem
