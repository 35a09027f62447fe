// Step 5 in space: trims
//
//   build/release/bin/sem3d_step_05_trims --out out/step_05                numbers, pictures
//   build/release/bin/sem3d_step_05_trims --set radius=0.4 --set knots=6   who has no sample left?
//   build/release/bin/sem3d_step_05_trims --interactive                    drag the hole in [1]
//
// New here: a part may be what loops of curves in its parameter plane leave of a surface. That
// region is a solid in the plane: the 2D code finds what is inside and puts points there.
//
//   (a)  integral over the part of f da = sum_s f(u_s) |X_u x X_v| w_s     u_s in the region
//   (b)  a line hits the part where it hits the surface and u lies in the region
//   (c)  a control point whose basis function the region does not see has no row in J: it follows
//        p_j = sum_k a_k p_k, the affine map that fits the part's other control points best
//
// Truths: 1 - pi r^2; the area of a paraboloid's cap; the drilled plate's (1 - pi r^2) h; affine
// motions, which (c) keeps.
//
// Things to try: drag the hole over the border: what does the error message say? --set bulge=0.
// --set knots=12 --until 4: the followers fill the hole.
#include <cmath>

#include "sem/base/error.h"
#include "sem/lesson/lesson.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/discretization.h"
#include "sem/scene/model.h"
#include "sem/solve/statics.h"
#include "src3d/tutorials/scenes.h"
#include "src3d/tutorials/solid_view.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

// z = a (x^2 + y^2), x = 2u - 1, y = 2v - 1: Bernstein coefficients of t^2 on [-1, 1] are 1, -1, 1.
Nurbs<2, 3> paraboloid(double a) {
  Nurbs<2, 3> patch = square_patch(0);
  const double square[] = {1, -1, 1};
  for (int k = 0; k < 9; ++k)
    patch.control_points.col(k) << k % 3 - 1, k / 3 - 1, a * (square[k % 3] + square[k / 3]);
  return patch;
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 5 in space: trims", {{0, 0}, {1, 1}});
  SolidView view(lesson, -25, 40);

  // [1] The region: a solid of Dim = 2 in the parameter plane, a square with a round hole.
  Vec<2> center(0.5, 0.5);
  double radius = 0.3;
  int n_points = 4;
  Boundary<2> loops;
  ParameterRule<2> rule;
  lesson.handle("hole", center, "middle of the hole");
  lesson.slider("radius", radius, 0.05, 0.45, "of the hole, r");
  lesson.slider("points", n_points, 1, 10, "in every direction of every piece");
  lesson.step(
      "The parameter plane is a 2D solid",
      [&](std::ostream& out) {
        if (center.minCoeff() <= radius || center.maxCoeff() >= 1 - radius)
          throw InputError("", "hole", "a hole that leaves the square",
                           "a middle farther than the radius from all sides");
        auto curves = square();
        for (const auto& arc : circle(center, radius)) curves.push_back(arc);
        loops = make_boundary<2>({curves});
        const auto nested = find_loops(loops);
        const double truth = 1 - M_PI * radius * radius;
        out << nested.loops.size() << " loops, depths " << nested.loops[0].depth << " and "
            << nested.loops[1].depth << "; area by the loops' integral "
            << rounded(boundary_moments(loops, nested).volume)
            << ", 1 - pi r^2 = " << rounded(truth) << "\n";
        const auto part =
            make_boundary<3>({{square_patch(0)}}, {{square(), circle(center, radius)}}).parts[0];
        rule = part.region->rule(n_points);
        double area = 0;
        for (const double w : rule.weight) area += w;
        std::vector<std::vector<std::string>> rows;
        for (const int n : {8, 32, 128}) {
          const auto grid =
              quadrature_on_rays(cast_rays(loops, nested, {.axis = 0, .n_rays = n}), {});
          rows.push_back({"midpoints on " + std::to_string(n) + " rays along u",
                          std::to_string(grid.size()), error_text(grid.weight.sum() / truth - 1)});
        }
        rows.push_back({"the region's rule: Gauss on Gauss rays between turns",
                        std::to_string(rule.u.size()), error_text(area / truth - 1, 1e-9)});
        out << table({"", "points", "error of the area"}, rows);
      },
      [&](Picture& picture) {
        picture.set_view({{-0.05, -0.05}, {1.05, 1.05}}, picture.part({0.02, 0.06}, {0.98, 0.98}));
        for (const auto& part : loops.parts) {
          Points<2> line(2, 31);
          for (int k = 0; k <= 30; ++k) line.col(k) = point(part, Param<1>(k / 30.0));
          picture.curve(line, {.color = ink, .width = 3});
        }
        const double most = *std::max_element(rule.weight.begin(), rule.weight.end());
        for (std::size_t k = 0; k < rule.u.size(); ++k)
          picture.dot(rule.u[k], colors::viridis(rule.weight[k] / most), 7);
        picture.label({0.5, 0.02}, "u", ink, {0, 18});
        picture.label({0.02, 0.5}, "v", ink, {-18, 0});
        picture.note("the region's points, coloured by their weights; drag the hole");
      });

  // [2] (a) on a curved surface. The disc of radius r in the plane is cut out of z = a (x^2 + y^2).
  double bulge = 0.8;
  Boundary<3> cap;
  Samples<3> samples;
  lesson.slider("bulge", bulge, 0, 1.5, "of the paraboloid, a, 1/m");
  lesson.step(
      "The same region on a curved surface",
      [&](std::ostream& out) {
        const TrimLoops disc = {circle({0.5, 0.5}, radius)};  // 2 r wide in x and y
        cap = make_boundary<3>({{paraboloid(bulge)}}, {disc});
        const double R = 2 * radius, a = bulge;
        const double truth =
            a > 0 ? M_PI / (6 * a * a) * (std::pow(1 + 4 * a * a * R * R, 1.5) - 1) : M_PI * R * R;
        std::vector<std::vector<std::string>> rows;
        for (const int n : {2, 3, 4, 6, 8}) {
          samples = sample_boundary(cap, {.points_per_span = n});
          rows.push_back({std::to_string(n), std::to_string(samples.size()),
                          error_text(samples.weight.sum() / truth - 1)});
        }
        samples = sample_boundary(cap, {.points_per_span = std::max(2, n_points)});
        out << "area of the cap " << rounded(truth, 5) << " m^2\n"
            << table({"n", "samples", "error of the area"}, rows);
      },
      [&](Picture& picture) {
        render::RenderScene scene;
        add_parts(
            scene, cap, [](int) { return colors::mix(blue, colors::white, 0.4); }, 3);
        add_ends(scene, make_boundary<3>({{paraboloid(bulge)}}), colors::gray, 1.5, 0.6);
        add_balls(scene, samples.position, 0.018, [&](int k) {
          return colors::viridis(samples.weight[k] / samples.weight.maxCoeff());
        });
        view.draw(picture, scene);
        picture.note(
            "the cap and its samples; gray: border of the surface that it is trimmed from");
      });

  // [3] A plate with a hole: planes with regions, and the hole's wall. (b).
  constexpr double height = 0.4;
  int n_knots = 10;
  std::vector<ScenePart<3>> parts;
  Boundary<3> plate;
  Rays<3> rays;
  lesson.slider("knots", n_knots, 1, 12, "knot spans of the trimmed faces, each direction");
  lesson.step(
      "A hole drilled through a plate",
      [&](std::ostream& out) {
        parts = drilled_plate(center, radius, height, n_knots);
        plate = boundary_of(parts);
        const auto shells = find_loops(plate);
        const double truth = (1 - M_PI * radius * radius) * height;
        out << plate.n_parts() << " parts, " << shells.loops.size() << " shell; volume off by "
            << error_text(boundary_moments(plate, shells).volume / truth - 1)
            << "\nrelative error of the volume by rays:\n";
        for (const int axis : {0, 2}) {
          const auto cast = cast_rays(plate, shells, {.axis = axis, .n_rays = 24});
          double volume = 0;
          for (const auto& ray : cast.rays)
            for (const auto& i : ray.intervals) volume += ray.weight * (i.end - i.begin);
          out << "  24 x 24 along "
              << "xyz"[axis] << ": " << error_text(volume / truth - 1) << "\n";
        }
        rays = cast_rays(plate, shells, {.axis = 0, .n_rays = 7});
      },
      [&](Picture& picture) {
        render::RenderScene scene;
        add_parts(scene, plate, [&](int i) {
          return !parts[i].trims.empty() ? colors::mix(blue, colors::white, 0.4).with_alpha(0.6)
                                         : clay.with_alpha(0.4);
        });
        add_stretches(scene, rays, green, 4);
        view.draw(picture, scene);
        picture.note("blue: trimmed faces; green: rays along x, inside");
      });

  // [4] (c): who follows. Samples alone would leave their columns of J empty: singular.
  Followers<3> followers;
  lesson.step(
      "Control points that no sample sees follow",
      [&](std::ostream& out) {
        Samples<3> q = sample_boundary(plate, {});
        const Eigen::MatrixXd J = sample_jacobian(q, plate.n_controls());
        int n_empty = 0;
        for (int c = 0; c < J.cols(); ++c) n_empty += J.col(c).isZero(0);
        followers = find_followers(plate, q);
        Mat<3> A;
        A << 1.2, 0.3, 0, -0.1, 0.8, 0.2, 0.4, 0, 1.1;
        const Points<3> p = (A * rest_controls(plate)).colwise() + Vec<3>(1, 2, 3);
        double error = 0;
        for (std::size_t f = 0; f < followers.control.size(); ++f) {
          Vec<3> at = Vec<3>::Zero();
          for (std::size_t k = 0; k < followers.leaders[f].size(); ++k)
            at += followers.share[f][int(k)] * p.col(followers.leaders[f][k]);
          error = std::max(error, (at - p.col(followers.control[f])).norm());
        }
        substitute(followers, q);  // their columns into those of their leaders
        const Points<3> X = p * sample_jacobian(q, plate.n_controls()).transpose();
        const Points<3> exact = (A * q.position).colwise() + Vec<3>(1, 2, 3);
        out << plate.n_controls() << " control points: " << n_empty << " in no sample, "
            << followers.control.size() << " follow\n"
            << "an affine motion: followers off by " << error_text(error, 1e-11) << ", samples by "
            << error_text((X - exact).cwiseAbs().maxCoeff(), 1e-11) << " m\n";
      },
      [&](Picture& picture) {
        render::RenderScene scene;
        add_parts(scene, plate, [&](int i) {
          return parts[i].name == "top" ? blue.with_alpha(0.5) : clay.with_alpha(0.2);
        });
        int top = 0;
        while (parts[top].name != "top") ++top;
        const auto& net = plate.parts[top].nurbs.control_points;
        add_balls(scene, net, 0.02, [&](int k) {
          return followers.follows(plate.first_control[top] + k) ? red : ink;
        });
        view.draw(picture, scene);
        picture.note("control points of the top face; red: followers");
      });

  // [5] The plate pulled at its right face, held at its left one.
  double pull = 0.3;
  Scene<3> scene;
  std::unique_ptr<Model<3>> model;
  State state;
  lesson.slider("pull", pull, 0, 0.6, "motion of the right face, m");
  lesson.step(
      "Pull the plate: the hole becomes an oval",
      [&](std::ostream& out) {
        scene = plate_scene({{"plate", plate_material, parts}});
        scene.pins[1].displacement[0] = pull;
        model = build_model(scene, "plate");
        state = model->initial;
        StaticOptions options;
        options.target = model->target;
        const auto report = solve_static(model->system, state, options);
        const Eigen::VectorXd force = reaction(model->system, state.z);
        double left = 0, right = 0;
        for (const int e : model->held[0].entries)
          if (e % 3 == 0) left += force[e];
        for (const int e : model->held[1].entries)
          if (e % 3 == 0) right += force[e];
        out << name(report.status) << " in " << report.iterations << " iterations, "
            << model->n_unknowns() << " unknowns, " << model->discretization.quadrature.size()
            << " points\nforce of the right face " << rounded(right, 4) << " N, sum of both "
            << error_text((left + right) / right, 1e-6) << " of it\n";
      },
      [&](Picture& picture) {
        const auto& d = model->discretization;
        const auto body = moved(d.boundary, control_points(d.unknowns, state.z));
        render::RenderScene shown;
        add_parts(shown, body, [&](int i) {
          return parts[i].trims.empty() ? clay : colors::mix(blue, colors::white, 0.4);
        });
        add_ends(shown, d.boundary, colors::gray, 1.2, 0.4);
        view.draw(picture, shown);
        picture.note("gray: at rest; dark: gaps that open, as parts share no control points");
      });
  return lesson.run(argc, argv);
}
// Next: step_06_cad, solids from files.
