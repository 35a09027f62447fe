#include "sem/solve/sparse_cholesky.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sem/solve/cholesky.h"
#include "sem/solve/dense_kernels.h"

namespace sem {

using Eigen::VectorXd;

SparseCholesky::SparseCholesky(std::shared_ptr<const Elimination> plan, int components, const std::vector<int>& free)
    : plan_(std::move(plan)), components_(components), n_free_(int(free.size())), factor_(plan_, components) {
  const int C = components_, n = factor_.size();
  is_free_.assign(n, false);
  for (const int i : free) is_free_[C * plan_->position[i / C] + i % C] = true;
  scale_.resize(n);
  ordered_.resize(n);
  const int n_eliminated = plan_->n_free_panels > 0 ? plan_->panels[plan_->n_free_panels - 1].end : 0;
  long most_rows = 0, highest = 0;
  for (int p = 0; p < plan_->n_free_panels; ++p) {
    const auto& panel = plan_->panels[p];
    n_rows_.push_back(int(std::lower_bound(panel.rows.begin(), panel.rows.end(), n_eliminated) - panel.rows.begin()));
    const double w = C * panel.width(), b = rows_below(p);
    const double entries = w * (w + 1) / 2 + w * b, size = sizeof(double) * entries;
    factor_work_ += {w * w * w / 3 + w * w * b + w * b * (b + 1), 2 * size};
    solve_work_ += {4 * entries, 2 * size};
    most_rows = std::max(most_rows, long(b));
    highest = std::max(highest, long(w + b));
  }
  rows_.resize(most_rows);
  row_scale_.resize(highest);
}

bool SparseCholesky::set_scale(const SymmetricMatrix& A) {
  for (int p = 0; p < plan_->n_free_panels; ++p) {
    const auto values = A.panel(p);
    const int first = components_ * plan_->panels[p].begin;
    for (int j = 0; j < values.cols(); ++j) {
      scale_[first + j] = 0;
      if (!is_free_[first + j]) continue;
      if (!(values(j, j) > 0) || !std::isfinite(values(j, j))) return false;
      scale_[first + j] = 1 / std::sqrt(values(j, j));
    }
  }
  return true;
}

// Rows and columns that are not free become those of the identity.
void SparseCholesky::copy_scaled(const SymmetricMatrix& A) {
  const int C = components_;
  for (int p = 0; p < plan_->n_free_panels; ++p) {
    const auto& panel = plan_->panels[p];
    const auto source = A.panel(p);
    auto target = factor_.panel(p);
    const int first = C * panel.begin, width = C * panel.width(), height = width + rows_below(p);
    row_scale_.head(width) = scale_.segment(first, width);
    for (int r = 0; r < n_rows_[p]; ++r) row_scale_.segment(width + C * r, C) = scale_.segment(C * panel.rows[r], C);
    for (int j = 0; j < width; ++j) {
      const int n = height - j;
      target.col(j).segment(j, n) = scale_[first + j] * source.col(j).segment(j, n).cwiseProduct(row_scale_.segment(j, n));
      if (!is_free_[first + j]) target(j, j) = 1;
    }
  }
}

bool SparseCholesky::compute(const SymmetricMatrix& A) {
  ok_ = false;
  if (!set_scale(A)) return false;
  copy_scaled(A);
  const DenseKernels& kernels = dense_kernels();
  const double least = zero_level(n_free_);
  for (int p = 0; p < plan_->n_free_panels; ++p) {
    auto L = factor_.panel(p);
    const int width = int(L.cols()), ld = int(L.rows());
    if (!kernels.cholesky(L.data(), width, ld)) return false;
    for (int j = 0; j < width; ++j)  // written so that NaN fails
      if (!(L(j, j) * L(j, j) > least)) return false;
    if (rows_below(p) == 0) continue;
    kernels.solve_right(L.data(), ld, L.data() + width, ld, rows_below(p), width);
    update_ancestors(p);
  }
  return ok_ = true;
}

// Subtracts L_rows L_rows^T where the rows of panel p are columns.
void SparseCholesky::update_ancestors(int p) {
  const int C = components_;
  const auto& panel = plan_->panels[p];
  const auto L = factor_.panel(p);
  const int width = int(L.cols()), ld = int(L.rows()), n = n_rows_[p];
  for (int first = 0; first < n;) {
    const int q = plan_->panel_of[panel.rows[first]];
    const auto& target = plan_->panels[q];
    int last = first;
    while (last < n && panel.rows[last] < target.end) ++last;
    const int m = C * (n - first), k = C * (last - first);
    const double* below = L.data() + width + C * first;
    auto values = factor_.panel(q);
    const int to = target.row_of(panel.rows[first]);
    if (target.row_of(panel.rows[n - 1]) - to == n - 1 - first) {  // all next to each other there
      dense_kernels().add_scaled_product(-1, &values(C * to, C * to), int(values.rows()), below, ld, below, ld, m, k, width);
    } else {
      if (product_.size() < long(m) * k) product_.resize(long(m) * k);
      Eigen::Map<Eigen::MatrixXd> product(product_.data(), m, k);
      product.setZero();
      dense_kernels().add_scaled_product(-1, product.data(), m, below, ld, below, ld, m, k, width);
      for (int i = first; i < n; ++i) {
        const int row = C * target.row_of(panel.rows[i]);
        for (int j = first; j < last; ++j)
          values.block(row, C * (panel.rows[j] - target.begin), C, C) += product.block(C * (i - first), C * (j - first), C, C);
      }
    }
    first = last;
  }
}

void SparseCholesky::solve_in_place(VectorXd& b) const {
  const int C = components_;
  ordered_.setZero();
  for (int i = 0; i < plan_->n_nodes(); ++i)
    for (int a = 0; a < C; ++a) {
      const int at = C * plan_->position[i] + a;
      if (is_free_[at]) ordered_[at] = scale_[at] * b[C * i + a];
    }
  for (int p = 0; p < plan_->n_free_panels; ++p) {
    const auto& panel = plan_->panels[p];
    const auto L = factor_.panel(p);
    const int width = int(L.cols()), below = rows_below(p);
    auto own = ordered_.segment(C * panel.begin, width);
    L.topRows(width).triangularView<Eigen::Lower>().solveInPlace(own);
    if (below == 0) continue;
    auto rows = rows_.head(below);
    rows.noalias() = L.middleRows(width, below) * own;
    for (int r = 0; r < n_rows_[p]; ++r) ordered_.segment(C * panel.rows[r], C) -= rows.segment(C * r, C);
  }
  for (int p = plan_->n_free_panels - 1; p >= 0; --p) {
    const auto& panel = plan_->panels[p];
    const auto L = factor_.panel(p);
    const int width = int(L.cols()), below = rows_below(p);
    auto own = ordered_.segment(C * panel.begin, width);
    if (below > 0) {
      auto rows = rows_.head(below);
      for (int r = 0; r < n_rows_[p]; ++r) rows.segment(C * r, C) = ordered_.segment(C * panel.rows[r], C);
      own.noalias() -= L.middleRows(width, below).transpose() * rows;
    }
    L.topRows(width).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  for (int i = 0; i < plan_->n_nodes(); ++i)
    for (int a = 0; a < C; ++a) {
      const int at = C * plan_->position[i] + a;
      b[C * i + a] = is_free_[at] ? scale_[at] * ordered_[at] : 0;
    }
}

double SparseCholesky::condition_estimate() const {
  if (!ok_) return std::numeric_limits<double>::infinity();
  double largest = 0, smallest = std::numeric_limits<double>::infinity();
  for (int p = 0; p < plan_->n_free_panels; ++p) {
    const auto L = factor_.panel(p);
    for (int j = 0; j < L.cols(); ++j) {
      if (!is_free_[components_ * plan_->panels[p].begin + j]) continue;
      largest = std::max(largest, L(j, j));
      smallest = std::min(smallest, L(j, j));
    }
  }
  return largest > 0 ? largest * largest / (smallest * smallest) : 1;
}

}  // namespace sem
