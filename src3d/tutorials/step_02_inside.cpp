// Step 2 in space: inside a solid of loose patches
//
//   build/release/bin/sem3d_step_02_inside --out out/step_02            numbers, pictures
//   build/release/bin/sem3d_step_02_inside --set flipped=6 --until 1    orientation does not count
//   build/release/bin/sem3d_step_02_inside --interactive                drag to turn, move the ray
//
// New here: patches are not joined, nobody orients them, some may be missing. As in the plane
// (sem2d_step_02_interior) a ray decides:
//
//   (a)  inside a shell = after an odd number of crossings with its patches
//   (b)  inside a solid = the deepest shell around the point has even depth: a shell in a shell
//        is a cavity
//   (c)  integral f dX = sum_k f(X_k) v_k, v_k = area of the ray's tile * length inside * share
//
// The solid is a ball of radius 1 with a round cavity. Truths: hits with spheres, at +-sqrt(R^2 -
// y^2 - z^2); the volume 4/3 pi (R^3 - r^3); the boundary's own integral.
//
// Things to try: --set cavity=0.95: a thin shell. --set missing=2 --until 4: which rays notice?
// --set rays=6 and look at [3] from above (lift = 90).
#include <algorithm>
#include <cmath>

#include "sem/lesson/lesson.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/line_rules.h"
#include "sem/method/quadrature.h"
#include "sem/nurbs/refine.h"
#include "src3d/shapes/solids.h"
#include "src3d/tutorials/solid_view.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

using Surfaces = std::vector<Nurbs<2, 3>>;

// (a), (b): the stretches inside, from hits that are sorted along the ray.
std::vector<RayInterval> inside(const std::vector<RayHit>& hits, const Loops<3>& loops) {
  std::vector<RayInterval> result;
  std::vector<char> odd(loops.loops.size(), false);
  for (std::size_t k = 0; k + 1 < hits.size(); ++k) {
    int deepest = -1;
    for (std::size_t l = 0; l < odd.size(); ++l) {
      const auto& shell = loops.loops[l];
      odd[l] ^= hits[k].crosses && std::count(shell.parts.begin(), shell.parts.end(), hits[k].part);
      if (odd[l]) deepest = std::max(deepest, shell.depth);
    }
    if (deepest >= 0 && deepest % 2 == 0) result.push_back({hits[k].t, hits[k + 1].t, 0});
  }
  return result;
}

double volume(const Rays<3>& rays) {
  double sum = 0;
  for (const auto& ray : rays.rays)
    for (const auto& i : ray.intervals) sum += ray.weight * (i.end - i.begin);
  return sum;
}

// Gauss points between the heights where the length inside has a root: at the silhouettes of both
// spheres. n of them in every stretch of y and z; rays along x.
Rays<3> split_rays(double R, double r, int n) {
  Rays<3> rays;
  rays.axis = 0;
  const auto stretches = [](double outer, double inner) {
    return inner > 0 ? std::vector<double>{-outer, -inner, inner, outer}
                     : std::vector<double>{-outer, outer};
  };
  const auto y_ends = stretches(R, r);
  const LineRule gauss = gauss_legendre(n);
  for (std::size_t a = 0; a + 1 < y_ends.size(); ++a)
    for (int i = 0; i < n; ++i) {
      const double half_y = (y_ends[a + 1] - y_ends[a]) / 2,
                   y = y_ends[a] + half_y * (1 + gauss.node[i]);
      const auto z_ends =
          stretches(std::sqrt(R * R - y * y), std::sqrt(std::max(0., r * r - y * y)));
      const int m = int(z_ends.size()) - 1;
      for (int b = 0; b < m; ++b) {
        const auto kind = [&](bool outer) {  // of the length inside at an end of the stretch
          return outer ? EndKind::closing : b == 1 ? EndKind::root : EndKind::smooth;
        };
        const LineRule rule = rule_between(kind(b == 0), kind(b == m - 1), n);
        const double half_z = (z_ends[b + 1] - z_ends[b]) / 2;
        for (int j = 0; j < n; ++j)
          rays.rays.push_back({Vec<3>(0, y, z_ends[b] + half_z * (1 + rule.node[j])),
                               half_y * gauss.weight[i] * half_z * rule.weight[j],
                               {},
                               {}});
      }
    }
  return rays;
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 2 in space: inside a solid of loose patches", {{-1, -1}, {1, 1}});
  SolidView view(lesson);

  // [1] Twelve patches; the first few have their normals turned round.
  int flipped = 3;
  double cavity = 0.55;
  std::vector<std::string> names;
  Boundary<3> boundary;
  Loops<3> loops;
  Moments<3> truth;
  const auto patches = [&] {
    Surfaces result;
    names.clear();
    for (const double radius : {1.0, cavity})
      for (const auto& part : make_parts(shapes3d::Sphere{{0, 0, 0}, radius})) {
        result.push_back(part.shape);
        names.push_back((radius == 1 ? "" : "cavity/") + part.name);
      }
    for (int i = 0; i < flipped; ++i) result[i] = reversed(result[i], 0);
    return result;
  };
  const auto color = [&](int i) {
    return (i >= 6 ? red : loops.orientation[i] < 0 ? colors::categorical(4) : blue);
  };
  const auto shell = [&](const Boundary<3>& body, double opacity) {
    render::RenderScene scene;
    add_parts(scene, body, [&](int i) {
      return colors::mix(color(i), colors::white, 0.3).with_alpha(i < 6 ? opacity : 0.5);
    });
    return scene;
  };
  lesson.slider("flipped", flipped, 0, 6, "patches of the ball with the normal turned round");
  lesson.slider("cavity", cavity, 0.1, 0.95, "its radius r, m");
  lesson.step(
      "Shells, depths and sides are found, not given",
      [&](std::ostream& out) {
        boundary = make_boundary<3>({patches()});
        loops = find_loops(boundary);
        std::vector<std::vector<std::string>> rows;
        for (const auto& loop : loops.loops) {
          int out_of = 0;
          for (const int i : loop.parts) out_of += loops.orientation[i] > 0;
          rows.push_back({names[loop.parts[0]] + ", ...", std::to_string(loop.parts.size()),
                          std::to_string(loop.depth), std::to_string(out_of)});
        }
        truth = boundary_moments(boundary, loops);
        const double exact = 4 * M_PI / 3 * (1 - std::pow(cavity, 3));
        out << table({"shell", "patches", "depth", "normals out of the material"}, rows)
            << "volume by the boundary " << rounded(truth.volume) << " m^3; relative error "
            << error_text(truth.volume / exact - 1) << "\n";
      },
      [&](Picture& picture) {
        // Pulled apart, to be seen.
        Points<3> p = rest_controls(boundary);
        for (int i = 0; i < 6; ++i) {
          auto own = p.middleCols(boundary.first_control[i], 25);
          const Vec<3> away = 0.45 * Vec<3>(own.rowwise().mean()).normalized();
          own.colwise() += away;
        }
        const auto apart = moved(boundary, p);
        auto scene = shell(apart, 0.75);
        for (int i = 0; i < 6; ++i) {
          const auto at = point_slopes(apart.parts[i], Param<2>(0.5, 0.5));
          const Vec<3> n = DimTraits<3>::area_normal(at.first).normalized();
          add_line(scene, at.point, at.point + 0.35 * n, ink, 5, 0.4);
          scene.spheres.push_back({at.point + 0.35 * n, 0.035, ink});
        }
        view.draw(picture, scene);
        picture.legend({{"normal out of the material", blue},
                        {"normal into it", colors::categorical(4)},
                        {"cavity", red}});
        picture.note("the patches pulled apart; pins: their normals du × dv");
      });

  // [2] One ray along x.
  Vec<2> through(0.25, 0.3);
  Rays<3> one;
  lesson.slider("y", through[0], -1.2, 1.2, "of a ray along x, m");
  lesson.slider("z", through[1], -1.2, 1.2, "of a ray along x, m");
  lesson.step(
      "One ray: hits, crossings, inside",
      [&](std::ostream& out) {
        one = {};
        one.rays.push_back({Vec<3>(0, through[0], through[1]), 1, {}, {}});
        cast(boundary, loops, one);
        const auto& ray = one.rays[0];
        std::vector<std::vector<std::string>> rows;
        for (const auto& hit : ray.hits) {
          const double R = hit.part < 6 ? 1 : cavity,
                       x = std::sqrt(std::max(0., R * R - through.squaredNorm()));
          rows.push_back({rounded(hit.t, 5), names[hit.part], hit.crosses ? "yes" : "no",
                          error_text(std::abs(hit.t) - x)});
        }
        double ours = 0, library = 0;
        for (const auto& i : inside(ray.hits, loops)) ours += i.end - i.begin;
        for (const auto& i : ray.intervals) library += i.end - i.begin;
        if (!rows.empty()) out << table({"x", "patch", "crosses", "|x| - truth"}, rows);
        out << ray.hits.size() << " hits; length inside " << rounded(library, 5)
            << ", library's - ours " << error_text(library - ours) << "\n";
      },
      [&](Picture& picture) {
        auto scene = shell(boundary, 0.2);
        const auto& ray = one.rays[0];
        const auto at = [&](double x) { return Vec<3>(x, through[0], through[1]); };
        add_line(scene, at(-1.5), at(1.5), colors::gray, 2, 0.5);
        for (const auto& i : ray.intervals) add_line(scene, at(i.begin), at(i.end), green, 7, 0.8);
        SpaceNotes notes;
        notes.points.resize(3, int(ray.hits.size()));
        for (std::size_t k = 0; k < ray.hits.size(); ++k) {
          scene.spheres.push_back({at(ray.hits[k].t), 0.035, ink});
          notes.points.col(int(k)) = at(ray.hits[k].t);
          notes.labels.push_back({at(ray.hits[k].t), std::to_string(k + 1), ink, {0, -20}});
        }
        notes.text = [&](int k) { return names[ray.hits[k].part]; };
        view.draw(picture, scene, notes);
        picture.note(
            "green: inside, between an odd number of crossings of the ball and an even one of the "
            "cavity");
      });

  // [3] All rays of a grid, with midpoints; (c). Errors of the volume and of the moment of x^2.
  int n_rays = 12;
  Rays<3> rays;
  Quadrature<3> quadrature;
  std::vector<Trace> errors;
  lesson.slider("rays", n_rays, 4, 24, "along y and z");
  lesson.step(
      "All rays, and how fast the volume converges",
      [&](std::ostream& out) {
        const auto grid = [&](int n, RayGrid kind) {
          return cast_rays(boundary, loops, {.axis = 0, .n_rays = n, .grid = kind});
        };
        rays = grid(n_rays, RayGrid::midpoint);
        quadrature = quadrature_on_rays(rays, {.spacing = 0.2});
        errors = {{"uniform", {}, {}}, {"Gauss", {}, {}}, {"Gauss between silhouettes", {}, {}}};
        std::vector<std::vector<std::string>> rows;
        for (const int n : {4, 8, 16, 32, 64}) {
          rows.push_back({std::to_string(n * n)});
          for (const auto kind : {RayGrid::midpoint, RayGrid::gauss}) {
            const double error = std::abs(volume(grid(n, kind)) / truth.volume - 1);
            errors[int(kind)].x.push_back(n * n);
            errors[int(kind)].y.push_back(error);
            rows.back().push_back(error_text(error));
          }
        }
        out << "relative error of the volume on grids of rays:\n"
            << table({"rays", "uniform", "Gauss"}, rows) << "on rays between silhouettes:\n";
        for (const int n : {1, 2, 4, 8, 12, 16}) {
          Rays<3> split = split_rays(1, cavity, n);
          cast(boundary, loops, split);
          const double error = std::abs(volume(split) / truth.volume - 1);
          errors[2].x.push_back(double(split.rays.size()));
          errors[2].y.push_back(std::max(error, 1e-16));
          out << "  " << split.rays.size() << " rays: " << error_text(error) << "\n";
        }
        out << quadrature.size() << " points in the picture\n";
      },
      [&](Picture& picture) {
        auto scene = shell(boundary, 0.15);
        add_stretches(scene, rays, green.with_alpha(0.8), 2);
        add_balls(scene, quadrature.position, 0.022, [&](int k) {
          return colors::viridis(quadrature.weight[k] / quadrature.weight.maxCoeff());
        });
        view.draw(
            picture, scene,
            {.points = quadrature.position,
             .text = [&](int k) { return "v = " + rounded(quadrature.weight[k], 3) + " m³"; }},
            picture.part({0, 0.06}, {0.5, 0.98}));
        draw_charts(
            picture,
            {{{.label = "rays", .lower = 1, .upper = 1e4, .logarithmic = true},
              {.label = "error of the volume", .lower = 1e-16, .upper = 1, .logarithmic = true},
              errors}},
            picture.part({0.5, 0.06}, {0.99, 0.98}));
        picture.note(
            "left: the rule; right: where rays begin to hit, the length inside has a root: split "
            "there");
      });

  // [4] A patch is missing (of a ball without a cavity). Rays through the hole see an odd number of
  // hits: the last is dropped, and the ray counted as a doubt. Rays across do not notice, but those
  // beside the hole do.
  int missing = 6;
  Boundary<3> open;
  Rays<3> through_hole;
  lesson.slider("missing", missing, 1, 6, "patch of the ball left out");
  lesson.step(
      "A missing patch: which rays doubt",
      [&](std::ostream& out) {
        auto parts = patches();
        parts.resize(6);
        parts.erase(parts.begin() + missing - 1);
        open = make_boundary<3>({parts});
        const auto shells = find_loops(open);
        std::vector<std::vector<std::string>> rows;
        for (const int axis : {0, 1, 2}) {
          const auto cast = cast_rays(open, shells, {.axis = axis, .n_rays = 48});
          int n_hit = 0;
          for (const auto& ray : cast.rays) n_hit += !ray.hits.empty();
          rows.push_back({std::string(1, "xyz"[axis]), std::to_string(n_hit),
                          std::to_string(cast.n_unpaired),
                          rounded(100 * (volume(cast) / (4 * M_PI / 3) - 1), 2) + " %"});
        }
        out << "without " << names[missing - 1] << ":\n"
            << table({"rays along", "hit", "not paired", "volume off by"}, rows);
        through_hole = cast_rays(open, shells, {.axis = 2, .n_rays = 16});
      },
      [&](Picture& picture) {
        render::RenderScene scene;
        add_parts(scene, open, [&](int) { return blue.with_alpha(0.25); });
        add_stretches(scene, through_hole, green, 3);
        for (const auto& ray : through_hole.rays) {
          const Vec<3> end(0, 0, 1.15);
          if (ray.hits.size() % 2 != 0)
            add_line(scene, ray.origin - end, ray.origin + end, red, 2, 0.8);
        }
        view.draw(picture, scene);
        picture.note("rays along z; green: stretches inside, red: an odd number of hits");
      });
  return lesson.run(argc, argv);
}
// Next: step_03_weights, who is followed where.
