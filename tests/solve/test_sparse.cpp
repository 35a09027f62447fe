// Matrices in panels: plans of elimination, products, factors; the dense kernels under them.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "sem/solve/dense_kernels.h"
#include "sem/solve/sparse_cholesky.h"
#include "linear_algebra.h"

using namespace sem;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Cliques = std::vector<std::vector<int>>;

// A grid of cells, each a clique of its four corners, and one node that meets everything.
Cliques grid_cliques(int n) {
  Cliques cliques;
  std::vector<int> all;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      all.push_back(i * n + j);
      if (i + 1 < n && j + 1 < n) cliques.push_back({i * n + j, i * n + j + 1, (i + 1) * n + j, (i + 1) * n + j + 1});
    }
  all.push_back(n * n);
  for (const int i : all)
    if (i < n * n) cliques.push_back({i, n * n});
  return cliques;
}

// Random, positive definite, with entries where the cliques have them.
MatrixXd random_matrix(const Cliques& cliques, int n_nodes, int components, unsigned seed) {
  std::srand(seed);
  MatrixXd A = MatrixXd::Identity(n_nodes * components, n_nodes * components);
  for (const auto& clique : cliques) {
    std::vector<int> entries;
    for (const int i : clique)
      for (int a = 0; a < components; ++a) entries.push_back(components * i + a);
    const MatrixXd R = MatrixXd::Random(entries.size(), entries.size());
    A(entries, entries) += R * R.transpose();
  }
  return A;
}

SymmetricMatrix from_dense(const MatrixXd& A, const std::shared_ptr<const Elimination>& plan, int components) {
  SymmetricMatrix S(plan, components);
  S.set(A);
  return S;
}

}  // namespace

TEST_CASE("a plan orders every node once and has room for every clique; rows of a panel come later") {
  const int n = 9, n_nodes = n * n + 1;
  const auto cliques = grid_cliques(n);
  const std::vector<int> held = {3, 40, 77};
  const auto plan = plan_elimination(n_nodes, cliques, held);
  CHECK(std::set<int>(plan->node.begin(), plan->node.end()).size() == size_t(n_nodes));
  for (int i = 0; i < n_nodes; ++i) CHECK(plan->node[plan->position[i]] == i);
  for (const auto& panel : plan->panels) {
    CHECK(std::is_sorted(panel.rows.begin(), panel.rows.end()));
    if (!panel.rows.empty()) CHECK(panel.rows.front() >= panel.end);
  }
  for (const auto& clique : cliques)
    for (const int i : clique)
      for (const int j : clique) {
        const auto [a, b] = std::minmax(plan->position[i], plan->position[j]);
        const auto& panel = plan->panels[plan->panel_of[a]];
        const bool has_room = b < panel.end || std::binary_search(panel.rows.begin(), panel.rows.end(), b);
        CHECK(has_room);
      }
  for (const int i : held) CHECK(plan->panel_of[plan->position[i]] >= plan->n_free_panels);
  CHECK(plan->panels.size() > 3);
  CHECK(plan->fill() < 0.6);
}

TEST_CASE("minimum degree keeps the factor of a chain free of fill, in whatever order its nodes come") {
  std::vector<int> shuffled(40);
  for (int i = 0; i < 40; ++i) shuffled[i] = (7 * i) % 40;
  Cliques chain;
  for (int i = 0; i + 1 < 40; ++i) chain.push_back({std::min(shuffled[i], shuffled[i + 1]), std::max(shuffled[i], shuffled[i + 1])});
  const auto plan = plan_elimination(40, chain);
  // Panels of up to 9 nodes are joined although they add zeros; dense would be 820.
  double stored = 0;
  for (const auto& panel : plan->panels) stored += panel.width() * panel.height();
  CHECK(stored < 500);
}

TEST_CASE("products, sums and entries of a matrix in panels are those of the dense one") {
  for (const int components : {1, 2, 3}) {
    CAPTURE(components);
    const int n_nodes = 26;
    const auto cliques = grid_cliques(5);
    const auto plan = plan_elimination(n_nodes, cliques, {2, 9});
    const MatrixXd dense = random_matrix(cliques, n_nodes, components, 1);
    SymmetricMatrix A = from_dense(dense, plan, components);
    CHECK((A.dense() - dense).norm() == 0);
    const VectorXd x = VectorXd::Random(dense.rows());
    CHECK((A * x - dense * x).norm() < 1e-13 * dense.norm());
    VectorXd y;
    A.absolute_product(x, y);
    CHECK((y - dense.cwiseAbs() * x.cwiseAbs()).norm() < 1e-13 * dense.norm());
    CHECK((A.diagonal() - dense.diagonal()).norm() == 0);
    // A scalar matrix acts on every component.
    const MatrixXd scalar = random_matrix(cliques, n_nodes, 1, 2);
    MatrixXd expanded = MatrixXd::Zero(dense.rows(), dense.cols());
    for (int i = 0; i < n_nodes; ++i)
      for (int j = 0; j < n_nodes; ++j)
        for (int a = 0; a < components; ++a) expanded(components * i + a, components * j + a) = scalar(i, j);
    const SymmetricMatrix M = from_dense(scalar, plan, 1);
    CHECK((M * x - expanded * x).norm() < 1e-13 * expanded.norm());
    M.absolute_product(x, y);
    CHECK((y - expanded.cwiseAbs() * x.cwiseAbs()).norm() < 1e-13 * expanded.norm());
    SymmetricMatrix combined(plan, components);
    combined.set_sum(2, A, 0.5, M);
    CHECK((combined.dense() - 2 * dense - 0.5 * expanded).norm() < 1e-14 * dense.norm());
    combined.set_sum(2, A, -1, A);
    CHECK((combined.dense() - dense).norm() < 1e-14 * dense.norm());
    A.add(0.5, M);
    CHECK((A.dense() - dense - 0.5 * expanded).norm() < 1e-14 * dense.norm());
    // Local matrices, nodes in any order.
    const std::vector<int> nodes = {25, 6, 5, 11, 10};
    const MatrixXd R = MatrixXd::Random(5 * components, 5 * components), local = R + R.transpose();
    MatrixXd sum = A.dense();
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        sum.block(components * nodes[i], components * nodes[j], components, components) +=
            local.block(components * i, components * j, components, components);
    A.add(nodes, local);
    CHECK((A.dense() - sum).norm() < 1e-14 * sum.norm());
  }
}

TEST_CASE("a sparse factor solves with the free block, whatever is held") {
  for (const int components : {1, 3}) {
    CAPTURE(components);
    const int n_nodes = 50;
    const auto cliques = grid_cliques(7);
    const std::vector<int> held = {0, 1, 48};
    const auto plan = plan_elimination(n_nodes, cliques, held);
    const MatrixXd dense = random_matrix(cliques, n_nodes, components, 3);
    std::vector<int> free;
    for (int e = 0; e < dense.rows(); ++e) {
      const bool node_held = std::count(held.begin(), held.end(), e / components) > 0;
      if (!node_held && e != 17) free.push_back(e);  // one component of a node that else is free
    }
    SparseCholesky cholesky(plan, components, free);
    REQUIRE(cholesky.compute(from_dense(dense, plan, components)));
    const VectorXd b = VectorXd::Random(dense.rows());
    VectorXd x = b;
    cholesky.solve_in_place(x);
    const MatrixXd block = dense(free, free);
    const VectorXd own = b(free), expected = test::least_squares(block, own), found = x(free);
    CHECK((found - expected).norm() < 1e-11 * expected.norm());
    CHECK(x[17] == 0);
    CHECK(cholesky.factor_work().flops > 0);
    CHECK(cholesky.condition_estimate() >= 1);
    // Indefinite in the free block: no factor.
    MatrixXd indefinite = dense;
    indefinite(30, 30) = -1;
    CHECK_FALSE(cholesky.compute(from_dense(indefinite, plan, components)));
    CHECK(std::isinf(cholesky.condition_estimate()));
    indefinite = dense;
    indefinite(17, 17) = -1;  // held
    CHECK(cholesky.compute(from_dense(indefinite, plan, components)));
  }
}

TEST_CASE("the kernels of all sets of instructions agree with plain products") {
  for (const DenseKernels* kernels : available_dense_kernels()) {
    CAPTURE(kernels->name);
    const int m = 37, n = 21, k = 13;
    const MatrixXd A = MatrixXd::Random(m, k), B = MatrixXd::Random(n, k), C = MatrixXd::Random(m, n);
    MatrixXd out = C;
    kernels->add_scaled_product(-0.7, out.data(), m, A.data(), m, B.data(), n, m, n, k);
    CHECK((out - (C - 0.7 * A * B.transpose())).norm() < 1e-12);
    const MatrixXd At = A.transpose(), Bt = B.transpose();
    out = C;
    kernels->add_product(out.data(), m, At.data(), k, Bt.data(), k, m, n, k);
    CHECK((out - (C + A * B.transpose())).norm() < 1e-12);
    const MatrixXd gram = B * B.transpose(), start = MatrixXd::Random(n, n);
    out = start;
    kernels->add_lower_product(out.data(), n, Bt.data(), k, Bt.data(), k, n, k);
    const MatrixXd lower = (start + gram).triangularView<Eigen::Lower>();
    CHECK((MatrixXd(out.triangularView<Eigen::Lower>()) - lower).norm() < 1e-12);
    MatrixXd S = gram + MatrixXd::Identity(n, n), L = S;
    REQUIRE(kernels->cholesky(L.data(), n, n));
    const MatrixXd factor = L.triangularView<Eigen::Lower>();
    CHECK((factor * factor.transpose() - S).norm() < 1e-12 * S.norm());
    MatrixXd X = C;
    kernels->solve_right(L.data(), n, X.data(), m, m, n);
    CHECK((X * factor.transpose() - C).norm() < 1e-11);
    for (const int n_factors : {2, 3}) {
      const MatrixXd G = MatrixXd::Random(n_factors * k, n), F = MatrixXd::Random(k, n_factors);
      const double* factors[] = {F.col(0).data(), F.col(1).data(), F.col(n_factors - 1).data()};
      MatrixXd sum = MatrixXd::Zero(k, n);
      for (int d = 0; d < n_factors; ++d) sum += F.col(d).asDiagonal() * G.middleRows(d * k, k);
      MatrixXd weighed = MatrixXd::Constant(k, n, 9);
      kernels->weigh_rows(weighed.data(), k, factors, n_factors, G.data(), n_factors * k, k, n);
      CHECK((weighed - sum).norm() < 1e-14);
    }
    MatrixXd panel(n + m, n);  // what stands above the diagonal is not read
    panel << factor, C;
    panel.topRows(n).triangularView<Eigen::StrictlyUpper>().setConstant(1e3);
    const MatrixXd whole = MatrixXd(factor.triangularView<Eigen::StrictlyLower>()).transpose() + factor;
    const VectorXd x = VectorXd::Random(n), u = VectorXd::Random(m), before = VectorXd::Random(n);
    VectorXd y = before, v = VectorXd::Constant(m, 9);
    kernels->multiply_panel(panel.data(), n + m, n, m, x.data(), u.data(), y.data(), v.data());
    CHECK((y - (before + whole * x + C.transpose() * u)).norm() < 1e-12);
    CHECK((v - C * x).norm() < 1e-12);
    S(n - 1, n - 1) = -1;
    CHECK_FALSE(kernels->cholesky(S.data(), n, n));
  }
}
