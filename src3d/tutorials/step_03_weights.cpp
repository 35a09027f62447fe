// Step 3 in space: weights in a solid with limbs, origins of a torus
//
//   build/release/bin/sem3d_step_03_weights --out out/step_03               numbers, pictures
//   build/release/bin/sem3d_step_03_weights --set variant=sided --until 2   a side that knows its
//   side build/release/bin/sem3d_step_03_weights --interactive                   slide the plane
//   through
//
// New here: nothing but the look of it. Closest points and rays are geometry; the rest is the code
// of the tutorials in the plane, sem2d_step_06_weights and sem2d_step_07_origins:
//
//   (25')  theta_i = 1 - |X - X*| / min(|X* to hit|, alpha)   published
//   (25s)  theta_i = smooth(1 - |X - X*| / alpha, cosine to the inner normal at X*)   sided
//   (24)   w_i = theta_i / sum_j theta_j
//   (4')   origin of a set of parts: the centroid of their surface
//
// Truths: in a solid of plane faces distances are differences of coordinates; half a torus has its
// surface's centroid at (2 R^2 + r^2) / (pi R) from the axis.
//
// Things to try: --set variant=distance_only --until 2: does the right arm follow the left one?
// --set alpha=0.3 --until 2: what is uncovered? --set pull=1 --set origins=one.
#include <cmath>

#include "sem/lesson/lesson.h"
#include "sem/method/discretization.h"
#include "sem/nurbs/bezier_curve.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"
#include "src2d/shapes/shapes.h"
#include "src3d/shapes/solids.h"
#include "src3d/tutorials/solid_view.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

constexpr double thickness = 0.8;

bool in_arms(const Vec<3>& X) {
  const bool arm = X[0] < 0.8 || X[0] > 1;
  return X.minCoeff() > 0 && X[0] < 1.8 && X[1] < 2.4 && X[2] < thickness && (arm || X[1] < 0.6);
}

// Two arms with a gap of 0.2 m: eight sides, three rectangles below and above. Side 8 is at x = 0.
Boundary<3> two_arms() {
  Points<2> corner(2, 8);
  corner << 0, 1.8, 1.8, 1, 1, 0.8, 0.8, 0,  //
      0, 0, 2.4, 2.4, 0.6, 0.6, 2.4, 2.4;
  std::vector<Nurbs<2, 3>> parts = surfaces_of(
      make_parts(shapes3d::Extrusion{shapes2d::make_parts(shapes2d::Polygon{corner, {}, 1}),
                                     {0, 0, thickness},
                                     shapes3d::Caps::none}));
  for (const double z : {0.0, thickness})
    for (const auto& [a, b] : {std::pair(Vec<2>(0, 0), Vec<2>(1.8, 0.6)),
                               {Vec<2>(0, 0.6), Vec<2>(0.8, 2.4)},
                               {Vec<2>(1, 0.6), Vec<2>(1.8, 2.4)}}) {
      const auto edge = [&](double y) {
        Points<3> ends(3, 2);
        ends << a[0], b[0], y, y, z, z;
        return bezier_curve<3>(ends, Eigen::Vector2d::Ones());
      };
      parts.push_back(shapes3d::ruled(edge(a[1]), edge(b[1])));
    }
  return make_boundary<3>({parts});
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 3 in space: weights in a solid with limbs, origins of a torus",
                {{0, 0}, {2, 2}});
  SolidView view(lesson, -20, 50);
  const Boundary<3> body = two_arms();
  const Loops<3> loops = find_loops(body);
  const auto faint = [&](int) { return clay.with_alpha(0.15); };

  // [1] One part and one point: X*, the ray from X* through X, the nearest other part on it.
  int part = 8;
  double alpha = 1.2;
  Vec<3> X(0.3, 1.5, 0.5);
  ClosestPoint<3> foot;
  Vec<3> hit;
  lesson.slider("part", part, 1, 14, "8: the left face of the left arm");
  lesson.slider("alpha", alpha, 0.2, 3, "cutoff, m");
  lesson.slider("x", X[0], 0.02, 0.78, "of a point in the left arm, m");
  lesson.slider("y", X[1], 0.7, 2.38, "m");
  lesson.slider("z", X[2], 0.02, thickness - 0.02, "m");
  lesson.step(
      "Closest point, ray, distance weight",
      [&](std::ostream& out) {
        foot = closest_point(body.parts[part - 1], X);
        double d_total = std::numeric_limits<double>::infinity();
        const Line<3> ray{foot.point, (X - foot.point) / foot.distance};
        for (int i = 0; i < body.n_parts(); ++i) {
          std::vector<Hit<3>> hits;
          if (i != part - 1) append_hits<3>(body.parts[i], ray, 1e-7, 10, hits);
          for (const auto& h : hits) d_total = std::min(d_total, h.t);
        }
        hit = ray.origin + std::min(d_total, 3.0) * ray.direction;
        const double ours = std::max(0., 1 - foot.distance / std::min(d_total, alpha));  // (25')
        const auto theta =
            distance_weights(measure_distances<3>(body, loops, X, DistanceWeight::published, alpha),
                             {.cutoff = alpha});
        double library = 0, sum = 0;
        for (std::size_t e = 0; e < theta.part.size(); ++e) {
          sum += theta.theta[e];
          if (theta.part[e] == part - 1) library = theta.theta[e];
        }
        out << "|X - X*| = " << rounded(foot.distance, 4)
            << " m, |X* to hit| = " << (std::isinf(d_total) ? "no hit" : rounded(d_total, 4) + " m")
            << "\ntheta = " << rounded(ours, 4)
            << ", library's - ours: " << error_text(library - ours)
            << "\nw = " << (sum > 0 ? rounded(library / sum, 4) : "undefined") << ", "
            << theta.part.size() << " parts have theta > 0\n";
        if (part == 8) out << "|X - X*| - x: " << error_text(foot.distance - X[0]) << "\n";
      },
      [&](Picture& picture) {
        render::RenderScene scene;
        add_parts(scene, body, [&](int i) {
          return i == part - 1 ? red.with_alpha(0.6) : clay.with_alpha(0.15);
        });
        add_line(scene, foot.point, X, red, 5, 0.8);
        add_line(scene, X, hit, blue, 5, 0.8);
        for (const Vec<3>& at : {foot.point, X, hit}) scene.spheres.push_back({at, 0.035, ink});
        view.draw(picture, scene,
                  {.labels = {{foot.point, "X*", ink, {-12, -14}},
                              {X, "X", ink, {0, -22}},
                              {hit, "hit", ink, {14, -12}}}});
        picture.note("red: |X − X*|, with blue: from X* to the hit");
      });

  // [2] The same everywhere on a plane. Does the right arm feel the part of the left one?
  DistanceWeight variant = DistanceWeight::published;
  double height = 0.4;
  const std::array<int, 2> n = {54, 72};
  const Vec<3> along_x(1.8, 0, 0), along_y(0, 2.4, 0);
  Points<3> cells;
  Eigen::VectorXd w;
  const auto weights_of = [&](const DistanceWeights<3>& theta, const Points<3>& at) {
    const auto blend = blending_weights(theta, body, at);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(at.cols());
    for (int k = 0; k < at.cols(); ++k)
      for (int e = blend.begin[k]; e < blend.begin[k + 1]; ++e)
        if (blend.part[e] == part - 1) result[k] = blend.w[e];
    return result;
  };
  lesson.choice("variant", variant,
                {{"published", DistanceWeight::published},
                 {"distance_only", DistanceWeight::distance_only},
                 {"sided", DistanceWeight::sided}},
                "of theta");
  lesson.slider("height", height, 0.02, thickness - 0.02, "of the plane, m");
  lesson.step(
      "A slice through the weight of the part",
      [&](std::ostream& out) {
        cells = slice_points(Vec<3>(0, 0, height), along_x, along_y, n);
        const auto theta = distance_weights(measure_distances(body, loops, cells, variant, alpha),
                                            {.variant = variant, .cutoff = alpha});
        w = weights_of(theta, cells);
        double own = 0, other = 0;
        for (int k = 0; k < w.size(); ++k) {
          if (!in_arms(cells.col(k)) || cells(1, k) < 0.6) continue;
          double& most = cells(0, k) < 0.9 ? own : other;
          most = std::max(most, w[k]);
        }
        out << "largest w of part " << part << ": " << rounded(own, 3) << " in the left arm, "
            << rounded(other, 3) << " in the right one\n";
      },
      [&](Picture& picture) {
        render::RenderScene scene;
        add_parts(scene, body,
                  [&](int i) { return i == part - 1 ? red.with_alpha(0.5) : faint(i); });
        add_slice(
            scene, Vec<3>(0, 0, height), along_x, along_y, n,
            [&](int k) { return in_arms(cells.col(k)); },
            [&](int k) { return colors::viridis(w[k] / 0.6); });
        view.draw(picture, scene,
                  {.points = cells, .text = [&](int k) { return "w = " + rounded(w[k], 3); }});
        color_bar(picture, "w = 0", "0.6", Vec<2>(picture.part({0.72, 0.02}, {1, 1}).lower));
        picture.note("weight of the red part on the plane");
      });

  // [3] Over alpha. The distances do not depend on it: measured once for all.
  std::vector<Trace> leaks;
  lesson.step(
      "How far each variant reaches across the gap",
      [&](std::ostream& out) {
        const Points<3> arm =
            slice_points(Vec<3>(1, 0.6, height), Vec<3>(0.8, 0, 0), Vec<3>(0, 1.8, 0), {8, 18});
        leaks = {{"published", {}, {}}, {"distance only", {}, {}}, {"sided", {}, {}}};
        const DistanceWeight variants[] = {DistanceWeight::published, DistanceWeight::distance_only,
                                           DistanceWeight::sided};
        std::vector<std::vector<std::string>> rows;
        for (int v = 0; v < 3; ++v) {
          const auto distances = measure_distances(body, loops, arm, variants[v], 3);
          rows.push_back({leaks[v].label});
          for (int k = 1; k <= 12; ++k) {
            const double cutoff = 0.25 * k;
            const auto theta =
                distance_weights(distances, {.variant = variants[v], .cutoff = cutoff});
            leaks[v].x.push_back(cutoff);
            leaks[v].y.push_back(weights_of(theta, arm).maxCoeff());
            if (k % 3 == 0) rows.back().push_back(rounded(leaks[v].y.back(), 3));
          }
        }
        out << "largest w of part " << part << " in the right arm, by alpha:\n"
            << table({"", "0.75", "1.5", "2.25", "3 m"}, rows);
      },
      [&](Picture& picture) {
        draw_charts(picture, {{{.label = "alpha, m", .lower = 0, .upper = 3.1},
                               {.label = "largest w in the other arm", .lower = -0.01},
                               leaks,
                               alpha}});
      });

  // [4] A torus of four quarters. Groups of quadrature points that see the same parts are the
  // candidates for origins (sem2d_step_07_origins).
  double R = 1, r = 0.4;
  int n_samples = 5;
  OriginChoice choice = OriginChoice::shared_parts;
  Discretization<3> torus;
  lesson.slider("R", R, 0.8, 1.5, "of the torus, m");
  lesson.slider("r", r, 0.2, 0.7, "of its tube, m");
  lesson.slider("samples", n_samples, 2, 9, "of the surface, a knot span and direction");
  lesson.choice("origins", choice,
                {{"shared", OriginChoice::shared_parts}, {"one", OriginChoice::one}});
  const auto paint = [&](int i) {
    return colors::mix(part_color(torus.origins.of_part[i]), colors::white, 0.3);
  };
  lesson.step(
      "A torus: two origins",
      [&](std::ostream& out) {
        MethodOptions options;
        options.rays = {2, 14};
        options.interval.points = 5;
        options.weights.cutoff = 0.5;
        options.projection.degree = 2;
        options.origins = choice;
        options.sampling.points_per_span = n_samples;
        torus = discretize<3>({surfaces_of(make_parts(shapes3d::Torus{{0, 0, 0}, R, r, {2, 2}}))},
                              options);
        const double truth = (2 * R * R + r * r) / (M_PI * R);
        std::vector<std::vector<std::string>> rows;
        for (std::size_t o = 0; o < torus.origins.members.size(); ++o) {
          std::string set;
          for (const int i : torus.origins.members[o]) set += " " + std::to_string(i + 1);
          const Vec<3> at = torus.origins.position.col(int(o));
          rows.push_back({set.substr(1), list(at, 4), rounded(at.norm(), 4)});
        }
        out << torus.quadrature.size() << " points, " << torus.origins.ties.size() << " ties\n"
            << table({"set of parts", "origin", "distance to the axis"}, rows)
            << "half a torus has it at " << rounded(truth, 4) << " m\n";
      },
      [&](Picture& picture) {
        render::RenderScene scene;
        add_parts(scene, torus.boundary, [&](int i) { return paint(i).with_alpha(0.55); });
        SpaceNotes notes;
        for (int o = 0; o < torus.origins.position.cols(); ++o) {
          const Vec<3> at = torus.origins.position.col(o);
          scene.spheres.push_back({at, 0.06, part_color(o)});
          notes.labels.push_back({at, "origin " + std::to_string(o + 1), ink, {0, -26}});
        }
        view.draw(picture, scene, notes);
        picture.note("parts in the colour of their origin, the centroid of its set");
      });

  // [5] Part 1 is pulled off by its control points alone.
  double pull = 0.5;
  Eigen::VectorXd z;
  Points<3> x;
  lesson.slider("pull", pull, 0, 1, "of part 1 along y, m");
  lesson.step(
      "Who follows a pulled part",
      [&](std::ostream& out) {
        Points<3> p = rest_controls(torus.boundary);
        const auto& first = torus.boundary.first_control;
        p.middleCols(first[0], first[1]).row(1).array() += pull;
        z = p.reshaped();
        x = evaluate(torus.interior, z);
        // Mean motion of the points that follow each part most.
        Eigen::VectorXd motion = Eigen::VectorXd::Zero(4), volume = motion;
        const auto& q = torus.quadrature;
        for (int k = 0; k < q.size(); ++k)
          for (int e = torus.weights.begin[k]; e < torus.weights.begin[k + 1]; ++e) {
            const double v = q.weight[k] * torus.weights.w[e];
            motion[torus.weights.part[e]] += v * (x(1, k) - q.position(1, k));
            volume[torus.weights.part[e]] += v;
          }
        out << "mean motion along y around parts 1 to 4: " << list(motion.cwiseQuotient(volume), 3)
            << " m\n";
        Mat<3> A;  // all control points under an affine motion: so is the map
        A << 1.1, 0.2, 0, -0.1, 0.9, 0.3, 0, 0.1, 1;
        const Vec<3> b(0.3, 0, -0.2);
        const Points<3> affine = (A * rest_controls(torus.boundary)).colwise() + b;
        const Points<3> image = evaluate(torus.interior, Eigen::VectorXd(affine.reshaped()));
        const Points<3> exact = (A * q.position).colwise() + b;
        out << "an affine motion of all control points: |x - (A X + b)| "
            << error_text((image - exact).cwiseAbs().maxCoeff()) << "\n";
      },
      [&](Picture& picture) {
        render::RenderScene scene;
        const Points<3> p = Eigen::Map<const Points<3>>(z.data(), 3, z.size() / 3);
        add_parts(scene, moved(torus.boundary, p), [&](int i) { return paint(i).with_alpha(0.3); });
        const auto& weights = torus.weights;
        add_balls(scene, x, 0.03, [&](int k) {
          int most = weights.begin[k];
          for (int e = most; e < weights.begin[k + 1]; ++e)
            if (weights.w[e] > weights.w[most]) most = e;
          return part_color(weights.part[most]);
        });
        view.draw(picture, scene);
        picture.note("points inside, in the colour of the part that they follow most");
      });
  return lesson.run(argc, argv);
}
// Next: step_04_beam, forces and the truth.
