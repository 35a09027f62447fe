#include "sem/mechanics/internal_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sem {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// F at point k from its columns.
template <int Dim>
Mat<Dim> assemble_F(const std::array<Points<Dim>, Dim>& columns, int k) {
  Mat<Dim> F;
  for (int b = 0; b < Dim; ++b) F.col(b) = columns[b].col(k);
  return F;
}

}  // namespace

template <int Dim>
InternalEnergy<Dim>::InternalEnergy(const Map<Dim>& map, const VectorXd& weight,
                                    const MaterialField& materials, const MatrixXd& stability,
                                    Clamps<Dim> clamps, Pressure<Dim> pressure)
    : map_(map),
      weight_(weight),
      materials_(materials),
      stability_(stability),
      clamps_(std::move(clamps)),
      pressure_(std::move(pressure)),
      work_(map.blocks.size()),
      stability_nodes_(Dim, map.n_columns),
      stability_force_(Dim, map.n_columns) {
  quadratic_ = std::all_of(materials_.of_point.begin(), materials_.of_point.end(), [&](int m) {
    return is_quadratic(materials_.materials[m].model);
  });
  int most_columns = 0;
  for (size_t b = 0; b < work_.size(); ++b) {
    const int n = int(map.blocks[b].points.size()), a = int(map.blocks[b].columns.size());
    most_columns = std::max(most_columns, a);
    work_[b].nodes.resize(Dim, a);
    for (auto& F : work_[b].F) F.resize(Dim, n);
    work_[b].scaled.resize(n, a);
    work_[b].tangent.resize(n);
  }
  product_.resize(most_columns, most_columns);
}

template <int Dim>
void InternalEnergy<Dim>::deformation_gradients(const VectorXd& z, const MapBlock<Dim>& block,
                                                Workspace& work) {
  for (size_t j = 0; j < block.columns.size(); ++j)
    work.nodes.col(j) = z.template segment<Dim>(Dim * block.columns[j]);
  for (int b = 0; b < Dim; ++b) work.F[b].noalias() = work.nodes * block.gradient[b].transpose();
}

template <int Dim>
bool InternalEnergy<Dim>::update_pressure(const VectorXd& z) {
  if (pressure_.empty()) return true;
  VectorXd g = VectorXd::Zero(map_.n_points);
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& block = map_.blocks[i];
    deformation_gradients(z, block, work_[i]);
    for (size_t k = 0; k < block.points.size(); ++k) {
      const Mat<Dim> F = assemble_F<Dim>(work_[i].F, int(k));
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
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& block = map_.blocks[i];
    deformation_gradients(z, block, work_[i]);
    for (size_t k = 0; k < block.points.size(); ++k)
      sum += weight_[block.points[k]] *
             energy_density<Dim>(material(block.points[k]), assemble_F<Dim>(work_[i].F, int(k)),
                                  pressure(block.points[k]));
  }
  return sum;
}

// gamma S z. S knows no translation: about the first node, so that a body far from zero loses no digits.
template <int Dim>
void InternalEnergy<Dim>::set_stability_force(const Eigen::Map<const Points<Dim>>& nodes) {
  stability_nodes_ = nodes.colwise() - nodes.col(0);
  stability_force_.noalias() = stability_nodes_ * stability_;
}

template <int Dim>
double InternalEnergy<Dim>::stability_energy(const VectorXd& z) {
  if (stability_.size() == 0) return 0;
  const Eigen::Map<const Points<Dim>> nodes(z.data(), Dim, map_.n_columns);
  set_stability_force(nodes);
  return stability_force_.cwiseProduct(stability_nodes_).sum() / 2;
}

template <int Dim>
double InternalEnergy<Dim>::energy(const VectorXd& z) {
  const double body = elastic_energy(z) + stability_energy(z);
  return clamps_.empty() || !std::isfinite(body) ? body : body + clamps_.energy(z, clamp_pressure());
}

template <int Dim>
void InternalEnergy<Dim>::gradient(const VectorXd& z, VectorXd& g) {
  update_pressure(z);
  const Eigen::Map<const Points<Dim>> nodes(z.data(), Dim, map_.n_columns);
  Eigen::Map<Points<Dim>> out(g.data(), Dim, map_.n_columns);
  if (stability_.size() > 0) {
    set_stability_force(nodes);
    out = stability_force_;
  } else {
    out.setZero();
  }
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& block = map_.blocks[i];
    Workspace& work = work_[i];
    deformation_gradients(z, block, work);
    for (size_t k = 0; k < block.points.size(); ++k) {
      const Mat<Dim> P = weight_[block.points[k]] *
                         first_piola<Dim>(material(block.points[k]), assemble_F<Dim>(work.F, int(k)),
                                              pressure(block.points[k]));
      for (int b = 0; b < Dim; ++b) work.F[b].col(k) = P.col(b);  // F is not needed any more
    }
    work.nodes.setZero();
    for (int b = 0; b < Dim; ++b) work.nodes.noalias() += work.F[b] * block.gradient[b];
    for (size_t j = 0; j < block.columns.size(); ++j) out.col(block.columns[j]) += work.nodes.col(j);
  }
  if (!clamps_.empty()) clamps_.add_gradient(z, g, clamp_pressure());
}

template <int Dim>
void InternalEnergy<Dim>::hessian(const VectorXd& z, bool psd, MatrixXd& H) {
  update_pressure(z);
  H.setZero();
  for (int j = 0; j < stability_.cols(); ++j)
    for (int i = 0; i < stability_.rows(); ++i)
      for (int a = 0; a < Dim; ++a) H(Dim * i + a, Dim * j + a) = stability_(i, j);
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& block = map_.blocks[i];
    Workspace& work = work_[i];
    const int n = int(block.points.size()), n_columns = int(block.columns.size());
    auto product = product_.topLeftCorner(n_columns, n_columns);
    deformation_gradients(z, block, work);
    for (int k = 0; k < n; ++k) {
      const StressDerivative<Dim> C =
          stress_derivative<Dim>(material(block.points[k]), assemble_F<Dim>(work.F, k), pressure(block.points[k]));
      work.tangent[k] = weight_[block.points[k]] * (psd ? project_to_psd<Dim>(C) : C);
    }
    for (int a = 0; a < Dim; ++a)
      for (int c = a; c < Dim; ++c) {
        product.setZero();
        for (int b = 0; b < Dim; ++b) {
          for (int j = 0; j < n_columns; ++j)
            for (int k = 0; k < n; ++k) {
              double sum = 0;
              for (int d = 0; d < Dim; ++d)
                sum += work.tangent[k](a + Dim * b, c + Dim * d) * block.gradient[d](k, j);
              work.scaled(k, j) = sum;
            }
          product.noalias() += block.gradient[b].transpose() * work.scaled;
        }
        for (int j = 0; j < n_columns; ++j)
          for (int m = 0; m < n_columns; ++m) {
            const int row = Dim * block.columns[m] + a, column = Dim * block.columns[j] + c;
            H(row, column) += product(m, j);
            if (c != a) H(column, row) += product(m, j);
          }
      }
  }
  if (!clamps_.empty()) clamps_.add_hessian(z, psd, H, clamp_pressure());
  if (!pressure_.empty()) add_pressure_hessian(z, H);
}

// H += G^T M^-1 G with G = db/dz.
template <int Dim>
void InternalEnergy<Dim>::add_pressure_hessian(const VectorXd& z, MatrixXd& H) {
  const auto& q = pressure_.functions();
  MatrixXd G = MatrixXd::Zero(q.interior.n_columns, size());
  for (size_t i = 0; i < work_.size(); ++i) {
    const auto& block = map_.blocks[i];
    const auto& values = q.interior.blocks[i];
    Workspace& work = work_[i];
    deformation_gradients(z, block, work);
    const int n = int(block.points.size());
    std::array<Points<Dim>, Dim> first;  // v dg/dF_ab: column a of row b
    for (auto& rows : first) rows = Points<Dim>::Zero(Dim, n);
    for (int k = 0; k < n; ++k) {
      if (!pressure(block.points[k])) continue;
      const auto g = volume_measure<Dim>(material(block.points[k]).model, assemble_F<Dim>(work.F, k));
      for (int b = 0; b < Dim; ++b) first[b].col(k) = weight_[block.points[k]] * g.first.col(b);
    }
    MatrixXd local(values.columns.size(), block.columns.size());
    for (int a = 0; a < Dim; ++a) {
      for (size_t j = 0; j < block.columns.size(); ++j)
        for (int k = 0; k < n; ++k) {
          double sum = 0;
          for (int b = 0; b < Dim; ++b) sum += first[b](a, k) * block.gradient[b](k, j);
          work.scaled(k, j) = sum;
        }
      local.noalias() = values.value.transpose() * work.scaled;
      for (size_t j = 0; j < block.columns.size(); ++j)
        for (size_t m = 0; m < values.columns.size(); ++m)
          G(values.columns[m], Dim * block.columns[j] + a) += local(m, j);
    }
  }
  if (!clamps_.empty()) clamps_.add_volume_work_derivative(z, q.on_clamps, G);
  pressure_.add_to_hessian(G, H);
}

template class InternalEnergy<2>;
template class InternalEnergy<3>;

}  // namespace sem
