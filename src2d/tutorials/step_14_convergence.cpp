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

const int splits[] = {1, 2, 4};  // parts a side

Axis parts_axis() {
  return {.label = "parts a side",
          .lower = 0.9,
          .upper = 4.5,
          .logarithmic = true,
          .ticks = {{1, "1"}, {2, "2"}, {4, "4"}}};
}
Axis error_axis(double lower, double upper, const std::string& label = "relative error (b)") {
  return {.label = label, .lower = lower, .upper = upper, .logarithmic = true};
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 14: what converges, and why", {{-0.2, -0.2}, {1.4, 1.4}});
  const baseline::Manufactured exact;

  // [1] Two checks of b and t against u: equilibrium, and Clapeyron's theorem.
  AttemptOptions options;
  Cells cells;
  Grid grid;
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
        grid = make_grid(options.convex, cells.outline);
        Vec<2> force(0, 0);
        double work = 0, energy = 0, size = 0;
        const auto add = [&](const Vec<2>& X, const Vec<2>& f) {
          force += f;
          size += f.norm();
          work += f.dot(exact.displacement(X));
        };
        for (int k = 0; k < d.quadrature.size(); ++k) {
          const Vec<2> X = d.quadrature.position.col(k);
          const Mat<2> F = Mat<2>::Identity() + exact.gradient(X);
          add(X, d.quadrature.weight[k] * exact.body_force(X));
          energy += d.quadrature.weight[k] * energy_density<2>(exact.material, F);
        }
        const auto rule = boundary_rule(d);
        for (int s = 0; s < rule.samples.size(); ++s) {
          const Vec<2> X = rule.samples.position.col(s);
          add(X, rule.samples.weight[s] * exact.stress(X) * rule.normal.col(s));
        }
        out << "energy: " << rounded(energy, 6) << " J\nb and t add up to "
            << error_text(force.norm() / size, 1e-9)
            << " of their size\nhalf of their work / energy - 1: "
            << error_text(work / 2 / energy - 1, 1e-9) << "\n";
      },
      [&](Picture& picture) {
        Points<2> u = grid.X;
        for (auto column : u.colwise()) column = exact.displacement(column);
        draw_answer(picture, grid, u, picture.part({0, 0}, {1, 1}),
                    "u, drawn at a quarter; lines were 1/8 m apart");
      });

  // [2] Steps 1 to 11. The stability term has the program's default gamma, 10 n^2 E / h.
  Attempt paper;
  std::vector<Trace> errors;
  lesson.slider("degree", options.degree, 1, 4, "n");
  lesson.slider("parts", options.m, 1, 4, "a side, of the pictures");
  lesson.slider("alpha", options.cutoff, 0.55, 1.5, "cutoff, m", Lesson::Scale::logarithmic);
  const auto with = [&](int m, int n) {
    AttemptOptions changed = options;
    changed.m = m;
    changed.degree = n;
    return changed;
  };
  const auto n_splits = [&] { return lesson.quick() ? 2 : 3; };  // fewer in a drag
  lesson.step(
      "The paper's answers: the more parts, the worse",
      [&](std::ostream& out) {
        errors.clear();
        std::vector<std::vector<std::string>> rows;
        for (int n = 1; n <= 3; ++n) {
          errors.push_back({"n = " + std::to_string(n), {}, {}});
          rows.push_back({errors.back().label});
          for (int i = 0; i < n_splits(); ++i) {
            errors.back().x.push_back(splits[i]);
            errors.back().y.push_back(attempt(Rung::paper, with(splits[i], n)).answer.energy);
            rows.back().push_back(percent(errors.back().y.back()));
          }
          rows.back().resize(4);
        }
        paper = attempt(Rung::paper, options);
        out << table({"error (b), %", "1 part a side", "2", "4"}, rows)
            << "picture: " << percent(paper.answer.energy) << " %, x - X off by "
            << percent(displacement_error(paper, paper.answer.u)) << " %\n";
      },
      [&](Picture& picture) {
        draw_charts(picture, {{parts_axis(), error_axis(0.1, 100), errors}},
                    picture.part({0.01, 0.02}, {0.5, 0.97}));
        draw_answer(picture, grid, displacement(paper, paper.answer.u, grid.X),
                    picture.part({0.5, 0}, {1, 1}), "blue: the answer, black: exact");
      });

  // [3] z* of (c): the F that fits grad u best belongs to a map that does not.
  baseline::ManufacturedSolution nearest;
  lesson.step(
      "First reason: F is not the gradient of x",
      [&](std::ostream& out) {
        nearest = nearest_gradient(paper);
        out << "z* of (c): F is off by " << percent(nearest.energy) << " %, x - X by "
            << percent(displacement_error(paper, nearest.u)) << " %, (d) fails by "
            << percent(divergence_defect(paper, nearest.u)) << " %\nanswer:    F is off by "
            << percent(paper.answer.energy) << " %, x - X by "
            << percent(displacement_error(paper, paper.answer.u)) << " %, (d) fails by "
            << percent(divergence_defect(paper, paper.answer.u)) << " %\n";
      },
      [&](Picture& picture) {
        draw_error(picture, cells, error_field(paper, nearest.u, cells.center),
                   picture.part({0, 0.05}, {0.5, 1}), "F of z*: near the exact one");
        draw_answer(picture, grid, displacement(paper, nearest.u, grid.X),
                    picture.part({0.5, 0.05}, {1, 1}), "blue: x of z*, black: exact");
      });

  // [4] With grad w in F, (d) holds where x has no jumps. The published theta of all other parts is
  // 0 on a part but not beside it.
  Attempt kept;
  std::vector<Trace> profiles;
  lesson.step(
      "Second reason: the weights jump",
      [&](std::ostream& out) {
        kept = attempt(Rung::exact_gradient, options);
        Attempt sided = attempt(Rung::continuous_weights, options);
        Points<2> X = Points<2>::Constant(2, 42, 0.3);  // from the bottom upwards
        for (int k = 0; k < 42; ++k) X(1, k) = k == 0 ? 0 : k == 1 ? 1e-6 : (k - 1) * 0.01;
        profiles.clear();
        for (const Attempt* now : {&kept, &sided}) {
          const MatrixXd w = weights_at(*now, X);
          int own = 0;
          w.row(0).maxCoeff(&own);
          profiles.push_back({now == &kept ? "published" : "sided", {X.row(1).begin(), X.row(1).end()},
                              column(w, own)});
          out << profiles.back().label << ": w on the part " << rounded(w(0, own), 3)
              << ", 1e-6 m inside " << rounded(w(1, own), 3) << "; F with grad w is off by "
              << percent(now->answer.energy) << " %, (d) fails by "
              << percent(divergence_defect(*now, now->answer.u)) << " %\n";
        }
      },
      [&](Picture& picture) {
        draw_charts(picture, {{{.label = "distance from the bottom, m", .lower = -0.02},
                               {.label = "w of the part below", .lower = 0, .upper = 1.05},
                               profiles}},
                    picture.part({0.01, 0.02}, {0.5, 0.97}));
        draw_answer(picture, grid, displacement(kept, kept.answer.u, grid.X),
                    picture.part({0.5, 0}, {1, 1}), "published: inside (blue) and boundary (red)",
                    displacement(kept, kept.answer.u, grid.outline));
      });

  // [5] On y = h the monomials X^a Y^b are multiples of 1, X, ..., X^n. The fit has to invent the rest.
  Attempt tied, free;
  VectorXd field[2];
  lesson.step(
      "Third reason: what a straight edge does not know",
      [&](std::ostream& out) {
        tied = attempt(Rung::continuous_weights, options);
        free = attempt(Rung::free_coefficients, options);
        const auto& samples = tied.body().samples;
        const Points<2> edge = samples.position.leftCols(samples.first[1]);
        std::vector<std::vector<std::string>> rows{{"monomials"}, {"seen by an edge"}};
        for (int n = 1; n <= 4; ++n) {
          const MatrixXd m = monomial_rows(n, edge, edge.rowwise().mean());
          rows[0].push_back(std::to_string(m.cols()));
          rows[1].push_back(std::to_string(rank(m)));
        }
        out << table({"", "n = 1", "2", "3", "4"}, rows);
        for (const Attempt* now : {&tied, &free}) {
          const auto best = nearest_gradient(*now);
          field[now == &free] = error_field(*now, best.u, cells.center);
          out << (now == &free ? "free coefficients: " : "fitted ones: ")
              << 2 * now->body().unknowns.size() << " unknowns, nearest F off by "
              << percent(best.energy) << " %\n";
        }
      },
      [&](Picture& picture) {
        draw_error(picture, cells, field[0], picture.part({0, 0.05}, {0.5, 1}),
                   "nearest F, coefficients fitted to the edges");
        draw_error(picture, cells, field[1], picture.part({0.5, 0.05}, {1, 1}),
                   "nearest F, coefficients free");
      });

  // [6] All three.
  std::vector<Climb> ladder;
  lesson.step(
      "One change after another",
      [&](std::ostream& out) {
        ladder.clear();
        std::vector<std::vector<std::string>> rows;
        for (const Rung rung : rungs) {
          Climb& climb = ladder.emplace_back();
          rows.push_back({rung_names[int(rung)]});
          for (int i = 0; i < n_splits(); ++i) {
            const Attempt now = attempt(rung, with(splits[i], options.degree));
            climb.parts.push_back(splits[i]);
            climb.answer.push_back(now.answer.energy);
            climb.nearest.push_back(nearest_gradient(now).energy);
            rows.back().push_back(percent(climb.answer.back()) + " (" +
                                  percent(climb.nearest.back()) + ")");
          }
          rows.back().resize(4);
        }
        out << table({"error (b) (nearest), %", "1 part a side", "2", "4"}, rows);
      },
      [&](Picture& picture) {
        draw_ladder(picture, ladder, parts_axis(), error_axis(1e-4, 100));
      });

  // [7] "formulation": "condensed" of a scene.
  std::vector<Trace> degrees[2];
  lesson.step(
      "The condensed formulation: degree and parts",
      [&](std::ostream& out) {
        std::vector<std::vector<std::string>> rows;
        for (const bool convex : {true, false}) {
          degrees[!convex].clear();
          for (int i = 0; i < n_splits() - !convex; ++i) {
            const std::string m = std::to_string(splits[i]);
            Trace trace{m + (i == 0 ? " part a side" : " parts a side"), {}, {}};
            rows.push_back({(convex ? "square, " : "L, ") + trace.label});
            for (int n = 1; n <= 4; ++n) {
              AttemptOptions now = with(splits[i], n);
              now.convex = convex;
              trace.x.push_back(n);
              trace.y.push_back(attempt(Rung::free_coefficients, now).answer.energy);
              rows.back().push_back(percent(trace.y.back()));
            }
            degrees[!convex].push_back(trace);
          }
        }
        out << table({"error (b), %", "n = 1", "2", "3", "4"}, rows);
      },
      [&](Picture& picture) {
        std::vector<Chart> charts;
        for (const bool convex : {true, false})
          charts.push_back({count_axis(convex ? "degree n, square" : "degree n, L", 4),
                            error_axis(1e-4, 1), degrees[!convex]});
        for (auto& chart : charts) chart.x.lower = 0.8;
        draw_charts(picture, charts);
      });

  // [8] The rule's error in f - f*, and the width of the functions: it is alpha, not the part's.
  std::vector<Trace> rule_errors, cutoff_errors;
  double tolerance = 1e-3;
  lesson.slider("tolerance", tolerance, 1e-5, 1e-1, "of the quadrature of weights",
                Lesson::Scale::logarithmic);
  lesson.step(
      "What limits it: quadrature and the cutoff",
      [&](std::ostream& out) {
        AttemptOptions now = with(2, 3);
        rule_errors = {{"n = 3", {}, {}}, {"its nearest", {}, {}}};
        std::vector<std::vector<std::string>> rows;
        for (const double tolerance_now : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
          now.tolerance = tolerance_now;
          const Attempt last = attempt(Rung::free_coefficients, now);
          const double error[] = {last.answer.energy, nearest_gradient(last).energy};
          rows.push_back({rounded(now.tolerance), std::to_string(last.body().quadrature.size()),
                          percent(error[0]), percent(error[1])});
          for (int k = 0; k < 2; ++k) {
            rule_errors[k].x.push_back(now.tolerance);
            rule_errors[k].y.push_back(error[k]);
          }
        }
        out << table({"tolerance", "points", "error (b), %", "nearest, %"}, rows);
        cutoff_errors.clear();
        rows.clear();
        for (int n = 1; n <= 3; ++n) {
          cutoff_errors.push_back({"n = " + std::to_string(n), {}, {}});
          rows.push_back({cutoff_errors.back().label});
          for (const double alpha : {0.55, 0.65, 0.75, 1.0, 1.25, 1.5}) {
            now = with(2, n);
            now.cutoff = alpha;
            now.tolerance = tolerance;
            cutoff_errors.back().x.push_back(alpha);
            cutoff_errors.back().y.push_back(attempt(Rung::free_coefficients, now).answer.energy);
            rows.back().push_back(percent(cutoff_errors.back().y.back()));
          }
        }
        out << table({"error (b), %", "alpha = 0.55", "0.65", "0.75", "1", "1.25", "1.5"}, rows);
      },
      [&](Picture& picture) {
        draw_charts(picture, {{{.label = "tolerance of the quadrature", .logarithmic = true},
                               error_axis(1e-4, 1), rule_errors, tolerance},
                              {{.label = "cutoff α, m"}, error_axis(1e-4, 1), cutoff_errors,
                               options.cutoff}});
      });

  // [9] The scenes of these names: a clamp, a corner singularity, finite strains, gravity.
  std::vector<Trace> tips;
  lesson.step(
      "The cantilever's tip",
      [&](std::ostream& out) {
        tips.clear();
        std::vector<std::vector<std::string>> rows;
        for (const auto& [label, scene, n] :
             {std::tuple("the paper's, n = 2", "cantilever", 2),
              {"condensed, n = 2", "cantilever_condensed", 2},
              {"condensed, n = 3", "cantilever_condensed", 3}}) {
          tips.push_back({label, {}, {}});
          rows.push_back({label});
          for (const std::string m : {"1", "2", "4", "8"}) {
            tips.back().x.push_back(std::stod(m));
            tips.back().y.push_back(
                100 * tip_share(scene, {"solids[0].shape.parts=[" + m + ",1," + m + ",1]",
                                        "method.degree=" + std::to_string(n)}));
            rows.back().push_back(rounded(tips.back().y.back(), 4));
          }
        }
        out << table({"u_y in % of the truth", "1 part along", "2", "4", "8"}, rows);
      },
      [&](Picture& picture) {
        Axis along = parts_axis();
        along.label = "parts along the beam";
        along.upper = 9;
        along.ticks.emplace_back(8, "8");
        const auto content = [&](Panel& panel) {
          for (std::size_t k = 0; k < tips.size(); ++k) {
            Series style = series(int(k), tips[k].label);
            style.width = 2;
            panel.curve(tips[k].x, tips[k].y, style);
          }
          panel.horizontal(100, "truth: finite elements");
        };
        draw_panel(picture, along, {.label = "u_y of the tip, % of the truth", .lower = 0}, content,
                   tips);
      });
  return lesson.run(argc, argv);
}
// Next: the condensed formulation in a scene, `sem2d run cantilever_condensed`.
