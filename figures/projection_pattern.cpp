#include "figures/projection_pattern.h"

#include <cmath>

namespace sem::figures {

template <int Dim>
void add_projection_size(Data& data, const Discretization<Dim>& body) {
  data.add("size", {"n_parts", "n_monomials", "n_controls"})
      .add({double(body.boundary.n_parts()), double(body.projection.monomials.size()),
            double(body.boundary.n_controls())});
  auto& first = data.add("first_control", {"column"});
  for (const int c : body.boundary.first_control) first.add({double(c)});
}

template <int Dim>
void add_projection(Data& data, const std::string& name, const Projection<Dim>& projection) {
  constexpr double zero = 1e-10;  // of the largest entry: rounding
  const Monomials<Dim>& monomials = projection.monomials;
  auto& table = data.add(name, {"row", "column", "degree", "value"});
  const int n_rows = monomials.size() + 1;
  for (int i = 0; i < int(projection.parts.size()); ++i) {
    const PartFit fit = fit_on_controls(projection, i);
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

#define SEM_INSTANTIATE(Dim)                                            \
  template void add_projection_size(Data&, const Discretization<Dim>&); \
  template void add_projection(Data&, const std::string&, const Projection<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

namespace {

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

}  // namespace

void draw_projection(Panel& panel, const Data& data, const std::string& name) {
  const DataTable &size = data["size"], &entries = data[name];
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

}  // namespace sem::figures
