// The patch test: an affine boundary must give an affine interior. Which fits keep it.
#include <cmath>

#include "figures/figure.h"
#include "sem/method/discretization.h"
#include "sem/nurbs/basis.h"

namespace sem::figures {
namespace {

constexpr int n_motions = 3, n_fits = 3, points_per_part = 40;
const char* const motion_names[] = {"stretch", "shear", "rotation"};
const char* const fit_names[] = {"degree by degree", "degree by degree, raw",
                                 "pseudo-inverse (draft)"};

Mat<2> motion(int i) {
  Mat<2> A;
  const double c = std::cos(0.6), s = std::sin(0.6);
  if (i == 0) A << 1.3, 0, 0, 0.8;
  if (i == 1) A << 1, 0.5, 0, 1;
  if (i == 2) A << c, -s, s, c;
  return A;
}

Nurbs<1, 2> cubic(const Points<2>& controls) {
  const int n = int(controls.cols()) - 3;
  std::vector<double> knots(3, 0);
  for (int k = 0; k <= n; ++k) knots.push_back(k);
  knots.insert(knots.end(), 3, n);
  return {{3}, {knots}, controls, Eigen::VectorXd::Ones(controls.cols())};
}

Nurbs<1, 2> straight(const Vec<2>& a, const Vec<2>& b) {
  Points<2> controls(2, 4);
  for (int c = 0; c < 4; ++c) controls.col(c) = a + c / 3.0 * (b - a);
  return cubic(controls);
}

// A straight base and left side, a curved back: both kinds of part that a fit meets.
Discretization<2> body(FitKind fit, int degree) {
  Points<2> back(2, 5), top(2, 6);
  back << 2, 2.35, 2.25, 1.7, 1.75, 0, 0.25, 0.65, 0.7, 1.1;
  top << 1.75, 1.8, 1.2, 0.85, 0.5, 0, 1.1, 1.5, 1.75, 1.05, 1.15, 1.3;
  MethodOptions options;
  options.projection = {.degree = degree, .fit = fit};
  options.weights.cutoff = 1.2;
  options.rays.n_rays = 30;
  options.interval.spacing = 0.06;
  return discretize<2>({{straight({0, 0}, {1, 0}), straight({1, 0}, {2, 0}), cubic(back),
                         cubic(top), straight({0, 1.3}, {0, 0})}},
                       options);
}

// |F - A| (Frobenius) at every point.
Eigen::VectorXd deviation(const Map<2>& map, const Points<2>& p, const Mat<2>& A) {
  Eigen::VectorXd square = Eigen::VectorXd::Zero(map.n_points);
  for (int b = 0; b < 2; ++b) {
    const Points<2> F_b = p * dense_gradient(map, b).transpose();
    square += (F_b.colwise() - A.col(b)).colwise().squaredNorm().transpose();
  }
  return square.cwiseSqrt();
}

// Not below what a logarithmic axis shows; as many digits as colours tell apart.
double shown(double error) { return std::max(error, 1e-16); }
double coarse(double error) {
  const double unit = std::pow(10, std::floor(std::log10(error)) - 2);
  return std::round(error / unit) * unit;
}

Points<2> to_points(const std::vector<Vec<2>>& list) {
  Points<2> points(2, list.size());
  for (size_t k = 0; k < list.size(); ++k) points.col(k) = list[k];
  return points;
}

Points<2> along_parts(const Boundary<2>& boundary) {
  std::vector<Vec<2>> points;
  for (const auto& part : boundary.parts)
    for (int k = 0; k <= points_per_part; ++k) {
      const Interval u = domain(part.nurbs, 0);
      points.push_back(
          point(part.nurbs, Param<1>(u.lower + double(k) / points_per_part * (u.upper - u.lower))));
    }
  return to_points(points);
}

void add_boundary(DataTable& table, const Discretization<2>& d, int i) {
  const Points<2> x = motion(i) * along_parts(d.boundary);
  for (int k = 0; k < x.cols(); ++k)
    table.add({double(i), double(k / (points_per_part + 1)), x(0, k), x(1, k)});
}

// |F - A| in the cells of a grid over the moved body.
void add_cells(DataTable& table, const Discretization<2>& d, int fit, int i) {
  const Mat<2> A = motion(i);
  const Points<2> outline = A * along_parts(d.boundary);
  const Box<2> box{outline.rowwise().minCoeff(), outline.rowwise().maxCoeff()};
  const CellGrid grid = empty_grid(box, 0.025);
  std::vector<Vec<2>> cells, X;
  for (int row = 0; row < grid.n_y; ++row)
    for (int column = 0; column < grid.n_x; ++column) {
      const Vec<2> center = grid.center(column, row), at = A.inverse() * center;
      if (!inside(d.boundary, d.loops, at)) continue;
      cells.push_back(center);
      X.push_back(at);
    }
  const auto dF = deviation(map_at(d, to_points(X), true), A * d.unknowns.rest, A);
  for (size_t k = 0; k < cells.size(); ++k)
    table.add({double(fit), double(i), cells[k][0], cells[k][1], coarse(shown(dF[k]))});
}

Data compute() {
  DataTable errors({"fit", "degree", "motion", "map_error", "gradient_error"});
  DataTable boundary({"motion", "part", "x", "y"});
  DataTable cells({"fit", "motion", "x", "y", "deviation"});
  for (int fit = 0; fit < n_fits; ++fit)
    for (int degree = 1; degree <= 4; ++degree) {
      const auto d = body(FitKind(fit), degree);
      for (int i = 0; i < n_motions; ++i) {
        const Mat<2> A = motion(i);
        const Points<2> p = A * d.unknowns.rest;
        const Points<2> x = evaluate(d.interior, Eigen::VectorXd(p.reshaped()));
        const double off = (x - A * d.quadrature.position).colwise().norm().maxCoeff();
        errors.add({double(fit), double(degree), double(i), shown(off / d.boundary.box.diagonal()),
                    shown(deviation(d.interior, p, A).maxCoeff())});
        if (degree != 2 || fit == 1) continue;
        if (fit == 0) add_boundary(boundary, d, i);
        add_cells(cells, d, fit, i);
      }
    }
  Data data;
  data.add("errors", errors.columns()) = errors;
  data.add("boundary", boundary.columns()) = boundary;
  data.add("cells", cells.columns()) = cells;
  return data;
}

void draw_body(Panel& panel, const Data& data, int fit, int i, const ColorScale& scale) {
  panel.equal = true;
  panel.frame = false;
  const DataTable cells = data["cells"].where("fit", fit).where("motion", i);
  const DataTable boundary = data["boundary"].where("motion", i);
  panel.heat_map(grid_of(cells["x"], cells["y"], cells["deviation"]), scale);
  panel.cut_outside({zip(boundary["x"], boundary["y"])});
  for (const auto& part : boundary.runs("part")) {
    const auto curve = zip(part["x"], part["y"]);
    panel.curve(curve, {.width = 1.2});
    panel.curve({curve.front(), curve.back()},
                {.width = 0, .marker = MarkerShape::circle, .marker_size = 3});
  }
}

void draw(Plot& plot, const Data& data) {
  ColorScale scale{1e-16, 1};
  scale.logarithmic = true;
  const int shown_fits[] = {0, 2};
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < n_motions; ++i) {
      Panel& panel = plot.panel(row, i);
      draw_body(panel, data, shown_fits[row], i, scale);
      if (i == n_motions - 1) panel.color_bar(scale, "|F − A|");
    }
  plot.shared_legend = true;
  plot.row_titles = {"degree by degree", "pseudo-inverse"};
  plot.column_titles = {motion_names[0], motion_names[1], motion_names[2], "worst of the three"};
  const char* const columns[] = {"map_error", "gradient_error"};
  const char* const labels[] = {"max |x − AX| / size", "max |F − A|"};
  for (int row = 0; row < 2; ++row) {
    Panel& panel = plot.panel(row, n_motions);
    panel.x = {
        .label = row == 1 ? "degree n" : "", .lower = 0.7, .upper = 4.3, .tick_labels = row == 1};
    for (int n = 1; n <= 4; ++n) panel.x.ticks.push_back({double(n), std::to_string(n)});
    panel.y = {.label = labels[row], .lower = 1e-16, .upper = 10, .logarithmic = true};
    for (int fit = 0; fit < n_fits; ++fit) {
      std::vector<double> degrees, worst;
      for (const auto& run : data["errors"].where("fit", fit).runs("degree")) {
        degrees.push_back(run.value("degree"));
        worst.push_back(0);
        for (const double error : run[columns[row]]) worst.back() = std::max(worst.back(), error);
      }
      panel.curve(degrees, worst, series(fit, fit_names[fit]));
    }
  }
}

}  // namespace

Figure patch_test() {
  return {"patch_test",
          "Patch test: control points moved by an affine map A must move the inside by it; fits "
          "made degree by degree do so, the draft's pseudo-inverse fails wherever a straight "
          "part has weight, at all degrees above 1 (left: n = 2)",
          7,
          3.6,
          compute,
          draw};
}

}  // namespace sem::figures
