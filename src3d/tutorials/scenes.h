#pragma once
// Scenes that several tutorials use: the program's own with some settings changed, and a drilled
// plate, the solid of the tutorials on trims and CAD files.

#include <string>
#include <vector>

#include "sem/method/boundary.h"
#include "sem/scene/scene.h"

namespace sem::tutorial {

/// A scene that comes with sem3d; settings as its --set takes them.
Scene<3> builtin_scene(const std::string& name, const std::vector<std::string>& settings);

/// The arcs of a circle as one closed loop.
std::vector<Nurbs<1, 2>> circle(const Vec<2>& center, double radius);
/// The sides of the unit square, as the border of a domain.
std::vector<Nurbs<1, 2>> square();

/// The rectangle [0, 1]^2 at height z with u = x, v = y; biquadratic, each direction cut at n - 1
/// knots.
Nurbs<2, 3> square_patch(double z, int n = 1);

/// The plate [0, 1] x [0, 1] x [0, height] with a hole along z: four sides, "bottom" and "top" as
/// square_patch() trimmed to what the hole leaves, the hole's wall in four patches. All of
/// degree 2.
std::vector<ScenePart<3>> drilled_plate(const Vec<2>& center, double radius, double height,
                                        int n = 1);

/// Statics of the solids, of which the first has such a plate's parts: quadratic, projected; "left"
/// is held, "right" is led (pin 1).
Scene<3> plate_scene(const std::vector<SceneSolid<3>>& solids);
/// Soft, nearly incompressible.
inline const Material plate_material{MaterialModel::neo_ref, 1e6, 0.4, 1000};

/// The boundary of one solid; parts have a shape and trims.
template <class Part>
Boundary<3> boundary_of(const std::vector<Part>& parts) {
  std::vector<Nurbs<2, 3>> shapes;
  std::vector<TrimLoops> trims;
  for (const auto& part : parts) {
    shapes.push_back(part.shape);
    trims.push_back(part.trims);
  }
  return make_boundary<3>({shapes}, trims);
}

}  // namespace sem::tutorial
