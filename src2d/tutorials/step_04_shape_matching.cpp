// Step 4: shape matching of one part
//
//   build/release/bin/sem2d_step_04_shape_matching --out out/step_04    numbers, pictures
//   build/release/bin/sem2d_step_04_shape_matching --until 2 --set n=3  cubic
//   build/release/bin/sem2d_step_04_shape_matching --interactive        drag the control points
//
// New here: one closed curve, one polynomial; where the boundary goes, the inside follows. J is of
// step 1, the fits are of step 3, now weighted by the length v_s that a sample stands for:
//
//   (4)   xbar = sum_s v_s x_s / sum_s v_s                 Xbar likewise, at rest
//   (5)   Pi = argmin sum_s v_s |Pi m(X_s - Xbar) - (x_s - xbar)|^2,   degree by degree
//   (2)   x(X) = Pi m(X - Xbar) + xbar
//   (6)   x(X) = sum_j Gamma_j(X) p_j                      all of this is linear in p
//
// Erratum: (4) is the samples' plain mean in the draft, as "centre of mass": [1]. Neighbours:
// Mueller et al. 2005, "Meshless deformations based on shape matching": [4]; virtual elements: [5].
//
// Things to try: [4] turn all of p: R follows. [6] n = 3: nothing is blind, as c has more entries.
#include "sem/lesson/lesson.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/projection.h"
#include "sem/nurbs/basis.h"
#include "src2d/shapes/shapes.h"
#include "src2d/tutorials/drawing.h"
#include "src2d/tutorials/matrices.h"

using namespace sem;
using namespace sem::tutorial;

namespace {
Nurbs<1, 2> closed_curve(const Points<2>& p) {
  return shapes2d::make_parts(shapes2d::ClosedCurve{p})[0].shape;
}

// 2005: A = A_pq A_qq, the affine fit of positions x of the samples.
Mat<2> matching(const Samples<2>& samples, const MatrixXd& x) {
  const VectorXd& v = samples.weight;
  const MatrixXd q = samples.position.colwise() - Vec<2>(samples.position * v / v.sum());
  return moments(x, v, q) * pseudo_inverse(moments(q, v, q));
}
// The virtual element method's: the mean of dx/dX inside = 1/area boundary integral of x N^T.
Mat<2> mean_gradient(const Boundary<2>& rest, const Samples<2>& samples, const MatrixXd& x) {
  MatrixXd N = x;  // normals
  for (int s = 0; s < N.cols(); ++s) {
    const auto X = derivatives(rest.parts[samples.part[s]].nurbs, samples.u[s], 1);
    N.col(s) = DimTraits<2>::area_normal(X.first).normalized();
  }
  const double area = moments(samples.position, samples.weight, N).trace() / 2;
  return moments(x, samples.weight, N) / area;
}

Points<2> outline_of(const Points<2>& p) { return polyline(closed_curve(p), 200); }
const Color light = colors::light_gray;

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 4: shape matching of one part", {{-0.5, -0.6}, {5.5, 4.1}});

  // [1] The curve at rest and its samples: dense where it runs slowly through its parameter.
  constexpr int m = 9;
  Points<2> p0(2, m), p(2, m);
  p0 << 0.0, 0.5, 1.3, 3.0, 4.8, 5.0, 2.8, 1.2, 0.3,  //
      0.9, 0.2, 0.1, 0.8, -0.2, 2.0, 1.5, 2.5, 2.1;
  int per_span = 5;
  const Points<2> outline = outline_of(p0);
  Boundary<2> boundary;
  Samples<2> samples;
  MatrixXd J;
  Vec<2> Xbar;
  Points<2> middles(2, 3);
  lesson.slider("per_span", per_span, 4, 9, "samples in each knot span");
  lesson.step(
      "Samples, and three kinds of middle",
      [&](std::ostream& out) {
        boundary = make_boundary<2>({{closed_curve(p0)}});
        samples = sample_boundary(boundary, {.points_per_span = per_span});
        const MatrixXd all = sample_jacobian(samples, m + 3);  // p1, p2, p3 count again at the end
        J = all.leftCols(m);
        J.leftCols(3) += all.rightCols(3);
        Xbar = samples.position * samples.weight / samples.weight.sum();  // (4)
        const auto inside = boundary_moments(boundary, find_loops(boundary));
        middles << Xbar, samples.position.rowwise().mean(), inside.first / inside.volume;
        print(out, "Xbar, plain mean (the draft), centre of mass", middles);
      },
      [&](Picture& picture) {
        draw_outline(picture, outline, light);
        picture.dots(samples.position, colors::gray, 9);
        picture.dot(middles.col(2), green, 16, MarkerShape::diamond);
        picture.dot(middles.col(1), red, 18, MarkerShape::cross);
        picture.dot(Xbar, blue, 20, MarkerShape::plus);
        picture.legend({{"Xbar, (4) by length", blue, MarkerShape::plus},
                        {"plain mean of the samples", red, MarkerShape::cross},
                        {"centre of mass", green, MarkerShape::diamond}});
        read_values(picture, samples.position, samples.weight, "length of the sample, m");
      });

  // [2] Control points move to p, samples to J p, and the polynomial follows.
  int n = 2;
  p << -0.1, 0.5, 1.3, 3.2, 5.0, 5.2, 2.8, 0.9, 0.2,  //
      1.5, 0.4, -0.1, -0.2, 1.3, 3.6, 1.3, 3.4, 2.5;
  VectorXd root;         // of the samples' weights: sum v |x|^2 = |root x|^2
  Eigen::RowVectorXd t;  // m entries; times p: xbar
  MatrixXd K;            // #monomials by m; times p: the transpose of Pi
  const auto fit = [&](const Points<2>& X) -> Points<2> {  // (2)
    return p * ((monomial_rows(n, X, Xbar) * K).rowwise() + t).transpose();
  };
  const auto weighted = [&](const MatrixXd& rows) -> MatrixXd { return root.asDiagonal() * rows; };
  const auto rms = [&](const MatrixXd& x) { return rounded(weighted(x).norm() / root.norm(), 3); };
  const auto affine_image = [&](const Mat<2>& A) -> Points<2> {
    return (A * (outline.colwise() - Xbar)).colwise() + p * t.transpose();
  };
  lesson.slider("n", n, 1, 4, "degree of the polynomial");
  lesson.handles("p", p, "control point, deformed");
  lesson.step(
      "The polynomial of a part",
      [&](std::ostream& out) {
        root = samples.weight.cwiseSqrt();
        t = samples.weight.transpose() * J / samples.weight.sum();  // (4)
        const MatrixXd M = monomial_rows(n, samples.position, Xbar), P = J.rowwise() - t;
        MatrixXd rest = P;
        K.resize(M.cols(), m);
        for (int k = 1, first = 0; k <= n; first += k + 1, ++k) {  // (5)
          const MatrixXd M_k = M.middleCols(first, k + 1);
          K.middleRows(first, k + 1) = least_squares(weighted(M_k), weighted(rest));
          rest -= M_k * K.middleRows(first, k + 1);
          out << "left after degree " << k << ":       " << rms(rest * p.transpose()) << "\n";
        }
        const MatrixXd once = M * least_squares(weighted(M), weighted(P));
        out << "left, all degrees at once: " << rms((P - once) * p.transpose()) << "\n";
        const auto origins = origins_from_sets<2>({{0}}, {0}, samples);
        const auto part = fit_on_controls(project(samples, origins, {.degree = n}), 0);
        MatrixXd x = monomial_rows(n, (samples.position.colwise() - Xbar) / part.scale, {0, 0}) *
                     part.coefficients;
        x.leftCols(3) += x.rightCols(3);
        out << "library's - ours: " << error_text((x.leftCols(m) - M * K).norm(), 1e-10) << "\n";
      },
      [&](Picture& picture) {
        draw_outline(picture, outline, light);
        draw_outline(picture, outline_of(p), red);
        draw_outline(picture, fit(outline), blue, outline_of(p), "left over, m");
        picture.legend({{"rest", light}, {"x = J p", red}, {"Pi m + xbar", blue}});
      });

  // [3] (6): each control point of the part counts everywhere; its weight may be negative.
  Vec<2> X(4.5, 0.7);
  Eigen::RowVectorXd Gamma;
  lesson.handle("X", X, "a point of the inside, at rest");
  lesson.step(
      "x(X) is linear in p",
      [&](std::ostream& out) {
        Gamma = monomial_rows(n, X, Xbar) * K + t;  // (6)
        out << "Gamma(X): " << list(Gamma, 2) << "\nsum - 1:       " << error_text(Gamma.sum() - 1)
            << "\nGamma p - (2): " << error_text((p * Gamma.transpose() - fit(X)).norm()) << "\n";
      },
      [&](Picture& picture) {
        draw_outline(picture, outline, light);
        draw_influence(picture, X, p0, Gamma.transpose(), "Γ");
        for (int j = 0; j < m; ++j)
          picture.label(p0.col(j), rounded(Gamma[j], 2), Gamma[j] > 0 ? blue : red);
        picture.note("shares of the control points in x(X): blue positive, red negative");
      },
      [&](const Vec<2>& at) {
        return "Γ = " + list((monomial_rows(n, at, Xbar) * K + t).transpose(), 2);
      });

  // [4] 2005: masses at points (here v_s), A = A_pq A_qq. Goals that points are pulled to: by A's
  // rotation R, by beta A + (1 - beta) R; quadratic by q2 = (x, y, x^2, x y, y^2) in place of q.
  double beta = 0.5;
  Mat<2> A, R;
  lesson.slider("beta", beta, 0, 1, "goals from R (0) to A (1)");
  lesson.step(
      "Shape matching of 2005 is the case n = 1",
      [&](std::ostream& out) {
        const VectorXd& v = samples.weight;
        const MatrixXd x = p * (J.rowwise() - t).transpose();
        const MatrixXd q = samples.position.colwise() - Xbar;
        const MatrixXd q2 = monomial_rows(2, q, {0, 0}).transpose();
        A = matching(samples, x);
        R = rotation(A);
        const MatrixXd A2 = moments(x, v, q2) * pseudo_inverse(moments(q2, v, q2));
        const MatrixXd once = least_squares(weighted(q2.transpose()), weighted(x.transpose()));
        const auto left = [&](const MatrixXd& goal) { return rms((goal - x).transpose()); };
        print(out, "A", A);
        out << "A - linear part of Pi: " << error_text((A - p * K.topRows(2).transpose()).norm())
            << "\ngoals - samples: R " << left(R * q) << ", A " << left(A * q) << ", quadratic "
            << left(A2 * q2) << "\nquadratic A - Pi of (5) at once: "
            << error_text((A2 - once.transpose()).norm(), 1e-10) << "\n";
      },
      [&](Picture& picture) {
        draw_outline(picture, outline_of(p), red);
        draw_outline(picture, affine_image(A), blue, outline_of(p), "from A to J p, m");
        draw_outline(picture, affine_image(beta * A + (1 - beta) * R), green, outline_of(p),
                     "from goal to J p, m");
        picture.legend({{"x = J p", red}, {"A", blue}, {"goals", green}});
      });

  // [5] Virtual elements project by the mean gradient and have two energies, too: of the projection
  // ("consistency") and of the rest ("stability"). Both projectors keep affine motions.
  Mat<2> mean;
  lesson.step(
      "Where the virtual element method meets it",
      [&](std::ostream& out) {
        const auto gap = [](const Boundary<2>& rest, const Samples<2>& at, const MatrixXd& x) {
          return error_text((matching(at, x) - mean_gradient(rest, at, x)).norm());
        };
        Curves arcs;
        for (const auto& arc : shapes2d::make_parts(shapes2d::Disc{})) arcs.push_back(arc.shape);
        const auto circle = make_boundary<2>({arcs});
        const auto on_circle = sample_boundary(circle, {.points_per_span = 8});
        Points<2> bent = on_circle.position, sheared = samples.position;
        bent.row(0) += 0.3 * bent.row(1).cwiseAbs2();
        sheared.row(0) += 0.3 * sheared.row(1);
        mean = mean_gradient(boundary, samples, p * J.transpose());
        out << "shape matching - mean gradient:\n  circle, bent: " << gap(circle, on_circle, bent)
            << "\n  our curve, sheared: " << gap(boundary, samples, sheared)
            << "\n  our curve, as it is: " << error_text((A - mean).norm()) << "\n";
      },
      [&](Picture& picture) {
        draw_outline(picture, outline_of(p), red);
        draw_outline(picture, affine_image(A), blue);
        draw_outline(picture, affine_image(mean), green, affine_image(A), "between both, m");
        picture.legend({{"x = J p", red}, {"shape matching", blue}, {"mean gradient", green}});
      });

  // [6] p has m vectors, c and t have (n + 1)(n + 2) / 2: what is left moves the boundary only.
  double amount = 3;
  Points<2> blind;
  lesson.slider("amount", amount, -5, 5, "of the blind motion");
  lesson.step(
      "What the projection does not see",
      [&](std::ostream& out) {
        MatrixXd S(K.rows() + 1, m);
        S << K, t;
        const MatrixXd seen = least_squares(S, S * (p - p0).transpose());  // least with these c, t
        blind = p - p0 - seen.transpose();
        out << m << " control points, " << S.rows() << " coefficients, " << m - rank(S)
            << " blind motions\nblind part of p - p0: boundary moves by "
            << rms(J * blind.transpose()) << ", coefficients by "
            << error_text((S * blind.transpose()).norm(), 1e-9) << "\n";
      },
      [&](Picture& picture) {
        draw_outline(picture, outline_of(p0 + amount * blind), red, outline, "moved by, m");
        draw_outline(picture, outline, blue);
        picture.legend({{"x = J p", red}, {"Pi m + xbar stays", blue}});
      });
  return lesson.run(argc, argv);
}
// Next: step_05_finite_elements, what the method replaces.
