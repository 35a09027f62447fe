#include "figures/blob.h"

#include "sem/base/error.h"
#include "sem/nurbs/basis.h"
#include "sem/scene/model.h"
#include "sem/scene/builtin.h"
#include "src2d/shapes/shape_fields.h"

namespace sem::figures {

Discretization<2> builtin_body(const std::string& name, const std::vector<std::string>& overrides) {
  for (const auto& scene : builtin_scenes<2>())
    if (scene.name == name)
      return build_model(read_scene<2>(scene.text, name, shapes2d::describe_shape, overrides), name)
          ->discretization;
  throw InputError("", "scene", name, "a built-in scene");
}

void add_curves(Data& data, const Boundary<2>& boundary, int per_piece) {
  auto& curves = data.add("curves", {"part", "x", "y"});
  for (int i = 0; i < boundary.n_parts(); ++i)
    for (const auto& piece : boundary.parts[i].pieces)
      for (int k = 0; k <= per_piece; ++k) {
        const Param<1> u = piece.lower + double(k) / per_piece * (piece.upper - piece.lower);
        const Vec<2> X = sem::point(boundary.parts[i].nurbs, u);
        curves.add({double(i), X[0], X[1]});
      }
}

std::vector<Vec<2>> outline(const Data& data) {
  return zip(data["curves"]["x"], data["curves"]["y"]);
}

Color part_color(int part) {
  static const Color palette[] = {colors::okabe_ito[1], colors::okabe_ito[0], colors::okabe_ito[2]};
  return palette[part % 3];
}

void draw_parts(Panel& panel, const Data& data, int highlighted) {
  for (const auto& part : data["curves"].runs("part")) {
    const int i = int(part.value("part"));
    const double width = i == highlighted ? 2.4 : highlighted < 0 ? 1.8 : 1.0;
    panel.curve(part["x"], part["y"], {.color = part_color(i), .width = width});
  }
}

}  // namespace sem::figures
