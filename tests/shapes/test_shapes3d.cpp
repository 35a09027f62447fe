// The 3D shape library.
#include <doctest/doctest.h>

#include <map>
#include <set>

#include "sem/method/boundary_integrals.h"
#include "sem/nurbs/basis.h"
#include "src3d/shapes/box.h"

using namespace sem;
using shapes3d::make_parts;

namespace {

shapes3d::Box sample_box() {
  shapes3d::Box box;
  box.lower << -0.1, 0.3, 1.1;
  box.upper << 0.9, 2.3, 4.4;
  box.n_parts = {2, 1, 3};
  box.degree = 2;
  return box;
}

// Control points of the four edges of a patch, in a direction that does not depend on the patch.
std::vector<std::vector<std::array<double, 3>>> edges(const Nurbs<2, 3>& patch) {
  const int p = patch.degree[0], n = p + 1;
  const int first[4] = {0, p * n, 0, p}, stride[4] = {1, 1, n, n};
  std::vector<std::vector<std::array<double, 3>>> result;
  for (int e = 0; e < 4; ++e) {
    std::vector<std::array<double, 3>> edge;
    for (int k = 0; k < n; ++k) {
      const Vec<3> X = patch.control_points.col(first[e] + k * stride[e]);
      edge.push_back({X[0], X[1], X[2]});
    }
    if (edge.back() < edge.front()) edge = {edge.rbegin(), edge.rend()};
    result.push_back(edge);
  }
  return result;
}

}  // namespace

TEST_CASE("box: every edge belongs to two patches, bit for bit") {
  std::map<std::vector<std::array<double, 3>>, int> uses;
  for (const auto& part : make_parts(sample_box()))
    for (const auto& edge : edges(part.shape)) ++uses[edge];
  for (const auto& [edge, n] : uses) CHECK(n == 2);
}

TEST_CASE("box: faces are named, cut and face outward") {
  const auto box = sample_box();
  const auto parts = make_parts(box);
  REQUIRE(parts.size() == 2 * (3 + 6 + 2));
  std::set<std::string> names;
  for (const auto& part : parts) names.insert(part.name);
  CHECK(names.size() == parts.size());
  for (const char* name : {"left.3", "right.1", "front.6", "back.6", "bottom.2", "top.1"})
    CHECK(names.count(name) == 1);
  const Vec<3> center = (box.lower + box.upper) / 2;
  const std::map<std::string, std::pair<int, double>> planes = {
      {"left", {0, -0.1}}, {"right", {0, 0.9}},  {"front", {1, 0.3}},
      {"back", {1, 2.3}},  {"bottom", {2, 1.1}}, {"top", {2, 4.4}}};
  for (const auto& part : parts) {
    CAPTURE(part.name);
    CHECK_NOTHROW(check(part.shape, "", part.name));
    const auto [axis, plane] = planes.at(part.name.substr(0, part.name.find('.')));
    CHECK((part.shape.control_points.row(axis).array() == plane).all());
    const auto d = derivatives(part.shape, Param<2>(0.5, 0.5));
    CHECK(DimTraits<3>::area_normal(d.first).dot(d.point - center) > 0);
  }
}

TEST_CASE("box: volume and first moment from its boundary") {
  for (int degree : {1, 3}) {
    auto box = sample_box();
    box.degree = degree;
    std::vector<Nurbs<2, 3>> shapes;
    for (const auto& part : make_parts(box)) shapes.push_back(part.shape);
    const Boundary<3> boundary = make_boundary<3>({shapes});
    const Loops<3> loops = find_loops(boundary);
    CHECK(loops.n_gaps == 0);
    const Moments<3> m = boundary_moments(boundary, loops);
    REQUIRE(m.available);
    CHECK(m.volume == doctest::Approx(1.0 * 2.0 * 3.3).epsilon(1e-13));
    CHECK((m.first / m.volume - Vec<3>(0.4, 1.3, 2.75)).norm() < 1e-13);
  }
}
