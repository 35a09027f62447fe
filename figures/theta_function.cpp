// The distance weight as a function of both ray lengths, measured in a strip of growing thickness.
#include <cmath>

#include "figures/interior.h"
#include "sem/nurbs/bezier_curve.h"

namespace sem::figures {
namespace {

constexpr double alpha = 1;    // m
constexpr double longest = 2;  // m, both axes
constexpr int n_cells = 100;   // along either axis
constexpr double length = 3, thin = 0.002,
                 thick = 4.1;  // m, of the strip: all sums of both lengths

// Straight bottom, slanted top: above x the strip is thick(x), and from a point of the bottom the
// ray through any point above it runs straight up to the top.
Discretization<2> strip() {
  const Vec<2> a(0, 0), b(length, 0), c(length, thick), d(0, thin);
  Discretization<2> body;
  body.boundary =
      make_boundary<2>({{segment<2>(a, b), segment<2>(b, c), segment<2>(c, d), segment<2>(d, a)}});
  body.loops = find_loops(body.boundary);
  body.options.weights.cutoff = alpha;
  return body;
}

double x_of_thickness(double thickness) { return length * (thickness - thin) / (thick - thin); }

Data compute() {
  const Discretization<2> body = strip();
  Points<2> lengths(2, n_cells * n_cells), position(2, n_cells * n_cells);
  for (int k = 0; k < lengths.cols(); ++k) {
    const Vec<2> d = longest / n_cells * Vec<2>(k % n_cells + 0.5, k / n_cells + 0.5);
    lengths.col(k) = d;
    position.col(k) = Vec<2>(x_of_thickness(d[0] + d[1]), d[0]);
  }
  Eigen::VectorXd theta[2];
  const DistanceWeight variants[] = {DistanceWeight::draft, DistanceWeight::published};
  for (int v = 0; v < 2; ++v) theta[v] = theta_field(body, position, variants[v]).col(0);
  Data data;
  auto& corners = data.add("strip", {"x", "y"});
  for (const auto& part : body.boundary.parts) {
    const Vec<2> X = part.nurbs.control_points.col(0);
    corners.add({X[0], X[1]});
  }
  auto& field = data.add("field", {"d1", "d2", "theta_draft", "theta_published"});
  for (int k = 0; k < lengths.cols(); ++k)
    field.add({lengths(0, k), lengths(1, k), theta[0][k], theta[1][k]});
  const Vec<2> X(x_of_thickness(2.7), 0.9);  // the point that the sketch measures
  data.add("point", {"x", "y", "top", "alpha"}).add({X[0], X[1], 2.7, alpha});
  return data;
}

void draw_strip(Panel& panel, const Data& data) {
  panel.equal = true;
  panel.frame = false;
  const auto corners = zip(data["strip"]["x"], data["strip"]["y"]);
  panel.area({corners}, {0.95, 0.95, 0.96});
  panel.curve({corners[1], corners[2], corners[3], corners[0]}, {.width = 1});
  panel.curve({corners[0], corners[1]}, {.color = colors::okabe_ito[2], .width = 2.4});
  const DataTable& point = data["point"];
  const double x = point.value("x"), y = point.value("y"), top = point.value("top");
  panel.curve({x, x}, {0, top}, {.width = 0.8, .dash = {3, 2}});
  panel.curve({x, x, x}, {0, y, top},
              {.width = 0, .marker = MarkerShape::circle, .marker_size = 4});
  panel.note({x, y}, "X", {.offset = {-5, 0}});
  panel.note({x, 0}, "X*", {.offset = {0, -5}});
  panel.note({x, y / 2}, "d₁", {.offset = {4, 0}});
  panel.note({x, (y + top) / 2}, "d₂", {.offset = {4, 0}});
  panel.note({corners[1][0], 0}, "part i", {.offset = {-4, -5}, .color = colors::okabe_ito[2]});
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.column_shares = {0.8, 1, 1};
  draw_strip(plot.panel(0, 0), data);
  const DataTable& field = data["field"];
  const double cutoff = data["point"].value("alpha");
  const ColorScale scale{0, 1};
  const char* columns[] = {"theta_draft", "theta_published"};
  const char* titles[] = {"draft: 1 − d₁ / min(d₂, α)", "published: 1 − d₁ / min(d₁ + d₂, α)"};
  for (int v = 0; v < 2; ++v) {
    Panel& panel = plot.panel(0, 1 + v);
    panel.title = titles[v];
    panel.equal = true;
    panel.x.label = "d₁, from X* to X (m)";
    panel.y.label = "d₂, from X on to the hit (m)";
    const CellGrid grid = grid_of(field["d1"], field["d2"], field[columns[v]]);
    panel.heat_map(grid, scale);
    panel.contours(grid, {0.2, 0.4, 0.6, 0.8}, {.color = colors::white, .width = 0.6});
    const double corner = grid.box.upper[0];
    const std::vector<Vec<2>> line = v == 0 ? std::vector<Vec<2>>{{0, cutoff}, {corner, cutoff}}
                                            : std::vector<Vec<2>>{{0, cutoff}, {cutoff, 0}};
    panel.curve(line, {.color = colors::okabe_ito[4], .width = 1.2, .dash = {4, 2}});
    panel.note(v == 0 ? Vec<2>(corner, cutoff) : Vec<2>(cutoff / 2, cutoff / 2),
               v == 0 ? "d₂ = α" : "d₁ + d₂ = α",
               {.offset = v == 0 ? Vec<2>(-26, 8) : Vec<2>(30, 18), .color = colors::okabe_ito[4]});
  }
  plot.color_bar(scale, "θ");
}

}  // namespace

Figure theta_function() {
  return {"theta_function",
          "The distance weight as a function of both ray lengths, measured in a strip of growing "
          "thickness, alpha = 1 m: the draft's is zero in the far half (d1 > d2), the published "
          "one reaches across",
          7,
          2.6,
          compute,
          draw};
}

}  // namespace sem::figures
