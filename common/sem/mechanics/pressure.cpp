#include "sem/mechanics/pressure.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "sem/solve/dense_kernels.h"

namespace sem {

using Eigen::MatrixXd;
using Eigen::VectorXd;

template <int Dim>
Pressure<Dim>::Pressure(PressureFunctions<Dim> functions, const VectorXd& weight)
    : functions_(std::move(functions)), weight_(weight) {
  const int n = functions_.interior.n_columns;
  MatrixXd M = MatrixXd::Zero(n, n);
  for (const auto& block : functions_.interior.blocks) {
    VectorXd v = VectorXd::Zero(block.points.size());
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int point = block.points[k];
      if (functions_.lambda[point] > 0) v[k] = weight_[point] / functions_.lambda[point];
    }
    const MatrixXd scaled = v.asDiagonal() * block.value;
    const MatrixXd product = block.value.transpose() * scaled;
    for (size_t j = 0; j < block.columns.size(); ++j)
      for (size_t i = 0; i < block.columns.size(); ++i) M(block.columns[i], block.columns[j]) += product(i, j);
  }
  if (!factor_.compute(M)) throw std::invalid_argument("Pressure: the functions are dependent on the points");
  interior_ = VectorXd::Zero(functions_.interior.n_points);
  on_clamps_ = VectorXd::Constant(functions_.on_clamps.rows(), std::numeric_limits<double>::quiet_NaN());
}

template <int Dim>
void Pressure<Dim>::solve(const VectorXd& g, const VectorXd& clamp_work) {
  b_ = VectorXd::Zero(functions_.interior.n_columns);
  for (const auto& block : functions_.interior.blocks) {
    VectorXd work(block.points.size());
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int point = block.points[k];
      work[k] = functions_.lambda[point] > 0 ? weight_[point] * g[point] : 0;
    }
    const VectorXd sums = block.value.transpose() * work;
    for (size_t j = 0; j < block.columns.size(); ++j) b_[block.columns[j]] += sums[j];
  }
  for (int s = 0; s < clamp_work.size(); ++s)
    if (functions_.clamp_mixed[s]) b_ += clamp_work[s] * functions_.on_clamps.row(s).transpose();
  y_ = b_;
  factor_.solve_in_place(y_);
  for (const auto& block : functions_.interior.blocks) {
    const VectorXd p = block.value * y_(block.columns).eval();
    for (size_t k = 0; k < block.points.size(); ++k) interior_[block.points[k]] = p[k];
  }
  for (int s = 0; s < on_clamps_.size(); ++s)
    if (functions_.clamp_mixed[s]) on_clamps_[s] = functions_.on_clamps.row(s).dot(y_);
}

template <int Dim>
void Pressure<Dim>::add_to_hessian(const MatrixXd& G, SymmetricMatrix& H) const {
  // Columns in the order of elimination, so that the lower triangle of the product is that of H.
  const auto& position = H.plan()->position;
  const int n = int(G.cols());
  MatrixXd ordered(G.rows(), n);
  for (size_t node = 0; node < position.size(); ++node)
    ordered.middleCols<Dim>(Dim * position[node]) = G.middleCols<Dim>(Dim * Eigen::Index(node));
  factor_.solve_factor_in_place(ordered);
  MatrixXd product = MatrixXd::Zero(n, n);
  const int rows = int(ordered.rows());
  dense_kernels().add_lower_product(product.data(), n, ordered.data(), rows, ordered.data(), rows, n, rows);
  std::vector<int> positions(position.size());
  std::iota(positions.begin(), positions.end(), 0);
  H.add_at(positions, product);
}

template class Pressure<2>;
template class Pressure<3>;

}  // namespace sem
