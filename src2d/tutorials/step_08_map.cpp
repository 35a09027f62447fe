// Step 8: the blended map and its gradient
//
//   build/release/bin/sem2d_step_08_map --out out/step_08         numbers, pictures
//   build/release/bin/sem2d_step_08_map --set degree=1            a linear map: F is worse still
//   build/release/bin/sem2d_step_08_map --interactive             drag X and the control points
//
// New here: one map for the whole solid, as a matrix, and two gradients of it.
//
//   (2, 3)  x(X) = sum_i w_i(X) x_i(X),   x_i(X) = m(X - Xbar_i) c_i + t_i
//   (6)     x(X) = Gamma(X) p             linear in the control points: c_i, t_i are (step 4)
//   (12)    F = dx/dX = sum_i w_i dm/dX c_i                      the paper's "diffuse" gradient
//   (12')   F = sum_i w_i dm/dX c_i + x_i (x) grad w_i           the gradient of x(X)
//   (14)    dF/dp = B: F = B p            scalar rows again, one for each direction of X
//
// Errata of the draft: (12) pulls Pi-hat out of the derivative as if w_i were constant; (14) lacks
// w_i and E_i, and has d^2 |q| entries, not 3 |q|; (10) applies J(u, v) of one point where all
// samples' rows are needed. Columns of (14) that are near 0 may be pruned: prune() in map.h.
//
// Things to try: degree 1: how many motions are free? Drag p5 to p7 back to where they were: where
// do the gradients still differ? A circle across one of the jumps of [4]: does (12') still close?
#include "sem/base/error.h"
#include "sem/lesson/lesson.h"
#include "sem/mechanics/internal_energy.h"
#include "sem/mechanics/quadratic_forms.h"
#include "sem/method/quadrature.h"
#include "src2d/tutorials/matrices.h"
#include "src2d/tutorials/pictures.h"
#include "sem/lesson/plots.h"

using namespace sem;
using namespace sem::tutorial;

int main(int argc, char** argv) {
  Lesson lesson("Step 8: the blended map and its gradient", {{-0.4, -0.9}, {5.2, 4.2}});
  const Points<2> p0 = three_points();
  const Curves parts = three_curves(p0);
  const auto boundary = make_boundary<2>({parts});
  const auto loops = find_loops(boundary);
  const auto samples = sample_boundary(boundary, {.points_per_span = 8});
  const auto rule = quadrature_on_rays(cast_rays(boundary, loops, {.n_rays = 40}), {.points = 20});
  const Cells grids[] = {cells_inside(boundary, loops, 64), cells_inside(boundary, loops, 28)};
  const auto cells = [&]() -> const Cells& { return grids[lesson.quick()]; };  // coarse in a drag
  const auto check_inside = [&](const std::string& name, const Vec<2>& X) {
    if (!inside(boundary, loops, X)) throw InputError("", name, list(X), "inside the rest solid");
  };

  // Steps 5 to 7 in the library's words.
  double alpha = 2;
  int degree = 2;
  Origins<2> origins;
  Projection<2> projection;
  const auto weights_at = [&](const Points<2>& X, bool with_gradient) {
    const auto published = DistanceWeight::published;
    const auto distances = measure_distances(boundary, loops, X, published, alpha);
    auto theta = distance_weights(distances, {published, alpha});
    if (with_gradient) distance_weight_gradients(boundary, X, distances, theta);
    return blending_weights(theta, boundary, X);
  };
  // Gamma and B; given grad w, blended_map returns B of (12'), else that of (12).
  const auto map_at = [&](const Points<2>& X, bool exact) {
    return blended_map(X, weights_at(X, exact), origins, projection, 12, true);
  };
  const auto x_at = [&](const Points<2>& X, const Points<2>& z) -> Points<2> {
    return z * dense_value(map_at(X, false)).transpose();
  };
  const auto F_at = [&](const Vec<2>& X, const Points<2>& z, bool exact) {
    const auto map = map_at(X, exact);
    Mat<2> F;
    for (int b = 0; b < 2; ++b) F.col(b) = z * dense_gradient(map, b).transpose();  // F = B p
    return F;
  };

  // [1] What the parts say, and the blend.
  Points<2> p = pulled_points(), z, opinions(2, 3);
  Vec<2> X(3, 1.75), x;
  MatrixXd w;
  Eigen::RowVectorXd row;
  lesson.handles("p", p, "control point, deformed");
  lesson.handle("X", X, "a point of the solid at rest");
  lesson.slider("degree", degree, 1, 4, "n of the polynomials");
  lesson.slider("alpha", alpha, 0.3, 5, "cutoff, m", Lesson::Scale::logarithmic);
  lesson.step(
      "Three polynomials, one map",
      [&](std::ostream& out) {
        check_inside("X", X);
        origins = choose_origins(OriginChoice::one, weights_at(rule.position, false), rule.weight,
                                 samples);
        projection = project(samples, origins, {.degree = degree});
        z = controls_of(p);  // 12 control points: the parts share three positions
        w = dense(weights_at(X, false));
        row = Eigen::RowVectorXd::Zero(12);
        Eigen::RowVectorXd m(projection.monomials.size());
        for (int i = 0; i < 3; ++i) {
          const PartFit fit = fit_on_controls(projection, i);
          projection.monomials.values((X - origins.position.col(0)) / fit.scale, m);
          const Eigen::RowVectorXd row_i = m * fit.coefficients + fit.translation;
          opinions.col(i) = z(Eigen::all, fit.columns) * row_i.transpose();  // x_i = m c_i + t_i
          row(fit.columns) += w(i) * row_i;                                  // Gamma: (3) in (6)
          out << "ABC"[i] << ": w = " << rounded(w(i), 4) << ", x_i = (" << list(opinions.col(i))
              << ")\n";
        }
        x = opinions * w.transpose();  // (2, 3)
        const Eigen::RowVectorXd library = dense_value(map_at(X, false));
        out << "x(X) = (" << list(x)
            << "), Gamma p - x: " << error_text((z * row.transpose() - x).norm())
            << "\nGamma, library's - ours: " << error_text((library - row).norm())
            << ", sum - 1: " << error_text(row.sum() - 1) << "\n";
      },
      [&](Picture& picture) {
        draw_squares(picture, cells(), x_at(cells().center, z), 0.25);
        draw_opinions(picture, p, row, opinions, x);
      });

  // [2] p = A p0 + b should give x = A X + b and F = A.
  double shear = 0.3, stretch = 1.2;
  Points<2> affine;
  lesson.slider("shear", shear, -1, 1, "of the affine field");
  lesson.slider("stretch", stretch, 0.5, 2, "of the affine field");
  lesson.step(
      "Affine fields are reproduced",
      [&](std::ostream& out) {
        const Mat<2> A{{stretch, shear}, {0, 1}};
        const Vec<2> b(0.1, -0.2);
        affine = (A * p0).colwise() + b;
        const Points<2> q = controls_of(affine),
                        error = x_at(cells().center, q) - ((A * cells().center).colwise() + b);
        out << "x - (A X + b): " << error_text(error.cwiseAbs().maxCoeff(), 1e-9)
            << ", F - A by (12): " << error_text((F_at(X, q, false) - A).norm(), 1e-9)
            << ", by (12'): " << error_text((F_at(X, q, true) - A).norm(), 1e-9) << "\n";
      },
      [&](Picture& picture) {
        draw_squares(picture, cells(), x_at(cells().center, controls_of(affine)), 0.5);
        draw_parts(picture, parts, "", 1.5);
        draw_parts(picture, three_curves(affine), "ABC");
        picture.note("thin: at rest; its squares of 0.5 m become equal parallelograms");
      });

  // [3] Central differences of x(X) against both gradients.
  std::vector<std::pair<std::string, Check>> checks;
  lesson.step(
      "Which one is the gradient?",
      [&](std::ostream& out) {
        const auto map = [&](const VectorXd& at) -> VectorXd { return x_at(at, z); };
        checks.clear();
        for (const bool exact : {false, true}) {
          const Mat<2> F = F_at(X, z, exact);
          checks.emplace_back(exact ? "(12')" : "(12)", Check(map, X, F));
          out << checks.back().first << " F = " << list(F.reshaped<Eigen::RowMajor>())
              << ", error with h = 1e-4: " << error_text(checks.back().second.error[12], 1e-6)
              << "\n";
        }
      },
      [&](Picture& picture) { draw_errors(picture, checks); });

  // [4] They differ by sum_i x_i (x) grad w_i: where weights change and the parts disagree.
  VectorXd apart;
  const Cells* grid = nullptr;
  lesson.step(
      "Where the two gradients differ",
      [&](std::ostream& out) {
        grid = &cells();
        const auto diffuse = map_at(grid->center, false), exact = map_at(grid->center, true);
        apart = VectorXd::Zero(grid->center.cols());
        for (int b = 0; b < 2; ++b) {
          const MatrixXd D = dense_gradient(diffuse, b) - dense_gradient(exact, b);
          apart += (D * z.transpose()).rowwise().squaredNorm();
        }
        apart = apart.cwiseSqrt();
        out << "|F (12) - F (12')| > 0.1 in "
            << rounded(100 * (apart.array() > 0.1).cast<double>().mean(), 2) << " %, > 0.5 in "
            << rounded(100 * (apart.array() > 0.5).cast<double>().mean(), 2) << " % of the solid\n";
      },
      [&](Picture& picture) {
        draw_field(picture, *grid, apart, "|F (12) − F (12')|");
        draw_parts(picture, parts, "ABC");
        color_bar(picture, "|F (12) − F (12')| = 0", "1 or more");
      });

  // [5] A gradient adds up: the sum of F dX around a closed curve is 0. With (12) one ends
  // elsewhere: there is no deformation whose gradient that F is.
  Vec<2> center(2.6, 1.2);
  double radius = 0.35;
  Points<2> image, walked[2];
  lesson.handle("center", center, "of a circle in the solid at rest");
  lesson.slider("radius", radius, 0.02, 0.8, "of the circle, m");
  lesson.step(
      "Around a circle",
      [&](std::ostream& out) {
        constexpr int n = 400;
        Points<2> circle(2, n + 1);
        for (int k = 0; k <= n; ++k) {
          circle.col(k) =
              center + radius * Eigen::Rotation2Dd(2 * M_PI * k / n).toRotationMatrix().col(0);
          check_inside("radius", circle.col(k));
        }
        image = x_at(circle, z);
        const Points<2> middle = (circle.leftCols(n) + circle.rightCols(n)) / 2,
                        dX = circle.rightCols(n) - circle.leftCols(n);
        for (const bool exact : {false, true}) {
          const auto map = map_at(middle, exact);
          const Points<2> Fx = z * dense_gradient(map, 0).transpose(),
                          Fy = z * dense_gradient(map, 1).transpose();
          walked[exact] = image;
          for (int k = 0; k < n; ++k)
            walked[exact].col(k + 1) =
                walked[exact].col(k) + Fx.col(k) * dX(0, k) + Fy.col(k) * dX(1, k);
          out << (exact ? "(12')" : "(12)") << " misses its start by "
              << error_text((walked[exact].col(n) - image.col(0)).norm() / radius, 1e-3)
              << " of the radius\n";
        }
      },
      [&](Picture& picture) { draw_walks(picture, image, walked[0], walked[1]); });

  // [6] Energy is made of F (step 9). The softest motion by (12): least energy for its size, rigid
  // ones aside; K v = lambda M v, linear material, E = 1 Pa. What does (12') say of it?
  Points<2> soft;
  double energy[2];
  lesson.step(
      "The softest motion",
      [&](std::ostream& out) {
        MatrixXd K[2], tie = MatrixXd::Zero(24, 18);
        for (int k = 0; k < 24; ++k) tie(k, 2 * point_of_control(k / 2) + k % 2) = 1;
        const MaterialField linear{{{MaterialModel::linear, 1}}, std::vector<int>(rule.size(), 0)};
        for (const bool exact : {false, true}) {
          const auto map = map_at(rule.position, exact);
          const MatrixXd H = InternalEnergy<2>(map, rule.weight, linear, MatrixXd::Zero(12, 12))
                                 .dense_hessian(VectorXd::Zero(24));
          K[exact] = tie.transpose() * H * tie;
        }
        const MatrixXd mass = expand(mass_matrix(map_at(rule.position, false), rule.weight), 2);
        const MatrixXd M = tie.transpose() * mass * tie;
        const VectorXd v = vibrations(K[0], M, 1e-4).v.col(3);  // after three rigid ones
        for (int e = 0; e < 2; ++e) energy[e] = v.dot(K[e] * v);
        out << "energy of the softest motion by (12): " << error_text(energy[0], 1e-9)
            << ", of the same by (12'): " << rounded(energy[1], 2)
            << "\nsoftest by (12'): " << rounded(vibrations(K[1], M, 1e-4).lambda[3], 2)
            << "\n(of motions of one size, E = 1 Pa: (12) does not see what x(X) strains where the weights change)\n";
        soft = (tie * v).reshaped(2, 12);
      },
      [&](Picture& picture) {
        const Points<2> u = x_at(cells().center, soft);
        draw_squares(picture, cells(), cells().center + 0.4 / u.cwiseAbs().maxCoeff() * u, 0.25);
        draw_parts(picture, parts, "", 1.5);
        picture.note("(12) sees " + rounded(100 * energy[0] / energy[1], 2) +
                     " % of the energy of this motion; squares of 0.25 m at rest");
      });
  return lesson.run(argc, argv);
}
// Next: step_09_energy, what a deformation costs.
