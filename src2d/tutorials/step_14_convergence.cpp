// Step 14: what converges, and why
//
//   build/release/bin/sem2d_step_14_convergence --out out/step_14     numbers, pictures
//   build/release/bin/sem2d_step_14_convergence --set body=L          a body that is not convex
//   build/release/bin/sem2d_step_14_convergence --interactive         n, parts, alpha as sliders
//
// New here: given more parts or a higher degree, the paper's method does not come closer to the
// truth. Three things stand in its way; without them the same polynomials converge. The test is a
// smooth displacement u that is known. Its body force b = -div P and traction t = P N, P = P(u) by
// linear elasticity, load a free body, whose map x = sum_j N_j z_j, F = sum_j z_j (x) B_j answers
//
//   (a)  K z = f,    K = int B^T C B dX (+ gamma S),   f = int N^T b dX + int N^T t da
//   (b)  |e| / |grad u|,    e = F - I - grad u,    |e|^2 = int Psi(I + e) dX       the error
//   (c)  K z* = f*,   f* = int B^T P dX:   F(z*) is the F nearest to I + grad u
//   (d)  int F dX = int x (x) N da,   if F = grad x and x has no jumps
//
// |e|^2 = |e*|^2 + |F(z) - F(z*)|^2: what the functions cannot do, and what the equations get
// wrong. The latter is 0 if f = f*: integrate by parts, as in (d), with P^T x in place of x.
//
// Things to try: --set alpha=1.4, --set degree=1 --set parts=4: which message changes? --set
// tolerance=1e-2: where does it show, and why not in [2]? What would [9] say at another cutoff?
#include "sem/lesson/lesson.h"
#include "src2d/tutorials/beam.h"
#include "src2d/tutorials/convergence.h"

using namespace sem;
using namespace sem::tutorial;

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
            << error_text(sum.work / 2 / sum.energy - 1, 1e-9)
            << "\nerror (b): that of F in the energy norm, by the size of grad u; z*, the nearest F: the least error "
               "these functions can have\n(d): what int F dX lacks of int x (x) N da, which it is if F = grad x\n";
      },
      [&](Picture& picture) {
        draw_answer(picture, grid, exact_displacement(grid.X), picture.part({0, 0}, {1, 1}),
                    "u, drawn at a quarter of its size; the lines were straight and 1/8 m apart");
      });

  // [2] Steps 1 to 11, with the program's default gamma, 10 n^2 E / h.
  Attempt paper;
  std::vector<Trace> papers;
  lesson.slider("degree", options.degree, 1, 4, "n");
  lesson.slider("parts", options.m, 1, 4, "a side, of the pictures");
  lesson.slider("alpha", options.cutoff, 0.55, 1.5, "cutoff, m", Lesson::Scale::logarithmic);
  const auto splits = [&] {
    return lesson.quick() ? std::vector{1., 2.} : std::vector{1., 2., 4.};
  };
  lesson.step(
      "The paper's answers: the more parts, the worse",
      [&](std::ostream& out) {
        papers.clear();
        for (const int n : {1, 2, 3})
          papers.push_back(sweep("n = " + std::to_string(n), splits(), [&](double m) {
            return attempt(Rung::paper, options.with(m, n)).answer.energy;
          }));
        paper = attempt(Rung::paper, options);
        out << percent_table("error (b) in %; parts a side:", papers) << "picture: F is off by "
            << percent(paper.answer.energy) << " %, u by "
            << percent(displacement_error(paper, paper.answer.u)) << " %\n";
      },
      [&](Picture& picture) {
        draw_charts(picture, {{axis_of("parts a side", 4), error_axis(0.1, 100), papers}},
                    picture.part({0.01, 0.02}, {0.5, 0.97}));
        draw_answer(picture, grid, displacement(paper, paper.answer.u, grid.X),
                    picture.part({0.5, 0}, {1, 1}), "blue: the answer, black: exact");
      });

  // [3] The F nearest to I + grad u comes with an x that is far from X + u. Forces act on x.
  ManufacturedSolution nearest;
  double off = 0;
  lesson.step(
      "First reason: F is not the gradient of x",
      [&](std::ostream& out) {
        nearest = nearest_gradient(paper);
        off = displacement_error(paper, nearest.u);
        out << "z*: F is off by " << percent(nearest.energy) << " %, u by " << percent(off)
            << " %, (d) by " << error_text(divergence_defect(paper, nearest.u), 1e-4)
            << " |int grad u dX|\n";
      },
      [&](Picture& picture) {
        draw_error(picture, cells, error_field(paper, nearest.u, cells.center),
                   picture.part({0, 0.05}, {0.5, 1}),
                   "F of z*, off by " + percent(nearest.energy) + " %");
        draw_answer(picture, grid, displacement(paper, nearest.u, grid.X),
                    picture.part({0.5, 0.05}, {1, 1}),
                    "blue: x of z*, u off by " + percent(off) + " %; black: exact");
      });

  // [4] F with grad w is step 8's (12'). But on a part the published weights of all others are 0,
  // beside it they are not: x jumps, (d) still fails. Sided weights (sided_weight.h) are continuous.
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
          const auto& [name, y, w] = profiles[first ? 0 : 1];
          out << name << ": w on the part " << rounded(w[0], 3) << ", beside it "
              << rounded(w[1], 3) << "; answer: F is off by " << percent(now.answer.energy)
              << " %, (d) by " << error_text(divergence_defect(now, now.answer.u), 1e-4) << "\n";
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

  // [5] On y = h the monomials X^a Y^b are multiples of 1, X, ..., X^n. What an edge does not see
  // the fit sets by a rule of its own. The remedy: the coefficients themselves are the unknowns.
  VectorXd fields[2];
  lesson.step(
      "Third reason: what a straight edge does not see",
      [&](std::ostream& out) {
        const Attempt tied = attempt(Rung::continuous_weights, options),
                      free = attempt(Rung::free_coefficients, options);
        const auto& samples = tied.body().samples;
        const Points<2> edge = samples.position.leftCols(samples.first[1]);
        for (const int n : {1, 2, 3, 4}) {
          const MatrixXd m = monomial_rows(n, edge, edge.rowwise().mean());
          out << "n = " << n << ": " << m.cols() << " monomials, an edge sees " << rank(m) << "\n";
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

  // [6] Each line has the changes of those before it. The last is "formulation": "condensed".
  std::vector<Trace> ladder;
  lesson.step(
      "One change after another",
      [&](std::ostream& out) {
        ladder.clear();
        for (const Rung rung : rungs)
          add_attempts(ladder, rung_names[int(rung)], splits(),
                       [&](double m) { return attempt(rung, options.with(m, options.degree)); });
        out << percent_table("error (b) in %; parts a side:", ladder);
      },
      [&](Picture& picture) {
        draw_pairs(picture, {{axis_of("parts a side", 4), error_axis(1e-4, 100), ladder}});
      });

  // [7] A degree more gains more than twice the parts, until the answer leaves the nearest F.
  std::vector<Trace> degrees[2];
  lesson.step(
      "The condensed formulation: degree and parts",
      [&](std::ostream& out) {
        for (const bool convex : {true, false}) {
          auto& traces = degrees[convex ? 0 : 1];
          traces.clear();
          for (int m = 1; m <= (lesson.quick() ? 1 : 2); ++m)
            add_attempts(traces, std::to_string(m) + " a side", {1, 2, 3, 4}, [&](double n) {
              return attempt(Rung::free_coefficients,
                             {convex, m, int(n), options.cutoff, options.tolerance});
            });
          out << percent_table(convex ? "square: error (b) in %; n:" : "L:", traces);
        }
      },
      [&](Picture& picture) {
        draw_pairs(picture,
                   {{axis_of("degree n, square", 4, false), error_axis(1e-4, 1), degrees[0]},
                    {axis_of("degree n, L", 4, false), error_axis(1e-4, 1), degrees[1]}});
      });

  // [8] A rule's error makes f differ from f*. Twice the parts about halve the error, for n = 2 as
  // for n = 1 (finite elements: 2^-n): functions stay as wide as alpha, which covers the body.
  std::vector<Trace> rules, cutoffs;
  lesson.step(
      "What limits it: quadrature and the cutoff",
      [&](std::ostream& out) {
        rules.clear();
        add_attempts(rules, "n = 3", {1e-2, 1e-3, 1e-4}, [&](double tolerance) {
          return attempt(Rung::free_coefficients, {false, 2, 3, options.cutoff, tolerance});
        });
        cutoffs.clear();
        for (const int n : {1, 2})
          for (const double m : splits())
            cutoffs.push_back(
                sweep("n = " + std::to_string(n) + ", " + rounded(m) + " a side", {0.55, 0.75, 1.5},
                      [&](double alpha) {
                        return attempt(Rung::free_coefficients,
                                       {options.convex, int(m), n, alpha, options.tolerance})
                            .answer.energy;
                      }));
        out << percent_table("L, 2 a side; tolerance:", rules) << percent_table("alpha:", cutoffs);
      },
      [&](Picture& picture) {
        const Axis rule{.label = "tolerance of the quadrature, L", .logarithmic = true};
        draw_charts(picture,
                    {{rule, error_axis(1e-4, 1), rules, options.tolerance},
                     {{.label = "cutoff α, m"}, error_axis(1e-4, 1), cutoffs, options.cutoff}});
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
        draw_charts(picture, {{axis_of("parts along the beam", 8),
                               error_axis(1e-3, 1, "relative error of the tip's u_y"), tips}});
      });
  return lesson.run(argc, argv);
}
// Next: `sem2d run cantilever_condensed`, and its error estimate in summary.json.
