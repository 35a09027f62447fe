#include "figures/blob.h"

#include "sem/base/error.h"
#include "sem/nurbs/basis.h"
#include "sem/scene/model.h"
#include "src2d/scenes/builtin.h"
#include "src2d/shapes/shape_fields.h"

namespace sem::figures {

Discretization<2> builtin_body(const std::string& name, const std::vector<std::string>& overrides) {
  for (const auto& scene : builtin_scenes())
    if (scene.name == name)
      return build_model(read_scene<2>(scene.text, name, shapes2d::describe_shape, overrides), name)
          ->discretization;
  throw InputError("", "scene", name, "a built-in scene");
}

std::vector<std::array<double, 3>> part_points(const Boundary<2>& boundary, int per_piece) {
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < boundary.n_parts(); ++i)
    for (const auto& piece : boundary.parts[i].pieces)
      for (int k = 0; k <= per_piece; ++k) {
        const Param<1> u = piece.lower + double(k) / per_piece * (piece.upper - piece.lower);
        const Vec<2> X = sem::point(boundary.parts[i].nurbs, u);
        points.push_back({double(i), X[0], X[1]});
      }
  return points;
}

Color part_color(int part) {
  static const Color palette[] = {colors::okabe_ito[1], colors::okabe_ito[0], colors::okabe_ito[2]};
  return palette[part % 3];
}

void draw_parts(Canvas& canvas, const View2& view, const Data& curves,
                const std::string& part_column, int highlighted) {
  const auto x = curves.column("x"), y = curves.column("y"), part = curves.column(part_column);
  for (size_t begin = 0, end; begin < x.size(); begin = end) {
    Polyline line;
    for (end = begin; end < x.size() && part[end] == part[begin]; ++end)
      line.push_back(view.map({x[end], y[end]}));
    const int index = int(part[begin]);
    const double width = index == highlighted ? 2.4 : highlighted < 0 ? 1.8 : 1.0;
    canvas.stroke(line,
                  {.color = part_color(index), .width = width * point, .cap = Stroke::Cap::round});
  }
}

}  // namespace sem::figures
