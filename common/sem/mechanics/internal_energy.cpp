#include "sem/mechanics/internal_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sem/solve/dense_kernels.h"

namespace sem {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Columns multiplied at once fill less than this, which the product copies.
constexpr int product_columns_bytes = 64 << 10;

// F at point k of n: row b n + k holds its column b.
template <int Dim>
Mat<Dim> F_at(const Eigen::Matrix<double, Eigen::Dynamic, Dim>& rows, int k) {
  const int n = int(rows.rows()) / Dim;
  Mat<Dim> F;
  for (int b = 0; b < Dim; ++b) F.col(b) = rows.row(b * n + k).transpose();
  return F;
}

}  // namespace

template <int Dim>
InternalEnergy<Dim>::InternalEnergy(const Map<Dim>& map, const VectorXd& weight,
                                    const MaterialField& materials, const SymmetricMatrix& stability,
                                    Clamps<Dim> clamps, Pressure<Dim> pressure,
                                    std::shared_ptr<const Elimination> plan, Unresisted unresisted)
    : map_(joined(map, blocks_to_join(map))),
      weight_(weight),
      materials_(materials),
      stability_(stability),
      unresisted_(std::move(unresisted)),
      assembly_(map_, plan ? plan : stability.plan() ? stability.plan() : dense_elimination(map.n_columns), Dim),
      clamps_(std::move(clamps)),
      pressure_(std::move(pressure)),
      work_(map_.blocks.size()),
      stability_z_(Dim * map.n_columns),
      stability_force_(Dim * map.n_columns) {
  if (unresisted_.one.size() == 0) unresisted_.one.setOnes(map.n_columns);
  if (unresisted_.rest.size() == 0) unresisted_.rest.setZero(size());
  quadratic_ = std::all_of(materials_.of_point.begin(), materials_.of_point.end(), [&](int m) {
    return is_quadratic(materials_.materials[m].model);
  });
  work_of_ = count_work(map);
  if (!pressure_.empty()) pressure_.join(blocks_to_join(map));
  long most_scaled = 0, most_columns = 0;
  for (size_t b = 0; b < work_.size(); ++b) {
    auto& block = map_.blocks[b];
    Workspace& work = work_[b];
    const int n = int(block.points.size()), n_columns = int(block.columns.size());
    most_scaled = std::max(most_scaled, long(Dim) * n * n_columns);
    most_columns = std::max(most_columns, long(n_columns));
    for (const int c : assembly_.order(int(b))) work.columns.push_back(block.columns[c]);
    work.nodes.resize(Dim, n_columns);
    work.F.resize(Dim * n, Dim);
    work.gradient.resize(Dim * n, n_columns);
    for (int axis = 0; axis < Dim; ++axis) {
      work.gradient.middleRows(axis * n, n) = block.gradient[axis](Eigen::all, assembly_.order(int(b)));
      block.gradient[axis] = {};
    }
    block.value = {};
    for (auto& entry : work.tangent) entry.resize(n);
  }
  scaled_.resize(most_scaled * Dim * (Dim + 1) / 2);
  product_.resize(most_columns * most_columns * Dim * (Dim + 1) / 2);
  local_.resize(Dim * Dim * most_columns * most_columns);
}

template <int Dim>
PotentialWork InternalEnergy<Dim>::count_work(const Map<Dim>& map) const {
  PotentialWork work;
  Work F, local;  // F at all points; the blocks' matrices
  for (const auto& block : map.blocks) {
    const double n = double(block.points.size()), N = double(block.columns.size());
    F += {2 * Dim * Dim * n * N, sizeof(double) * Dim * n * N};
    const double pairs = Dim * (Dim + 1) / 2, entries = Dim * N * (Dim * N + 1) / 2;
    local += {2 * pairs * Dim * Dim * n * N + 2 * entries * Dim * n + entries, sizeof(double) * Dim * n * N};
  }
  for (const auto& shared : map.shared)
    F += {2 * Dim * double(shared.rows.size()), sizeof(double) * double(shared.rows.size())};
  const double n = size(), m = pressure_.functions().interior.n_columns;
  const double entries = double(assembly_.plan()->n_entries), K = sizeof(double) * Dim * Dim * entries;
  if (stability_.size() > 0) F += {4 * Dim * entries, sizeof(double) * entries};
  work.energy = F;
  work.gradient = {2 * F.flops, F.bytes};
  work.hessian = {F.flops + m * m * n + m * n * n, F.bytes + K + sizeof(double) * m * n};
  work.hessian += local;
  work.hessian += assembly_.finish_work();
  return work;
}

template <int Dim>
void InternalEnergy<Dim>::deformation_gradients(int b) {
  Workspace& work = work_[b];
  for (size_t j = 0; j < work.columns.size(); ++j) work.nodes.col(j) = y_.col(work.columns[j]);
  const int n = int(work.gradient.rows()), N = int(work.gradient.cols());
  work.F.setZero();
  dense_kernels().add_scaled_product(1, work.F.data(), n, work.gradient.data(), n, work.nodes.data(), Dim, n, Dim, N);
}

template <int Dim>
bool InternalEnergy<Dim>::update_pressure(const VectorXd& z) {
  if (pressure_.empty()) return true;
  VectorXd g = VectorXd::Zero(map_.n_points);
  set_coefficients(map_, z, y_);
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& block = map_.blocks[i];
    deformation_gradients(int(i));
    for (size_t k = 0; k < block.points.size(); ++k) {
      const Mat<Dim> F = F_at<Dim>(work_[i].F, int(k));
      if (!std::isfinite(energy_density<Dim>(material(block.points[k]), F))) return false;
      g[block.points[k]] = volume_measure<Dim>(material(block.points[k]).model, F).value;
    }
  }
  pressure_.solve(g, clamps_.volume_work(z));
  return true;
}

template <int Dim>
VectorXd InternalEnergy<Dim>::pressure_coefficients(const VectorXd& z) {
  if (pressure_.empty()) return {};
  if (!update_pressure(z))
    return VectorXd::Constant(pressure_.functions().interior.n_columns, std::numeric_limits<double>::quiet_NaN());
  return pressure_.coefficients();
}

template <int Dim>
double InternalEnergy<Dim>::elastic_energy(const VectorXd& z) {
  if (!update_pressure(z)) return std::numeric_limits<double>::infinity();
  return mixed_energy(z);
}

template <int Dim>
double InternalEnergy<Dim>::mixed_energy(const VectorXd& z) {
  double sum = pressure_.empty() ? 0 : -pressure_.half_work();
  set_coefficients(map_, z, y_);
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& block = map_.blocks[i];
    deformation_gradients(int(i));
    for (size_t k = 0; k < block.points.size(); ++k)
      sum += weight_[block.points[k]] *
             energy_density<Dim>(material(block.points[k]), F_at<Dim>(work_[i].F, int(k)),
                                  pressure(block.points[k]));
  }
  return sum;
}

// gamma S z, of the displacement and about that of the first node: a body far from zero, and a thin one whose weight is
// no more than the rounding of S times its size, lose no digits.
template <int Dim>
void InternalEnergy<Dim>::set_stability_force(const VectorXd& z) {
  Eigen::Map<Points<Dim>> nodes(stability_z_.data(), Dim, map_.n_columns);
  stability_z_ = z - unresisted_.rest;
  const Vec<Dim> first = nodes.col(0);
  for (int j = 0; j < nodes.cols(); ++j) nodes.col(j) -= unresisted_.one[j] * first;
  stability_.multiply(stability_z_, stability_force_);
}

template <int Dim>
double InternalEnergy<Dim>::stability_energy(const VectorXd& z) {
  if (stability_.size() == 0) return 0;
  set_stability_force(z);
  return stability_force_.dot(stability_z_) / 2;
}

template <int Dim>
double InternalEnergy<Dim>::energy(const VectorXd& z) {
  const double body = elastic_energy(z) + stability_energy(z);
  return clamps_.empty() || !std::isfinite(body) ? body : body + clamps_.energy(z, clamp_pressure());
}

template <int Dim>
void InternalEnergy<Dim>::gradient(const VectorXd& z, VectorXd& g) {
  update_pressure(z);
  set_coefficients(map_, z, y_);
  forces_.setZero(Dim, y_.cols());
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& block = map_.blocks[i];
    Workspace& work = work_[i];
    deformation_gradients(int(i));
    for (size_t k = 0; k < block.points.size(); ++k) {
      const Mat<Dim> P = weight_[block.points[k]] *
                         first_piola<Dim>(material(block.points[k]), F_at<Dim>(work.F, int(k)),
                                              pressure(block.points[k]));
      for (int b = 0; b < Dim; ++b) work.F.row(b * block.points.size() + k) = P.col(b).transpose();  // F is not needed any more
    }
    const int n = int(work.gradient.rows()), N = int(work.gradient.cols());
    Eigen::Map<Rows> sum(product_.data(), N, Dim);
    sum.setZero();
    dense_kernels().add_product(sum.data(), N, work.gradient.data(), n, work.F.data(), n, N, Dim, n);
    for (int j = 0; j < N; ++j) forces_.col(work.columns[j]) += sum.row(j).transpose();
  }
  add_shared(map_, forces_);
  g = Eigen::Map<const VectorXd>(forces_.data(), size());
  if (stability_.size() > 0) {
    set_stability_force(z);
    g += stability_force_;
  }
  if (!clamps_.empty()) clamps_.add_gradient(z, g, clamp_pressure());
}

// v dP/dF at the block's points, from F in the work space.
template <int Dim>
void InternalEnergy<Dim>::set_tangents(const MapBlock<Dim>& block, bool project_psd, Workspace& work) {
  for (size_t k = 0; k < block.points.size(); ++k) {
    const int point = block.points[k];
    const StressDerivative<Dim> C = stress_derivative<Dim>(material(point), F_at<Dim>(work.F, int(k)), pressure(point));
    const StressDerivative<Dim> scaled = weight_[point] * (project_psd ? project_to_psd<Dim>(C) : C);
    for (int e = 0; e < scaled.size(); ++e) work.tangent[e][k] = scaled.data()[e];
  }
}

// The lower triangle of sum_k v_k B_k^T C_k B_k in the block's columns, components interleaved: the products of G^T
// and the scaled G of all pairs of components a >= c, side by side.
template <int Dim>
Eigen::Map<const MatrixXd> InternalEnergy<Dim>::local_hessian(const Workspace& work) {
  constexpr int n_pairs = Dim * (Dim + 1) / 2;
  const int n = int(work.tangent[0].size()), N = int(work.gradient.cols()), k = Dim * n;
  Eigen::Map<MatrixXd> scaled(scaled_.data(), k, n_pairs * N), product(product_.data(), N, n_pairs * N), local(local_.data(), Dim * N, Dim * N);
  const DenseKernels& kernels = dense_kernels();
  std::array<std::array<int, Dim>, Dim> pair;
  for (int c = 0, next = 0; c < Dim; ++c)
    for (int a = c; a < Dim; ++a, ++next) {
      pair[a][c] = pair[c][a] = next;
      for (int b = 0; b < Dim; ++b) {
        std::array<const double*, Dim> C;
        for (int d = 0; d < Dim; ++d) C[d] = work.tangent[a + Dim * b + Dim * Dim * (c + Dim * d)].data();
        kernels.weigh_rows(&scaled(b * n, next * N), k, C.data(), Dim, work.gradient.data(), k, n, N);
      }
    }
  product.setZero();
  const int at_once = std::clamp(product_columns_bytes / int(sizeof(double) * k), N, n_pairs * N);
  for (int j = 0; j < n_pairs * N; j += at_once)
    kernels.add_product(&product(0, j), N, work.gradient.data(), k, &scaled(0, j), k, N, std::min(at_once, n_pairs * N - j), k);
  for (int j = 0; j < N; ++j)
    for (int c = 0; c < Dim; ++c) {
      double* column = &local(0, Dim * j + c);
      for (int a = 0; a < Dim; ++a) {
        const bool swapped = a < c;  // entry (a, c) of (m, j) is entry (c, a) of (j, m)
        const double* from = swapped ? &product(j, pair[a][c] * N) : &product(0, pair[a][c] * N + j);
        const int stride = swapped ? N : 1;
        for (int m = j; m < N; ++m) column[Dim * m + a] = from[m * stride];
      }
    }
  return {local_.data(), Dim * N, Dim * N};
}

template <int Dim>
void InternalEnergy<Dim>::hessian(const VectorXd& z, bool project_psd, SymmetricMatrix& H) {
  update_pressure(z);
  H.set_zero();
  if (stability_.size() > 0) H.add(1, stability_);
  set_coefficients(map_, z, y_);
  for (size_t i = 0; i < work_.size(); ++i) {
    deformation_gradients(int(i));
    set_tangents(map_.blocks[i], project_psd, work_[i]);
    assembly_.add(int(i), local_hessian(work_[i]), H);
  }
  assembly_.finish(H);
  if (!clamps_.empty()) clamps_.add_hessian(z, project_psd, H, clamp_pressure());
  if (!pressure_.empty()) add_pressure_hessian(z, H);
}

// H += G^T M^-1 G with G = db/dz.
template <int Dim>
void InternalEnergy<Dim>::add_pressure_hessian(const VectorXd& z, SymmetricMatrix& H) {
  const auto& q = pressure_.functions();
  const DenseKernels& kernels = dense_kernels();
  MatrixXd G = MatrixXd::Zero(q.interior.n_columns, size()), scaled, local;
  set_coefficients(map_, z, y_);
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& points = map_.blocks[i].points;
    const auto& values = q.interior.blocks[i];
    Workspace& work = work_[i];
    deformation_gradients(int(i));
    const int n = int(points.size()), N = int(work.columns.size()), m = int(values.columns.size());
    MatrixXd first = MatrixXd::Zero(n, Dim * Dim);  // v dg/dF_ab in column Dim a + b
    for (int k = 0; k < n; ++k) {
      if (!pressure(points[k])) continue;
      const auto g = volume_measure<Dim>(material(points[k]).model, F_at<Dim>(work.F, k));
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) first(k, Dim * a + b) = weight_[points[k]] * g.first(a, b);
    }
    scaled.resize(n, N);
    for (int a = 0; a < Dim; ++a) {
      std::array<const double*, Dim> factors;
      for (int b = 0; b < Dim; ++b) factors[b] = first.col(Dim * a + b).data();
      kernels.weigh_rows(scaled.data(), n, factors.data(), Dim, work.gradient.data(), Dim * n, n, N);
      local.setZero(m, N);
      kernels.add_product(local.data(), m, values.value.data(), n, scaled.data(), n, m, N, n);
      for (int j = 0; j < N; ++j)
        for (int c = 0; c < m; ++c) G(values.columns[c], Dim * work.columns[j] + a) += local(c, j);
    }
  }
  if (!clamps_.empty()) clamps_.add_volume_work_derivative(z, q.on_clamps, G);
  pressure_.add_to_hessian(G, H);
}

template class InternalEnergy<2>;
template class InternalEnergy<3>;

}  // namespace sem
