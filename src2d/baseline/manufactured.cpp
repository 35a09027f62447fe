#include "src2d/baseline/manufactured.h"

#include "src2d/shapes/shapes.h"

namespace sem::baseline {

std::vector<ScenePart<2>> manufactured_body(bool convex, int m) {
  if (convex) return shapes2d::make_parts(shapes2d::Rectangle{{0, 0}, {1, 1}, {m, m, m, m}, 3});
  shapes2d::Polygon polygon;
  polygon.vertices.resize(2, 6);
  polygon.vertices << 0, 1, 1, 0.5, 0.5, 0,  //
      0, 0, 0.5, 0.5, 1, 1;
  polygon.n_parts = {2 * m, m, m, m, m, 2 * m};
  polygon.degree = 3;
  return shapes2d::make_parts(polygon);
}

}  // namespace sem::baseline
