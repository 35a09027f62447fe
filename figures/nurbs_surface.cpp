// The draft's figure 2: a NURBS surface, its control net as the degrees of freedom, the support of
// one row of its Jacobian.
#include <cmath>

#include "figures/solid_view.h"
#include "sem/nurbs/basis.h"
#include "src3d/render/tessellate.h"

namespace sem::figures {
namespace {

const Param<2> shown_u(2.3, 0.75);  // of the row J(u, v) that the figure explains
constexpr int n_cells = 120;        // of the plotted basis function, each way
const Color surface_color{0.66, 0.78, 0.92}, net_color{0.45, 0.45, 0.47};

// A bicubic sheet of 3 x 2 knot spans, one control point heavier than the others.
Nurbs<2, 3> sheet() {
  Nurbs<2, 3> nurbs;
  nurbs.degree = {3, 3};
  nurbs.knots[0] = {0, 0, 0, 0, 1, 2, 3, 3, 3, 3};
  nurbs.knots[1] = {0, 0, 0, 0, 1, 2, 2, 2, 2};
  nurbs.control_points.resize(3, 30);
  nurbs.weights.setOnes(30);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 6; ++i)
      nurbs.control_points.col(i + 6 * j) << 0.6 * i + 0.08 * std::sin(2.0 * j),
          0.65 * j + 0.1 * std::sin(1.3 * i),
          0.55 * std::sin(1.15 * i + 0.3) * std::cos(0.9 * j - 0.4);
  nurbs.weights[2 + 6 * 2] = 2;
  return nurbs;
}

Data compute() {
  const Nurbs<2, 3> nurbs = sheet();
  Data data;
  add_surfaces(data, {nurbs});
  BasisValues<2> basis;
  evaluate_basis(nurbs, shown_u, 0, basis);
  auto& row = data.add("row", {"control", "value"});
  for (std::size_t e = 0; e < basis.column.size(); ++e)
    row.add({double(basis.column[e]), basis.value[e]});
  const Vec<3> X = sem::point(nurbs, shown_u);
  data.add("shown", {"u", "v", "x", "y", "z"}).add({shown_u[0], shown_u[1], X[0], X[1], X[2]});
  const int largest =
      basis.column[std::max_element(basis.value.begin(), basis.value.end()) - basis.value.begin()];
  auto& function = data.add("basis", {"control", "u", "v", "value"});
  const Interval u = domain(nurbs, 0), v = domain(nurbs, 1);
  const double size = (u.upper - u.lower) / n_cells;
  for (double b = v.lower + size / 2; b < v.upper; b += size)
    for (int i = 0; i < n_cells; ++i) {
      const Param<2> at(u.lower + (i + 0.5) * size, b);
      evaluate_basis(nurbs, at, 0, basis);
      double value = 0;
      for (std::size_t e = 0; e < basis.column.size(); ++e)
        if (basis.column[e] == largest) value = basis.value[e];
      function.add({double(largest), at[0], at[1], value});
    }
  return data;
}

struct Row {
  std::vector<int> control;
  std::vector<double> value;
  double largest = 0;
  explicit Row(const DataTable& row) : value(row["value"]) {
    for (const double c : row["control"]) control.push_back(int(c));
    for (const double x : value) largest = std::max(largest, x);
  }
};

render::RenderScene scene_of(const Data& data, double point) {
  const auto parts = surfaces_of(data);
  const Row row(data["row"]);
  const DataTable& shown = data["shown"];
  const Vec<3> X(shown.value("x"), shown.value("y"), shown.value("z"));
  render::RenderScene scene;
  scene.meshes = meshes_of(parts, [](int) { return surface_color; });
  // Knot lines, then what divides the spans.
  auto fine = lines_of(parts, 3, Color{0.1, 0.2, 0.4}.with_alpha(0.35), 0.4 * point);
  auto knots = lines_of(parts, 0, {0.05, 0.15, 0.4}, 1.1 * point);
  knots.chains = render::isoparametric_lines(prepare(parts[0]), 0, true, {1e-3});
  scene.lines = {fine, knots, {render::control_net(parts[0]), net_color, 0.6 * point, 0.3}};
  const auto& p = parts[0].control_points;
  for (Eigen::Index c = 0; c < p.cols(); ++c)
    scene.spheres.push_back({p.col(c), 0.028, {0.6, 0.6, 0.6}});
  for (std::size_t k = 0; k < row.control.size(); ++k) {
    const double share = row.value[k] / row.largest;
    const Vec<3> control = p.col(row.control[k]);
    scene.spheres[row.control[k]] = {control, 0.028 + 0.045 * std::sqrt(share),
                                     colors::viridis(share)};
    scene.lines.push_back(
        {{{X, control}}, colors::viridis(share), (0.4 + 1.8 * share) * point, 0.35});
  }
  scene.spheres.push_back({X, 0.075, colors::okabe_ito[1]});
  double lowest = p(2, 0);
  for (Eigen::Index c = 0; c < p.cols(); ++c) lowest = std::min(lowest, p(2, c));
  scene.ground = lowest - 0.1;
  return scene;
}

void draw_domain(Panel& panel, const Data& data) {
  const auto parts = surfaces_of(data);
  const DataTable &basis = data["basis"], &shown = data["shown"];
  const ColorScale scale{0, 0.4};
  panel.equal = true;
  panel.x.label = "u";
  panel.y.label = "v";
  panel.heat_map(grid_of(basis["u"], basis["v"], basis["value"]), scale);
  for (int axis = 0; axis < 2; ++axis)
    for (const auto& span : spans(parts[0], axis))
      for (const double knot : {span.lower, span.upper}) {
        const Interval other = domain(parts[0], 1 - axis);
        Vec<2> a, b;
        a[axis] = b[axis] = knot;
        a[1 - axis] = other.lower;
        b[1 - axis] = other.upper;
        panel.curve({a, b}, {.color = colors::white, .width = 0.7});
      }
  const Vec<2> at(shown.value("u"), shown.value("v"));
  panel.node(at, "", 5, colors::okabe_ito[1]);
  panel.title = "basis function of the largest ball";
  panel.color_bar(scale, "R(u, v)");
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.column_shares = {1.75, 1};
  const auto parts = surfaces_of(data);
  const DataTable& shown = data["shown"];
  const Vec<3> X(shown.value("x"), shown.value("y"), shown.value("z"));
  draw_view(plot.panel(0, 0), {[data](double point) { return scene_of(data, point); },
                               framed(parts),
                               {.from = {-0.35, -1, 0.75}},
                               {{X, "x(u, v) = J(u, v) p", {25, -62}, true}}});
  draw_domain(plot.panel(0, 1), data);
}

}  // namespace

Figure nurbs_surface() {
  return {"nurbs_surface",
          "Draft figure 2: a bicubic NURBS surface of 3 x 2 knot spans and its control net, the "
          "degrees of freedom; a point of it follows 16 of them (lines; size and colour: the "
          "value of their basis function there), each of which reaches over a few spans only",
          7,
          2.9,
          compute,
          draw};
}

}  // namespace sem::figures
