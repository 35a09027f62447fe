// The draft's figure 1: what the method does. Curves, weights, motion.
#include <array>
#include <cmath>

#include "figures/blob.h"
#include "figures/interior.h"
#include "figures/starfish.h"
#include "src2d/picture/outline.h"

namespace sem::figures {
namespace {

constexpr double moments[] = {0.4, 0.7, 1.0};  // s
constexpr int n_parts = 5;
constexpr double quad_size = 0.045;  // m
constexpr int quads_per_field = 6;   // side of a field of the chequerboard, in quads

Color arm_color(int part) {
  constexpr int order[n_parts] = {1, 4, 2, 0, 3};
  return colors::okabe_ito[order[part]];
}

// Tables of one state: the quads, the curves x = J(u) p.
void add_state(Data& data, const std::string& suffix, const Discretization<2>& body,
               const Quads& quads, const Points<2>& position, const Points<2>& p) {
  auto& cells = data.add("quads" + suffix, {"x0", "y0", "x1", "y1", "x2", "y2", "x3", "y3"});
  for (const auto& quad : quads.quads) {
    std::vector<double> row;
    for (const int c : quad) row.insert(row.end(), {position(0, c), position(1, c)});
    cells.add(row);
  }
  auto& curves = data.add("curves" + suffix, {"part", "x", "y"});
  const Outline outline(body);
  for (int i = 0; i < outline.n_parts(); ++i)
    for (const Vec<2>& x : outline.part(i, p)) curves.add({double(i), x[0], x[1]});
}

// Centres of the quads.
Points<2> centers(const Quads& quads) {
  Points<2> center = Points<2>::Zero(2, quads.quads.size());
  for (size_t k = 0; k < quads.quads.size(); ++k)
    for (const int c : quads.quads[k]) center.col(k) += quads.corner.col(c) / 4;
  return center;
}

Data compute() {
  const Scene<2> scene = starfish_scene();
  const auto model = build_model(scene, scene.name);
  const Discretization<2>& body = model->discretization;
  const auto states = states_at(scene, *model, {std::begin(moments), std::end(moments)});
  const Quads quads = fitted_quads(body, quad_size);
  const Points<2> center = centers(quads), rest = rest_controls(body.boundary);
  Data data;
  auto& controls = data.add("control_points", {"part", "x", "y"});
  for (int i = 0; i < n_parts; ++i)
    for (int c = body.boundary.first_control[i]; c < body.boundary.first_control[i + 1]; ++c)
      controls.add({double(i), rest(0, c), rest(1, c)});
  auto& pins = data.add("pins", {"x", "y"});
  for (const int c : model->held[0].controls) pins.add({rest(0, c), rest(1, c)});
  // What a quad carries: the weights in it, and its field of a chequerboard on the rest shape.
  auto& carried = data.add("carried", {"w0", "w1", "w2", "w3", "w4", "chequer"});
  const Eigen::MatrixXd w = weight_field(body, center, body.options.weights.variant);
  for (int k = 0; k < w.rows(); ++k) {
    const Vec<2> field = (center.col(k) - body.boundary.box.lower) / (quads_per_field * quad_size);
    carried.add(
        {w(k, 0), w(k, 1), w(k, 2), w(k, 3), w(k, 4), double((int(field[0]) + int(field[1])) % 2)});
  }
  auto& times = data.add("times", {"time"});
  for (const State& state : states) times.add({state.time});
  add_state(data, "0", body, quads, quads.corner, rest);
  const Map<2> map = map_at(body, quads.corner, false);
  for (size_t m = 0; m < states.size(); ++m)
    add_state(data, std::to_string(m + 1), body, quads, evaluate(map, states[m].z),
              control_points(body.unknowns, states[m].z));
  return data;
}

void draw_quads(Panel& panel, const DataTable& quads, const std::function<Color(int)>& color_of) {
  std::vector<std::array<Vec<2>, 4>> corners(quads.n_rows());
  std::vector<Color> colors(quads.n_rows());
  for (int k = 0; k < quads.n_rows(); ++k) {
    colors[k] = color_of(k);
    for (int c = 0; c < 4; ++c) {
      const std::string number = std::to_string(c);
      corners[k][c] = {quads.value("x" + number, k), quads.value("y" + number, k)};
      panel.include(corners[k][c]);
    }
  }
  panel.draw([=](const Pen& pen) {
    for (size_t k = 0; k < corners.size(); ++k) {
      Polyline loop;
      for (const Vec<2>& x : corners[k]) loop.push_back(pen.map(x));
      Vec<2> middle = Vec<2>::Zero();
      for (const Vec<2>& x : loop) middle += x / 4;
      for (Vec<2>& x : loop) x += 0.9 * (x - middle).normalized();  // no seams between neighbours
      pen.canvas.fill(loop, colors[k]);
    }
  });
}

void draw_curves(Panel& panel, const DataTable& curves, double width, bool rest_shape = false) {
  for (const auto& part : curves.runs("part"))
    panel.curve(part["x"], part["y"],
                rest_shape ? Series{.color = colors::gray, .width = width, .dash = {2, 1.5}}
                           : Series{.color = arm_color(int(part.value("part"))), .width = width});
}

// Colours of the parts, mixed by their weights in a quad; fields of the chequerboard are lighter.
Color carried_color(const DataTable& carried, int quad) {
  Color mixed{0, 0, 0};
  for (int i = 0; i < n_parts; ++i) {
    const double w = carried.value("w" + std::to_string(i), quad);
    const Color c = arm_color(i);
    mixed = {mixed.r + w * c.r, mixed.g + w * c.g, mixed.b + w * c.b};
  }
  return colors::mix(mixed, colors::white, carried.value("chequer", quad) > 0 ? 0.45 : 0.2);
}

void draw_state(Panel& panel, const Data& data, int state) {
  const std::string number = std::to_string(state);
  if (state > 0) draw_curves(panel, data["curves0"], 0.6, true);
  draw_quads(panel, data["quads" + number],
             [&](int k) { return carried_color(data["carried"], k); });
  draw_curves(panel, data["curves" + number], 1.8);
  const DataTable &controls = data["control_points"], &pins = data["pins"];
  if (state == 0)
    panel.curve(
        controls["x"], controls["y"],
        {.color = {0.45, 0.45, 0.45}, .width = 0, .marker = MarkerShape::circle, .marker_size = 3});
  else
    panel.curve(pins["x"], pins["y"],
                {.width = 0, .marker = MarkerShape::square, .marker_size = 3});
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  const DataTable& times = data["times"];
  for (int state = 0; state <= times.n_rows(); ++state) {
    Panel& panel = plot.panel(0, state);
    panel.equal = true;
    panel.frame = false;
    panel.title = state == 0 ? "at rest" : "t = " + number_text(times["time"][state - 1]) + " s";
    for (int other = 0; other <= times.n_rows(); ++other) {  // the same view for all
      const DataTable& curves = data["curves" + std::to_string(other)];
      for (int k = 0; k < curves.n_rows(); ++k) panel.include({curves["x"][k], curves["y"][k]});
    }
    draw_state(panel, data, state);
  }
}

}  // namespace

Figure teaser() {
  return {
      "teaser",
      "No mesh: a starfish is five NURBS curves and what is blended from them inside (weights as "
      "mixed colours); hung by one arm (squares), its control points (gray) make it swing",
      7,
      2.0,
      compute,
      draw};
}

}  // namespace sem::figures
