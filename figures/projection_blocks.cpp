// Block structure of the projection p -> (c, t): parts by control points, and its degree blocks.
#include <cmath>

#include "figures/blob.h"

namespace sem::figures {
namespace {

constexpr double zero = 1e-10;  // of the largest entry: rounding

// Entries of one projection: rows by part, in a part the translation, then the monomials by degree.
void add_entries(Data& data, const std::string& suffix, const Discretization<2>& body) {
  const Monomials<2>& monomials = body.projection.monomials;
  auto& table = data.add("entries" + suffix, {"row", "column", "degree", "value"});
  const int n_rows = monomials.size() + 1;
  for (int i = 0; i < body.boundary.n_parts(); ++i) {
    const PartFit fit = fit_on_controls(body.projection, i);
    const double largest = fit.coefficients.cwiseAbs().maxCoeff();
    for (size_t c = 0; c < fit.columns.size(); ++c) {
      if (std::abs(fit.translation[c]) > zero)
        table.add({double(i * n_rows), double(fit.columns[c]), 0, fit.translation[c]});
      for (int degree = 1; degree <= monomials.degree(); ++degree)
        for (int m = monomials.first(degree); m < monomials.first(degree + 1); ++m)
          if (std::abs(fit.coefficients(m, c)) > zero * largest)
            table.add({double(i * n_rows + 1 + m), double(fit.columns[c]), double(degree),
                       fit.coefficients(m, c)});
    }
  }
}

Data compute() {
  const auto shared =
      builtin_body("cantilever", {"method.origins=shared_parts", "method.weights.cutoff=1.01"});
  const auto one = builtin_body("cantilever", {"method.origins=one", "method.fit=pseudo_inverse"});
  Data data;
  data.add("size", {"n_parts", "n_monomials", "n_controls"})
      .add({double(one.boundary.n_parts()), double(one.projection.monomials.size()),
            double(one.boundary.n_controls())});
  auto& first = data.add("first_control", {"column"});
  for (const int c : one.boundary.first_control) first.add({double(c)});
  add_entries(data, "_draft", one);
  add_entries(data, "_published", shared);
  return data;
}

const std::string degree_names[] = {"translation t", "degree 1", "degree 2"};

// Rows and columns where a part begins, as the matrix counts them.
void draw_separators(Panel& panel, const std::vector<double>& rows,
                     const std::vector<double>& columns) {
  const Series style{.color = {0.75, 0.75, 0.75}, .width = 0.5};
  for (const double row : rows)
    panel.segments({{columns.front(), row}}, {{columns.back(), row}}, style);
  for (const double column : columns)
    panel.segments({{column, rows.front()}}, {{column, rows.back()}}, style);
}

void draw_matrix(Panel& panel, const Data& data, const std::string& suffix) {
  const DataTable &size = data["size"], &entries = data["entries" + suffix];
  const int n_parts = int(size.value("n_parts")), n_rows = int(size.value("n_monomials")) + 1;
  const int n_controls = int(size.value("n_controls"));
  std::vector<double> rows;
  std::vector<Tick> row_ticks, column_ticks;
  for (int i = 0; i <= n_parts; ++i) rows.push_back(i * n_rows);
  const std::vector<double> columns = data["first_control"]["column"];
  for (int i = 0; i < n_parts; ++i) {
    row_ticks.push_back({(rows[i] + rows[i + 1]) / 2, std::to_string(i + 1)});
    column_ticks.push_back({(columns[i] + columns[i + 1]) / 2, std::to_string(i + 1)});
  }
  for (int degree = 0; degree < 3; ++degree) {
    const DataTable block = entries.where("degree", degree);
    std::vector<std::pair<int, int>> cells;
    for (int e = 0; e < block.n_rows(); ++e)
      cells.push_back({int(block["row"][e]), int(block["column"][e])});
    constexpr int order[] = {7, 0, 4};
    panel.pattern(n_parts * n_rows, n_controls, cells, colors::okabe_ito[order[degree]]);
    panel.legend_entry({.label = degree_names[degree],
                        .color = colors::okabe_ito[order[degree]],
                        .width = 0,
                        .marker = MarkerShape::square,
                        .marker_size = 5});
  }
  draw_separators(panel, rows, columns);
  panel.equal = false;
  panel.x.label = "control points of part";
  panel.y.label = "c, t of part";
  panel.x.ticks = column_ticks;
  panel.y.ticks = row_ticks;
  panel.lines_below = {number_text(100.0 * entries.n_rows() / (n_parts * n_rows * n_controls), 2) +
                       " % of the entries are not zero"};
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.shared_legend = true;
  Panel &draft = plot.panel(0, 0), &published = plot.panel(0, 1);
  draft.title = "draft: one origin, pseudo-inverse";
  published.title = "published: shared origins, by degree";
  draw_matrix(draft, data, "_draft");
  draw_matrix(published, data, "_published");
}

}  // namespace

Figure projection_blocks() {
  return {
      "projection_blocks",
      "Which control points the polynomials of a cantilever's ten parts depend on: with one origin "
      "on nearly all, with shared origins on those of the origin's parts, in degree 2 on the own",
      7,
      3.6,
      compute,
      draw};
}

}  // namespace sem::figures
