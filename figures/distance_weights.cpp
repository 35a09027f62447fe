// The draft's figure 4 as fields: distance weights theta_i and blending weights w_i of three
// curves.
#include "figures/blob.h"
#include "figures/interior.h"

namespace sem::figures {
namespace {

constexpr int n_cells = 160;  // along the longer side
constexpr int n_parts = 3;
const std::string fields[] = {"theta_", "theta_draft_", "w_"};

// theta (published), theta (draft) and w (published) of all parts in the cells.
Data compute() {
  const auto body = builtin_body("blob");
  Data data;
  add_curves(data, body.boundary);
  const Points<2> cells = cells_inside(body, n_cells);
  const Eigen::MatrixXd values[] = {theta_field(body, cells, DistanceWeight::published),
                                    theta_field(body, cells, DistanceWeight::draft),
                                    weight_field(body, cells, DistanceWeight::published)};
  std::vector<std::string> columns = {"x", "y"};
  for (const auto& field : fields)
    for (int i = 0; i < n_parts; ++i) columns.push_back(field + std::to_string(i));
  auto& table = data.add("cells", columns);
  for (int k = 0; k < cells.cols(); ++k) {
    std::vector<double> row = {cells(0, k), cells(1, k)};
    for (const auto& field : values)
      for (int i = 0; i < n_parts; ++i) row.push_back(field(k, i));
    table.add(row);
  }
  return data;
}

void draw(Plot& plot, const Data& data) {
  const DataTable& cells = data["cells"];
  const ColorScale scale{0, 1};
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < n_parts; ++i) {
      Panel& panel = plot.panel(row, i);
      panel.equal = true;
      panel.frame = false;
      panel.heat_map(grid_of(cells["x"], cells["y"], cells[fields[row] + std::to_string(i)]),
                     scale);
      panel.cut_outside({outline(data)});
      draw_parts(panel, data, i);
    }
  plot.row_titles = {"θ published", "θ draft (eq. 25)", "w published"};
  plot.column_titles = {"of the orange curve", "of the blue curve", "of the green curve"};
  plot.color_bar(scale, "weight");
}

}  // namespace

Figure distance_weights() {
  return {
      "distance_weights",
      "Draft figure 4 as fields: theta and w of the three curves; theta jumps where the closest "
      "point or the curve hit changes, and the draft's leaves a gap midway",
      7,
      6.6,
      compute,
      draw};
}

}  // namespace sem::figures
