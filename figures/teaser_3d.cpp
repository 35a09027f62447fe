// What the method does, in space: solids from surfaces, at rest and deformed.
#include "figures/solid_states.h"
#include "sem/base/error.h"

namespace sem::figures {
namespace {

struct Shown {
  const char *scene, *title;
  double time;                         // s; 0: static
  std::vector<std::string> overrides;  // loads larger than the scene's
};
const Shown all_shown[] = {{"torus", "torus", 0.5, {}},
                           {"rocket", "rocket", 0.3, {"loads[0].force=[14000,0,0]"}},
                           {"cube", "cube", 0.4, {}},
                           {"mug", "mug", 0, {"loads[0].traction=[12000,0,-12000]"}},
                           {"beam_condensed", "beam", 0, {}}};
const render::ViewDirection view{.from = {0.5, -1, 0.42}};

Data compute() {
  Data data;
  for (const auto& shown : all_shown) {
    std::vector<std::string> overrides = shown.overrides;
    overrides.push_back("probes=[]");
    SolidModel solid(shown.scene, overrides);
    const auto state =
        shown.time > 0 ? std::optional(solid.after(shown.time)) : solid.equilibrium();
    if (!state) throw InputError(shown.scene, "analysis", "no equilibrium", "one");
    add_surfaces(data, parts_of(*solid.model, solid.model->initial),
                 std::string(shown.scene) + " ");
    add_surfaces(data, parts_of(*solid.model, *state), std::string(shown.scene) + " deformed ");
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
  for (const auto& shown : all_shown) {
    const std::string body = shown.scene;
    const std::vector<std::vector<Nurbs<2, 3>>> rows = {surfaces_of(data, body + " "),
                                                        surfaces_of(data, body + " deformed ")};
    Box<3> box;
    for (const auto& parts : rows)
      for (const Vec<3>& corner : framed(parts)) box.include(corner);
    for (int row = 0; row < 2; ++row) {
      Panel& panel = plot.panel(row, column);
      if (row == 0) panel.title = shown.title;
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
      "that only sits in its wall, a cube that swings at a corner, a beam under its own weight",
      7,
      2.9,
      compute,
      draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
