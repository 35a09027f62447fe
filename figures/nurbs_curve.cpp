// The draft's figure 2 in 2D: a NURBS curve, its control points as the degrees of freedom, its
// basis.
#include <cmath>

#include "figures/blob.h"
#include "sem/nurbs/basis.h"

namespace sem::figures {
namespace {

constexpr double shown_u = 2.4;     // of the row J(u) that the figure explains
constexpr int steps_per_span = 40;  // of the plotted lines
constexpr int ticks_per_span = 4;   // parameter ticks along the curve

Data compute() {
  const auto body = builtin_body("blob");
  const Nurbs<1, 2>& curve = body.boundary.parts[0].nurbs;
  Data data;
  auto& points = data.add("curve", {"u", "x", "y"});
  const auto [lower, upper] = domain(curve, 0);
  const int n_spans = int(spans(curve, 0).size());
  for (int k = 0; k <= n_spans * steps_per_span; ++k) {
    const double u = lower + (upper - lower) * k / (n_spans * steps_per_span);
    const Vec<2> x = sem::point(curve, Param<1>(u));
    points.add({u, x[0], x[1]});
  }
  auto& ticks = data.add("ticks", {"u", "x", "y", "normal_x", "normal_y", "knot"});
  for (const auto& span : spans(curve, 0))
    for (int k = 0; k <= ticks_per_span; ++k) {
      if (k == ticks_per_span && span.upper < upper) continue;  // the next span's first
      const double u = span.lower + (span.upper - span.lower) * k / ticks_per_span;
      const auto d = derivatives(curve, Param<1>(u), 1);
      const Vec<2> tangent = d.first.col(0).normalized();
      ticks.add(
          {u, d.point[0], d.point[1], -tangent[1], tangent[0], double(k % ticks_per_span == 0)});
    }
  auto& controls = data.add("control_points", {"x", "y"});
  for (int c = 0; c < n_control(curve, 0); ++c)
    controls.add({curve.control_points(0, c), curve.control_points(1, c)});
  auto& basis_table = data.add("basis", {"control_point", "u", "value"});
  BasisValues<1> basis;
  for (int c = 0; c < n_control(curve, 0); ++c)
    for (const double u : data["curve"]["u"]) {
      evaluate_basis(curve, Param<1>(u), 0, basis);
      for (size_t e = 0; e < basis.column.size(); ++e)
        if (basis.column[e] == c) basis_table.add({double(c), u, basis.value[e]});
    }
  evaluate_basis(curve, Param<1>(shown_u), 0, basis);
  auto& row = data.add("row", {"control_point", "value"});
  for (size_t e = 0; e < basis.column.size(); ++e)
    row.add({double(basis.column[e]), basis.value[e]});
  const Vec<2> at = sem::point(curve, Param<1>(shown_u));
  data.add("shown", {"u", "x", "y"}).add({shown_u, at[0], at[1]});
  return data;
}

// Colour of an active control point: its line to x(u) and its basis function share it.
Color active_color(int k) {
  constexpr int order[] = {0, 4, 2, 3};
  return colors::okabe_ito[order[k % 4]];
}

std::string subscript(int number) {
  std::string text;
  for (const char digit : std::to_string(number))
    text += std::string("\xE2\x82") + char(0x80 + digit - '0');
  return text;
}

// The parameter of a knot, on the side of the curve that is farther from the control points.
void draw_knot_label(Panel& panel, const DataTable& ticks, int k, const std::vector<Vec<2>>& p) {
  const Vec<2> at(ticks["x"][k], ticks["y"][k]), normal(ticks["normal_x"][k], ticks["normal_y"][k]);
  constexpr double aside = 0.1;  // m, about where the label stands
  double room[2] = {1e9, 1e9};
  for (const Vec<2>& point : p)
    for (const int side : {0, 1})
      room[side] = std::min(room[side], (at + (side ? aside : -aside) * normal - point).norm());
  panel.note(at, number_text(ticks["u"][k]),
             {.offset = (room[1] > room[0] ? 7 : -7) * normal, .color = part_color(0), .size = 7});
}

void draw_curve(Panel& panel, const Data& data) {
  panel.equal = true;
  panel.frame = false;
  const DataTable &controls = data["control_points"], &ticks = data["ticks"], &row = data["row"];
  const auto p = zip(controls["x"], controls["y"]);
  const Vec<2> x(data["shown"].value("x"), data["shown"].value("y"));
  constexpr Color gray{0.6, 0.6, 0.6};
  panel.curve(p, {.color = colors::light_gray, .width = 0.8});
  for (int k = 0; k < row.n_rows(); ++k)
    panel.curve({p[int(row["control_point"][k])], x},
                {.color = active_color(k), .width = 0.4 + 4 * row["value"][k]});
  panel.curve(data["curve"]["x"], data["curve"]["y"], {.color = part_color(0), .width = 2});
  panel.draw([=](const Pen& pen) {
    for (int k = 0; k < ticks.n_rows(); ++k) {
      const bool knot = ticks["knot"][k] > 0;
      const Vec<2> at = pen.map({ticks["x"][k], ticks["y"][k]});
      const Vec<2> half =
          (knot ? 4 : 2) * pen.point * Vec<2>(ticks["normal_x"][k], -ticks["normal_y"][k]);
      pen.canvas.line(at - half, at + half, pen.stroke(part_color(0), knot ? 1.2 : 0.7));
    }
  });
  for (int k = 0; k < ticks.n_rows(); ++k)
    if (ticks["knot"][k] > 0) draw_knot_label(panel, ticks, k, p);
  for (size_t c = 0; c < p.size(); ++c) panel.node(p[c], "", 6, gray);
  panel.node(x, "", 5, part_color(0));
  const Vec<2> offsets[] = {{-7, -2}, {-7, 4}, {7, 2},  {-4, -9}, {7, -2},
                            {-7, 0},  {-7, 2}, {-7, 2}, {6, 4},   {7, 0}};
  for (size_t c = 0; c < p.size(); ++c)
    panel.note(p[c], "p" + subscript(int(c) + 1), {.offset = offsets[c % 10]});
  panel.note(x, "x(u) = J(u) p", {.offset = {22, -18}, .leader = true});
}

void draw_basis(Panel& panel, const Data& data) {
  const DataTable& row = data["row"];
  const double u = data["shown"].value("u");
  panel.x.label = "u";
  panel.y.label = "basis functions";
  panel.y.lower = 0;
  panel.y.upper = 1;
  panel.x.lower = data["curve"]["u"].front();
  panel.x.upper = data["curve"]["u"].back();
  for (const auto& function : data["basis"].runs("control_point")) {
    Color color{0.6, 0.6, 0.6};
    for (int k = 0; k < row.n_rows(); ++k)
      if (row["control_point"][k] == function.value("control_point")) color = active_color(k);
    panel.curve(function["u"], function["value"], {.color = color, .width = 1.1});
  }
  panel.vertical(u, "", {.color = part_color(0), .width = 0.8, .dash = {4, 2}});
  for (int k = 0; k < row.n_rows(); ++k)
    panel.curve(
        {u}, {row["value"][k]},
        {.color = active_color(k), .width = 0, .marker = MarkerShape::circle, .marker_size = 4.5});
}

void draw(Plot& plot, const Data& data) {
  plot.row_shares = {2.6, 1};
  draw_curve(plot.panel(0, 0), data);
  draw_basis(plot.panel(1, 0), data);
}

}  // namespace

Figure nurbs_curve() {
  return {"nurbs_curve",
          "Draft figure 2 in 2D: a NURBS curve of the blob, its knots and its control points, the "
          "degrees of freedom; x(u) follows four of them, by their basis functions at u (colours)",
          3.3,
          4.2,
          compute,
          draw};
}

}  // namespace sem::figures
