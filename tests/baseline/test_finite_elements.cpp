// The finite elements that the method is measured against, themselves against independent truths.
#include <doctest/doctest.h>

#include <cmath>

#include "src2d/baseline/finite_elements.h"

using namespace sem;
using namespace sem::baseline;

namespace {

const Corners beam = {Vec<2>(0, 0), Vec<2>(4, 0), Vec<2>(4, 1), Vec<2>(0, 1)};
const Corners cook = {Vec<2>(0, 0), Vec<2>(48, 44), Vec<2>(48, 60), Vec<2>(0, 44)};

Problem hanging_beam(double density) {
  Problem problem;
  problem.material = {MaterialModel::neo_log, 1e5, 0.3, density};
  problem.gravity = {0, -10};
  return problem;
}

// Displacement of the middle of the beam's right end.
Vec<2> tip(const Mesh& mesh, const Problem& problem) {
  const Solution solution = solve_static(mesh, problem);
  REQUIRE(solution.converged);
  return solution.displacement.col(mesh.node(2 * mesh.n_x, mesh.n_y));
}

// Displacement of Cook's membrane at (48, 60).
Vec<2> cook_corner(const Mesh& mesh, double nu) {
  Problem problem;
  problem.material = {MaterialModel::neo_log, 240.565, nu, 0};
  problem.traction[right] = {0, 20. / 16};
  const Solution solution = solve_static(mesh, problem);
  REQUIRE(solution.converged);
  return solution.displacement.col(mesh.node(2 * mesh.n_x, 2 * mesh.n_y));
}

}  // namespace

TEST_CASE(
    "patch test: an affine displacement of all sides is that of all nodes, for every material") {
  Mat<2> A;
  A << 0.02, 0.01, -0.015, 0.03;
  const Mesh mesh = quadrilateral_mesh(cook, 3, 4, 1.5);
  for (const auto model :
       {MaterialModel::linear, MaterialModel::stvk, MaterialModel::corotated,
        MaterialModel::neo_log, MaterialModel::neo_ref, MaterialModel::neo_iso}) {
    CAPTURE(name(model));
    Problem problem;
    problem.material = {model, 1e5, 0.3, 0};
    problem.held = {true, true, true, true};
    problem.held_displacement = [&](const Vec<2>& X) -> Vec<2> { return A * X; };
    const Solution solution = solve_static(mesh, problem);
    CHECK(solution.converged);
    CHECK((solution.displacement - A * mesh.nodes).norm() < 1e-9 * mesh.nodes.norm());
    const Mat<2> F = Mat<2>::Identity() + A;
    CHECK(solution.energy ==
          doctest::Approx(1440 * energy_density<2>(problem.material, F)));  // area 1440 m^2
  }
}

TEST_CASE("elements fill the quadrilateral, anticlockwise, and their edges are straight") {
  const Mesh mesh = quadrilateral_mesh(cook, 5, 3, 2, true);
  double area = 0;
  for (const auto& element : mesh.elements) {
    Mat<2> edges;
    edges << mesh.nodes.col(element[1]) - mesh.nodes.col(element[0]),
        mesh.nodes.col(element[2]) - mesh.nodes.col(element[0]);
    CHECK(edges.determinant() > 0);
    area += edges.determinant() / 2;
    for (int a = 0; a < 3; ++a)
      CHECK((mesh.nodes.col(element[3 + a]) -
             (mesh.nodes.col(element[a]) + mesh.nodes.col(element[(a + 1) % 3])) / 2)
                .norm() < 1e-12);
  }
  CHECK(area == doctest::Approx(1440));
}

TEST_CASE(
    "cantilever: the tip's error is that of another program's quadratic triangles, of order "
    "h^1.4") {
  // Truth: graded finite elements of high degree. Errors of the other program's quadratic
  // triangles.
  double last = 0;
  for (const auto& [n, n_unknowns, expected] :
       {std::tuple(4, 594, 4e-3), std::tuple(8, 2210, 1.5e-3), std::tuple(16, 8514, 5.6e-4)}) {
    const Mesh mesh = quadrilateral_mesh(beam, 4 * n, n);
    CHECK(mesh.nodes.size() == n_unknowns);
    const double error = std::abs(tip(mesh, hanging_beam(10))[1] / -0.3684452 - 1);
    CHECK(error == doctest::Approx(expected).epsilon(0.03));
    if (last > 0)
      CHECK(std::log2(last / error) ==
            doctest::Approx(1.4).epsilon(0.1));  // the clamp's corners limit it
    last = error;
  }
}

TEST_CASE("cantilever: a graded grid finds tip and energy at all loads to 4e-4") {
  struct Truth {
    double density, ux, uy, energy;
  };
  const Mesh mesh = quadrilateral_mesh(beam, 48, 12, 2);
  for (const Truth& truth :
       {Truth{1, -1.774756e-4, -0.03703440, 0.3085726},
        Truth{10, -0.01760132, -0.3684452, 30.65339}, Truth{20, -0.0687034, -0.725788, 120.2350},
        Truth{40, -0.25118, -1.37317, 447.63}}) {
    CAPTURE(truth.density);
    const Vec<2> u = tip(mesh, hanging_beam(truth.density));
    CHECK(u[0] == doctest::Approx(truth.ux).epsilon(4e-4));
    CHECK(u[1] == doctest::Approx(truth.uy).epsilon(4e-4));
    CHECK(solve_static(mesh, hanging_beam(truth.density)).energy ==
          doctest::Approx(truth.energy).epsilon(4e-4));
  }
}

TEST_CASE("Cook's membrane: the corner's error is that of another program's quadratic triangles") {
  for (const auto& [n, expected] : {std::pair(8, 0.016), std::pair(32, 3e-3)}) {
    const Vec<2> u = cook_corner(quadrilateral_mesh(cook, n, n), 0.3);
    CHECK(std::abs(u[1] / 1.840498 - 1) == doctest::Approx(expected).epsilon(0.05));
  }
  const Vec<2> u = cook_corner(quadrilateral_mesh(cook, 32, 32, 2, true), 0.3);
  CHECK(u[0] == doctest::Approx(-1.438027).epsilon(1e-3));
  CHECK(u[1] == doctest::Approx(1.840498).epsilon(1e-3));
}

TEST_CASE("without a held side the Hessian is singular and the report says so") {
  Problem problem = hanging_beam(10);
  problem.held = {false, false, false, false};
  CHECK(!solve_static(quadrilateral_mesh(beam, 4, 2), problem).converged);
}
