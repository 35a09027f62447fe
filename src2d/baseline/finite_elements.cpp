#include "src2d/baseline/finite_elements.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "sem/base/timing.h"

namespace sem::baseline {
namespace {

using Eigen::VectorXd;
using Gradients = Eigen::Matrix<double, 6, 2>;    // grad N_a in rows
using Stiffness = Eigen::Matrix<double, 12, 12>;  // of (u_0x, u_0y, u_1x, ...)
constexpr int n_points = 3;                       // of the quadrature
constexpr int n_pairs = 78;                       // entries of a stiffness' lower triangle

// By (xi, eta) on the triangle (0, 0), (1, 0), (0, 1).
Gradients reference_gradients(double xi, double eta) {
  const double l = 1 - xi - eta;
  Gradients G;
  G << 1 - 4 * l, 1 - 4 * l, 4 * xi - 1, 0, 0, 4 * eta - 1,  // corners
      4 * (l - xi), -4 * xi, 4 * eta, 4 * xi, -4 * eta, 4 * (l - eta);
  return G;
}
const std::array<Gradients, n_points> at_points = {  // exact to degree 2, weights 1/3
    reference_gradients(1. / 6, 1. / 6), reference_gradients(2. / 3, 1. / 6),
    reference_gradients(1. / 6, 2. / 3)};

class Solver {
 public:
  Solver(const Mesh& mesh, const Problem& problem);
  Solution newton();

 private:
  void hold_sides();
  void find_pattern();
  void assemble_load();
  Mat<2> deformation_gradient(int e, const Gradients& G) const;
  double strain_energy() const;
  double potential_energy() const { return strain_energy() - load_.dot(u_); }
  void assemble(bool project_psd);
  void scatter(int e, const Stiffness& K);
  bool factorize();
  bool line_search(const VectorXd& step);
  void move(const VectorXd& step, double length);

  const Mesh& mesh_;
  const Problem& problem_;
  std::vector<Mat<2>> inverse_;  // of an element's map from the reference triangle
  std::vector<double> area_;
  std::vector<int> row_;   // of each component among the free ones; -1: held
  std::vector<int> slot_;  // of each element's pairs: where in the matrix' values; -1: held
  int n_free_ = 0;
  VectorXd u_, load_, internal_, residual_;  // all components but the last, which has the free ones
  Eigen::SparseMatrix<double> matrix_;       // lower triangle
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky_;
};

Solver::Solver(const Mesh& mesh, const Problem& problem)
    : mesh_(mesh),
      problem_(problem),
      u_(VectorXd::Zero(mesh.nodes.size())),
      load_(u_),
      internal_(u_) {
  for (const auto& element : mesh.elements) {
    Mat<2> edges;
    edges << mesh.nodes.col(element[1]) - mesh.nodes.col(element[0]),
        mesh.nodes.col(element[2]) - mesh.nodes.col(element[0]);
    inverse_.push_back(edges.inverse());
    area_.push_back(edges.determinant() / 2);
  }
  hold_sides();
  find_pattern();
  assemble_load();
}

void Solver::hold_sides() {
  row_.assign(u_.size(), 0);
  for (const Side side : {bottom, right, top, left}) {
    if (!problem_.held[side]) continue;
    for (const int a : mesh_.nodes_on(side)) {
      row_[2 * a] = row_[2 * a + 1] = -1;
      if (problem_.held_displacement)
        u_.segment<2>(2 * a) = problem_.held_displacement(mesh_.nodes.col(a));
    }
  }
  for (int& row : row_)
    if (row == 0) row = n_free_++;
  residual_.resize(n_free_);
}

// Calls visit(p, q) for an element's pairs p >= q of components, in the order of slot_.
template <class Visit>
void visit_pairs(const Visit& visit) {
  for (int q = 0; q < 12; ++q)
    for (int p = q; p < 12; ++p) visit(p, q);
}

void Solver::find_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  const auto visit_entries = [&](const auto& visit) {
    for (const auto& element : mesh_.elements) {
      const auto row = [&](int p) { return row_[2 * element[p / 2] + p % 2]; };
      visit_pairs([&](int p, int q) { visit(std::max(row(p), row(q)), std::min(row(p), row(q))); });
    }
  };
  visit_entries([&](int i, int j) {
    if (j >= 0) entries.emplace_back(i, j, 0.);
  });
  matrix_.resize(n_free_, n_free_);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  const int *rows = matrix_.innerIndexPtr(), *columns = matrix_.outerIndexPtr();
  visit_entries([&](int i, int j) {
    slot_.push_back(
        j < 0 ? -1 : int(std::lower_bound(rows + columns[j], rows + columns[j + 1], i) - rows));
  });
  cholesky_.analyzePattern(matrix_);
}

// Integrals of the functions: a third of the area for middles, nothing for corners; Simpson's rule
// on edges.
void Solver::assemble_load() {
  const Vec<2> weight = problem_.material.density * problem_.gravity;
  for (size_t e = 0; e < mesh_.elements.size(); ++e)
    for (int a = 3; a < 6; ++a) load_.segment<2>(2 * mesh_.elements[e][a]) += area_[e] / 3 * weight;
  for (const Side side : {bottom, right, top, left}) {
    const auto nodes = mesh_.nodes_on(side);
    for (size_t k = 0; k + 2 < nodes.size(); k += 2) {
      const double length = (mesh_.nodes.col(nodes[k + 2]) - mesh_.nodes.col(nodes[k])).norm();
      for (int a = 0; a < 3; ++a)
        load_.segment<2>(2 * nodes[k + a]) +=
            (a == 1 ? 4 : 1) * length / 6 * problem_.traction[side];
    }
  }
}

Mat<2> Solver::deformation_gradient(int e, const Gradients& G) const {
  Mat<2> F = Mat<2>::Identity();
  for (int a = 0; a < 6; ++a) F += u_.segment<2>(2 * mesh_.elements[e][a]) * G.row(a);
  return F;
}

double Solver::strain_energy() const {
  double energy = 0;
  for (int e = 0; e < int(area_.size()); ++e)
    for (const auto& reference : at_points)
      energy +=
          area_[e] / n_points *
          energy_density<2>(problem_.material, deformation_gradient(e, reference * inverse_[e]));
  return energy;
}

// grad N_a . dP/dF . grad N_b for b <= a.
void add_stiffness(const Gradients& G, const StressDerivative<2>& C, Stiffness& K) {
  for (int b = 0; b < 6; ++b) {
    const Eigen::Matrix<double, 4, 2> CB = G(b, 0) * C.leftCols<2>() + G(b, 1) * C.rightCols<2>();
    for (int a = b; a < 6; ++a)
      K.block<2, 2>(2 * a, 2 * b) += G(a, 0) * CB.topRows<2>() + G(a, 1) * CB.bottomRows<2>();
  }
}

void Solver::assemble(bool project) {
  internal_.setZero();
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.);
  for (int e = 0; e < int(area_.size()); ++e) {
    Stiffness K = Stiffness::Zero();
    for (const auto& reference : at_points) {
      const Gradients G = reference * inverse_[e];
      const Mat<2> F = deformation_gradient(e, G);
      const double v = area_[e] / n_points;
      const Mat<2> P = v * first_piola<2>(problem_.material, F);
      for (int a = 0; a < 6; ++a)
        internal_.segment<2>(2 * mesh_.elements[e][a]) += P * G.row(a).transpose();
      StressDerivative<2> C = stress_derivative<2>(problem_.material, F);
      if (project) C = project_to_psd<2>(C);
      add_stiffness(G, v * C, K);
    }
    scatter(e, K);
  }
  for (int c = 0; c < int(row_.size()); ++c)
    if (row_[c] >= 0) residual_[row_[c]] = load_[c] - internal_[c];
}

void Solver::scatter(int e, const Stiffness& K) {
  const int* slot = &slot_[size_t(e) * n_pairs];
  visit_pairs([&](int p, int q) {
    if (*slot >= 0) matrix_.valuePtr()[*slot] += K(p, q);
    ++slot;
  });
}

bool Solver::factorize() {
  cholesky_.factorize(matrix_);
  if (cholesky_.info() == Eigen::Success) return true;
  assemble(true);
  cholesky_.factorize(matrix_);
  return cholesky_.info() == Eigen::Success;
}

void Solver::move(const VectorXd& step, double length) {
  for (int c = 0; c < int(row_.size()); ++c)
    if (row_[c] >= 0) u_[c] += length * step[row_[c]];
}

// Armijo's rule; the last term lets rounding pass.
bool Solver::line_search(const VectorXd& step) {
  const double before = potential_energy(), slope = residual_.dot(step);
  const double rounding = 1e-13 * (std::abs(before) + std::abs(load_.dot(u_)));
  for (double length = 1; length > 1e-8; length /= 2) {
    move(step, length);
    if (potential_energy() <= before - 1e-4 * length * slope + rounding) return true;
    move(step, -length);
  }
  return false;
}

Solution Solver::newton() {
  Solution solution;
  solution.n_unknowns = int(u_.size());
  double largest_force = load_.norm();
  for (; solution.iterations < 50; ++solution.iterations) {
    assemble(false);
    largest_force = std::max(largest_force, internal_.norm());
    solution.converged = residual_.norm() <= 1e-10 * largest_force;
    if (solution.converged || !factorize()) break;
    if (!line_search(cholesky_.solve(residual_))) break;
  }
  solution.energy = strain_energy();
  solution.displacement = u_.reshaped(2, mesh_.nodes.cols());
  return solution;
}

}  // namespace

double graded_place(int k, int n, double grading, bool from_both_ends) {
  if (!from_both_ends) return std::pow(double(k) / n, grading);
  return 2 * k <= n ? std::pow(2. * k / n, grading) / 2
                    : 1 - std::pow(2. * (n - k) / n, grading) / 2;
}

std::vector<int> Mesh::nodes_on(Side side) const {
  const bool along_x = side == bottom || side == top;
  std::vector<int> result;
  for (int k = 0; k <= 2 * (along_x ? n_x : n_y); ++k)
    result.push_back(along_x ? node(k, side == top ? 2 * n_y : 0)
                             : node(side == right ? 2 * n_x : 0, k));
  return result;
}

Mesh quadrilateral_mesh(const Corners& corners, int n_x, int n_y, double grading,
                        bool to_both_sides) {
  Mesh mesh{n_x, n_y, Points<2>(2, (2 * n_x + 1) * (2 * n_y + 1)), {}};
  const auto corner_of_cell = [&](int i, int j) -> Vec<2> {
    const double s = graded_place(i, n_x, grading, to_both_sides),
                 t = graded_place(j, n_y, grading, true);
    return (1 - t) * ((1 - s) * corners[0] + s * corners[1]) +
           t * ((1 - s) * corners[3] + s * corners[2]);
  };
  for (int j = 0; j <= 2 * n_y; ++j)
    for (int i = 0; i <= 2 * n_x; ++i)  // in the middle of two corners, or of one with itself
      mesh.nodes.col(mesh.node(i, j)) =
          (corner_of_cell(i / 2, j / 2) + corner_of_cell((i + 1) / 2, (j + 1) / 2)) / 2;
  for (int j = 0; j < 2 * n_y; j += 2)
    for (int i = 0; i < 2 * n_x; i += 2) {
      const auto at = [&](int k, int l) { return mesh.node(i + k, j + l); };
      mesh.elements.push_back({at(0, 0), at(2, 0), at(2, 2), at(1, 0), at(2, 1), at(1, 1)});
      mesh.elements.push_back({at(0, 0), at(2, 2), at(0, 2), at(1, 1), at(1, 2), at(0, 1)});
    }
  return mesh;
}

Solution solve_static(const Mesh& mesh, const Problem& problem) {
  const double start = thread_seconds();
  Solver solver(mesh, problem);
  const double prepared = thread_seconds();
  Solution solution = solver.newton();
  solution.preparation_seconds = prepared - start;
  solution.solve_seconds = thread_seconds() - prepared;
  return solution;
}

}  // namespace sem::baseline
