// Triangles of surfaces: near enough, with exact normals, without cracks.
#include <doctest/doctest.h>

#include "sem/nurbs/basis.h"
#include "solids3d.h"
#include "src3d/shapes/box.h"
#include "trimmed.h"

using namespace sem;
using namespace sem::render;

namespace {

double distance_to_segment(const Vec<3>& X, const Vec<3>& a, const Vec<3>& b) {
  const double t = std::clamp((X - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (X - a - t * (b - a)).norm();
}

// Edges that only one triangle has.
std::vector<std::array<Vec<3>, 2>> open_edges(const Mesh& mesh) {
  std::vector<std::array<int, 2>> all;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) all.push_back({t[k], t[(k + 1) % 3]});
  std::vector<std::array<Vec<3>, 2>> open;
  for (const auto& e : all)
    if (std::none_of(all.begin(), all.end(),
                     [&](const auto& f) { return f[0] == e[1] && f[1] == e[0]; }) &&
        (mesh.position[e[0]] - mesh.position[e[1]]).norm() > 0)
      open.push_back({mesh.position[e[0]], mesh.position[e[1]]});
  return open;
}

}  // namespace

TEST_CASE("triangles of a ball keep to it within the tolerance, and not much closer") {
  for (const double tolerance : {3e-2, 1e-3, 1e-4})
    for (const bool poles : {true, false}) {
      CAPTURE(tolerance);
      CAPTURE(poles);
      double worst = 0;
      for (const auto& surface : poles
                                     ? test::ball_with_poles(2)
                                     : test::prepared(make_parts(shapes3d::Sphere{{0, 0, 0}, 2}))) {
        const Mesh mesh = tessellate(surface, {.distance = tolerance, .max_turn = 1});
        for (const auto& t : mesh.triangles)
          for (const Vec<3>& share :
               {Vec<3>(1, 1, 1), Vec<3>(0, 1, 1), Vec<3>(1, 0, 1), Vec<3>(1, 1, 0)}) {
            Vec<3> X = Vec<3>::Zero();
            for (int k = 0; k < 3; ++k) X += share[k] / share.sum() * mesh.position[t[k]];
            worst = std::max(worst, std::abs(X.norm() - 2));
          }
      }
      CHECK(worst < tolerance);
      CHECK(worst > tolerance / 30);
    }
}

TEST_CASE("normals are those of the surface, at collapsed edges their limit") {
  for (const auto& surface : test::ball_with_poles(1)) {
    const Mesh mesh = tessellate(surface, {.distance = 1e-3});
    for (std::size_t k = 0; k < mesh.normal.size(); ++k) {
      const Vec<3> X = point(surface, mesh.uv[k]);
      CHECK((mesh.normal[k] - X).norm() < 1e-9);
    }
  }
}

TEST_CASE("triangles turn about their normals") {
  for (const auto& surface : test::prepared(make_parts(shapes3d::Torus{{0, 0, 0}, 2, 0.5}))) {
    const Mesh mesh = tessellate(surface, {.distance = 1e-3});
    for (const auto& t : mesh.triangles) {
      const Vec<3> a = mesh.position[t[1]] - mesh.position[t[0]],
                   b = mesh.position[t[2]] - mesh.position[t[0]];
      CHECK(a.cross(b).dot(mesh.normal[t[0]]) > 0);
    }
  }
}

TEST_CASE("parts that share an edge leave no crack, however fine each is inside") {
  // A flat, a twisted and a curved patch that meet: a prism with a saddle on top.
  auto parts = make_parts(shapes3d::Cylinder{{0, 0, 0}, 1, 0.4, 2, 3});
  const auto surfaces = test::prepared(parts);
  std::vector<std::array<Vec<3>, 2>> all;
  for (const auto& surface : surfaces)
    for (const auto& edge : open_edges(tessellate(surface, {.distance = 5e-3})))
      all.push_back(edge);
  CHECK(all.size() > 30);
  for (const auto& edge : all)
    for (const Vec<3>& X : {edge[0], Vec<3>((edge[0] + edge[1]) / 2)}) {
      double nearest = 1;
      for (const auto& other : all)
        if (other[0] != edge[0] || other[1] != edge[1])
          nearest = std::min(nearest, distance_to_segment(X, other[0], other[1]));
      CHECK(nearest < 1e-12);
    }
}

TEST_CASE("a flat face is two triangles however its control points are spaced") {
  auto parts = make_parts(shapes3d::Box{});
  shapes3d::elevate(parts, 3);
  auto& face = parts[0].shape.control_points;
  face.col(5) += Vec<3>(0, 0.1, -0.05);  // within the plane x = 0
  CHECK(tessellate(prepare(parts[1].shape), {.distance = 1e-6}).triangles.size() == 2);
  const Mesh mesh = tessellate(prepare(parts[0].shape), {.distance = 1e-3});
  for (const auto& X : mesh.position) CHECK(X[0] == 0);
  CHECK(tessellate(prepare(parts[1].shape), {.distance = 1, .least_cells = 4}).triangles.size() ==
        32);
}

TEST_CASE("isoparametric lines: sides, lines between, no line where an edge is collapsed") {
  const auto ball = test::ball_with_poles(1);
  const Flatness flatness{.distance = 1e-3};
  CHECK(outline(ball[0], flatness).size() == 2);  // two meridians: both other sides are poles
  const auto lines = isoparametric_lines(ball[0], 1, true, flatness);
  CHECK(lines.size() == 3 + 3);  // meridians with one between; 45, 0, -45 degrees
  for (const auto& line : lines)
    for (const auto& X : line) CHECK(X.norm() == doctest::Approx(1));
  CHECK(control_net(ball[0].nurbs).size() == 3 + 5);
}

TEST_CASE("a trimmed surface has triangles and an outline only where its trims leave it") {
  // The square [-1, 1]^2 on a paraboloid, trimmed to a ring.
  auto surface = prepare(test::paraboloid(0.1));
  TrimLoops ring = {test::circle({0.1, 0}, 0.8), test::circle({0.1, 0}, 0.3)};
  surface.region = make_region<3>(surface, ring);
  const Mesh mesh = tessellate(surface, {1e-3});
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const auto u = [&](int k) { return Vec<2>(mesh.uv[t[k]]); };
    const double twice = DimTraits<2>::cross(u(1) - u(0), u(2) - u(0))[0];
    CHECK(twice >= 0);  // as du x dv
    area += twice / 2;
    for (int k = 0; k < 3; ++k) {
      const double r = (u(k) - Vec<2>(0.1, 0)).norm();
      CHECK(r < 0.8 + 1e-6);
      CHECK(r > 0.3 - 1e-6);
    }
  }
  CHECK(area == doctest::Approx(M_PI * (0.64 - 0.09)).epsilon(2e-3));
  double length = 0;
  for (const auto& chain : outline(surface, {1e-3})) {
    REQUIRE(chain.size() == 2);
    length += (chain[1] - chain[0]).head<2>().norm();
  }
  CHECK(length == doctest::Approx(2 * M_PI * 1.1).epsilon(5e-3));
}
