#include "sem/mechanics/clamps.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sem/method/join_blocks.h"
#include "sem/solve/dense_kernels.h"

namespace sem {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Factor of the penalty where a layer along the boundary is crushed, with its derivatives by
// vec(F). It thins to 1 / |F^-T N| of its rest thickness, and the square of a neo-Hookean traction
// grows beside the stored energy by q = |F^-T N|^2: a constant penalty loses to -P N . r. From half
// of its thickness on the penalty grows as q:
//   s = 1 + t^3 / (1 + t^2), t = max(0, q - 4);
// with m = F^-T N and a = F^-1 m, dq = -2 m . dF a. Materials without a barrier at J = 0 need none.
template <int Dim>
struct Stiffening {
  double factor = 1;
  Mat<Dim> first = Mat<Dim>::Zero();
  StressDerivative<Dim> second = StressDerivative<Dim>::Zero();
};

bool has_barrier(MaterialModel model) {
  return model == MaterialModel::neo_log || model == MaterialModel::neo_ref ||
         model == MaterialModel::neo_iso;
}

template <int Dim>
Stiffening<Dim> stiffening(const Material& material, const Mat<Dim>& F, const Vec<Dim>& normal) {
  if (!has_barrier(material.model)) return {};
  const Mat<Dim> inverse = F.inverse();
  const Vec<Dim> m = inverse.transpose() * normal, a = inverse * m;
  const double t = m.squaredNorm() - 4, u = 1 + t * t;
  if (!(t > 0)) return {};
  const double slope = t * t * (t * t + 3) / (u * u), bend = 2 * t * (3 - t * t) / (u * u * u);
  Stiffening<Dim> s{1 + t * t * t / u, -2 * slope * m * a.transpose(), {}};
  const Mat<Dim> dq = -2 * m * a.transpose();
  for (int c = 0; c < Dim; ++c)
    for (int d = 0; d < Dim; ++d) {  // along dF = e_c e_d^T
      const Vec<Dim> dm = -m[c] * inverse.row(d).transpose(),
                     da = inverse * dm - a[d] * inverse.col(c);
      const Mat<Dim> column =
          bend * dq(c, d) * dq - 2 * slope * (dm * a.transpose() + m * da.transpose());
      s.second.col(c + Dim * d) = column.reshaped();
    }
  return s;
}

// One held point, ready for the formulas.
template <int Dim>
struct HeldPoint {
  const MapBlock<Dim>& block;
  int row;  // in the block
  Vec<Dim> residual, normal, held;
  Mat<Dim> F;
  double weight, penalty;
  const Material& material;
  const double* pressure;  // null: none of its own
  int index;               // among the held points
};

template <int Dim, class Visit>
void visit_points(const ClampedPoints<Dim>& points, const VectorXd& z, const double* pressure,
                  const Visit& visit) {
  const Eigen::Map<const Points<Dim>> nodes(z.data(), Dim, points.map.n_columns);
  for (const auto& block : points.map.blocks) {
    const Points<Dim> y = nodes(Eigen::all, block.columns), x = y * block.value.transpose();
    std::array<Points<Dim>, Dim> F;
    for (int b = 0; b < Dim; ++b) F[b] = y * block.gradient[b].transpose();
    for (size_t row = 0; row < block.points.size(); ++row) {
      const int s = block.points[row];
      Mat<Dim> F_s;
      for (int b = 0; b < Dim; ++b) F_s.col(b) = F[b].col(row);
      const HeldPoint<Dim> point{
          block,
          int(row),
          points.held.col(s).cwiseProduct(x.col(row) - points.position.col(s)),
          points.normal.col(s),
          points.held.col(s),
          F_s,
          points.weight[s],
          points.penalty[s],
          points.material[s],
          pressure && !std::isnan(pressure[s]) ? pressure + s : nullptr,
          s};
      visit(point);
    }
  }
}

// The same block by block.
template <int Dim, class Visit>
void visit_blocks(const ClampedPoints<Dim>& points, const VectorXd& z, const double* pressure,
                  const Visit& visit) {
  std::vector<HeldPoint<Dim>> held;
  visit_points<Dim>(points, z, pressure, [&](const HeldPoint<Dim>& p) {
    if (!held.empty() && &held[0].block != &p.block) {
      visit(held);
      held.clear();
    }
    held.push_back(p);
  });
  if (!held.empty()) visit(held);
}

// K of the penalty beta/(2h) r . K r at rest, held components only. A pressure of its own is what holds the volume's
// change back, so that the penalty's lambda need not grow with it, and rounding of that hides no softer motion.
constexpr double most_volume_stiffness = 10;  // lambda / mu
template <int Dim>
Mat<Dim> penalty_matrix(const HeldPoint<Dim>& p) {
  const double mu = p.material.lame_mu(), lambda = p.material.lame_lambda();
  const Mat<Dim> K = 2 * mu * Mat<Dim>::Identity() +
                     (p.pressure ? std::min(lambda, most_volume_stiffness * mu) : lambda) *
                         p.normal * p.normal.transpose();
  return p.penalty * p.held.asDiagonal() * K * p.held.asDiagonal();
}

// vec(r (x) N).
template <int Dim>
Eigen::Matrix<double, Dim * Dim, 1> work_direction(const HeldPoint<Dim>& p) {
  const Mat<Dim> D = p.residual * p.normal.transpose();
  return Eigen::Map<const Eigen::Matrix<double, Dim * Dim, 1>>(D.data());
}

// Derivative of stress_derivative along r (x) N.
template <int Dim>
StressDerivative<Dim> third_derivative(const HeldPoint<Dim>& p) {
  const double size = p.residual.norm(), step = 1e-4;
  if (is_quadratic(p.material.model) || size == 0) return StressDerivative<Dim>::Zero();
  const Mat<Dim> D = step * (p.residual / size) * p.normal.transpose();
  return size / (2 * step) *
         (stress_derivative<Dim>(p.material, p.F + D, p.pressure) -
          stress_derivative<Dim>(p.material, p.F - D, p.pressure));
}

// The Hessian of all points of a block in its columns: with the traction on held components, less
// what dF changes of the penalty, held (dP N - K r ds) = T_j dz_j by column j, and s K for K, sum
// of w (v_m v_j K - v_m T_j - v_j T_m^T - grad v_m . D . grad v_j), one product over the points for
// each pair of components.
template <int Dim>
MatrixXd block_hessian(const std::vector<HeldPoint<Dim>>& points, bool approximate) {
  const MapBlock<Dim>& block = points[0].block;
  const int n = int(block.columns.size()), n_points = int(points.size());
  const auto rows = Eigen::seqN(points[0].row, n_points);
  const MatrixXd V = block.value(rows, Eigen::all);
  MatrixXd G(Dim * n_points, n);
  for (int b = 0; b < Dim; ++b)
    G.middleRows(b * n_points, n_points) = block.gradient[b](rows, Eigen::all);
  std::vector<Mat<Dim>> K, ds;
  std::vector<Vec<Dim>> Kr;
  std::vector<StressDerivative<Dim>> C, D;
  for (const auto& p : points) {
    const Mat<Dim> at_rest = p.weight * penalty_matrix(p);
    const Stiffening<Dim> s = stiffening<Dim>(p.material, p.F, p.normal);
    K.push_back(s.factor * at_rest);
    Kr.push_back(at_rest * p.residual);
    ds.push_back(approximate ? Mat<Dim>::Zero() : s.first);
    C.push_back(p.weight * stress_derivative<Dim>(p.material, p.F, p.pressure));
    if (!approximate)
      D.push_back(p.weight * third_derivative(p) - Kr.back().dot(p.residual) / 2 * s.second);
  }
  // Rows of `target`: minus the sum over d of factor(k, d) G_d, #points by #columns.
  const DenseKernels& kernels = dense_kernels();
  MatrixXd factors(n_points, Dim);
  const auto subtract_weighed = [&](const auto& factor, MatrixXd& target, int first) {
    std::array<const double*, Dim> columns;
    for (int d = 0; d < Dim; ++d) {
      for (int k = 0; k < n_points; ++k) factors(k, d) = -factor(k, d);
      columns[d] = factors.col(d).data();
    }
    kernels.weigh_rows(&target(first, 0), int(target.rows()), columns.data(), Dim, G.data(),
                       Dim * n_points, n_points, n);
  };
  // w T of component a by component c.
  const auto traction = [&](int a, int c) {
    return [&, a, c](int k, int d) {
      double factor = -Kr[k][a] * ds[k](c, d);
      for (int b = 0; b < Dim; ++b) factor += points[k].normal[b] * C[k](a + Dim * b, c + Dim * d);
      return points[k].held[a] * factor;
    };
  };
  // All terms below each other: V and K V - T_ac, -T_ca and V, grad V and -D grad V.
  const int n_rows = (approximate ? 2 : 2 + Dim) * n_points;
  MatrixXd left(n_rows, n), right(n_rows, n), sum(Dim * n, Dim * n), local(n, n);
  left.topRows(n_points) = V;
  right.middleRows(n_points, n_points) = V;
  if (!approximate) left.bottomRows(Dim * n_points) = G;
  for (int a = 0; a < Dim; ++a)
    for (int c = 0; c <= a; ++c) {
      subtract_weighed(traction(a, c), right, 0);
      for (int k = 0; k < n_points; ++k) right.row(k) += K[k](a, c) * V.row(k);
      subtract_weighed(traction(c, a), left, n_points);
      for (int b = 0; b < Dim && !approximate; ++b)
        subtract_weighed([&](int k, int d) { return D[k](a + Dim * b, c + Dim * d); }, right,
                         (2 + b) * n_points);
      local.setZero();
      kernels.add_product(local.data(), n, left.data(), n_rows, right.data(), n_rows, n, n, n_rows);
      for (int j = 0; j < n; ++j)
        for (int m = 0; m < n; ++m) {
          sum(Dim * m + a, Dim * j + c) = local(m, j);
          sum(Dim * j + c, Dim * m + a) = local(m, j);
        }
    }
  return sum;
}

// The unknowns that a spring acts on, ascending.
template <int Dim>
std::vector<int> coupled_columns(const HeldControl<Dim>& spring) {
  std::vector<int> columns;
  for (int c = 0; c < spring.output.size(); ++c)
    if (spring.output[c] != 0) columns.push_back(c);
  return columns;
}

}  // namespace

template <int Dim>
Clamps<Dim>::Clamps(ClampedPoints<Dim> points, std::vector<HeldControl<Dim>> controls)
    : points_(std::move(points)), controls_(std::move(controls)) {
  points_.map = joined(points_.map, blocks_to_join(points_.map));
}

template <int Dim>
double Clamps<Dim>::energy(const VectorXd& z, const double* pressure) const {
  double sum = 0;
  visit_points<Dim>(points_, z, pressure, [&](const HeldPoint<Dim>& p) {
    if (!std::isfinite(energy_density<Dim>(p.material, p.F))) {
      sum = std::numeric_limits<double>::infinity();
      return;
    }
    sum += p.weight * (stiffening<Dim>(p.material, p.F, p.normal).factor *
                           p.residual.dot(penalty_matrix(p) * p.residual) / 2 -
                       (first_piola<Dim>(p.material, p.F, p.pressure) * p.normal).dot(p.residual));
  });
  for (const auto& spring : controls_) {
    const Eigen::Map<const Points<Dim>> nodes(z.data(), Dim, spring.output.size());
    const Vec<Dim> r = nodes * spring.output.transpose() - spring.rest;
    sum += spring.stiffness / 2 * spring.held.cwiseProduct(r).squaredNorm();
  }
  return sum;
}

template <int Dim>
void Clamps<Dim>::add_gradient(const VectorXd& z, VectorXd& g, const double* pressure) const {
  visit_points<Dim>(points_, z, pressure, [&](const HeldPoint<Dim>& p) {
    // dV = force . d(x - d) - Q : dF with Q = C : (r (x) N) - r . K r/2 ds/dF.
    const Vec<Dim> traction =
        p.held.cwiseProduct(first_piola<Dim>(p.material, p.F, p.pressure) * p.normal);
    const Stiffening<Dim> s = stiffening<Dim>(p.material, p.F, p.normal);
    const Vec<Dim> penalty = penalty_matrix(p) * p.residual;
    const Vec<Dim> force = p.weight * (s.factor * penalty - traction);
    const Eigen::Matrix<double, Dim * Dim, 1> q =
        stress_derivative<Dim>(p.material, p.F, p.pressure) * work_direction(p);
    const Mat<Dim> Q =
        p.weight * (Eigen::Map<const Mat<Dim>>(q.data()) - penalty.dot(p.residual) / 2 * s.first);
    for (size_t j = 0; j < p.block.columns.size(); ++j) {
      Vec<Dim> f = p.block.value(p.row, j) * force;
      for (int b = 0; b < Dim; ++b) f -= p.block.gradient[b](p.row, j) * Q.col(b);
      g.template segment<Dim>(Dim * p.block.columns[j]) += f;
    }
  });
  for (const auto& spring : controls_) {
    const Eigen::Map<const Points<Dim>> nodes(z.data(), Dim, spring.output.size());
    Eigen::Map<Points<Dim>> out(g.data(), Dim, spring.output.size());
    const Vec<Dim> r = nodes * spring.output.transpose() - spring.rest;
    out += spring.stiffness * spring.held.cwiseProduct(r) * spring.output;
  }
}

template <int Dim>
void Clamps<Dim>::add_hessian(const VectorXd& z, bool approximate, SymmetricMatrix& H,
                              const double* pressure) const {
  visit_blocks<Dim>(points_, z, pressure, [&](const std::vector<HeldPoint<Dim>>& points) {
    H.add(points[0].block.columns, block_hessian(points, approximate));
  });
  MatrixXd sum;
  for (const auto& spring : controls_) {
    const std::vector<int> columns = coupled_columns(spring);
    const Eigen::RowVectorXd& row = spring.output;
    const int n = int(columns.size());
    sum.setZero(Dim * n, Dim * n);
    for (int a = 0; a < Dim; ++a)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          sum(Dim * i + a, Dim * j + a) =
              spring.held[a] * spring.stiffness * row[columns[i]] * row[columns[j]];
    H.add(columns, sum);
  }
}

template <int Dim>
std::vector<std::vector<int>> Clamps<Dim>::couplings() const {
  std::vector<std::vector<int>> cliques;
  for (const auto& block : points_.map.blocks) cliques.push_back(block.columns);
  for (const auto& spring : controls_) cliques.push_back(coupled_columns(spring));
  std::sort(cliques.begin(), cliques.end());
  cliques.erase(std::unique(cliques.begin(), cliques.end()), cliques.end());
  return cliques;
}

template <int Dim>
VectorXd Clamps<Dim>::volume_work(const VectorXd& z) const {
  VectorXd work = VectorXd::Zero(points_.size());
  visit_points<Dim>(points_, z, nullptr, [&](const HeldPoint<Dim>& p) {
    const auto g = volume_measure<Dim>(p.material.model, p.F);
    work[p.index] = -p.weight * (g.first * p.normal).dot(p.residual);
  });
  return work;
}

template <int Dim>
void Clamps<Dim>::add_volume_work_derivative(const VectorXd& z, const MatrixXd& Q,
                                             MatrixXd& G) const {
  visit_blocks<Dim>(points_, z, nullptr, [&](const std::vector<HeldPoint<Dim>>& points) {
    const MapBlock<Dim>& block = points[0].block;
    const int n = int(points.size());
    MatrixXd functions(n, Q.cols());
    std::array<MatrixXd, Dim> derivative;  // of each component, #points by #columns
    for (auto& component : derivative) component.resize(n, block.columns.size());
    for (int k = 0; k < n; ++k) {
      const HeldPoint<Dim>& p = points[k];
      const auto g = volume_measure<Dim>(p.material.model, p.F);
      const Vec<Dim> by_residual = -p.weight * p.held.cwiseProduct(g.first * p.normal);
      const Eigen::Matrix<double, Dim * Dim, 1> q = -p.weight * (g.second * work_direction(p));
      const Eigen::Map<const Mat<Dim>> by_F(q.data());
      functions.row(k) = Q.row(p.index);
      for (int a = 0; a < Dim; ++a) {
        derivative[a].row(k) = by_residual[a] * block.value.row(p.row);
        for (int b = 0; b < Dim; ++b)
          derivative[a].row(k) += by_F(a, b) * block.gradient[b].row(p.row);
      }
    }
    for (int a = 0; a < Dim; ++a) {
      MatrixXd sum = MatrixXd::Zero(Q.cols(), derivative[a].cols());
      dense_kernels().add_product(sum.data(), int(sum.rows()), functions.data(), n,
                                  derivative[a].data(), n, int(sum.rows()), int(sum.cols()), n);
      for (size_t j = 0; j < block.columns.size(); ++j)
        G.col(Dim * block.columns[j] + a) += sum.col(Eigen::Index(j));
    }
  });
}

template class Clamps<2>;
template class Clamps<3>;

}  // namespace sem
