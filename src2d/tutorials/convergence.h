#pragma once
// The bench of step 14: a free body with a known answer, and the formulations between the paper's
// and the condensed one, each with one more thing replaced; the cantilever's tip; its pictures.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src2d/baseline/manufactured.h"
#include "src2d/tutorials/drawing.h"
#include "src2d/tutorials/matrices.h"
#include "sem/lesson/plots.h"

namespace sem::tutorial {

enum class Rung { paper, exact_gradient, continuous_weights, free_coefficients };
constexpr Rung rungs[] = {Rung::paper, Rung::exact_gradient, Rung::continuous_weights,
                          Rung::free_coefficients};
const std::string rung_names[] = {"the paper's", "F with grad w", "and sided weights",
                                  "and free coefficients"};

/// Integrals of the exact solution over a body: of its energy, J; of |b| and |t|, of b and t, N; of
/// their work b . u and t . u, J.
struct Balance {
  double energy = 0, size = 0, work = 0;
  Vec<2> force = Vec<2>::Zero();
};
/// cells: of the body.
Balance balance(bool convex, Cells& cells);

struct AttemptOptions {
  bool convex = true;       ///< the square or the L
  int m = 1;                ///< parts a side (manufactured_body)
  int degree = 3;           ///< n
  double cutoff = 0.75;     ///< alpha, m
  double tolerance = 3e-4;  ///< of the quadrature of sided weights; the others have 40 x 40 points
  /// The same with other parts and degree.
  AttemptOptions with(double parts, double n) const;
};

/// A body by a rung, with the rung's F in the model's discretization.interior, and its answer.
struct Attempt {
  Rung rung;
  std::unique_ptr<Model<2>> model;
  ManufacturedSolution answer;
  const Discretization<2>& body() const { return model->discretization; }
};
Attempt attempt(Rung rung, const AttemptOptions& options);

/// The u whose F is nearest to du/dX of the exact solution in the energy norm.
ManufacturedSolution nearest_gradient(const Attempt& attempt);

/// Displacement of the map at rest points, m, for u of z.
Points<2> displacement(const Attempt& attempt, const VectorXd& u, const Points<2>& X);
/// Its relative error in the mean square over the body.
double displacement_error(const Attempt& attempt, const VectorXd& u);
/// |int F dX - int x N^T da| / |int du/dX dX|: 0 if F is the gradient of a map without jumps.
double divergence_defect(const Attempt& attempt, const VectorXd& u);
/// sqrt of the energy density of F - du/dX over the exact one's mean, at rest points.
VectorXd error_field(const Attempt& attempt, const VectorXd& u, const Points<2>& X);
/// w of the part below (0.3, 0) on the line x = 0.3 m, y = 0, 1e-6, 0.01, 0.02, ..., 0.4 m.
Trace weight_profile(const Attempt& attempt, const std::string& label);

/// The exact displacement, m.
Points<2> exact_displacement(const Points<2>& X);

/// |u_y / truth - 1| of a built-in scene's tip, the truth as the scene states it (finite elements);
/// NaN if there is no equilibrium.
double tip_error(const std::string& scene, const std::vector<std::string>& overrides);

/// Lines x and y = 0, 1/8, ..., 1 m inside a body, those on its boundary 1e-6 m away from it.
struct Grid {
  static constexpr int per_line = 49;
  Points<2> X;  ///< line after line
  Points<2> outline;
};
Grid make_grid(bool convex, const Points<2>& outline);

/// The grid's lines where a displacement u of its points takes them, over the exact outline, both a
/// quarter as large; what the map makes of the boundary itself, if it is given; a title below.
void draw_answer(Picture& picture, const Grid& grid, const Points<2>& u, const Box<2>& rectangle,
                 const std::string& title, const Points<2>& u_boundary = {});
/// Errors from 1e-4 (dark) to 1 (light) on a logarithmic scale; a title below.
void draw_error(Picture& picture, const Cells& cells, const VectorXd& error,
                const Box<2>& rectangle, const std::string& title);

/// A function of every x.
Trace sweep(const std::string& label, const std::vector<double>& x,
            const std::function<double(double x)>& y);
/// A row a trace, its values in %, a column an x of the first one.
std::string percent_table(const std::string& heading, const std::vector<Trace>& rows);
/// A logarithmic axis of errors, and one of counts from 1 to `last`: 1, 2, 4, ... if logarithmic.
Axis error_axis(double lower, double upper, const std::string& label = "relative error (b)");
Axis axis_of(const std::string& counted, int last, bool logarithmic = true);
/// Appends the errors of answers against x, and of their nearest F.
void add_attempts(std::vector<Trace>& traces, const std::string& label,
                  const std::vector<double>& x, const std::function<Attempt(double x)>& attempt_at);
/// Panels side by side of traces that come in pairs, as above: a colour a pair, the second dashed.
void draw_pairs(Picture& picture, const std::vector<Chart>& charts);

}  // namespace sem::tutorial
