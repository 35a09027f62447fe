#include "sem/method/nnls.h"

#include "sem/method/least_squares.h"

#include <algorithm>
#include <vector>

namespace sem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Moves x towards the least-squares solution over the columns in use; those that reach 0 on the way
// leave.
void settle_columns(const MatrixXd& A, const VectorXd& b, std::vector<int>& used, VectorXd& x) {
  while (!used.empty()) {
    const VectorXd target = least_squares(A(Eigen::all, used), b);
    double step = 1;
    for (size_t k = 0; k < used.size(); ++k)
      if (target[k] <= 0) step = std::min(step, x[used[k]] / (x[used[k]] - target[k]));
    for (size_t k = 0; k < used.size(); ++k) x[used[k]] += step * (target[k] - x[used[k]]);
    if (step == 1) return;
    size_t kept = 0;
    for (size_t k = 0; k < used.size(); ++k) {
      const bool leaves = target[k] <= 0 && x[used[k]] <= 1e-14 * std::abs(target[k]);
      if (leaves)
        x[used[k]] = 0;
      else
        used[kept++] = used[k];
    }
    if (kept == used.size()) return;  // rounding: nothing left that could leave
    used.resize(kept);
  }
}

}  // namespace

NonNegative solve_non_negative(const MatrixXd& A, const VectorXd& b, double tolerance) {
  const int n = int(A.cols());
  NonNegative result;
  result.x = VectorXd::Zero(n);
  const VectorXd norm = A.colwise().norm();
  std::vector<int> used;
  std::vector<char> barred(n, 0);  // entered and left at once: not again until x has changed
  VectorXd residual = b;
  for (int step = 0; step < 5 * n; ++step) {
    const VectorXd gain = (A.transpose() * residual).cwiseQuotient(norm);
    int best = -1;
    for (int j = 0; j < n; ++j)
      if (!barred[j] && std::find(used.begin(), used.end(), j) == used.end() &&
          (best < 0 || gain[j] > gain[best]))
        best = j;
    result.converged = best < 0 || gain[best] <= tolerance * b.norm();
    if (result.converged) break;
    used.push_back(best);
    settle_columns(A, b, used, result.x);
    const VectorXd next = b - A * result.x;
    if (next.norm() < residual.norm()) {
      std::fill(barred.begin(), barred.end(), 0);
      residual = next;
    } else {
      barred[best] = 1;
    }
  }
  result.residual = residual.norm();
  return result;
}

}  // namespace sem
