// Weights through a shape with limbs: does one leg of a U feel the other?
#include <algorithm>

#include "figures/blob.h"
#include "figures/interior.h"

namespace sem::figures {
namespace {

constexpr int part = 10;       // the upper half of the left leg's inner side, x = 1, 2 <= y <= 3
constexpr double gap = 1.1;    // m, x of its middle
constexpr double level = 2.5;  // m, where the line runs across both legs
constexpr DistanceWeight variants[] = {DistanceWeight::published, DistanceWeight::draft,
                                       DistanceWeight::distance_only};
const std::vector<std::string> columns = {"w_published", "w_draft", "w_distance_only"};
const std::string titles[] = {"published", "draft", "distance only"};

// w of the part at the points, a column per variant.
Eigen::MatrixXd fields(const Discretization<2>& body, const Points<2>& position) {
  Eigen::MatrixXd w(position.cols(), 3);
  for (int v = 0; v < 3; ++v) w.col(v) = weight_field(body, position, variants[v]).col(part);
  return w;
}

Data compute() {
  const auto body = builtin_body("u_gap");
  Data data;
  add_curves(data, body.boundary, 1);
  const Points<2> cells = cells_inside(body, 150);
  const Eigen::MatrixXd w = fields(body, cells);
  auto& table = data.add("cells", {"x", "y", columns[0], columns[1], columns[2]});
  for (int k = 0; k < cells.cols(); ++k)
    table.add({cells(0, k), cells(1, k), w(k, 0), w(k, 1), w(k, 2)});
  constexpr int n = 441;
  const Box<2>& box = body.boundary.box;
  Points<2> line(2, n);
  for (int k = 0; k < n; ++k)
    line.col(k) = Vec<2>(box.lower[0] + (box.upper[0] - box.lower[0]) * k / (n - 1), level);
  const Eigen::MatrixXd across = fields(body, line);
  auto& values = data.add("line", {"leg", "x", "y", columns[0], columns[1], columns[2]});
  for (int k = 0; k < n; ++k)
    if (inside(body.boundary, body.loops, Vec<2>(line.col(k))))
      values.add(
          {double(line(0, k) > gap), line(0, k), level, across(k, 0), across(k, 1), across(k, 2)});
  return data;
}

// The area over which the part counts in the other leg, weighted: integral of w, m^2.
double beyond_gap(const DataTable& cells, const std::string& column, double cell_area) {
  double sum = 0;
  for (int k = 0; k < cells.n_rows(); ++k)
    if (cells["x"][k] > gap && cells["y"][k] > 1) sum += cell_area * cells[column][k];
  return sum;
}

void draw_field(Panel& panel, const Data& data, int v, const ColorScale& scale) {
  panel.equal = true;
  panel.frame = false;
  panel.title = titles[v];
  const DataTable& cells = data["cells"];
  const CellGrid grid = grid_of(cells["x"], cells["y"], cells[columns[v]]);
  panel.heat_map(grid, scale);
  for (const auto& curve : data["curves"].runs("part")) {
    const bool shown = int(curve.value("part")) == part;
    panel.curve(
        curve["x"], curve["y"],
        {.color = shown ? colors::okabe_ito[1] : colors::black, .width = shown ? 2.4 : 0.8});
  }
  panel.curve({grid.box.lower[0], grid.box.upper[0]}, {level, level},
              {.color = colors::white, .width = 0.8, .dash = {3, 2}});
  const double cell = (grid.box.upper[0] - grid.box.lower[0]) / grid.n_x;
  panel.lines_below = {"∫w in the other leg:",
                       number_text(beyond_gap(cells, columns[v], cell * cell), 2) + " m²"};
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.column_shares = {1, 1, 1, 1.8};
  const ColorScale scale{0, 0.5};
  for (int v = 0; v < 3; ++v) draw_field(plot.panel(0, v), data, v, scale);
  const DataTable& line = data["line"];
  Panel& panel = plot.panel(0, 3);
  panel.x.label = "x along the dashed line (m)";
  panel.y.label = "w of the orange part";
  panel.x.lower = 0;
  panel.x.upper = line["x"].back();
  panel.y.lower = 0;
  panel.y.upper = 0.6;
  panel.area({{{1, 0}, {1.2, 0}, {1.2, 0.6}, {1, 0.6}}}, colors::light_gray);
  const double labelled[] = {0.9, 1.35, 1.58};  // m: where the curve's name stands
  for (int v = 0; v < 3; ++v) {
    Series style = series(v);
    style.marker = {};
    style.width = 1.4;
    for (const auto& leg : line.runs("leg")) panel.curve(leg["x"], leg[columns[v]], style);
    const auto& xs = line["x"];
    const int row = int(std::lower_bound(xs.begin(), xs.end(), labelled[v]) - xs.begin());
    panel.note({line["x"][row], line[columns[v]][row]}, v == 2 ? "distance" : titles[v],
               {.offset = {v == 0 ? -6.0 : 4.0, 6}, .color = style.color});
  }
  panel.note({gap, 0}, "gap", {.offset = {0, 4}, .size = 7});
  plot.color_bar(scale, "w");
}

}  // namespace

Figure limb_weights() {
  return {
      "limb_weights",
      "Blending weight of a part of a U's left leg (orange): the published ray stops at the gap, "
      "the draft's and plain distance reach into the other leg and tie the two together",
      7,
      2.6,
      compute,
      draw};
}

}  // namespace sem::figures
