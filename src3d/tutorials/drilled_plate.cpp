#include "src3d/tutorials/drilled_plate.h"

#include "sem/nurbs/bezier_curve.h"
#include "sem/nurbs/refine.h"
#include "src2d/shapes/shapes.h"
#include "src3d/shapes/box.h"
#include "src3d/shapes/solids.h"

namespace sem::tutorial {

std::vector<Nurbs<1, 2>> circle(const Vec<2>& center, double radius) {
  std::vector<Nurbs<1, 2>> arcs;
  for (const auto& arc : shapes2d::make_parts(shapes2d::Disc{center, radius}))
    arcs.push_back(arc.shape);
  return arcs;
}

std::vector<Nurbs<1, 2>> square() {
  const Vec<2> corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<Nurbs<1, 2>> sides;
  for (int k = 0; k < 4; ++k) sides.push_back(segment<2>(corners[k], corners[(k + 1) % 4]));
  return sides;
}

Nurbs<2, 3> square_patch(double z, int n) {
  auto patch = shapes3d::elevated(
      shapes3d::ruled(segment<3>({0, 0, z}, {1, 0, z}), segment<3>({0, 1, z}, {1, 1, z})), 2);
  for (int axis = 0; axis < 2; ++axis)
    for (int k = 1; k < n; ++k) patch = insert_knot(patch, axis, double(k) / n);
  return patch;
}

std::vector<ScenePart<3>> drilled_plate(const Vec<2>& center, double radius, double height, int n) {
  auto parts = make_parts(shapes3d::Box{{0, 0, 0}, {1, 1, height}});
  for (auto& part : parts) {
    const bool top = part.name == "top";
    if (!top && part.name != "bottom") continue;
    part.shape = square_patch(top ? height : 0, n);
    part.trims = {square(), circle(center, radius)};
  }
  shapes3d::Cylinder hole{.radius = radius, .top_radius = radius, .height = height, .caps = false};
  hole.center.head<2>() = center;
  for (auto& part : make_parts(hole)) {
    parts.push_back(part);
    parts.back().name = "hole" + part.name.substr(part.name.find('.'));
  }
  shapes3d::elevate(parts, 2);
  return parts;
}

}  // namespace sem::tutorial
