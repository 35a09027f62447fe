// Step 4 in space: a beam against the truth
//
//   build/release/bin/sem3d_step_04_beam --out out/step_04                 numbers, pictures
//   build/release/bin/sem3d_step_04_beam --set degree=3                    slower, nearer
//   build/release/bin/sem3d_step_04_beam --interactive                     drag to turn it
//
// New here: forces in space, and two formulations on the same beam, 5 x 1 x 1 m, clamped at x = 0,
// E = 1 MPa, nu = 0.45 (E_iso), 1000 kg/m^3, under its weight:
//
//   projected   z = control points; F without grad w (the paper's)
//   condensed   z = coefficients of the parts' polynomials; F exact; the clamp by Nitsche's method
//
// Truths. The tip's deflection at (5, 0.5, 1) by quadratic finite elements:
// -4.595(5) m under g = 10 m/s^2, -9.452(2) mm under g = 0.01; beams of Euler and
// Timoshenko, by hand; the clamp carries the weight. The published value for this beam, -4.158 m,
// is the lowest point of a motion, not this equilibrium.
//
// Things to try: --set degree=3 (seconds). --set degree=1: what is a linear field good for?
// --set along=3. --set rays=4: what does [5] say, and why should one not trust it?
#include <cmath>

#include "sem/lesson/lesson.h"
#include "sem/scene/monitor.h"
#include "sem/solve/statics.h"
#include "src3d/tutorials/scenes.h"
#include "src3d/tutorials/solid_view.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

constexpr double truth_small = -9.452e-3, truth_large = -4.595;  // m, at g = 0.01 and 10 m/s^2

struct Answer {
  std::unique_ptr<Model<3>> model = {};
  State state = {};
  StaticReport report = {};
  std::vector<double> probes = {};  // displacement of the tip, force of the clamp
};

Answer solve(const Scene<3>& scene) {
  Answer a;
  a.model = build_model(scene, scene.name);
  a.state = a.model->initial;
  StaticOptions options;
  options.tolerance = 1e-7;
  a.report = solve_static(a.model->system, a.state, options);
  a.probes = Monitor<3>(scene, *a.model).probes(a.state, {});
  return a;
}

std::vector<std::string> condensed(int along, int degree, int rays, double g) {
  const auto n = [](int k) { return std::to_string(k); };
  return {"solids[0].shape.parts=[" + n(along) + ",1,1]",
          "solids[0].shape.degree=" + n(degree),
          "method.degree=" + n(degree),
          "method.quadrature.rays=" + n(rays),
          "method.quadrature.points=" + n(4 * rays),
          "gravity=[0,0,-" + rounded(g) + "]"};
}

// The paper's formulation; its scene is dynamic, but a model is a model.
std::vector<std::string> projected(int along, double g) {
  return {"solids[0].shape.parts=[" + std::to_string(along) + ",1,1]",
          "gravity=[0,0,-" + rounded(g) + "]", "probes[0].at=[5,0.5,1]"};
}

std::string percent(double value, double truth) { return rounded(100 * value / truth, 3) + " %"; }

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 4 in space: a beam against the truth", {{0, 0}, {5, 1}});
  SolidView view(lesson, -25, 20);

  // [1] The model: all that happens once.
  int along = 2, degree = 2, rays = 6;
  Scene<3> scene, heavy;
  Answer small;
  std::unique_ptr<SolidPainter> painter;
  lesson.slider("along", along, 1, 4, "patches along the beam on each of four sides");
  lesson.slider("degree", degree, 1, 3, "of the deformation and of the patches");
  lesson.slider("rays", rays, 3, 10,
                "of a Gauss grid along y and z, 4 times as many points on each");
  lesson.step(
      "The beam, condensed",
      [&](std::ostream& out) {
        scene = builtin_scene("beam_condensed", condensed(along, degree, rays, 0.01));
        small = {.model = build_model(scene, "beam_condensed")};
        const auto& d = small.model->discretization;
        out << d.boundary.n_parts() << " patches, " << d.boundary.n_controls()
            << " control points, " << d.quadrature.size() << " points inside\n"
            << small.model->n_unknowns() << " unknowns, of " << d.boundary.n_parts() << " x "
            << d.projection.monomials.size() + 1 << " x 3 coefficients\n"
            << "volume - 5 m^3: " << error_text(d.quadrature.weight.sum() - 5, 1e-10)
            << ", mass - 5000 kg: " << error_text(small.model->total_mass() - 5000, 1e-7) << "\n";
      },
      [&](Picture& picture) {
        const auto& d = small.model->discretization;
        render::RenderScene shown;
        add_parts(shown, d.boundary, [&](int i) {
          return scene.solids[0].parts[i].name == "left" ? red.with_alpha(0.5)
                                                         : blue.with_alpha(0.12);
        });
        add_balls(shown, d.quadrature.position, 0.03, [&](int k) {
          return colors::viridis(d.quadrature.weight[k] / d.quadrature.weight.maxCoeff());
        });
        view.draw(picture, shown, {.points = d.quadrature.position, .text = [&](int k) {
                                     return "v = " + rounded(d.quadrature.weight[k], 3) + " m³";
                                   }});
        picture.note("red: clamped; points inside, coloured by their weights");
      });

  // [2] A thousandth of the load: nearly linear. Beams by hand: u = q L^4 / (8 E I) bends, and
  // Timoshenko's beam shears by q L^2 / (2 k G A), k = 5/6.
  double bend = 0, shear = 0;
  lesson.step(
      "A thousandth of the load: beams by hand",
      [&](std::ostream& out) {
        small = solve(scene);
        const double E = 1e6, G = E / (2 * 1.45), q = 1000 * 0.01, L = 5;
        bend = -q * std::pow(L, 4) / (8 * E / 12);
        shear = -q * L * L / (2 * 5.0 / 6 * G);
        std::vector<std::vector<std::string>> rows;
        for (const auto& [name, u] : {std::pair("Euler's beam", bend),
                                      {"Timoshenko's beam", bend + shear},
                                      {"this", small.probes[2]},
                                      {"finite elements (truth)", truth_small}})
          rows.push_back({name, rounded(1e3 * u, 4), percent(u, truth_small)});
        out << name(small.report.status) << "\n"
            << table({"tip under g = 0.01 m/s^2", "u_z, mm", "of the truth"}, rows)
            << "clamp's force - weight: " << error_text(small.probes[5] / 50 - 1, 1e-6) << "\n";
      },
      [&](Picture& picture) {
        // 100 times as large as it is.
        const auto& d = small.model->discretization;
        const Points<3> rest = rest_controls(d.boundary);
        const Points<3> u = control_points(d.unknowns, small.state.z) - rest;
        const auto body = moved(d.boundary, rest + 100 * u);
        render::RenderScene shown;
        add_parts(shown, body, [&](int) { return colors::mix(blue, colors::white, 0.4); });
        add_ends(shown, d.boundary, colors::gray, 1.5, 0.4);
        view.draw(picture, shown);
        picture.note("displacements 100 times as large; gray: at rest");
      });

  // [3] The weights have kinks inside: a rule that is too coarse for them leaves motions that cost
  // almost nothing, and the beam is too soft. So the rule comes first.
  std::vector<Trace> rules;
  lesson.step(
      "First the rule: too few points are too soft",
      [&](std::ostream& out) {
        rules = {{"condensed", {}, {}}};
        std::vector<std::vector<std::string>> rows;
        for (const int n : {3, 4, 5, 6, 7}) {
          const Answer a =
              solve(builtin_scene("beam_condensed", condensed(along, degree, n, 0.01)));
          const int points = a.model->discretization.quadrature.size();
          rules[0].x.push_back(points);
          const bool ok = a.report.status == Status::converged;
          rules[0].y.push_back(ok ? 100 * a.probes[2] / truth_small : NAN);
          rows.push_back({std::to_string(n) + " x " + std::to_string(n), std::to_string(points),
                          ok ? percent(a.probes[2], truth_small) : name(a.report.status)});
        }
        out << table({"rays", "points", "tip of the truth"}, rows);
      },
      [&](Picture& picture) {
        draw_charts(picture,
                    {{{.label = "points inside", .lower = 50, .upper = 4000, .logarithmic = true},
                      {.label = "tip's deflection, % of the truth", .lower = 0},
                      rules}});
      });

  // [4] More patches, higher degrees; the paper's formulation beside it.
  std::vector<Trace> shares;
  lesson.step(
      "More patches: projected and condensed",
      [&](std::ostream& out) {
        shares = {{"projected, n = 2", {}, {}},
                  {"condensed, n = 1", {}, {}},
                  {"condensed, n = 2", {}, {}},
                  {"condensed, n = 3", {}, {}}};
        std::vector<std::vector<std::string>> rows;
        const auto add = [&](int trace, const Answer& a) {
          const auto& d = a.model->discretization;
          const double share = 100 * a.probes[2] / truth_small;
          shares[trace].x.push_back(d.boundary.n_parts());
          shares[trace].y.push_back(share);
          rows.push_back({shares[trace].label, std::to_string(d.boundary.n_parts()),
                          std::to_string(a.model->n_unknowns()), rounded(share, 3) + " %"});
        };
        for (const int k : {1, 2, 4, 6}) add(0, solve(builtin_scene("beam", projected(k, 0.01))));
        for (int n = 1; n <= 3; ++n)
          for (int k = 1; k <= (n == 3 ? 2 : 3); ++k)
            add(n, solve(builtin_scene("beam_condensed", condensed(k, n, 6, 0.01))));
        out << table({"tip of the truth", "patches", "unknowns", ""}, rows);
      },
      [&](Picture& picture) {
        draw_charts(picture,
                    {{{.label = "patches", .lower = 0, .upper = 28},
                      {.label = "tip's deflection, % of the truth", .lower = 0, .upper = 110},
                      shares}});
      });

  // [5] All of the load, in one step from rest: Newton's method with a line search.
  Answer large;
  lesson.step(
      "Under its weight",
      [&](std::ostream& out) {
        heavy = builtin_scene("beam_condensed", condensed(along, degree, rays, 10));
        large = solve(heavy);
        painter = std::make_unique<SolidPainter>(heavy);
        out << name(large.report.status) << " in " << large.report.iterations
            << " iterations\ntip: u_z = " << rounded(large.probes[2], 4) << " m, "
            << percent(large.probes[2], truth_large) << " of the truth " << rounded(truth_large)
            << " m\na thousand times [2] would be " << rounded(1000 * small.probes[2], 4)
            << " m\nclamp's force - weight: " << error_text(large.probes[5] / 5e4 - 1, 1e-6)
            << "\n";
      },
      [&](Picture& picture) { view.draw_frame(picture, *painter, *large.model, large.state); });
  return lesson.run(argc, argv);
}
// Next: step_05_trims, holes.
