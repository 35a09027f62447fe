// Step 5: a page of finite elements
//
//   build/release/bin/sem2d_step_05_finite_elements --out out/step_05        numbers, pictures
//   build/release/bin/sem2d_step_05_finite_elements --until 2 --set rings=6  a finer mesh
//   build/release/bin/sem2d_step_05_finite_elements --interactive            drag the point X
//
// New here: what the method replaces, for the solid of step 2 on a mesh of linear triangles (the
// draft leaves a gap for an "Exposition about FEM"). N_a is 1 at node a and 0 at all others.
//
//   (a)   x(X) = sum_a N_a(X) x_a                          inside an element: three nodes
//   (b)   F = dx/dX = sum_a x_a grad N_a^T                 constant in an element: vec F = B x
//   (c)   V = sum_e Psi(F_e) v_e                           one quadrature point an element
//   (d)   f = -dV/dx,   K = sum_e B^T C B v_e              C = dP/dF
//
// [5] is the dictionary: in the method x(X) = sum_j Gamma_j(X) p_j with the boundary's control
// points in place of nodes, and (b), (c), (d) stay. Erratum: "the four surrounding nodal values"
// before (14) is true in tetrahedra; here there are three.
//
// Things to try: rings = 6: which entries of the table grow? X outside of the solid: what is N?
#include <Eigen/LU>

#include "sem/lesson/lesson.h"
#include "sem/mechanics/material.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/discretization.h"
#include "sem/nurbs/refine.h"
#include "src2d/tutorials/drawing.h"
#include "src2d/tutorials/matrices.h"
#include "src2d/tutorials/mesh.h"

using namespace sem;
using namespace sem::tutorial;

namespace {
struct Triangle {
  Eigen::Matrix<double, 3, 2> gradient;  // grad N_a in rows
  double area;
};
Triangle triangle(const Mesh& mesh, int e) {
  const auto& [a, b, c] = mesh.element[e];
  Mat<2> edges;  // X = X_a + edges (N_b, N_c)
  edges << mesh.node.col(b) - mesh.node.col(a), mesh.node.col(c) - mesh.node.col(a);
  Triangle t{{}, edges.determinant() / 2};
  t.gradient.bottomRows<2>() = edges.inverse();
  t.gradient.row(0) = -t.gradient.row(1) - t.gradient.row(2);  // the N_a sum to 1
  return t;
}

Mat<2> deformation_gradient(const Mesh& mesh, int e, const Points<2>& x) {
  return x(Eigen::all, mesh.element[e]) * triangle(mesh, e).gradient;  // (b)
}

// (d) B^T C B v of one quadrature point; gradients of the functions in rows. Unknowns x_0x, x_0y,
// x_1x, ...; vec F = (F_xx, F_yx, F_xy, F_yy).
MatrixXd point_stiffness(const MatrixXd& gradient, const StressDerivative<2>& C, double v) {
  MatrixXd B = MatrixXd::Zero(4, gradient.size());
  for (int a = 0; a < gradient.rows(); ++a)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) B(i + 2 * j, 2 * a + i) = gradient(a, j);
  const MatrixXd CB = C * B;
  return v * (B.transpose() * CB);
}

Eigen::SparseMatrix<double> stiffness(const Mesh& mesh, const StressDerivative<2>& C) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int e = 0; e < int(mesh.element.size()); ++e) {
    const Triangle t = triangle(mesh, e);
    const MatrixXd K = point_stiffness(t.gradient, C, t.area);
    const auto unknown = [&](int r) { return 2 * mesh.element[e][r / 2] + r % 2; };
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) entries.emplace_back(unknown(r), unknown(c), K(r, c));
  }
  Eigen::SparseMatrix<double> K(mesh.node.size(), mesh.node.size());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}
}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 5: a page of finite elements", {{-0.3, -0.3}, {4.3, 3.5}});

  // [1] The inside has to be cut into elements first. Straight edges miss a little of the solid.
  const Curves curves = three_curves(three_points());
  int rings = 3;
  Mesh mesh;
  lesson.slider("rings", rings, 1, 6, "of elements");
  lesson.step(
      "A mesh",
      [&](std::ostream& out) {
        mesh = ring_mesh(curves, {1.7, 1.2}, rings);
        VectorXd area(mesh.element.size());
        for (int e = 0; e < area.size(); ++e) area[e] = triangle(mesh, e).area;
        const auto boundary = make_boundary<2>({curves});
        const double truth = boundary_moments(boundary, find_loops(boundary)).volume;
        out << mesh.node.cols() << " nodes, " << area.size() << " elements, area "
            << rounded(area.sum(), 5) << ", error " << error_text(area.sum() / truth - 1) << "\n";
      },
      [&](Picture& picture) {
        draw_mesh(picture, mesh, mesh.node, colors::gray);
        picture.dots(mesh.node, colors::gray, 7);
        draw_parts(picture, curves, "", 3);
        read_elements(picture, mesh, mesh.node,
                      [&](int e) { return reading("area, m²", triangle(mesh, e).area); });
      });

  // [2] Nodes move to x_a: here on a parabola. In an element x(X) is their mean with weights
  // N_a(X). From one element to the next x is continuous, F jumps.
  double bend = 0.05;
  Vec<2> X(2.8, 1.2);
  Points<2> x;
  int element = 0;  // that holds X
  Eigen::Vector3d N;
  lesson.slider("bend", bend, -0.2, 0.2, "1/m, of the nodes' motion");
  lesson.handle("X", X, "a point, at rest");
  lesson.step(
      "In one element: N_a, x and F",
      [&](std::ostream& out) {
        x = mesh.node;
        x.row(1) += bend * mesh.node.row(0).cwiseAbs2();
        N.setConstant(-99);
        for (int e = 0; e < int(mesh.element.size()); ++e) {
          const Vec<2> d = X - mesh.node.col(mesh.element[e][0]);
          const Eigen::Vector3d here = Eigen::Vector3d::UnitX() + triangle(mesh, e).gradient * d;
          if (here.minCoeff() > N.minCoeff()) N = here, element = e;
        }
        const Vec<2> at = x(Eigen::all, mesh.element[element]) * N;  // (a)
        out << "N: " << list(N) << "; sum - 1: " << error_text(N.sum() - 1) << "\nx: " << list(at)
            << "\nF_yx: " << rounded(deformation_gradient(mesh, element, x)(1, 0), 4)
            << ", of the parabola: " << rounded(2 * bend * X[0], 4) << "\n";
      },
      [&](Picture& picture) {
        draw_mesh(picture, mesh, x, colors::gray);
        const Points<2> corners = x(Eigen::all, mesh.element[element]);
        picture.fill(corners, blue.with_alpha(0.3));
        for (int a = 0; a < 3; ++a) {
          picture.dot(corners.col(a), blue, 8 + 20 * std::max(0.0, N[a]));
          const Vec<2> off = 25 * (corners.col(a) - corners * N).normalized();
          picture.label(corners.col(a), "N = " + rounded(N[a], 2), blue, {off[0], -off[1]});
        }
        picture.dot(corners * N, red, 13);
        read_elements(picture, mesh, x, [&](int e) {
          return "F = " + list(deformation_gradient(mesh, e, x).reshaped<Eigen::RowMajor>(), 3);
        });
      });

  // [3] Linear elasticity: Psi is quadratic, so V = u K u / 2 for displacements u. K couples nodes
  // of one element only: the finer the mesh, the sparser K.
  const Material material{.model = MaterialModel::linear};  // E = 1e5 Pa, nu = 0.3
  const StressDerivative<2> C = stress_derivative<2>(material, Mat<2>::Identity());
  Eigen::SparseMatrix<double> K;
  VectorXd f;
  lesson.step(
      "Energy, forces, stiffness",
      [&](std::ostream& out) {
        K = stiffness(mesh, C);
        const VectorXd u = (x - mesh.node).reshaped();
        f = -(K * u);                                   // (d)
        const auto energy = [&](const Points<2>& at) {  // (c)
          double V = 0;
          for (int e = 0; e < int(mesh.element.size()); ++e)
            V += triangle(mesh, e).area *
                 energy_density<2>(material, deformation_gradient(mesh, e, at));
          return V;
        };
        const double V = energy(x);
        const Vec<2> sum = f.reshaped(2, x.cols()).rowwise().sum();
        out << "V = " << rounded(V, 5) << " J, off from u K u / 2 by "
            << error_text(-u.dot(f) / 2 - V, 1e-6)
            << " J; sum of the forces: " << error_text(sum.norm(), 1e-6) << " N\n";
      },
      [&](Picture& picture) {
        draw_mesh(picture, mesh, x, colors::gray);
        const double longest = f.cwiseAbs().maxCoeff();
        for (int a = 0; a < x.cols() && longest > 0; ++a)
          picture.arrow(x.col(a), 0.6 / longest * f.segment<2>(2 * a), red);
        picture.note("forces on the nodes, in balance: inside they nearly cancel");
        picture.hover(x, [&](int a) { return "f = " + coordinates(f.segment<2>(2 * a)) + " N"; });
      });

  // [4] The patch test: an affine motion of the boundary has to go on inside, whatever the mesh.
  VectorXd u;
  lesson.step(
      "The patch test",
      [&](std::ostream& out) {
        const Mat<2> A{{0.05, 0.2}, {-0.1, -0.05}};
        const VectorXd exact = (A * mesh.node).reshaped();
        std::vector<bool> free(K.rows(), true);
        std::fill(free.end() - 2 * mesh.n_boundary, free.end(), false);
        u = solve_free(K, free, VectorXd::Zero(K.rows()), exact);
        out << "largest error inside: " << error_text((u - exact).cwiseAbs().maxCoeff()) << "\n";
      },
      [&](Picture& picture) {
        draw_mesh(picture, mesh, mesh.node, colors::light_gray);
        const Points<2> moved = mesh.node + u.reshaped(2, mesh.node.cols());
        draw_mesh(picture, mesh, moved, blue);
        read_motion(picture, mesh.node, moved);
        picture.note(
            "grey: at rest; blue: the boundary moves affinely, the inside follows exactly");
      });

  // [5] The method needs no mesh and fewer unknowns; but each point depends on many of them, K is
  // full, and some motions have no energy if a part has more control points than coefficients.
  int inserted = 4;
  Discretization<2> method;
  lesson.slider("knots", inserted, 0, 8, "inserted into each curve: as many control points more");
  lesson.step(
      "Finite elements and the method",
      [&](std::ostream& out) {
        Curves parts = curves;
        for (auto& part : parts)
          for (int k = 1; k <= inserted; ++k) part = insert_knot(part, 0, k / (inserted + 1.0));
        MethodOptions options;
        options.weights.cutoff = 2;
        options.projection.degree = 2;
        method = discretize<2>({parts}, options);
        const MatrixXd Gx = dense_gradient(method.interior, 0),
                       Gy = dense_gradient(method.interior, 1);
        MatrixXd K2 = MatrixXd::Zero(2 * Gx.cols(), 2 * Gx.cols()), gradient(Gx.cols(), 2);
        for (int k = 0; k < Gx.rows(); ++k) {
          gradient << Gx.row(k).transpose(), Gy.row(k).transpose();
          K2 += point_stiffness(gradient, C, method.quadrature.weight[k]);  // (d)
        }
        const double filled = double((K2.array().abs() > 1e-9 * K2.maxCoeff()).count());
        const auto n = [](double value) { return rounded(value, 3); };
        out << table(
            {"", "elements", "method"},
            {{"unknown vectors", n(mesh.node.cols()), n(method.boundary.n_controls())},
             {"quadrature points", n(mesh.element.size()), n(Gx.rows())},
             {"unknowns that count at a point", n(mesh.element[0].size()),
              n(method.interior.fill() * Gx.cols())},
             {"% of K filled", n(100.0 * K.nonZeros() / K.size()), n(100 * filled / K2.size())},
             {"motions without energy", n(kernel(K, 1e-9).cols()), n(kernel(K2, 1e-9).cols())}});
      },
      [&](Picture& picture) {
        const MatrixXd Gamma = dense_value(map_at(method, Points<2>(X), false));
        const Points<2> p = rest_controls(method.boundary),
                        nodes = mesh.node(Eigen::all, mesh.element[element]);
        for (const int side : {0, 1}) {
          picture.set_view(lesson.world(), picture.part({side / 2.0, 0.05}, {(side + 1) / 2.0, 1}));
          if (side == 0) draw_mesh(picture, mesh, mesh.node, colors::light_gray);
          draw_parts(picture, curves, "", 3);
          if (side == 0) draw_influence(picture, X, nodes, N, "N");
          if (side == 1) draw_influence(picture, X, p, Gamma.row(0).transpose(), "Γ");
        }
        picture.note("x(X): three nodes of a mesh inside, or the control points of the boundary");
      });
  return lesson.run(argc, argv);
}
// Next: step_06_weights, how much each of several parts counts at a point.
