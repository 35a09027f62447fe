#include "src3d/tutorials/scenes.h"

#include "sem/base/error.h"
#include "sem/nurbs/bezier_curve.h"
#include "sem/nurbs/refine.h"
#include "sem/scene/builtin.h"
#include "sem/scene/read_scene.h"
#include "src2d/shapes/shapes.h"
#include "src3d/shapes/box.h"
#include "src3d/shapes/shape_fields.h"
#include "src3d/shapes/solids.h"

namespace sem::tutorial {

Scene<3> builtin_scene(const std::string& name, const std::vector<std::string>& settings) {
  for (const auto& builtin : builtin_scenes<3>())
    if (builtin.name == name)
      return read_scene<3>(builtin.text, name, shapes3d::describe_shape, settings);
  throw InputError("", "scene", name, "the name of a scene of sem3d");
}

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

Scene<3> plate_scene(const std::vector<SceneSolid<3>>& solids) {
  Scene<3> scene;
  scene.name = "plate";
  scene.solids = solids;
  scene.method.projection.degree = 2;
  scene.method.origins = OriginChoice::one;
  scene.method.weights.cutoff = 0.6;
  scene.method.rays = {.axis = 2, .n_rays = 12};
  scene.method.interval.points = 4;
  scene.analysis.kind = AnalysisKind::statics;
  scene.pins.resize(2);
  for (const int k : {0, 1}) {
    scene.pins[k].where.part = k == 0 ? "left" : "right";
    scene.pins[k].axes = every_axis<3>();
  }
  return scene;
}

}  // namespace sem::tutorial
