// Step 1: a NURBS curve and its Jacobian
//
//   build/release/bin/sem2d_step_01_curve --out out/step_01     numbers and a picture of each step
//   build/release/bin/sem2d_step_01_curve --until 2 --set u=0.5  the first two, elsewhere
//   build/release/bin/sem2d_step_01_curve --interactive          step through it, drag the points
//
// New here: the method simulates solids that are known by their boundary alone, and the boundary is
// made of NURBS curves. Their control points p are all that ever moves. This tutorial goes from p
// to points of the boundary, and to how these move when p moves:
//
//   (7)   x(u) = sum_i p_i w_i B_i,k(u) / sum_j w_j B_j,k(u)     a curve of degree k - 1
//   (9)   x(u, p) = J(u) p                                        the same as a matrix product
//   (11)  X(u) = J(u) p_0                                         at rest
//   (10)  q = J p                                                 many points at once
//
// Errata of the draft: (7) and (8) lack the sum in the denominator; without it x(u) is no mean of
// control points. (9) leaves out what J looks like ("elaborate on the form of J"): see [3]. (10)
// writes J(u, v), the matrix of one point, where it needs the stacked one of all samples: see [4].
//
// Things to try: w4 from 0.1 to 10: the curve leaves p4 or is drawn to it, R_4 grows at the others'
// cost. Degree 1 and 5: how many control points does x(u) feel, how many entries has its row of J?
// per_span=2: the rank of J falls below 7, and p does not come back from q.
#include <cmath>

#include "sem/lesson/lesson.h"
#include "sem/method/samples.h"
#include "sem/nurbs/basis.h"
#include "sem/nurbs/closest.h"
#include "src2d/tutorials/drawing.h"
#include "src2d/tutorials/matrices.h"
#include "sem/lesson/plots.h"

using namespace sem;

namespace {

// B_i of degree d at u: the recursion of Cox and de Boor over the knots t. Degree 0 is 1 on a knot
// span and 0 elsewhere; degree d lets B_i of degree d - 1 fade in and its neighbour fade out. 0/0
// (repeated knots) counts as 0. The library's evaluate_basis gives the same, faster.
double bspline(const std::vector<double>& t, int i, int d, double u) {
  if (d == 0) return (t[i] <= u && u < t[i + 1]) || (t[i] < u && u == t[i + 1] && u == t.back());
  const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0.0; };
  return ratio(u - t[i], t[i + d] - t[i]) * bspline(t, i, d - 1, u) +
         ratio(t[i + d + 1] - u, t[i + d + 1] - t[i + 1]) * bspline(t, i + 1, d - 1, u);
}

// Knots from 0 to 1. The ends are repeated d + 1 times, so that the curve starts in the first
// control point and ends in the last; the spans between are equal.
std::vector<double> clamped_knots(int n, int d) {
  std::vector<double> t(d + 1, 0.0);
  for (int i = 1; i < n - d; ++i) t.push_back(double(i) / (n - d));
  t.insert(t.end(), d + 1, 1.0);
  return t;
}

// R_i(u) = w_i B_i(u) / sum_j w_j B_j(u), n of them: the factors of the p_i in (7).
Eigen::VectorXd rational_basis(const Nurbs<1, 2>& curve, double u) {
  Eigen::VectorXd wB = curve.weights;
  for (int i = 0; i < wB.size(); ++i) wB[i] *= bspline(curve.knots[0], i, curve.degree[0], u);
  return wB / wB.sum();
}

// x(u) = sum_i p_i R_i(u), eq. (7).
Vec<2> position(const Nurbs<1, 2>& curve, double u) {
  return curve.control_points * rational_basis(curve, u);
}

Points<2> graph(const Nurbs<1, 2>& curve) {
  Points<2> points(2, 201);
  for (int k = 0; k <= 200; ++k) points.col(k) = position(curve, k / 200.0);
  return points;
}

const Color gray = colors::gray, blue = colors::categorical(0), red = colors::categorical(1);
const std::string subscript[] = {"₁", "₂", "₃", "₄", "₅", "₆", "₇"};
const std::vector<std::string> R_names = {"R₁", "R₂", "R₃", "R₄", "R₅", "R₆", "R₇"};

void draw_curve(Picture& picture, const Nurbs<1, 2>& curve) {
  picture.curve(curve.control_points, {.color = colors::light_gray, .width = 2});
  picture.curve(graph(curve), {.color = blue, .width = 4});
  picture.dots(curve.control_points, gray, 11);
  for (int i = 0; i < curve.control_points.cols(); ++i)
    picture.label(curve.control_points.col(i), "p" + subscript[i], gray);
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 1: a NURBS curve and its Jacobian", {{-0.2, -0.3}, {4.4, 2.6}});

  // [1] Degree, knots, weights and control points make the curve.
  int degree = 3;
  double w4 = 1;
  Points<2> p(2, 7);
  p << 0.2, 0.6, 1.6, 2.0, 3.0, 3.9, 3.4,  // x
      0.3, 2.0, 2.3, 0.4, 0.2, 1.0, 2.2;   // y
  const int n = int(p.cols());
  Nurbs<1, 2> curve;
  const auto nearest = [&](const Vec<2>& X) {  // shown under the mouse
    const double at = closest_point<2>(prepare(curve), X).u[0];
    return "u = " + rounded(at, 3) + ": x = " + tutorial::coordinates(position(curve, at)) +
           "\nR = " + tutorial::list(rational_basis(curve, at), 2);
  };
  lesson.slider("degree", degree, 1, 5, "of the curve");
  lesson.slider("w4", w4, 0.1, 10, "weight of p4, the others have 1", Lesson::Scale::logarithmic);
  lesson.handles("p", p, "control point");
  lesson.step(
      "The curve and its control points",
      [&](std::ostream& out) {
        const Eigen::VectorXd weights{{1, 1, 1, w4, 1, 1, 1}};
        curve = {{degree}, {clamped_knots(n, degree)}, p, weights};
        out << n << " control points, " << curve.knots[0].size() << " knots:\n"
            << rounded(Eigen::RowVectorXd::Map(curve.knots[0].data(), n + degree + 1), 3);
      },
      [&](Picture& picture) {
        draw_curve(picture, curve);
        for (const auto& span : spans(curve, 0))
          picture.dot(position(curve, span.upper), blue, 12, MarkerShape::diamond);
        picture.legend({{"ends of spans", blue, MarkerShape::diamond}});
      },
      nearest);

  // [2] Every control point has a function of u that says how much it counts there.
  double u = 0.35;
  Eigen::VectorXd R;
  lesson.slider("u", u, 0, 1, "parameter of the point x(u)");
  lesson.step(
      "Basis functions: how much each control point counts at u",
      [&](std::ostream& out) {
        R = rational_basis(curve, u);
        out << "R_1 to R_7:" << rounded(R.transpose(), 4, " ")
            << "their sum - 1: " << error_text(R.sum() - 1) << "\n"
            << "x(u) = sum R_i p_i:" << rounded(position(curve, u).transpose(), 4, " ");
      },
      [&](Picture& picture) {
        Eigen::MatrixXd values(n, 257);
        for (int k = 0; k <= 256; ++k) values.col(k) = rational_basis(curve, k / 256.0);
        tutorial::draw_columns(picture, {.label = "u"}, {.label = "R"},
                               tutorial::column(Eigen::VectorXd::LinSpaced(257, 0, 1), 0),
                               values.transpose(), R_names, picture.part({0, 0.05}, {0.5, 0.95}),
                               u);
        picture.set_view(lesson.world(), picture.part({0.5, 0}, {1, 1}));
        draw_curve(picture, curve);
        for (int i = 0; i < n; ++i) picture.dot(p.col(i), tutorial::part_color(i), 12);
        picture.dot(position(curve, u), colors::black, 14);
        picture.label(position(curve, u), "x(u)");
      },
      nearest);

  // [3] (7) is linear in p: x = J(u) p, J = [R_1 I, R_2 I, ...], 2 by 2n if p = (p_1x, p_1y, ...).
  // Only degree + 1 of its blocks are not 0: the library keeps the R_i and i of just these.
  BasisValues<1> J_u;
  lesson.step(
      "J(u): a sparse row of basis values",
      [&](std::ostream& out) {
        evaluate_basis(curve, Param<1>(u), 0, J_u);
        const auto values = Eigen::VectorXd::Map(J_u.value.data(), degree + 1);
        const Vec<2> x = p(Eigen::all, J_u.column) * values;  // J(u) p, eq. (9)
        out << "J(u) is 2 x " << 2 * n << "; not 0 are, from i = " << J_u.column[0] + 1
            << ", R_i =\n"
            << rounded(values.transpose())
            << "J(u) p - x(u): " << error_text((x - position(curve, u)).norm()) << "\n";
      },
      [&](Picture& picture) {
        draw_curve(picture, curve);
        const Vec<2> x = position(curve, u);
        for (std::size_t k = 0; k < J_u.value.size(); ++k) {
          const Vec<2> control = p.col(J_u.column[k]);
          picture.line(x, control, {.color = red.with_alpha(0.5), .width = 1 + 24 * J_u.value[k]});
          picture.label((x + control) / 2, rounded(J_u.value[k], 2), red, {12, 0});
        }
        picture.dot(x, colors::black, 15);
      },
      nearest);

  // [4] Samples: Gauss-Lobatto points of every span. Their rows of J, one under another, make
  // q = J p, eq. (10), the same matrix for x and y. With `per_span` > degree they determine p.
  int per_span = 4;
  Samples<2> samples;
  Eigen::MatrixXd J;  // #samples by n
  lesson.slider("per_span", per_span, 2, 8, "samples in each knot span");
  lesson.step(
      "Samples of the whole curve: q = J p",
      [&](std::ostream& out) {
        samples = sample_boundary(make_boundary<2>({{curve}}), {.points_per_span = per_span});
        J = sample_jacobian(samples, n);
        const Eigen::MatrixXd q = J * p.transpose();  // eq. (10), #samples by 2
        const Eigen::MatrixXd back = tutorial::least_squares(J, q);
        out << "J: " << J.rows() << " x " << J.cols() << ", " << (J.array() != 0).count() << " of "
            << J.size() << " entries not 0, rank " << tutorial::rank(J) << "\np back from q, error: "
            << error_text((back.transpose() - p).cwiseAbs().maxCoeff(), 1e-10) << "\n";
      },
      [&](Picture& picture) {
        tutorial::draw_matrix(picture, J, {}, picture.part({0.04, 0.09}, {0.3, 0.96}), "J");
        picture.note("J: a row is a sample, a column a control point; light grey is 0, red is 1");
        picture.set_view(lesson.world(), picture.part({0.32, 0.09}, {1, 1}));
        draw_curve(picture, curve);
        picture.dots(samples.position, red, 9);
      },
      nearest);

  // [5] Derivatives. x is linear in p, so that dx/dp_i = R_i I and its finite difference is exact
  // for any s. In w_4 it is not linear: there the error falls as s^2. D-NURBS is this linearity:
  // velocities are J dp/dt, and a force f at x(u) pulls at the control points by J^T f.
  int i = 4;
  double h = 0.5;
  lesson.slider("i", i, 1, n, "number of the control point that moves");
  lesson.slider("h", h, -1, 1, "by how much, upwards");
  const auto changed = [&](double up, double factor) {  // p_i moved up, w_4 multiplied
    Nurbs<1, 2> other = curve;
    other.control_points(1, i - 1) += up;
    other.weights[3] *= factor;
    return other;
  };
  lesson.step(
      "Moving a control point: dx/dp is J",
      [&](std::ostream& out) {
        const Vec<2> dx_dp(0, R[i - 1]);  // by p_i's y: a column of J
        const Vec<2> dx_dlogw = R[3] * (p.col(3) - position(curve, u));  // (7), quotient rule
        const auto of_p = [&](double s) { return position(changed(s, 1), u); };
        const auto of_logw = [&](double s) { return position(changed(0, std::exp(s)), u); };
        const auto error = [](const auto& x, double s, const Vec<2>& derivative) {
          return error_text(((x(s) - x(-s)) / (2 * s) - derivative).norm());
        };
        std::vector<std::vector<std::string>> rows;
        for (double s : {0.1, 0.05, 0.025, 0.0125})
          rows.push_back({rounded(s), error(of_p, s, dx_dp), error(of_logw, s, dx_dlogw)});
        out << "dx/dp_iy:     " << rounded(dx_dp.transpose(), 4, "")
            << "dx/d(log w4): " << rounded(dx_dlogw.transpose(), 4, "")
            << "errors of their finite differences:\n"
            << table({"s", "dx/dp_iy", "dx/d(log w4)"}, rows);
      },
      [&](Picture& picture) {
        draw_curve(picture, curve);
        picture.curve(graph(changed(h, 1)), {.color = red, .width = 3, .dash = {8, 6}});
        picture.arrow(p.col(i - 1), {0, h}, gray, 3);
        for (int k = 0; k <= 40; ++k)  // J times the motion of p_i: the tips lie on the moved curve
          picture.arrow(position(curve, k / 40.0), {0, h * rational_basis(curve, k / 40.0)[i - 1]},
                        red, 1.5);
        picture.legend({{"p" + subscript[i - 1] + " moved", red, {}, {8, 6}}});
      },
      nearest);
  return lesson.run(argc, argv);
}
// Next: step_02_interior, points inside from the boundary alone.
