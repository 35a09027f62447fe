// What the method does, in space: solids from surfaces, at rest and deformed.
#include "figures/solid_states.h"
#include "sem/base/error.h"

namespace sem::figures {
namespace {

struct Shown {
  const char *scene, *title;
  double time;  // s; 0: static
};
const Shown shown[] = {{"torus", "torus", 0.5},
                       {"rocket", "rocket", 0.3},
                       {"mug", "mug", 0},
                       {"tyre", "tyre", 0.13},
                       {"twist", "beam", 0}};
// The twisted beam lies along x.
const render::ViewDirection view{.from = {0.5, -1, 0.42}};

Data compute() {
  Data data;
  for (const auto& [name, title, time] : shown) {
    SolidModel solid(name, {"probes=[]"});
    const auto state = time > 0 ? std::optional(solid.after(time)) : solid.equilibrium();
    if (!state) throw InputError(name, "analysis", "no equilibrium", "one");
    add_body(data, name, *solid.model);
    add_state(data, std::string(name) + " deformed", *solid.model, *state);
  }
  return data;
}

render::RenderScene scene_of(const std::vector<Nurbs<2, 3>>& parts, double ground, double point) {
  render::RenderScene scene;
  scene.meshes = meshes_of(
      parts, [](int i) { return colors::mix(colors::okabe_ito[i % 7], colors::white, 0.45); });
  scene.lines.push_back(lines_of(parts, 0, {0.12, 0.12, 0.15}, 0.6 * point));
  scene.ground = ground;
  return scene;
}

void draw(Plot& plot, const Data& data) {
  plot.row_titles = {"at rest", "deformed"};
  int column = 0;
  for (const auto& [name, title, time] : shown) {
    const std::string body = name, state = body + " deformed";
    const std::vector<std::vector<Nurbs<2, 3>>> rows = {surfaces_of(data, body + " "),
                                                        solid_state_of(data, body, state).parts};
    Box<3> box = box_of(data, state);
    for (const Vec<3>& corner : framed(rows[0])) box.include(corner);
    for (int row = 0; row < 2; ++row) {
      Panel& panel = plot.panel(row, column);
      if (row == 0) panel.title = title;
      draw_view(panel, {[parts = rows[row], ground = box.lower[2]](double point) {
                          return scene_of(parts, ground, point);
                        },
                        render::corners(box), view});
    }
    ++column;
  }
}

}  // namespace

Figure teaser_3d() {
  Figure figure{
      "teaser_3d",
      "No mesh in space either: solids bounded by NURBS patches (a colour each), at rest "
      "and moved: a torus hung at its top, a rocket in the wind, a mug pulled at a handle "
      "that only sits in its wall, a tyre under its hub, a beam twisted by a whole turn",
      7,
      2.9,
      compute,
      draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
