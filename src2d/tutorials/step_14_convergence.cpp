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
// Things to try: --set alpha=1.4; --set degree=1 --set parts=4; --set body=L --set degree=2. Which of
// the pictures changes its message?
#include "sem/lesson/lesson.h"
#include "src2d/tutorials/beam.h"
#include "src2d/tutorials/convergence.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

Axis numbers(const std::string& label, const std::vector<int>& values, bool logarithmic) {
  Axis axis{.label = label, .lower = 0.85, .upper = 1.1 * values.back(), .logarithmic = logarithmic};
  for (const int i : values) axis.ticks.emplace_back(i, std::to_string(i));
  return axis;
}
Axis errors(double lower, double upper) {
  return {.label = "relative error (b)", .lower = lower, .upper = upper, .logarithmic = true};
}
const Axis parts_axis = numbers("parts a side", {1, 2, 4}, true);
std::string degree_text(int n) { return "n = " + std::to_string(n); }

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 14: what converges, and why", {{-0.2, -0.2}, {1.4, 1.4}});

  // [1] Two checks of b and t by an exact rule: equilibrium, and Clapeyron's theorem.
  AttemptOptions options;
  Cells cells;
  Grid grid;
  lesson.choice("body", options.convex, {{"square", true}, {"L", false}}, "convex or not");
  lesson.step(
      "A displacement that is known",
      [&](std::ostream& out) {
        const Balance sum = balance(options.convex, cells);
        grid = make_grid(options.convex, cells.outline);
        out << "energy: " << rounded(sum.energy) << " J\nb and t add up to "
            << error_text(sum.force.norm() / sum.size, 1e-9)
            << " of their size\nhalf of their work / energy - 1: "
            << error_text(sum.work / 2 / sum.energy - 1, 1e-9) << "\n";
      },
      [&](Picture& picture) {
        draw_answer(picture, grid, exact_displacement(grid.X), picture.part({0, 0}, {1, 1}),
                    "u, drawn at a quarter of its size; the lines were straight and 1/8 m apart");
      });

  // [2] Steps 1 to 11; the stability term has the program's default gamma, 10 n^2 E / h.
  Attempt paper;
  std::vector<Trace> papers;
  lesson.slider("degree", options.degree, 1, 4, "n");
  lesson.slider("parts", options.m, 1, 4, "a side, of the pictures");
  lesson.slider("alpha", options.cutoff, 0.55, 1.5, "cutoff, m", Lesson::Scale::logarithmic);
  const auto splits = [&] {  // fewer in a drag
    return lesson.quick() ? std::vector<double>{1, 2} : std::vector<double>{1, 2, 4};
  };
  lesson.step(
      "The paper's answers: the more parts, the worse",
      [&](std::ostream& out) {
        papers.clear();
        for (const int n : {1, 2, 3})
          papers.push_back(sweep(degree_text(n), splits(), [&](double m) {
            return attempt(Rung::paper, options.with(m, n)).answer.energy;
          }));
        paper = attempt(Rung::paper, options);
        out << percent_table("error (b) in %; parts a side:", papers)
            << "picture: F is off by " << percent(paper.answer.energy) << " %, u by "
            << percent(displacement_error(paper, paper.answer.u)) << " %\n";
      },
      [&](Picture& picture) {
        draw_charts(picture, {{parts_axis, errors(0.1, 100), papers}},
                    picture.part({0.01, 0.02}, {0.5, 0.97}));
        draw_answer(picture, grid, displacement(paper, paper.answer.u, grid.X),
                    picture.part({0.5, 0}, {1, 1}), "blue: the answer, black: exact");
      });

  // [3] The F nearest to grad u belongs to an x that is not near X + u: a small F may hide a large
  // deformation, and forces, which work on x, find the way there.
  baseline::ManufacturedSolution nearest;
  double nearest_u = 0;
  lesson.step(
      "First reason: F is not the gradient of x",
      [&](std::ostream& out) {
        nearest = nearest_gradient(paper);
        nearest_u = displacement_error(paper, nearest.u);
        out << "z*: F is off by " << percent(nearest.energy) << " %, u by " << percent(nearest_u)
            << " %; (d) is off by " << error_text(divergence_defect(paper, nearest.u), 1e-4)
            << " |int grad u dX|\n";
      },
      [&](Picture& picture) {
        draw_error(picture, cells, error_field(paper, nearest.u, cells.center),
                   picture.part({0, 0.05}, {0.5, 1}),
                   "F of z*, off by " + percent(nearest.energy) + " %");
        draw_answer(picture, grid, displacement(paper, nearest.u, grid.X),
                    picture.part({0.5, 0.05}, {1, 1}),
                    "blue: x of z*, u off by " + percent(nearest_u) + " %; black: exact");
      });

  // [4] grad w in F, step 8's (12'). On a part the published theta of all others is 0, beside it not:
  // x jumps there, (d) fails still. Sided theta: (1 - d / alpha) times a smooth step of the side.
  Attempt kept;
  std::vector<Trace> profiles;
  lesson.slider("tolerance", options.tolerance, 1e-4, 1e-1, "of the quadrature of sided weights",
                Lesson::Scale::logarithmic);
  lesson.step(
      "Second reason: the weights jump",
      [&](std::ostream& out) {
        kept = attempt(Rung::exact_gradient, options);
        const Attempt sided = attempt(Rung::continuous_weights, options);
        profiles = {weight_profile(kept, "published"), weight_profile(sided, "sided")};
        for (const bool first : {true, false}) {
          const Attempt& now = first ? kept : sided;
          const Trace& w = profiles[first ? 0 : 1];
          out << w.label << ": w on the part " << rounded(w.y[0], 3) << ", 1e-6 m beside it "
              << rounded(w.y[1], 3) << "\n  F is off by " << percent(now.answer.energy)
              << " %; (d) by " << error_text(divergence_defect(now, now.answer.u), 1e-4) << "\n";
        }
      },
      [&](Picture& picture) {
        const Axis w{.label = "w of the bottom's part at x = 0.3 m", .lower = 0, .upper = 1.05};
        draw_charts(picture, {{{.label = "y, m", .lower = -0.02}, w, profiles}},
                    picture.part({0.01, 0.02}, {0.5, 0.97}));
        draw_answer(picture, grid, displacement(kept, kept.answer.u, grid.X),
                    picture.part({0.5, 0}, {1, 1}), "published weights: inside blue, boundary red",
                    displacement(kept, kept.answer.u, grid.outline));
      });

  // [5] On y = h the monomials X^a Y^b are multiples of 1, X, ..., X^n. What the edge does not see
  // the fit sets by its own rule, whatever the body does: control points cannot change it.
  Attempt tied, free;
  VectorXd fields[2];
  lesson.step(
      "Third reason: what a straight edge does not see",
      [&](std::ostream& out) {
        tied = attempt(Rung::continuous_weights, options);
        free = attempt(Rung::free_coefficients, options);
        const auto& samples = tied.body().samples;
        const Points<2> edge = samples.position.leftCols(samples.first[1]);
        for (const int n : {1, 2, 3, 4}) {
          const MatrixXd m = monomial_rows(n, edge, edge.rowwise().mean());
          out << degree_text(n) << ": " << m.cols() << " monomials, an edge sees " << rank(m) << "\n";
        }
        for (const Attempt* now : {&tied, &free}) {
          const auto best = nearest_gradient(*now);
          fields[now == &free] = error_field(*now, best.u, cells.center);
          out << "coefficients " << (now == &free ? "free:   " : "fitted: ")
              << 2 * now->body().unknowns.size() << " unknowns, nearest F off by "
              << percent(best.energy) << " %\n";
        }
      },
      [&](Picture& picture) {
        draw_error(picture, cells, fields[0], picture.part({0, 0.05}, {0.5, 1}),
                   "nearest F, coefficients fitted to edges");
        draw_error(picture, cells, fields[1], picture.part({0.5, 0.05}, {1, 1}),
                   "nearest F, coefficients free");
      });

  // [6] Each line has the changes of those above it.
  std::vector<Trace> ladder;
  lesson.step(
      "One change after another",
      [&](std::ostream& out) {
        ladder.clear();
        for (const Rung rung : rungs)
          for (const Trace& trace :
               sweep_attempts(rung_names[int(rung)], splits(), [&](double m) {
                 return attempt(rung, options.with(m, options.degree));
               }))
            ladder.push_back(trace);
        out << percent_table("error (b) in %; parts a side:", ladder);
      },
      [&](Picture& picture) { draw_pairs(picture, {{parts_axis, errors(1e-4, 100), ladder}}); });

  // [7] "formulation": "condensed" of a scene is the last line of [6].
  std::vector<Trace> degrees[2];
  lesson.step(
      "The condensed formulation: degree and parts",
      [&](std::ostream& out) {
        for (const bool convex : {true, false}) {
          auto& traces = degrees[convex ? 0 : 1];
          traces.clear();
          for (const int m : {1, 2})
            for (const Trace& trace :
                 sweep_attempts(std::to_string(m) + " a side", {1, 2, 3, 4}, [&](double n) {
                   AttemptOptions now = options.with(m, n);
                   now.convex = convex;
                   return attempt(Rung::free_coefficients, now);
                 }))
              traces.push_back(trace);
          out << percent_table(convex ? "square: error (b) in %; n:" : "L:", traces);
        }
      },
      [&](Picture& picture) {
        const Axis square = numbers("degree n, square", {1, 2, 3, 4}, false),
                   L = numbers("degree n, L", {1, 2, 3, 4}, false);
        draw_pairs(picture, {{square, errors(1e-4, 1), degrees[0]}, {L, errors(1e-4, 1), degrees[1]}});
      });

  // [8] The rule's error makes f differ from f*. More parts at one alpha halve the error, whatever n:
  // the functions become more, but not narrower; alpha cannot shrink, it has to cover the body.
  std::vector<Trace> rules, cutoffs;
  lesson.step(
      "What limits it: quadrature and the cutoff",
      [&](std::ostream& out) {
        rules = sweep_attempts("n = 3", {1e-1, 1e-2, 1e-3, 1e-4}, [&](double tolerance) {
          AttemptOptions now = options.with(2, 3);
          now.tolerance = tolerance;
          return attempt(Rung::free_coefficients, now);
        });
        cutoffs.clear();
        for (const int n : {1, 2})
          for (const double m : splits())
            cutoffs.push_back(sweep(degree_text(n) + ", " + rounded(m) + " a side",
                                    {0.55, 0.75, 1.5}, [&](double alpha) {
                                      AttemptOptions now = options.with(m, n);
                                      now.cutoff = alpha;
                                      return attempt(Rung::free_coefficients, now).answer.energy;
                                    }));
        out << percent_table("2 parts a side; tolerance:", rules) << percent_table("alpha:", cutoffs);
      },
      [&](Picture& picture) {
        draw_charts(picture, {{{.label = "tolerance of the quadrature", .logarithmic = true},
                               errors(1e-4, 1), rules, options.tolerance},
                              {{.label = "cutoff α, m"}, errors(1e-4, 1), cutoffs, options.cutoff}});
      });

  // [9] Built-in scenes: a clamp, singular corners, large strains. Truth: graded finite elements.
  std::vector<Trace> tips;
  lesson.step(
      "The cantilever's tip",
      [&](std::ostream& out) {
        tips.clear();
        for (const auto& [label, scene, n] : {std::tuple("the paper's, n = 2", "cantilever", 2),
                                              {"condensed, n = 2", "cantilever_condensed", 2},
                                              {"condensed, n = 3", "cantilever_condensed", 3}})
          tips.push_back(sweep(label, {1, 2, 4, 8}, [&, scene = scene, n = n](double along) {
            const std::string m = rounded(along);
            return tip_error(scene, {"solids[0].shape.parts=[" + m + ",1," + m + ",1]",
                                     "method.degree=" + std::to_string(n)});
          }));
        out << percent_table("error of u_y in %; parts along:", tips);
      },
      [&](Picture& picture) {
        Axis y = errors(1e-3, 1);
        y.label = "relative error of the tip's displacement";
        draw_charts(picture, {{numbers("parts along the beam", {1, 2, 4, 8}, true), y, tips}});
      });
  return lesson.run(argc, argv);
}
// Next: `sem2d run cantilever_condensed`, and its error estimate in summary.json.
