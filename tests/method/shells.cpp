// Shells in space: what belongs together across gaps, what is open, and what is inside then.
#include <doctest/doctest.h>

#include "sem/method/boundary_integrals.h"
#include "sem/method/rays.h"
#include "solids.h"
#include "trimmed.h"

using namespace sem;
using test::Parts;

namespace {

struct Shells {
  Boundary<3> boundary;
  Loops<3> loops;
  explicit Shells(const Parts<3>& parts)
      : boundary(make_boundary<3>({parts})), loops(find_loops(boundary)) {}
  bool has(double x, double y, double z) const { return inside(boundary, loops, Vec<3>(x, y, z)); }
};

// Faces of the box [0, 2] x [0, 1]^2 cut at x = 1, the half beyond moved away by the gap.
Parts<3> halved_box(double gap) {
  Parts<3> parts = test::box<3>({0, 0, 0}, {1, 1, 1}, 1), more = test::box<3>({1, 0, 0}, {2, 1, 1}, 1);
  const auto lies_at = [](const Nurbs<2, 3>& part, double x) {
    return (part.control_points.row(0).array() - x).abs().maxCoeff() < 1e-12;
  };
  std::erase_if(parts, [&](const auto& part) { return lies_at(part, 1); });
  std::erase_if(more, [&](const auto& part) { return lies_at(part, 1); });
  for (auto& part : more) {
    part.control_points.row(0).array() += gap;
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

TEST_CASE("two open halves across a gap are one shell, and the gap is reported") {
  for (const double gap : {1e-6, 2e-3, 0.04}) {
    CAPTURE(gap);
    const Shells body(halved_box(gap));
    REQUIRE(body.loops.loops.size() == 1);
    CHECK(body.loops.loops[0].closed());
    CHECK(body.loops.n_gaps == 8);  // four edges on each side
    CHECK(body.loops.longest_gap == doctest::Approx(gap).epsilon(1e-6));
    for (const int orientation : body.loops.orientation) CHECK(orientation != 0);
    CHECK(boundary_moments(body.boundary, body.loops).volume == doctest::Approx(2 + gap).epsilon(1e-12));
    CHECK(body.has(0.5, 0.5, 0.5));
    CHECK(!body.has(0.5, 0.5, 1.5));
  }
  const Shells whole(halved_box(0));
  CHECK(whole.loops.n_gaps == 0);
  CHECK(whole.loops.longest_gap == 0);
}

TEST_CASE("halves far apart stay two open shells") {
  const Shells body(halved_box(0.5));
  CHECK(body.loops.loops.size() == 2);
  CHECK(body.loops.n_gaps == 0);
  CHECK(body.loops.n_free_borders == 8);
  for (const auto& loop : body.loops.loops) CHECK(!loop.closed());
}

TEST_CASE("an open tube that crosses the rim of another is a shell of its own: their union is inside") {
  // A pot without lid and a tube without ends that leads from its middle through the rim.
  Parts<3> parts = test::box<3>({0, 0, 0}, {2, 2, 1}, 1);
  std::erase_if(parts, [](const auto& part) { return part.control_points.row(2).minCoeff() > 0.5; });
  for (auto tube : test::cylinder({0, 1}, 0.2, 1, 3)) {
    tube.control_points = Eigen::MatrixXd(tube.control_points({2, 1, 0}, Eigen::all));
    tube.control_points.row(2).array() += 0.95;
    parts.push_back(tube);
  }
  const Shells body(parts);
  REQUIRE(body.loops.loops.size() == 2);
  CHECK(!body.loops.loops[0].closed());
  CHECK(!body.loops.loops[1].closed());
  CHECK(body.has(1.5, 1, 0.9));  // in both
  CHECK(body.has(2.4, 1, 0.95));
  CHECK(body.has(0.5, 0.5, 0.3));
  CHECK(!body.has(2.4, 1, 0.5));
}

TEST_CASE("a shell open at one end has its inside but for the mouth, and rays across find it") {
  Parts<3> parts = test::cylinder({0, 0}, 1, 0, 3);
  const Shells tube(parts);
  REQUIRE(tube.loops.loops.size() == 1);
  CHECK(tube.loops.n_free_borders == 8);
  for (const double z : {0.7, 1.5, 2.3}) CHECK(tube.has(0.3, 0.2, z));
  for (const double z : {-0.5, 3.5}) CHECK(!tube.has(0.3, 0.2, z));
  CHECK(!tube.has(1.2, 0, 1.5));
  const auto rays = cast_rays(tube.boundary, tube.loops, {0, 10, RayGrid::midpoint});
  CHECK(rays.n_unpaired == 0);
  for (const int orientation : tube.loops.orientation) CHECK(orientation == tube.loops.orientation[0]);
}

TEST_CASE("a part that closes on itself at a seam, and a pole, have no free edges") {
  // One sheet around: a cylinder's wall with collapsed ends, a double cone.
  Nurbs<2, 3> cone;
  cone.degree = {2, 1};
  cone.knots = {std::vector<double>{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {0, 0, 1, 2, 2}};
  cone.control_points.resize(3, 27);
  cone.weights.resize(27);
  const double around[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 9; ++i) {
      cone.control_points.col(i + 9 * j) = Vec<3>((j == 1) * around[i][0], (j == 1) * around[i][1], j);
      cone.weights[i + 9 * j] = i % 2 ? std::sqrt(0.5) : 1;
    }
  const Shells body({cone});
  CHECK(body.loops.n_free_borders == 0);
  CHECK(body.loops.n_gaps == 0);
  CHECK(body.has(0.2, 0.1, 1));
  CHECK(!body.has(0.9, 0, 0.2));
}
