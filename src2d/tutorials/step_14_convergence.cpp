// Step 14: what converges, and why
//
//   build/release/bin/sem2d_step_14_convergence --out out/step_14       numbers, pictures
//   build/release/bin/sem2d_step_14_convergence --set body=L            not convex
//   build/release/bin/sem2d_step_14_convergence --interactive           alpha, n, parts as sliders
//
// New here: the paper's method, given more parts or a higher degree, does not come closer to the
// truth. Three things stand in the way; without them the same weights and polynomials converge.
// The test is a smooth displacement u that is known: body force b = -div P(u), traction t = P(u) N
// on a free body, linear elasticity. A map x = X + sum_j N_j(X) z_j, F = sum_j z_j (x) B_j answers
//
//   (a)  K z = f,   K = int B^T C B dX,   f = int N^T b dX + int N^T t da
//   (b)  error: |e|_E / |grad u|_E,  e = F - grad u,  |e|_E^2 = int Psi(e) dX
//   (c)  K z* = f*,  f* = int B^T P(u) dX:  no z has a smaller error (b) than z*
//   (d)  int F dX = int x (x) N da        if F = grad x and x has no jumps
//
// By (d) for P^T x in place of x, f = f* and the answer is the best there is (Galerkin). Otherwise
// |e|^2 = |e*|^2 + |F(z) - F(z*)|^2: what the functions cannot do, and what the equations get wrong.
//
// Things to try: --set alpha=1.4; --set degree=1 --set m=4; --set body=L --set degree=2. Which of
// the pictures changes its message?
#include <chrono>
#include <cmath>

#include "sem/lesson/lesson.h"
#include "sem/mechanics/loads.h"
#include "src2d/shapes/shapes.h"
#include "src2d/tutorials/convergence.h"
#include "src2d/tutorials/plots.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

const int splits[] = {1, 2, 4};  // parts a side
const Axis parts_axis{.label = "parts a side", .lower = 0.9, .upper = 4.5, .logarithmic = true,
                      .ticks = {{1, "1"}, {2, "2"}, {4, "4"}}};
std::string percent(double share) { return rounded(100 * share, 2) + " %"; }
Axis error_axis(double lower, double upper, const std::string& label = "relative error (b)") {
  return {.label = label, .lower = lower, .upper = upper, .logarithmic = true};
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 14: what converges, and why", {{-0.2, -0.2}, {1.4, 1.4}});
  const baseline::Manufactured exact;

  // [1] The displacement, checked three times.
  AttemptOptions options;
  Cells cells;
  const auto exact_at = [&](const Points<2>& X) {
    Points<2> u(2, X.cols());
    for (int k = 0; k < X.cols(); ++k) u.col(k) = exact.displacement(X.col(k));
    return u;
  };
  lesson.choice("body", options.convex, {{"square", true}, {"L", false}}, "convex or not");
  lesson.step(
      "A displacement that is known",
      [&](std::ostream& out) {
        MethodOptions method;
        method.interior_rule.rule = InteriorRule::exact;
        std::vector<Nurbs<1, 2>> parts;
        for (const auto& part : baseline::manufactured_body(options.convex, 1))
          parts.push_back(part.shape);
        const auto d = discretize<2>({parts}, method);
        cells = cells_inside(d.boundary, d.loops, 48);
        Vec<2> force(0, 0);
        double work = 0, energy = 0, size = 0;
        const auto add = [&](const Vec<2>& X, const Vec<2>& f) {
          force += f;
          work += f.dot(exact.displacement(X));
          size += f.norm();
        };
        for (int k = 0; k < d.quadrature.size(); ++k) {
          const Vec<2> X = d.quadrature.position.col(k);
          add(X, d.quadrature.weight[k] * exact.body_force(X));
          const Mat<2> F = Mat<2>::Identity() + exact.gradient(X);
          energy += d.quadrature.weight[k] * energy_density<2>(exact.material, F);
        }
        const auto rule = boundary_rule(d);
        for (int s = 0; s < rule.samples.size(); ++s) {
          const Vec<2> X = rule.samples.position.col(s);
          add(X, rule.samples.weight[s] * exact.stress(X) * rule.normal.col(s));
        }
        const Vec<2> X(0.3, 0.4);
        const Check stress([&](const VectorXd& at) -> VectorXd { return exact.stress(at).reshaped(); },
                           X, MatrixXd::Zero(4, 2));
        (void)stress;
        out << "energy " << rounded(energy, 6) << " J = |grad u|_E^2\nforces b and t add up to "
            << error_text(force.norm() / size, 1e-9) << " of their sizes\nhalf their work / energy - 1: "
            << error_text(work / 2 / energy - 1, 1e-9) << "\n";
      },
      [&](Picture& picture) {
        draw_answer(picture, cells, exact_at(cells.center), 0.25, picture.part({0, 0}, {1, 1}),
                    "u, drawn at a quarter; squares of 0.125 m at rest");
      });

  // [2] Steps 1 to 11 on it.
  Attempt paper;
  std::vector<Trace> errors;
  lesson.slider("degree", options.degree, 1, 4, "n");
  lesson.slider("m", options.m, 1, 4, "parts a side, of pictures");
  lesson.slider("alpha", options.cutoff, 0.55, 1.5, "cutoff, m", Lesson::Scale::logarithmic);
  const auto with = [&](int m, int n) {
    AttemptOptions changed = options;
    changed.m = m;
    changed.degree = n;
    return changed;
  };
  lesson.step(
      "The paper's answers",
      [&](std::ostream& out) {
        errors.clear();
        std::vector<std::vector<std::string>> rows;
        for (const int m : splits) rows.push_back({std::to_string(m)});
        for (int n = 1; n <= 3; ++n) {
          Trace& trace = errors.emplace_back(Trace{"n = " + std::to_string(n), {}, {}});
          for (int i = 0; i < 3; ++i) {
            trace.x.push_back(splits[i]);
            trace.y.push_back(attempt(Rung::paper, with(splits[i], n)).answer.energy);
            rows[i].push_back(percent(trace.y.back()));
          }
        }
        out << "error (b)\n" << table({"parts a side", "n = 1", "n = 2", "n = 3"}, rows);
        paper = attempt(Rung::paper, options);
        out << "the picture's: " << percent(paper.answer.energy) << ", displacement "
            << percent(displacement_error(paper, paper.answer.u)) << "\n";
      },
      [&](Picture& picture) {
        draw_charts(picture, {{parts_axis, error_axis(0.1, 100), errors}},
                    picture.part({0.01, 0.02}, {0.5, 0.97}));
        draw_answer(picture, cells, displacement(paper, paper.answer.u, cells.center), 0.25,
                    picture.part({0.5, 0}, {1, 1}), "squares: the answer; line: exact");
      });

  // [3]
  baseline::ManufacturedSolution nearest;
  lesson.step(
      "First reason: F is not the gradient of x",
      [&](std::ostream& out) {
        nearest = nearest_gradient(paper);
        const Attempt kept = attempt(Rung::exact_gradient, options);
        out << "z* of (c): F is off by " << percent(nearest.energy) << ", x by "
            << percent(displacement_error(paper, nearest.u))
            << "\nanswer: F is off by " << percent(paper.answer.energy) << ", (d) by "
            << percent(divergence_defect(paper, paper.answer.u)) << "\nwith grad w in F: "
            << percent(kept.answer.energy) << ", (d) by "
            << percent(divergence_defect(kept, kept.answer.u)) << "\n";
      },
      [&](Picture& picture) {
        draw_error(picture, cells, error_field(paper, nearest.u, cells.center),
                   picture.part({0, 0.08}, {0.5, 1}), "error of F(z*)");
        draw_answer(picture, cells, displacement(paper, nearest.u, cells.center), 0.25,
                    picture.part({0.5, 0.08}, {1, 1}), "squares: x of z*; line: exact");
      });

  // [6]
  std::vector<Trace> ladder;
  lesson.step(
      "One after another",
      [&](std::ostream& out) {
        ladder.clear();
        std::vector<std::vector<std::string>> rows;
        for (const Rung rung : rungs) {
          rows.push_back({rung_names[int(rung)]});
          Trace answer{rung_names[int(rung)], {}, {}}, best{"its best", {}, {}};
          for (const int m : splits) {
            const Attempt now = attempt(rung, with(m, options.degree));
            answer.x.push_back(m), best.x.push_back(m);
            answer.y.push_back(now.answer.energy);
            best.y.push_back(nearest_gradient(now).energy);
            rows.back().push_back(percent(answer.y.back()) + " (" + percent(best.y.back()) + ", d " + percent(divergence_defect(now, now.answer.u)) + ", x " + percent(displacement_error(now, now.answer.u))+ ")");
          }
          ladder.push_back(answer), ladder.push_back(best);
        }
        out << table({"error (b), of z* in brackets", "1 part a side", "2", "4"}, rows);
      },
      [&](Picture& picture) { draw_charts(picture, {{parts_axis, error_axis(1e-4, 100), ladder}}); });

  // [9]
  lesson.step(
      "The cantilever's tip",
      [&](std::ostream& out) {
        for (const std::string scene : {"cantilever", "cantilever_condensed"})
          for (const int n : {2, 3})
            for (const int m : {1, 2, 4, 8}) {
              int n_unknowns;
              const std::string M = std::to_string(m);
              const auto t0 = std::chrono::steady_clock::now();
              const double share = tip_share(scene,
                                             {"solids[0].shape.parts=[" + M + ",1," + M + ",1]",
                                              "method.degree=" + std::to_string(n)},
                                             n_unknowns);
              out << scene << " n " << n << " m " << m << ": " << n_unknowns << " " << share << " " << std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count() << "\n";
            }
      },
      [&](Picture&) {});
  return lesson.run(argc, argv);
}
