// Step 3: monomials and the stacked least-squares problem
//
//   build/release/bin/sem2d_step_03_least_squares --out out/step_03    numbers, pictures
//   build/release/bin/sem2d_step_03_least_squares --until 3 --set h=2  a higher edge
//   build/release/bin/sem2d_step_03_least_squares --interactive        drag the deformed corners
//
// New here: the boundary's samples move from X_s to x_s; a polynomial says what happens elsewhere:
//
//   (1)   m(X) = (x, y, x^2, x y, y^2, ...)^T   with (x, y) = X - Xbar, all degrees from 1 to n
//   (2)   x(X) = Pi m(X) + xbar                 one part: no blending yet
//   (5)   Pi = P M^+                            least squares
//
// with a column for each sample: M = [m(X_1) m(X_2) ...], P = [x_1 - xbar, x_2 - xbar, ...]. M^+ is
// the pseudo-inverse: M^T (M M^T)^-1 if the rows of M are independent; if not, P M^+ is the least
// of all best Pi. Errata: the draft leaves out the general form of (1) and an example of (5), see
// [1], [2]; it stacks the monomials "row-wise", (5) needs columns; (5) fails on straight edges:
// [3].
//
// Things to try: [2] x a parallelogram. [3] n = 4; h = 0.1: why does "at once" look right there?
#include <cmath>

#include "sem/lesson/lesson.h"
#include "sem/method/projection.h"
#include "sem/nurbs/bezier_curve.h"
#include "src2d/tutorials/matrices.h"
#include "src2d/tutorials/pictures.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

// The general monomial basis: appends the exponents (a, b, ...) of all monomials of degree k in d
// variables, by falling powers of the first one. `begin` are the exponents chosen so far.
using Exponents = std::vector<int>;
void append_exponents(int d, int k, Exponents begin, std::vector<Exponents>& all) {
  begin.push_back(k);
  if (d == 1) return all.push_back(begin);
  for (int& a = begin.back(); a >= 0; --a) append_exponents(d - 1, k - a, begin, all);
}
std::vector<Exponents> exponents(int d, int n) {
  std::vector<Exponents> all;
  for (int k = 1; k <= n; ++k) append_exponents(d, k, {}, all);
  return all;
}

double monomial(const Exponents& e, const Vec<2>& x) {
  return std::pow(x[0], e[0]) * std::pow(x[1], e[1]);
}
// M: a column for each column of X, which is relative to the origin.
MatrixXd monomials(int n, const Points<2>& X) {
  const auto e = exponents(2, n);
  MatrixXd M(e.size(), X.cols());
  for (int s = 0; s < M.cols(); ++s)
    for (int i = 0; i < M.rows(); ++i) M(i, s) = monomial(e[i], X.col(s));
  return M;
}

// The published way: degree 1 alone, then degree 2 for what is left, ...
MatrixXd degree_by_degree(int n, const MatrixXd& M, const MatrixXd& P) {
  MatrixXd Pi(P.rows(), M.rows()), rest = P;
  for (int k = 1, first = 0; k <= n; first += k + 1, ++k) {  // k + 1 monomials of degree k
    Pi.middleCols(first, k + 1) = rest * pseudo_inverse(M.middleRows(first, k + 1));
    rest -= Pi.middleCols(first, k + 1) * M.middleRows(first, k + 1);
  }
  return Pi;
}

Nurbs<1, 2> segment(const Vec<2>& a, const Vec<2>& b) {
  return bezier_curve<2>((Points<2>(2, 2) << a, b).finished(), Eigen::Vector2d::Ones());
}

std::string name(const Exponents& e) {  // "x²y"
  const std::string power[] = {"", "", "²", "³", "⁴"};
  return (e[0] ? "x" + power[e[0]] : "") + (e[1] ? "y" + power[e[1]] : "");
}

// Where the polynomial takes the lines of a grid of 8 by 4 cells.
void draw_grid(Picture& picture, int n, const MatrixXd& Pi, const Color& color) {
  for (int i = 0; i < 14; ++i) {
    Points<2> X(2, 41);
    for (int k = 0; k <= 40; ++k)
      X.col(k) << (i < 9 ? i / 2.0 : k / 10.0) - 2, (i < 9 ? k / 20.0 : (i - 9) / 2.0) - 1;
    picture.curve(Pi * monomials(n, X), {.color = color, .width = 2});
  }
  picture.hover([=](const Vec<2>& at) {
    return "X = " + coordinates(at) + " goes to\n    " + coordinates(Pi * monomials(n, at));
  });
}

const Color light = colors::light_gray, black = colors::black;

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 3: monomials and least squares", {{-0.7, -0.6}, {5.2, 3.4}});

  // [1] How many there are: C(n + d, d), minus the constant, which is the translation xbar in (2).
  int n = 2;
  lesson.slider("n", n, 1, 4, "degree");
  lesson.step(
      "The monomials of degree 1 to n in d variables",
      [&](std::ostream& out) {
        for (int d = 1; d <= 3; ++d) {
          const double binomial = std::tgamma(n + d + 1) / std::tgamma(n + 1) / std::tgamma(d + 1);
          out << "d = " << d << ": " << exponents(d, n).size()
              << " monomials, C(n + d, d) = " << rounded(binomial) << "\n";
        }
        const auto ours = exponents(2, n);
        const Monomials<2> library(n);
        int n_equal = 0;
        for (int i = 0; i < library.size(); ++i) {
          out << (i == 0 ? "m = (" : ", ") << name(ours[i]);
          n_equal += std::equal(ours[i].begin(), ours[i].end(), library.exponent(i).begin());
        }
        out << ")\n" << n_equal << " of " << ours.size() << " are the library's, in its order\n";
      },
      [&](Picture& picture) {
        for (const auto& e : exponents(2, 4)) {
          const int k = e[0] + e[1];
          const Vec<2> at(400 + 150 * (e[1] - k / 2.0), 60 + 135 * (k - 1));
          draw_function(picture, {at, at + Vec<2>(100, 100)}, name(e), k > n,
                        [=](const Vec<2>& x) { return monomial(e, x); });
        }
        picture.note("on [−1, 1]²: red +, blue −");
      });

  // [2] Four samples, the corners of a square, and where they went. Every number can be checked by
  // hand: M has entries +-1, M M^T = 4 I, hence M^+ = M^T / 4.
  Points<2> X(2, 4), x(2, 4);
  X << 0, 2, 2, 0, 0, 0, 2, 2;
  x << 0, 2, 4, 0, 0, 0, 3, 2;
  MatrixXd Pi;
  Points<2> matched;  // (2) at the samples
  lesson.handles("x", x, "deformed position of sample");
  lesson.step(
      "A worked example: four samples, n = 1",
      [&](std::ostream& out) {
        const Vec<2> Xbar = X.rowwise().mean(), xbar = x.rowwise().mean();  // (4)
        const MatrixXd M = X.colwise() - Xbar, P = x.colwise() - xbar;      // (1) with n = 1
        Pi = P * M.transpose() * pseudo_inverse(M * M.transpose());         // (5)
        matched = (Pi * M).colwise() + xbar;
        print(out, "M", M), print(out, "P", P), print(out, "M M^T", M * M.transpose());
        print(out, "Pi", Pi), print(out, "P - Pi M", P - Pi * M);
        // The rest has the signs +, -, +, - of x y: with this monomial nothing is left.
        const MatrixXd M2 = monomials(2, M), Pi2 = P * pseudo_inverse(M2);
        print(out, "n = 2: Pi", Pi2);
        out << "rank of M: " << rank(M2) << " of 5, P - Pi M: " << error_text((P - Pi2 * M2).norm())
            << "\n";
      },
      [&](Picture& picture) {
        picture.curve(X, {.color = light, .width = 3, .closed = true});
        picture.fill(matched, blue.with_alpha(0.15));
        picture.curve(matched, {.color = blue, .width = 3, .closed = true});
        for (int s = 0; s < 4; ++s) {
          picture.line(matched.col(s), x.col(s), {.color = red, .width = 3});
          picture.label(x.col(s), "x" + std::to_string(s + 1), red, {14, 16});
        }
        picture.dots(x, red, 14);
        picture.note("grey: rest, red: samples and what is left, blue: Pi m(X) + xbar");
        picture.hover(x, [&](int s) {
          return "x" + std::to_string(s + 1) + " = " + coordinates(x.col(s)) +
                 "\nleft: " + coordinates(x.col(s) - matched.col(s));
        });
      });

  // [3] Five samples of a straight edge at y = h; nothing moves, x = X. The origin is (0, 0): other
  // parts have their share in it. On the edge x y is h x, and y, y^2 are constant. The least Pi
  // that explains the samples spreads x over x, x y, x y^2, ...: (1, h, ...) / (1 + h^2 + ...).
  double h = 1;
  Points<2> edge(2, 5);
  MatrixXd at_once, by_degree;
  lesson.slider("h", h, 0.1, 2, "height of the edge above the origin");
  lesson.step(
      "A straight edge: x y and x are the same there",
      [&](std::ostream& out) {
        edge << -2, -1, 0, 1, 2, h, h, h, h, h;
        const MatrixXd M = monomials(n, edge), P = edge;
        at_once = P * pseudo_inverse(M);  // (5)
        by_degree = degree_by_degree(n, M, P);
        print(out, "M", M), print(out, "Pi, at once", at_once),
            print(out, "Pi, degree by degree", by_degree);
        out << "rank of M: " << rank(M)
            << ", both match the samples: " << error_text((at_once * M - P).norm()) << ", "
            << error_text((by_degree * M - P).norm()) << "\n";
      },
      [&](Picture& picture) {
        for (const int i : {0, 1}) {
          const Box<2> half = picture.part({i / 2.0, 0.05}, {(i + 1) / 2.0, 1});
          picture.set_view({{-2.3, -1.6}, {2.3, 2.3}}, half);
          draw_grid(picture, n, MatrixXd::Identity(2, at_once.cols()), light);
          draw_grid(picture, n, i == 0 ? at_once : by_degree, i == 0 ? red : blue);
          picture.curve(edge, {.width = 4});
          picture.dots(edge, black, 12);
          picture.label({0, -1.4}, i == 0 ? "at once" : "degree by degree", black, {0, 0}, 20);
        }
        picture.note("nothing moves, but the least polynomial that matches the edge does");
      });

  // [4] The same for the bar of an H. At once, F depends on the unit of length. Degree by degree it
  // fails only with the origin on the bar: y = 0 at all samples. The library then takes the
  // direction that a part does not know from all parts that share the origin. It divides by the
  // samples' mean distance from the origin and orthogonalises each degree, so that units play no
  // part in this.
  double delta = 0;
  Mat<2> F[3];
  const char* const names[] = {"at once", "degree by degree", "library"};
  const auto gradient = [&](double d, int which) {
    const FitKind kind = which == 0 ? FitKind::pseudo_inverse : FitKind(2 - which);  // raw, default
    const auto boundary = make_boundary<2>(
        {{segment({-2, 2 * d}, {2, 2 * d}), segment({-2, -1}, {-2, 1}), segment({2, -1}, {2, 1})}});
    const auto samples = sample_boundary(boundary, {.points_per_span = 5});
    const auto origins = origins_from_sets<2>({{0, 1, 2}}, {0, 0, 0}, samples);  // (0, d)
    const PartFit bar = fit_on_controls(project(samples, origins, {.degree = n, .fit = kind}), 0);
    const MatrixXd p = rest_controls(boundary)(Eigen::all, bar.columns);
    return Mat<2>(p * bar.coefficients.topRows(2).transpose() / bar.scale);
  };
  lesson.slider("delta", delta, 0, 1, "distance from the origin to the bar of the H");
  lesson.step(
      "Origin and scale",
      [&](std::ostream& out) {
        std::vector<std::vector<std::string>> rows;
        for (const double d : {100.0, 1.0, 0.1, 0.0}) {
          rows.push_back({rounded(d)});
          for (int k = 0; k < 3; ++k)
            rows.back().push_back(error_text((gradient(d, k) - Mat<2>::Identity()).norm(), 1e-9));
        }
        for (int k = 0; k < 3; ++k) F[k] = gradient(delta, k);
        out << "error of F at the origin:\n"
            << table({"distance", names[0], names[1], names[2]}, rows);
      },
      [&](Picture& picture) {
        for (int k = 0; k < 3; ++k) {
          const Box<2> third = picture.part({k / 3.0, 0.2}, {(k + 1) / 3.0, 0.8});
          picture.set_view({{-2.3, -1.8}, {2.3, 1.8}}, third);
          picture.line({-2, delta}, {2, delta}, {.width = 8});
          for (const double x0 : {-2.0, 2.0})
            picture.line({x0, -1 - delta}, {x0, 1 - delta}, {.width = 8});
          draw_grid(picture, 1, F[k], k == 2 ? blue : red);
          picture.dot({0, 0}, black, 18, MarkerShape::plus);
          picture.label({0, -1.6}, names[k], black, {0, 0}, 20);
        }
        picture.note("nothing moves; +: the origin; the grid is mapped by F of the bar");
      });
  return lesson.run(argc, argv);
}
// Next: step_04_shape_matching, a whole solid by one polynomial.
