// The draft's figure 4 as fields: distance weights theta_i and blending weights w_i of three
// curves.
#include <algorithm>
#include <cmath>

#include "figures/blob.h"
#include "sem/draw/image.h"
#include "sem/draw/view.h"

namespace sem::figures {
namespace {

constexpr int n_cells = 160;  // along the longer side
constexpr int n_parts = 3;

// theta (published), theta (draft) and w (published) of all parts on a grid; rows of kind 0 are the
// boundary (part in theta_0), of kind 1 the cells inside.
Data compute() {
  const auto body = builtin_body("blob");
  Data data{{"kind", "x", "y", "column", "row"}, {}};
  for (const char* field : {"theta_", "theta_draft_", "w_"})
    for (int i = 0; i < n_parts; ++i) data.columns.push_back(field + std::to_string(i));
  for (const auto& [part, x, y] : part_points(body.boundary))
    data.rows.push_back({0, x, y, 0, 0, part, 0, 0, 0, 0, 0, 0, 0, 0});
  Box<2> box;
  for (const auto& row : data.rows) box.include(Vec<2>(row[1], row[2]));
  const Vec<2> size = box.upper - box.lower;
  const double cell = size.maxCoeff() / n_cells;
  std::vector<Vec<2>> inner;
  for (int r = 0; r < int(std::ceil(size[1] / cell)); ++r)
    for (int c = 0; c < int(std::ceil(size[0] / cell)); ++c) {
      const Vec<2> X(box.lower[0] + (c + 0.5) * cell, box.upper[1] - (r + 0.5) * cell);
      if (!inside(body.boundary, body.loops, X)) continue;
      inner.push_back(X);
      data.rows.push_back({1, X[0], X[1], double(c), double(r), 0, 0, 0, 0, 0, 0, 0, 0, 0});
    }
  Points<2> position(2, inner.size());
  for (size_t k = 0; k < inner.size(); ++k) position.col(k) = inner[k];
  const size_t first = data.rows.size() - inner.size();
  for (const auto variant : {DistanceWeight::published, DistanceWeight::draft}) {
    WeightOptions options = body.options.weights;
    options.variant = variant;
    const auto theta = distance_weights(
        measure_distances(body.boundary, body.loops, position, variant, options.cutoff, 2),
        options);
    const int column = variant == DistanceWeight::published ? 5 : 5 + n_parts;
    for (size_t k = 0; k < inner.size(); ++k)
      for (int e = theta.begin[k]; e < theta.begin[k + 1]; ++e)
        data.rows[first + k][column + theta.part[e]] = theta.theta[e];
    if (variant != DistanceWeight::published) continue;
    const auto w = blending_weights(theta, body.boundary, position);
    for (size_t k = 0; k < inner.size(); ++k)
      for (int e = w.begin[k]; e < w.begin[k + 1]; ++e)
        data.rows[first + k][5 + 2 * n_parts + w.part[e]] = w.w[e];
  }
  return data;
}

void draw_field(Canvas& canvas, const Box<2>& area, const Data& cells, const Data& boundary,
                const std::string& field, int highlighted) {
  int columns = 0, rows = 0;
  const auto c = cells.column("column"), r = cells.column("row"), values = cells.column(field);
  for (size_t k = 0; k < c.size(); ++k) {
    columns = std::max(columns, int(c[k]) + 1);
    rows = std::max(rows, int(r[k]) + 1);
  }
  Image image(columns, rows);
  std::fill(image.rgb.begin(), image.rgb.end(), 255);
  for (size_t k = 0; k < c.size(); ++k) image.set(int(c[k]), int(r[k]), colors::viridis(values[k]));
  Box<2> world;
  for (const auto& row : boundary.rows) world.include(Vec<2>(row[1], row[2]));
  const View2 view(world, area);
  const double cell = (world.upper - world.lower).maxCoeff() / n_cells;
  const Vec<2> corner(world.lower[0] + columns * cell, world.upper[1] - rows * cell);
  const Vec<2> top = view.map({world.lower[0], world.upper[1]}), bottom = view.map(corner);
  canvas.image(image, {top, bottom});
  draw_parts(canvas, view, boundary, "theta_0", highlighted);
}

void draw(Canvas& canvas, const Data& data) {
  const Data boundary = data.where("kind", 0), cells = data.where("kind", 1);
  const char* fields[] = {"theta_", "theta_draft_", "w_"};
  const char* titles[] = {"θ published", "θ draft (eq. 25)", "w published"};
  const double left = 22 * point, top = 18 * point, right = canvas.width() - 46 * point,
               bottom = canvas.height() - 6 * point;
  const double width = (right - left) / n_parts, height = (bottom - top) / 3;
  const char* names[] = {"red", "blue", "green"};
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < n_parts; ++i) {
      const Vec<2> corner(left + i * width, top + row * height);
      const Box<2> area{corner + Vec<2>(3 * point, 3 * point),
                        corner + Vec<2>(width - 3 * point, height - 3 * point)};
      draw_field(canvas, area, cells, boundary, fields[row] + std::to_string(i), i);
      if (row == 0) panel_title(canvas, area, std::string("of the ") + names[i] + " curve");
    }
    canvas.text({10 * point, top + (row + 0.5) * height}, titles[row],
                {.size = text_size,
                 .horizontal = TextStyle::Horizontal::center,
                 .vertical = TextStyle::Vertical::middle,
                 .upward = true});
  }
  color_bar(canvas,
            {Vec<2>(right + 10 * point, top + 10 * point),
             Vec<2>(right + 18 * point, bottom - 10 * point)},
            0, 1, "weight");
}

}  // namespace

Figure distance_weights() {
  return {"distance_weights",
          "Draft figure 4 as fields: theta (published, draft) and w of the three curves",
          7,
          6.6,
          compute,
          draw};
}

}  // namespace sem::figures
