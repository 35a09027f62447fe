// Step 6: weights: how much each part counts at a point inside
//
//   build/release/bin/sem2d_step_06_weights --out out/step_06         numbers, pictures
//   build/release/bin/sem2d_step_06_weights --until 2 --set X=2,1.5   d1, d2 and theta elsewhere
//   build/release/bin/sem2d_step_06_weights --interactive             drag X and the control points
//
// New here: distance weights theta_i(X) and blending weights w_i(X). With X* the closest point of
// part i, Y the first hit of the ray from X* through X with another part, d1 = |X - X*|,
// d2 = |Y - X|, d_total = |Y - X*| and a cutoff alpha (the draft's D):
//
//   (25)   theta_i = max(1 - d1 / min(d2, alpha), 0)           the draft
//   (25')  theta_i = max(1 - d1 / min(d_total, alpha), 0)      the published method
//   (25'') theta_i = max(1 - d1 / alpha, 0)                    distance only, no ray
//   (23, 24)  w = argmin w^T Theta w,  Theta_ii = 1 / theta_i,  0 <= w_i <= 1,  sum_i w_i = 1
//
// Errata of the draft: (23) writes min for argmin and needs no QP solver, see [4]. Section 1 wants
// weights that "are nonzero"; (25) makes most of them zero (and should). Where all theta_i vanish
// (24) is undefined, see [5].
//
// Things to try: --set alpha=0.4: which points does no part reach? Drag X into a bump of A: which
// parts count? Drag p3 down until it hides part of B from C: where does theta jump? --set
// variant=draft with a large alpha: what stays uncovered?
#include <algorithm>
#include <cmath>

#include "sem/base/error.h"
#include "sem/lesson/lesson.h"
#include "sem/method/samples.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"
#include "src2d/tutorials/pictures.h"
#include "sem/lesson/plots.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using enum DistanceWeight;
const DistanceWeight variants[] = {published, draft, distance_only};
const std::vector<std::string> variant_names = {"published", "draft", "distance only"};
const std::string names[] = {"A", "B", "C"};

// What (25) is made of, for one part and one point.
struct Chord {
  Vec<2> foot, along;                          // X*, (X - X*) / d1
  double d1, d2 = infinity, total = infinity;  // |X - X*|, |Y - X|, |Y - X*|; no hit: infinity
  int hit = -1;                                // the part that Y lies on
};

Chord shoot(const Boundary<2>& boundary, int i, const Vec<2>& X) {
  const auto closest = closest_point(boundary.parts[i], X);
  Chord ray{closest.point, (X - closest.point) / closest.distance, closest.distance};
  for (int j = 0; j < boundary.n_parts(); ++j) {
    if (j == i) continue;
    std::vector<Hit<2>> hits;
    append_hits<2>(boundary.parts[j], {ray.foot, ray.along}, 0, 2 * boundary.box.diagonal(), hits);
    for (const auto& hit : hits) {
      if (hit.t <= 1e-7 * boundary.box.diagonal()) continue;          // the joint that X* lies in
      if (hit.t < ray.total) ray.total = hit.t, ray.hit = j;          // first one from X* on
      if (hit.t > ray.d1) ray.d2 = std::min(ray.d2, hit.t - ray.d1);  // first one from X on
    }
  }
  return ray;
}

double theta_of(DistanceWeight variant, const Chord& ray, double alpha) {
  const double reach = variant == published ? ray.total  // (25')
                       : variant == draft   ? ray.d2     // (25)
                                            : infinity;    // (25'')
  return std::max(1 - ray.d1 / std::min(reach, alpha), 0.0);
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 6: weights", {{-0.4, -0.7}, {4.6, 4}});
  Curves parts;
  Boundary<2> boundary;
  Loops<2> loops;
  double alpha = 2;
  const auto library_theta = [&](const Points<2>& X, DistanceWeight variant) {
    const auto distances = measure_distances(boundary, loops, X, variant, infinity);
    return distance_weights(distances, {.variant = variant, .cutoff = alpha});
  };
  const auto library_w = [&](const Points<2>& X, DistanceWeight variant) {
    return blending_weights(library_theta(X, variant), boundary, X);
  };

  // [1] Figure 4: from the closest point through X to the other side.
  Points<2> p = three_points();
  Vec<2> X(1.9, 1);
  int i = 0;
  Chord ray;
  lesson.handles("p", p, "control point");
  lesson.handle("X", X, "the point that weights are computed for");
  lesson.choice("part", i, {"A", "B", "C"}, "whose closest point and ray are shown");
  lesson.step(
      "The closest point X* of a part and the ray through X",
      [&](std::ostream& out) {
        parts = three_curves(p);
        boundary = make_boundary<2>({parts});
        loops = find_loops(boundary);
        if (!inside(boundary, loops, X))
          throw InputError("", "X", list(X), "a point inside the solid");
        ray = shoot(boundary, i, X);
        out << "X* = (" << list(ray.foot) << "), d1 = " << rounded(ray.d1, 4)
            << " m\nhit: " << (ray.hit < 0 ? "none" : "part " + names[ray.hit])
            << ", d2 = " << rounded(ray.d2, 4) << " m, d_total = " << rounded(ray.total, 4)
            << " m\n";
      },
      [&](Picture& picture) { draw_construction(picture, parts, i, ray.foot, X, ray.d2); },
      [&](const Vec<2>& at) {
        const Chord there = shoot(boundary, i, at);
        return reading("d₁, m", there.d1) + "\n" + reading("d₂, m", there.d2);
      });

  // [2] The formulas at X, and along the ray for the part where it starts and the one it hits.
  Eigen::VectorXd s;
  std::vector<Eigen::MatrixXd> on_ray(3);
  lesson.slider("alpha", alpha, 0.05, 5, "cutoff, m", Lesson::Scale::logarithmic);
  lesson.step(
      "Three formulas for theta",
      [&](std::ostream& out) {
        s = Eigen::VectorXd::LinSpaced(301, 0.002, 0.998) *
            std::min(ray.total, boundary.box.diagonal());
        const Points<2> points = (ray.along * s.transpose()).colwise() + ray.foot;
        out << "theta of A, B, C at X; library's - ours:\n";
        for (int v = 0; v < 3; ++v) {
          Eigen::RowVector3d theta;
          for (int j = 0; j < 3; ++j)
            theta[j] = theta_of(variants[v], shoot(boundary, j, X), alpha);
          on_ray[v] = dense(library_theta(points, variants[v]));
          out << "  " << variant_names[v] << ": " << list(theta) << "; "
              << error_text((theta - dense(library_theta(X, variants[v]))).norm()) << "\n";
        }
      },
      [&](Picture& picture) {
        draw_profiles(picture, s, on_ray, {i, ray.hit}, variant_names, ray.d1);
      });

  // [3] As fields: a part should fade out where another part begins.
  Cells cells;
  std::vector<std::pair<std::string, Eigen::MatrixXd>> fields;
  lesson.step(
      "The fields theta_i",
      [&](std::ostream& out) {
        cells = cells_inside(boundary, loops, lesson.quick() ? 28 : 56);
        fields.clear();
        out << "share of the solid, %, where 0, 1, 2, 3 parts count:\n";
        for (int v = 0; v < 3; ++v) {
          fields.emplace_back(variant_names[v], dense(library_theta(cells.center, variants[v])));
          Eigen::Vector4d share = Eigen::Vector4d::Zero();
          for (const auto& row : fields[v].second.rowwise())
            share[(row.array() > 0).count()] += 100.0 / double(cells.center.cols());
          out << "  " << variant_names[v] << ": " << list(share, 2) << "\n";
        }
        const auto pairs = measure_distances(boundary, loops, cells.center, published, infinity);
        out << "published: every second theta is not 0 with alpha = "
            << rounded(distance_weights<2>(pairs, {.sparsity = 0.5}).cutoff, 4) << " m\n";
      },
      [&](Picture& picture) { draw_fields(picture, cells, parts, fields, "θ"); });

  // [4] (23) at X. Lagrange: for the parts with theta_i > 0 (the others cost infinitely much)
  //   2 w_i / theta_i = lambda + nu_i,   nu_i >= 0,   nu_i w_i = 0,   sum_i w_i = 1.
  // nu = 0 and the sum give w_i = theta_i / sum_j theta_j >= 0: a convex program's minimum.
  DistanceWeight variant = published;
  Eigen::Vector3d theta, w;
  const auto cost = [&](const Eigen::Vector3d& v) {  // v^T Theta v, with 1/theta at most 1e8
    return (v.array().square() / theta.array().max(1e-8)).sum();
  };
  lesson.choice<DistanceWeight>(
      "variant", variant,
      {{"published", published}, {"draft", draft}, {"distance_only", distance_only}},
      "formula of theta from here on");
  lesson.step(
      "Blending weights: the quadratic program in closed form",
      [&](std::ostream& out) {
        theta = dense(library_theta(X, variant)).transpose();
        w = dense(library_w(X, variant)).transpose();
        out << "theta = " << list(theta) << "\nw     = " << list(w) << "\n";
        if (theta.sum() == 0) return void(out << "all theta are 0: (23) is undefined\n");
        double on_grid = infinity;
        for (int a = 0; a <= 100; ++a)
          for (int b = 0; a + b <= 100; ++b)
            on_grid = std::min(on_grid, cost(Eigen::Vector3d(a, b, 100 - a - b) / 100));
        out << "library's w - theta / sum: " << error_text((w - theta / theta.sum()).norm())
            << "\ncost: " << rounded(cost(w), 5)
            << "; least of 5151 other w: " << rounded(on_grid, 5) << "\n";
      },
      [&](Picture& picture) {
        picture.note("yellow: the cost w·Θw is small; dot: the library's w");
        draw_triangle(picture, parts, lesson.world(), X, w, [&](const Eigen::Vector3d& v) {
          return std::pair(1 - std::log10(cost(v) / cost(w)) / 1.2, reading("cost", cost(v)));
        });
      });

  // [5] Where no part reaches, all theta vanish: the library lets points follow their closest part.
  BlendingWeights<2> weights;
  lesson.step(
      "The fields w_i, and points that no part reaches",
      [&](std::ostream& out) {
        weights = library_w(cells.center, variant);
        out << "sum of w - 1: "
            << error_text((dense(weights).rowwise().sum().array() - 1).matrix().norm())
            << "\nuncovered: "
            << rounded(100.0 * double(weights.uncovered.size()) / weights.n_points(), 3)
            << " % of the solid\n";
      },
      [&](Picture& picture) {
        picture.set_view(cells.box, picture.part({0.05, 0.1}, {0.95, 0.97}));
        draw_weights(picture, cells, dense(weights), weights.uncovered);
        draw_parts(picture, parts, "ABC");
        picture.note("the parts' colours mixed by w; pale: uncovered");
      });

  // [6] On a part its own weight is 1 (Kronecker), so that the boundary follows its own polynomial.
  // The library sets it there. Do the formulas lead to it from inside?
  Eigen::VectorXd depth = Eigen::pow(10.0, Eigen::ArrayXd::LinSpaced(41, -4, 0));
  Eigen::MatrixXd near(41, 3);
  lesson.step(
      "On parts and at joints",
      [&](std::ostream& out) {
        const auto samples = sample_boundary(boundary, {.points_per_span = 4});
        const Eigen::MatrixXd on = dense(library_w(samples.position, variant));
        double kronecker = 0, joints = 0;
        for (int k = 0; k < samples.size(); ++k) {
          const bool joint = samples.u[k][0] == 0 || samples.u[k][0] == 1;
          double& worst = joint ? joints : kronecker;
          worst = std::max(worst, std::abs(on(k, samples.part[k]) - (joint ? 0.5 : 1)));
        }
        out << "on part i: w_i - 1: " << error_text(kronecker)
            << ", at joints: w_i - 1/2: " << error_text(joints) << "\nw of " << names[i]
            << " at 1/10000 of the way from X* to X:\n";
        const Points<2> points = (ray.d1 * ray.along * depth.transpose()).colwise() + ray.foot;
        for (int v = 0; v < 3; ++v) {
          near.col(v) = dense(library_w(points, variants[v])).col(i);
          out << "  " << variant_names[v] << ": " << rounded(near(0, v), 3) << "\n";
        }
      },
      [&](Picture& picture) {
        draw_columns(picture, {.label = "share of the way from X* to X", .logarithmic = true},
                     {.label = "w of " + names[i], .lower = 0, .upper = 1.05}, column(depth, 0),
                     near, variant_names);
      });
  return lesson.run(argc, argv);
}
// Next: step_07_origins, which parts move together.
