#include "src2d/tutorials/convergence.h"

#include <cmath>
#include <limits>

#include "sem/lesson/numbers.h"
#include "src2d/baseline/scene_model.h"
#include "src2d/tutorials/beam.h"

namespace sem::tutorial {
namespace {

const Manufactured<2> exact;

MethodOptions method_of(Rung rung, const AttemptOptions& options) {
  MethodOptions method;
  method.weights.cutoff = options.cutoff;
  method.projection.degree = options.degree;
  if (rung < Rung::continuous_weights) {
    method.rays.n_rays = 40;
    method.interval.points = 40;
  } else {
    method.weights.variant = DistanceWeight::sided;
    method.interior_rule.rule = InteriorRule::resolved;
    method.interior_rule.weight_tolerance = options.tolerance;
  }
  if (rung == Rung::free_coefficients) method.formulation = Formulation::condensed;
  return method;
}

double energy(const Mat<2>& G) {
  return energy_density<2>(exact.material, Mat<2>(Mat<2>::Identity() + G));
}

// The map at rest points with the rung's gradient.
Map<2> map_of(const Attempt& attempt, const Points<2>& X) {
  const auto& d = attempt.body();
  if (attempt.rung == Rung::paper || attempt.rung == Rung::free_coefficients)
    return map_at(d, X, true);
  return baseline::exact_map(d, X);
}

}  // namespace

AttemptOptions AttemptOptions::with(double parts, double n) const {
  AttemptOptions changed = *this;
  changed.m = int(parts);
  changed.degree = int(n);
  return changed;
}

Balance balance(bool convex, Cells& cells) {
  MethodOptions method;
  method.interior_rule.rule = InteriorRule::exact;
  std::vector<Nurbs<1, 2>> parts;
  for (const auto& part : baseline::manufactured_body(convex, 1)) parts.push_back(part.shape);
  const auto d = discretize<2>({parts}, method);
  cells = cells_inside(d.boundary, d.loops, 48);
  Balance sum;
  const auto add = [&](const Vec<2>& X, const Vec<2>& f) {
    sum.force += f;
    sum.size += f.norm();
    sum.work += f.dot(exact.displacement(X));
  };
  for (int k = 0; k < d.quadrature.size(); ++k) {
    const Vec<2> X = d.quadrature.position.col(k);
    add(X, d.quadrature.weight[k] * exact.body_force(X));
    sum.energy += d.quadrature.weight[k] * energy(exact.gradient(X));
  }
  const auto rule = boundary_rule(d);
  for (int s = 0; s < rule.samples.size(); ++s) {
    const Vec<2> X = rule.samples.position.col(s);
    add(X, rule.samples.weight[s] * exact.stress(X) * rule.normal.col(s));
  }
  return sum;
}

Attempt attempt(Rung rung, const AttemptOptions& options) {
  Scene<2> scene;
  scene.solids.push_back(
      {"body", exact.material, baseline::manufactured_body(options.convex, options.m)});
  scene.method = method_of(rung, options);
  Attempt result{rung, build_model(scene, ""), {}};
  if (rung == Rung::exact_gradient || rung == Rung::continuous_weights)
    baseline::use_exact_gradient(*result.model);
  const auto& d = result.body();
  result.answer = solve_manufactured(d, *result.model->energy, manufactured_load(d, exact), exact);
  return result;
}

ManufacturedSolution nearest_gradient(const Attempt& attempt) {
  const auto& model = *attempt.model;
  const auto& d = model.discretization;
  SymmetricMatrix little;  // of the stability term, for motions without energy
  if (attempt.rung != Rung::free_coefficients)
    little = 1e-6 * model.stability_stiffness * model.stability;
  InternalEnergy<2> V(d.interior, d.quadrature.weight, model.materials, little);
  return solve_manufactured(d, V, manufactured_stress(d, exact), exact);
}

Points<2> displacement(const Attempt& attempt, const VectorXd& u, const Points<2>& X) {
  return evaluate(map_at(attempt.body(), X, false), u);
}

double displacement_error(const Attempt& attempt, const VectorXd& u) {
  const auto& rule = attempt.body().quadrature;
  const Points<2> own = displacement(attempt, u, rule.position);
  double error = 0, norm = 0;
  for (int k = 0; k < rule.size(); ++k) {
    const Vec<2> truth = exact.displacement(rule.position.col(k));
    error += rule.weight[k] * (own.col(k) - truth).squaredNorm();
    norm += rule.weight[k] * truth.squaredNorm();
  }
  return std::sqrt(error / norm);
}

double divergence_defect(const Attempt& attempt, const VectorXd& u) {
  const auto& d = attempt.body();
  Mat<2> sum = Mat<2>::Zero(), norm = Mat<2>::Zero();
  const Points<2> y = coefficients(d.interior, u);
  for (const auto& block : d.interior.blocks)
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const double v = d.quadrature.weight[block.points[k]];
      sum += v * deformation_gradient(block, int(k), y);
      norm += v * exact.gradient(d.quadrature.position.col(block.points[k]));
    }
  const BoundaryRule<2> rule = boundary_rule(d);
  const Points<2> x = displacement(attempt, u, rule.samples.position);
  return (sum - x * rule.samples.weight.asDiagonal() * rule.normal.transpose()).norm() /
         norm.norm();
}

VectorXd error_field(const Attempt& attempt, const VectorXd& u, const Points<2>& X) {
  VectorXd field(X.cols());
  double mean = 0;
  const Map<2> map = map_of(attempt, X);
  const Points<2> y = coefficients(map, u);
  for (const auto& block : map.blocks)
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const Mat<2> G = exact.gradient(X.col(block.points[k]));
      field[block.points[k]] = energy(deformation_gradient(block, int(k), y) - G);
      mean += energy(G) / double(X.cols());
    }
  return (field / mean).cwiseSqrt();
}

Trace weight_profile(const Attempt& attempt, const std::string& label) {
  Points<2> X = Points<2>::Constant(2, 42, 0.3);
  for (int k = 0; k < 42; ++k) X(1, k) = k < 2 ? 1e-6 * k : 0.01 * (k - 1);
  const auto& d = attempt.body();
  const auto& options = d.options.weights;
  const auto distances = measure_distances(d.boundary, d.loops, X, options.variant, options.cutoff);
  const MatrixXd w = dense(blending_weights(distance_weights(distances, options), d.boundary, X));
  int below = 0;
  w.row(0).maxCoeff(&below);
  return {label, {X.row(1).begin(), X.row(1).end()}, column(w, below)};
}

Points<2> exact_displacement(const Points<2>& X) {
  Points<2> u = X;
  for (auto column : u.colwise()) column = exact.displacement(column);
  return u;
}

double tip_error(const std::string& scene, const std::vector<std::string>& overrides) {
  const baseline::SceneModel beam(scene, overrides);
  const auto& tip = beam.scene.probes.front();
  const auto state = beam.equilibrium();
  return state ? std::abs(beam.displacement(*state, tip.at)[1] / tip.truth.value()[1] - 1)
               : std::numeric_limits<double>::quiet_NaN();
}

namespace {

Box<2> above_title(Picture& picture, const Box<2>& rectangle, const std::string& title) {
  picture.canvas().text({(rectangle.lower[0] + rectangle.upper[0]) / 2, rectangle.upper[1] - 12},
                        title,
                        {.size = Picture::text_size, .horizontal = TextStyle::Horizontal::center});
  return {rectangle.lower, rectangle.upper - Vec<2>(0, 36)};
}

}  // namespace

Grid make_grid(bool convex, const Points<2>& outline) {
  constexpr double away = 1e-6;
  Grid grid{Points<2>(2, 18 * Grid::per_line), outline};
  for (int line = 0; line < 18; ++line) {
    double c = line / 2 / 8.0;
    const double end = !convex && c > 0.5 ? 0.5 : 1;
    c += c == 0 ? away : c == 1 || (!convex && c == 0.5) ? -away : 0;
    for (int k = 0; k < Grid::per_line; ++k) {
      const double t = away + k * (end - 2 * away) / (Grid::per_line - 1);
      grid.X.col(line * Grid::per_line + k) = line % 2 == 0 ? Vec<2>(c, t) : Vec<2>(t, c);
    }
  }
  return grid;
}

void draw_answer(Picture& picture, const Grid& grid, const Points<2>& u, const Box<2>& rectangle,
                 const std::string& title, const Points<2>& u_boundary) {
  constexpr double scale = 0.25;
  const Points<2> truth = exact_displacement(grid.X),
                  outline = grid.outline + scale * exact_displacement(grid.outline);
  const Vec<2> lower = outline.rowwise().minCoeff(), upper = outline.rowwise().maxCoeff();
  const Vec<2> margin = Vec<2>::Constant(0.2);
  const Box<2> view = above_title(picture, rectangle, title);
  picture.set_view({lower - margin, upper + margin}, view);
  picture.canvas().push_clip(view);
  const Points<2> x = grid.X + scale * u;
  for (int k = 0; k < x.cols(); k += Grid::per_line)
    picture.curve(x.middleCols(k, Grid::per_line), {.color = blue, .width = 1.5});
  picture.curve(outline, {.color = colors::black, .width = 3.5});
  if (u_boundary.cols() > 0)
    picture.curve(grid.outline + scale * u_boundary, {.color = red, .width = 2.5});
  picture.canvas().pop_clip();
  picture.hover(x, [=, X = grid.X](int k) {
    return "X = " + coordinates(X.col(k)) + " m\nu = " + coordinates(u.col(k)) +
           " m\nexact: " + coordinates(truth.col(k)) + " m";
  });
}

void draw_error(Picture& picture, const Cells& cells, const VectorXd& error,
                const Box<2>& rectangle, const std::string& title) {
  const Vec<2> margin = Vec<2>::Constant(0.06);
  picture.set_view({cells.box.lower - margin, cells.box.upper + margin},
                   above_title(picture, rectangle, title));
  const VectorXd shade = error.unaryExpr([](double e) { return 1 + std::log10(e) / 4; });
  draw_cells(picture, cells, [&](int k) { return colors::viridis(shade[k]); });
  picture.curve(cells.outline, {.color = colors::black, .width = 2});
  read_values(picture, cells.center, error, "error");
  color_bar(picture, "error 0.0001", "1");
}

Trace sweep(const std::string& label, const std::vector<double>& x,
            const std::function<double(double)>& y) {
  Trace trace{label, x, {}};
  for (const double at : x) trace.y.push_back(y(at));
  return trace;
}

std::string percent_table(const std::string& heading, const std::vector<Trace>& rows) {
  std::vector<std::string> headings{heading};
  for (const double x : rows.front().x) headings.push_back(rounded(x));
  std::vector<std::vector<std::string>> cells;
  for (const auto& row : rows) {
    cells.push_back({row.label});
    for (const double y : row.y) cells.back().push_back(percent(y));
    cells.back().resize(headings.size());
  }
  return table(headings, cells);
}

Axis error_axis(double lower, double upper, const std::string& label) {
  return {.label = label, .lower = lower, .upper = upper, .logarithmic = true};
}

Axis axis_of(const std::string& counted, int last, bool logarithmic) {
  Axis axis{.label = counted, .lower = 0.85, .upper = 1.1 * last, .logarithmic = logarithmic};
  for (int i = 1; i <= last; i = logarithmic ? 2 * i : i + 1)
    axis.ticks.emplace_back(i, std::to_string(i));
  return axis;
}

void add_attempts(std::vector<Trace>& traces, const std::string& label,
                  const std::vector<double>& x, const std::function<Attempt(double)>& attempt_at) {
  Trace answer{label, x, {}}, nearest{"its nearest F", x, {}};
  for (const double at : x) {
    const Attempt now = attempt_at(at);
    answer.y.push_back(now.answer.energy);
    nearest.y.push_back(nearest_gradient(now).energy);
  }
  traces.push_back(answer);
  traces.push_back(nearest);
}

void draw_pairs(Picture& picture, const std::vector<Chart>& charts) {
  picture.note("solid: the answer; dashed: the nearest F that the same functions can make");
  const Box<2> place = picture.part({0.02, 0.07}, {0.98, 0.98});
  picture.plot(place, [&](Plot& plot) {
    plot.shared_legend = charts.size() > 1;
    for (int i = 0; i < int(charts.size()); ++i) {
      const Chart& chart = charts[i];
      Panel& panel = plot.panel(0, i);
      panel.x = chart.x;
      panel.y = chart.y;
      panel.legend = LegendPlace::below;
      for (int c = 0; c < int(chart.traces.size()); ++c) {
        Series style = series(c / 2, c % 2 == 0 ? chart.traces[c].label : "");
        style.width = c % 2 == 0 ? 2 : 1.2;
        style.dash = c % 2 == 0 ? std::vector<double>{} : std::vector<double>{3, 3};
        panel.curve(chart.traces[c].x, chart.traces[c].y, style);
      }
      read_curves(picture, place, panel, chart.traces);
    }
  });
}

}  // namespace sem::tutorial
