// Step 1 in space: the same code with Dim = 3
//
//   build/release/bin/sem3d_step_01_dimension --out out/step_01         numbers, pictures
//   build/release/bin/sem3d_step_01_dimension --set part=5 --set u=0.1  another point
//   build/release/bin/sem3d_step_01_dimension --interactive             drag the ball to turn it
//
// New here: the third dimension. Each function below is written once, for Dim = 2 and 3, and
// called for both: a disc of four arcs (degree 2) and a ball of six patches (degree 4 x 4).
//
//   (7-9) J(u):  R_k(u) = w_k prod_a N_k_a(u_a) / sum     a product over the Dim - 1 parameters
//   (a)   n da = rotated dX/du (2D), dX/du x dX/dv (3D)   DimTraits<Dim>::area_normal
//   (b)   V = 1/Dim integral of X . n da                  area or volume
//   (c)   dV/dp_k = integral of R_k n da                  what a control point does to it
//
// The truths are those of circle and ball: 2 pi r, pi r^2; 4 pi r^2, 4/3 pi r^3. Where does the
// library ask for the dimension? In DimTraits and in geometry (what a line hits, what is
// closest): samples, weights, origins, fits, energies and solvers do not know it.
//
// Things to try: --set u=0: which entries of the row vanish? --set pull=-1: V may be negative?
// --set points=2: what is exact already, what is not?
#include "sem/lesson/lesson.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/line_rules.h"
#include "sem/method/samples.h"
#include "src2d/shapes/shapes.h"
#include "src3d/shapes/solids.h"
#include "src3d/tutorials/solid_view.h"

using namespace sem;
using namespace sem::tutorial;
using Eigen::VectorXd;

namespace {

// What the lesson keeps of one dimension.
template <int Dim>
struct Body {
  Boundary<Dim> boundary;
  Loops<Dim> loops;
  Points<Dim> p;  // control points, pulled
  double difference = 0;
  std::vector<double> errors[2] = {};  // of measure and volume
  VectorXd gradient = {};              // (c) of the pulled control point
};

template <int Dim, class Parts>
void make(Body<Dim>& body, const Parts& parts) {
  std::vector<Nurbs<Dim - 1, Dim>> shapes;
  for (const auto& part : parts) shapes.push_back(part.shape);
  body.boundary = make_boundary<Dim>({shapes});
  body.loops = find_loops(body.boundary);
}

// B-splines N_0, ..., of degree d on knots t at u < the last knot (Cox and de Boor).
VectorXd splines(const std::vector<double>& t, int d, double u) {
  VectorXd N = VectorXd::Zero(int(t.size()) - 1);
  for (int i = 0; i < N.size(); ++i) N[i] = t[i] <= u && u < t[i + 1];
  for (int k = 1; k <= d; ++k)
    for (int i = 0; i + k + 1 < int(t.size()); ++i) {
      const double a = t[i + k] - t[i], b = t[i + k + 1] - t[i + 1];
      N[i] = (a > 0 ? (u - t[i]) / a * N[i] : 0) + (b > 0 ? (t[i + k + 1] - u) / b * N[i + 1] : 0);
    }
  return N.head(int(t.size()) - d - 1);
}

// (7-9) The row J(u) of one part: one entry for each of its control points.
template <int Dim>
VectorXd row(const Nurbs<Dim - 1, Dim>& nurbs, const Param<Dim - 1>& u) {
  VectorXd R = nurbs.weights;
  for (int a = 0, stride = 1; a < Dim - 1; stride *= n_control(nurbs, a++)) {
    const VectorXd N = splines(nurbs.knots[a], nurbs.degree[a], u[a]);
    for (int k = 0; k < R.size(); ++k) R[k] *= N[k / stride % N.size()];
  }
  return R / R.sum();
}

template <int Dim>
Param<Dim - 1> parameter(const Vec<2>& uv) {
  return uv.head<Dim - 1>();
}

// Calls visit(part, u, X, n da) at the Gauss points of all parts, n of them in every direction.
template <int Dim, class Visit>
void visit_gauss(const Boundary<Dim>& boundary, int n, const Visit& visit) {
  const LineRule rule = gauss_legendre(n);
  for (int i = 0; i < boundary.n_parts(); ++i)
    for (int k = 0; k < std::pow(n, Dim - 1); ++k) {
      Param<Dim - 1> u;
      double weight = 1;
      for (int a = 0, rest = k; a < Dim - 1; ++a, rest /= n) {
        u[a] = (1 + rule.node[rest % n]) / 2;  // every part is one piece on [0, 1]
        weight *= rule.weight[rest % n] / 2;
      }
      const auto x = derivatives(boundary.parts[i].nurbs, u, 1);
      visit(i, u, x.point, Vec<Dim>(weight * DimTraits<Dim>::area_normal(x.first)));  // (a)
    }
}

template <int Dim>
double volume(const Boundary<Dim>& boundary, int n) {
  double sum = 0;
  visit_gauss(boundary, n,
              [&](int, auto&, const auto& X, const auto& nda) { sum += X.dot(nda) / Dim; });
  return sum;  // (b)
}

template <int Dim>
Boundary<Dim> with_controls(const Boundary<Dim>& boundary, const Points<Dim>& p) {
  std::vector<Nurbs<Dim - 1, Dim>> shapes;
  for (int i = 0; i < boundary.n_parts(); ++i) {
    shapes.push_back(boundary.parts[i].nurbs);
    shapes[i].control_points = p.middleCols(boundary.first_control[i], shapes[i].weights.size());
  }
  return make_boundary<Dim>({shapes});
}

// In the left of the picture, one of them blue; `reach` is the half width of what is shown.
void draw_arcs(Picture& picture, const Boundary<2>& boundary, int part, double reach) {
  const Vec<2> corner(reach, reach);
  picture.set_view({-corner, corner}, picture.part({0.02, 0.1}, {0.46, 0.98}));
  for (int i = 0; i < boundary.n_parts(); ++i) {
    Points<2> line(2, 41);
    for (int k = 0; k <= 40; ++k) line.col(k) = point(boundary.parts[i], Param<1>(k / 40.0));
    picture.curve(line, {.color = i == part ? blue : ink, .width = 3});
  }
}

Box<2> right(const Picture& picture) { return picture.part({0.48, 0.1}, {0.99, 0.98}); }

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 1 in space: the same code with Dim = 3", {{-2, -1.7}, {2, 1.9}});
  SolidView view(lesson);
  const auto both = [](const auto& f, auto& a, auto& b) { f(a), f(b); };

  // [1] One row of J. In 3D it has (4 + 1)^2 entries in place of 2 + 1.
  Body<2> disc;
  Body<3> ball;
  make(disc, make_parts(shapes2d::Disc{}));
  make(ball, make_parts(shapes3d::Sphere{}));
  int part = 3;
  Vec<2> uv(0.3, 0.6);
  lesson.slider("part", part, 1, 6, "of the ball; the disc has four");
  lesson.slider("u", uv[0], 0, 0.999);
  lesson.slider("v", uv[1], 0, 0.999, "second parameter, only in space");
  const auto part_of = [&](const auto& body) { return (part - 1) % body.boundary.n_parts(); };
  lesson.step(
      "One row of J: a product over the parameters",
      [&](std::ostream& out) {
        std::vector<std::vector<std::string>> rows;
        const auto study = [&]<int Dim>(Body<Dim>& body) {
          const auto& nurbs = body.boundary.parts[part_of(body)].nurbs;
          const auto u = parameter<Dim>(uv);
          const VectorXd R = row<Dim>(nurbs, u);
          BasisValues<Dim - 1> library;
          evaluate_basis(nurbs, u, 0, library);
          VectorXd other = VectorXd::Zero(R.size());
          for (std::size_t k = 0; k < library.column.size(); ++k)
            other[library.column[k]] = library.value[k];
          const Vec<Dim> X = nurbs.control_points * R;  // q = J p
          rows.push_back({DimTraits<Dim>::name, std::to_string((R.array() > 1e-14).count()),
                          rounded(R.sum()), list(X, 4), error_text(X.norm() - 1),
                          error_text((R - other).norm())});
        };
        both(study, disc, ball);
        out << table({"Dim", "entries", "sum", "J p", "|J p| - r", "ours - library's"}, rows);
      },
      [&](Picture& picture) {
        const auto& arc = disc.boundary.parts[part_of(disc)].nurbs;
        const auto& patch = ball.boundary.parts[part_of(ball)].nurbs;
        const VectorXd R2 = row<2>(arc, parameter<2>(uv)), R3 = row<3>(patch, uv);
        draw_arcs(picture, disc.boundary, part_of(disc), 1.3);
        const Vec<2> X2 = arc.control_points * R2;
        for (int k = 0; k < R2.size(); ++k) {
          picture.line(X2, arc.control_points.col(k), {.color = red.with_alpha(0.5), .width = 2});
          picture.dot(arc.control_points.col(k), red, 6 + 40 * R2[k]);
          picture.label(arc.control_points.col(k), rounded(R2[k], 2), red, {14, -16});
        }
        picture.dot(X2, colors::black, 12);
        render::RenderScene scene;
        add_parts(scene, ball.boundary, [&](int i) {
          return i == part_of(ball) ? colors::mix(blue, colors::white, 0.5).with_alpha(0.7)
                                    : clay.with_alpha(0.35);
        });
        const Vec<3> X3 = patch.control_points * R3;
        for (int k = 0; k < R3.size(); ++k) {
          const Vec<3> p = patch.control_points.col(k);
          scene.spheres.push_back({p, 0.02 + 0.3 * R3[k], red});
          add_line(scene, X3, p, red.with_alpha(0.5), 1.5);
        }
        scene.spheres.push_back({X3, 0.06, colors::black});
        view.draw(picture, scene,
                  {.points = patch.control_points,
                   .text = [R3](int k) { return "J entry = " + rounded(R3[k], 3); }},
                  right(picture));
        picture.note(
            "red: control points, as large as their entries in the row of the black point");
      });

  // [2] (a), (b) by Gauss points; circle and sphere are rational, so no n is exact.
  int points = 5;
  lesson.slider("points", points, 1, 12, "Gauss points a direction of every part");
  lesson.step(
      "Length and area, area and volume",
      [&](std::ostream& out) {
        std::vector<std::vector<std::string>> rows;
        const auto study = [&]<int Dim>(Body<Dim>& body) {
          const double measure_truth = (Dim == 2 ? 2 : 4) * M_PI,
                       volume_truth = Dim == 2 ? M_PI : 4 * M_PI / 3;
          for (auto& errors : body.errors) errors.clear();
          for (int n = 1; n <= 12; ++n) {
            double measure = 0;
            visit_gauss(body.boundary, n,
                        [&](int, auto&, auto&, const auto& nda) { measure += nda.norm(); });
            body.errors[0].push_back(std::abs(measure / measure_truth - 1));
            body.errors[1].push_back(std::abs(volume(body.boundary, n) / volume_truth - 1));
          }
          const Samples<Dim> q = sample_boundary(body.boundary, {});
          rows.push_back(
              {DimTraits<Dim>::name, error_text(body.errors[0][points - 1]),
               error_text(body.errors[1][points - 1]),
               error_text(q.weight.sum() / measure_truth - 1),
               error_text(boundary_moments(body.boundary, body.loops).volume / volume_truth - 1)});
        };
        both(study, disc, ball);
        out << "relative errors:\n"
            << table({"Dim", "boundary", "inside", "library's samples", "library's moments"}, rows);
      },
      [&](Picture& picture) {
        std::vector<double> n(12);
        for (int k = 0; k < 12; ++k) n[k] = k + 1;
        std::vector<Chart> charts;
        for (const int which : {0, 1})
          charts.push_back(
              {{.label = "Gauss points a direction, n", .lower = 0.5, .upper = 12.5},
               {.label = which == 0 ? "error of length, area" : "error of area, volume",
                .lower = 1e-16,
                .upper = 1,
                .logarithmic = true},
               {{"disc, Dim = 2", n, disc.errors[which]}, {"ball, Dim = 3", n, ball.errors[which]}},
               double(points)});
        draw_charts(picture, charts);
      });

  // [3] (c): derivatives of (b). A pulled control point moves the samples by its column of J. Its
  // own p stands twice in no term of (b), p x p = 0: V is linear in it, whatever Dim is.
  constexpr int n_exact = 16;
  double pull = 0.8;
  int control = 12;
  lesson.slider("control", control, 0, 24, "control point of the part");
  lesson.slider("pull", pull, -1.5, 1.5, "it is moved by, away from the middle, m");
  const auto column_of = [&](const auto& body) {
    const auto& b = body.boundary;
    const int i = part_of(body), n = b.first_control[i + 1] - b.first_control[i];
    return b.first_control[i] + (n == 25 ? control : 1);  // the middle one of an arc
  };
  lesson.step(
      "Pull a control point: the volume's derivative",
      [&](std::ostream& out) {
        std::vector<std::vector<std::string>> rows;
        const auto study = [&]<int Dim>(Body<Dim>& body) {
          const int c = column_of(body), i = part_of(body);
          const Points<Dim> p0 = rest_controls(body.boundary);
          body.p = p0;
          body.p.col(c) += pull * p0.col(c).normalized();
          const auto pulled = with_controls(body.boundary, body.p);
          Vec<Dim> gradient = Vec<Dim>::Zero();
          visit_gauss(pulled, n_exact, [&](int at, auto& u, auto&, const auto& nda) {
            if (at == i)
              gradient += row<Dim>(pulled.parts[i].nurbs, u)[c - pulled.first_control[i]] * nda;
          });  // (c)
          body.gradient = gradient;
          const Check check(
              [&](const VectorXd& at) {
                Points<Dim> p = body.p;
                p.col(c) = at;
                return VectorXd::Constant(1, volume(with_controls(body.boundary, p), n_exact));
              },
              body.p.col(c), gradient.transpose());
          rows.push_back({DimTraits<Dim>::name, rounded(volume(body.boundary, n_exact), 5),
                          rounded(volume(pulled, n_exact), 5), rounded(gradient.norm(), 5),
                          text(check)});
        };
        both(study, disc, ball);
        out << table({"Dim", "V", "pulled", "|dV/dp|", "finite differences"}, rows)
            << "parts share edges, not control points: the pulled part comes off\n";
      },
      [&](Picture& picture) {
        draw_arcs(picture, with_controls(disc.boundary, disc.p), part_of(disc), 1.9);
        const Vec<2> p2 = disc.p.col(column_of(disc)), g2 = disc.gradient;
        picture.dot(p2, red, 14);
        picture.arrow(p2, 0.8 * g2, red, 4);
        render::RenderScene scene;
        add_parts(scene, moved(ball.boundary, ball.p), [&](int i) {
          return i == part_of(ball) ? colors::mix(blue, colors::white, 0.3) : clay;
        });
        const Vec<3> p3 = ball.p.col(column_of(ball)), tip = p3 + 4 * ball.gradient;
        scene.spheres.push_back({p3, 0.05, red});
        add_line(scene, p3, tip, red, 5);
        view.draw(picture, scene, {}, right(picture));
        picture.note(
            "red: a pulled control point and dV/dp there (right: 4 times as long); blue: its part");
      });

  // [4] All rows: most entries are zero, as every sample knows the control points of its part.
  Eigen::MatrixXd J[2];
  lesson.step(
      "All of J: blocks of parts",
      [&](std::ostream& out) {
        std::vector<std::vector<std::string>> rows;
        const auto study = [&]<int Dim>(Body<Dim>& body) {
          const Samples<Dim> q = sample_boundary(body.boundary, {});
          J[Dim - 2] = sample_jacobian(q, body.boundary.n_controls());
          const Points<Dim> X = rest_controls(body.boundary) * J[Dim - 2].transpose();
          rows.push_back(
              {DimTraits<Dim>::name, std::to_string(J[Dim - 2].rows()),
               std::to_string(J[Dim - 2].cols()),
               rounded(100.0 * double(q.value.size()) / double(J[Dim - 2].size()), 3) + " %",
               error_text((X.colwise().norm().array() - 1).abs().maxCoeff())});
        };
        both(study, disc, ball);
        out << table({"Dim", "samples", "control points", "stored", "| |q| - r |"}, rows);
      },
      [&](Picture& picture) {
        const double size = 0.44 * (picture.area().upper[0] - picture.area().lower[0]);
        for (const int k : {0, 1}) {
          const Vec<2> corner = picture.part({0.03 + 0.5 * k, 0.1}, {1, 1}).lower;
          std::vector<int> first;
          const int n = k == 0 ? disc.boundary.n_parts() : ball.boundary.n_parts();
          for (int i = 0; i <= n; ++i) first.push_back(int(J[k].rows()) * i / n);
          draw_matrix(picture, J[k], first, {corner, corner + Vec<2>::Constant(size)}, "J");
          picture.label_at(corner + Vec<2>(0, size + 20),
                           (k == 0 ? "disc: " : "ball: ") + std::to_string(J[k].rows()) +
                               " samples, " + std::to_string(J[k].cols()) + " points");
        }
        picture.note("rows: samples, columns: control points; red: entries > 0");
      });
  return lesson.run(argc, argv);
}
// Next: step_02_inside, solids of loose patches.
