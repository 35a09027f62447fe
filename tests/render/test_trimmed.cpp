// Trimmed surfaces as triangles: what the trims leave, and its border.
#include <doctest/doctest.h>

#include <cmath>

#include "sem/method/boundary.h"
#include "solids3d.h"
#include "src2d/shapes/shapes.h"
#include "src3d/shapes/box.h"

using namespace sem;
using namespace sem::render;

namespace {

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += (mesh.position[b] - mesh.position[a]).cross(mesh.position[c] - mesh.position[a]).norm();
  return area / 2;
}

std::vector<Nurbs<1, 2>> circle_loop(double radius) {
  std::vector<Nurbs<1, 2>> loop;
  for (const auto& arc : make_parts(shapes2d::Disc{{0.5, 0.5}, radius})) loop.push_back(arc.shape);
  return loop;
}

PreparedNurbs<2, 3> trimmed_square(const TrimLoops& trims) {
  const auto top = make_parts(shapes3d::Box{}).back().shape;  // z = 1, u = x, v = y
  return make_boundary<3>({{top}}, {trims}).parts[0];
}

}  // namespace

TEST_CASE("triangles of a disc, and of a ring, trimmed out of a face have its area and border") {
  for (const double inner : {0.0, 0.2}) {
    CAPTURE(inner);
    TrimLoops trims = {circle_loop(0.4)};
    if (inner > 0) trims.push_back(circle_loop(inner));
    const auto surface = trimmed_square(trims);
    const Mesh mesh = tessellate(surface, {1e-3});
    CHECK(area_of(mesh) == doctest::Approx(M_PI * (0.16 - inner * inner)).epsilon(2e-3));
    for (const auto& uv : mesh.uv) CHECK(surface.region->contains(uv));
    double length = 0;
    for (const auto& chain : outline(surface, {1e-3})) {
      length += (chain[1] - chain[0]).norm();
      for (const auto& X : chain) {
        const double r = std::hypot(X[0] - 0.5, X[1] - 0.5);
        CHECK(std::min(std::abs(r - 0.4), std::abs(r - inner)) < 1e-8);
      }
    }
    CHECK(length == doctest::Approx(2 * M_PI * (0.4 + inner)).epsilon(2e-3));
  }
}

TEST_CASE("triangles of a trimmed face turn about its normal") {
  const Mesh mesh = tessellate(trimmed_square({circle_loop(0.3)}), {1e-3});
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec<3> n =
        (mesh.position[b] - mesh.position[a]).cross(mesh.position[c] - mesh.position[a]);
    CHECK(n.dot(mesh.normal[a]) >= 0);
  }
}
