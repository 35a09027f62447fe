// The 3D shape library against what is known of its shapes.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>

#include "sem/method/boundary_integrals.h"
#include "sem/nurbs/basis.h"
#include "sem/nurbs/closest.h"
#include "src2d/shapes/shapes.h"
#include "src3d/shapes/box.h"
#include "src3d/shapes/solids.h"

using namespace sem;
using namespace sem::shapes3d;

namespace {

// Calls visit(derivatives) on an n x n grid of every part, borders included.
template <class Visit>
void visit_points(const Parts& parts, int n, const Visit& visit) {
  for (const auto& part : parts) {
    CAPTURE(part.name);
    const auto& shape = part.shape;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const auto share = [](const Interval& d, double s) { return s == 1 ? d.upper : d.lower + s * (d.upper - d.lower); };
        const Param<2> u(share(domain(shape, 0), double(i) / n), share(domain(shape, 1), double(j) / n));
        visit(derivatives(shape, u, 1));
      }
  }
}

template <class Shape>
Moments<3> moments(const Shape& parts) {
  std::vector<Nurbs<2, 3>> shapes;
  for (const auto& part : parts) shapes.push_back(part.shape);
  const Boundary<3> boundary = make_boundary<3>({shapes});
  const Loops<3> loops = find_loops(boundary);
  CHECK(loops.n_gaps == 0);
  const Moments<3> m = boundary_moments(boundary, loops);
  CHECK(m.available);
  return m;
}

// Area by a rule of 20 Gauss points a span; exact to rounding only for plane patches.
double area(const Parts& parts) {
  static const double node[] = {0.9739065285171717, 0.8650633666889845, 0.6794095682990244, 0.4333953941292472, 0.1488743389816312};
  static const double weight[] = {0.0666713443086881, 0.1494513491505806, 0.2190863625159820, 0.2692667193099963, 0.2955242247147529};
  double sum = 0;
  for (const auto& part : parts)
    for (const auto& su : spans(part.shape, 0))
      for (const auto& sv : spans(part.shape, 1))
        for (int i = 0; i < 10; ++i)
          for (int j = 0; j < 10; ++j) {
            const auto at = [&](const Interval& s, int k) {
              return (s.lower + s.upper) / 2 + (s.upper - s.lower) / 2 * (k < 5 ? -node[k] : node[9 - k]);
            };
            const auto d = derivatives(part.shape, Param<2>(at(su, i), at(sv, j)), 1);
            sum += DimTraits<3>::area_normal(d.first).norm() * (su.upper - su.lower) * (sv.upper - sv.lower) / 4 *
                   weight[i < 5 ? i : 9 - i] * weight[j < 5 ? j : 9 - j];
          }
  return sum;
}

using Edge = std::vector<std::array<double, 4>>;

// Control points with weights of the four edges of a clamped patch, in a direction that does not depend on the
// patch; edges of no length left out.
std::vector<Edge> edges(const Nurbs<2, 3>& patch) {
  const int nu = n_control(patch, 0), nv = n_control(patch, 1);
  const int first[4] = {0, (nv - 1) * nu, 0, nu - 1}, stride[4] = {1, 1, nu, nu}, n[4] = {nu, nu, nv, nv};
  std::vector<Edge> result;
  for (int e = 0; e < 4; ++e) {
    Edge edge;
    bool has_length = false;
    for (int k = 0; k < n[e]; ++k) {
      const Vec<3> X = patch.control_points.col(first[e] + k * stride[e]);
      edge.push_back({X[0], X[1], X[2], patch.weights[first[e] + k * stride[e]]});
      has_length |= X != Vec<3>(patch.control_points.col(first[e]));
    }
    if (!has_length) continue;
    result.push_back(std::min(edge, Edge(edge.rbegin(), edge.rend())));
  }
  return result;
}

// Every edge belongs to two patches, bit for bit: the solid is closed.
void check_joined(const Parts& parts) {
  std::map<Edge, int> uses;
  for (const auto& part : parts) {
    CHECK_NOTHROW(check(part.shape, "", part.name));
    for (const auto& edge : edges(part.shape)) ++uses[edge];
  }
  int n_single = 0;
  for (const auto& [edge, n] : uses) n_single += n != 2;
  CHECK(n_single == 0);
}

// Normals point away from what the shape's own function calls the inside.
void check_outward(const Parts& parts, const std::function<Vec<3>(const Vec<3>&)>& outward) {
  int n_wrong = 0;
  visit_points(parts, 6, [&](const auto& d) {
    const Vec<3> normal = DimTraits<3>::area_normal(d.first);
    n_wrong += normal.norm() > 1e-9 && !(normal.dot(outward(d.point)) > 0);
  });
  CHECK(n_wrong == 0);
}

shapes3d::Box sample_box() {
  shapes3d::Box box;
  box.lower << -0.1, 0.3, 1.1;
  box.upper << 0.9, 2.3, 4.4;
  box.n_parts = {2, 1, 3};
  return box;
}

Profile rectangle(double x0, double y0, double x1, double y1) {
  shapes2d::Rectangle r;
  r.lower << x0, y0;
  r.upper << x1, y1;
  return shapes2d::make_parts(r);
}

Profile disc(double radius, int n_arcs = 4, double x = 0, double y = 0) {
  shapes2d::Disc d;
  d.center << x, y;
  d.radius = radius;
  d.n_arcs = n_arcs;
  return shapes2d::make_parts(d);
}

constexpr double tight = 1e-14;

}  // namespace

TEST_CASE("box: faces are named, cut, joined bit for bit and face outward") {
  const auto box = sample_box();
  const auto parts = make_parts(box);
  REQUIRE(parts.size() == 2 * (3 + 6 + 2));
  check_joined(parts);
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
    const auto [axis, plane] = planes.at(part.name.substr(0, part.name.find('.')));
    CHECK((part.shape.control_points.row(axis).array() == plane).all());
    const auto d = derivatives(part.shape, Param<2>(0.5, 0.5));
    CHECK(DimTraits<3>::area_normal(d.first).dot(d.point - center) > 0);
  }
}

TEST_CASE("box of raised degree: volume and first moment from its boundary, joined bit for bit") {
  for (int degree : {1, 3}) {
    auto parts = make_parts(sample_box());
    elevate(parts, degree);
    weld(parts);
    check_joined(parts);
    CHECK(parts[0].shape.degree[0] == degree);
    const Moments<3> m = moments(parts);
    CHECK(m.volume == doctest::Approx(1.0 * 2.0 * 3.3).epsilon(1e-13));
    CHECK((m.first / m.volume - Vec<3>(0.4, 1.3, 2.75)).norm() < 1e-13);
  }
}

TEST_CASE("sphere: six patches without poles, every point at the radius, closed, outward, volume and inertia") {
  Sphere sphere;
  sphere.center << 0.3, -0.2, 1;
  sphere.radius = 1.7;
  const Parts parts = make_parts(sphere);
  REQUIRE(parts.size() == 6);
  check_joined(parts);
  double worst = 0, smallest = 1;
  visit_points(parts, 20, [&](const auto& d) {
    worst = std::max(worst, std::abs((d.point - sphere.center).norm() / 1.7 - 1));
    smallest = std::min(smallest, DimTraits<3>::area_normal(d.first).norm());
  });
  CHECK(worst < tight);
  CHECK(smallest > 0.1);
  check_outward(parts, [&](const Vec<3>& X) { return Vec<3>(X - sphere.center); });
  const Moments<3> m = moments(parts);
  const double volume = 4 * M_PI / 3 * std::pow(1.7, 3);
  CHECK(m.volume == doctest::Approx(volume).epsilon(1e-12));
  CHECK((m.first / volume - sphere.center).norm() < 1e-12);
  const Mat<3> inertia = m.second - m.first * m.first.transpose() / volume;
  CHECK((inertia - volume * 1.7 * 1.7 / 5 * Mat<3>::Identity()).norm() < 1e-11);
  CHECK(area(parts) == doctest::Approx(4 * M_PI * 1.7 * 1.7).epsilon(1e-9));
}

TEST_CASE("torus: every point at the tube's radius, closed, outward, volume and area by Pappus, for any number of parts") {
  for (const std::array<int, 2> n : {std::array{4, 1}, std::array{4, 4}, std::array{3, 5}, std::array{1, 2}}) {
    CAPTURE(n[0]);
    CAPTURE(n[1]);
    Torus torus;
    torus.center << 1, 0.5, -0.25;
    torus.radius = 2;
    torus.tube_radius = 0.75;
    torus.n_parts = n;
    const Parts parts = make_parts(torus);
    REQUIRE(int(parts.size()) == n[0] * n[1]);
    if (n[0] > 1 && n[1] > 1) check_joined(parts);
    const auto from_middle = [&](const Vec<3>& X) {
      const Vec<3> Y = X - torus.center;
      return Vec<3>(Y - 2 * Vec<3>(Y[0], Y[1], 0).normalized());
    };
    double worst = 0;
    visit_points(parts, 20, [&](const auto& d) { worst = std::max(worst, std::abs(from_middle(d.point).norm() - 0.75)); });
    CHECK(worst < tight * 2);
    check_outward(parts, from_middle);
    CHECK(moments(parts).volume == doctest::Approx(2 * M_PI * M_PI * 2 * 0.75 * 0.75).epsilon(1e-12));
    CHECK(area(parts) == doctest::Approx(4 * M_PI * M_PI * 2 * 0.75).epsilon(1e-7));
  }
}

TEST_CASE("cylinder and cone frustum: points, closed, outward, volume and area") {
  for (const double top : {1.5, 0.5}) {
    Cylinder cylinder;
    cylinder.radius = 1.5;
    cylinder.top_radius = top;
    cylinder.height = 2;
    cylinder.n_arcs = 5;
    const Parts parts = make_parts(cylinder);
    REQUIRE(parts.size() == 15);
    check_joined(parts);
    double worst = 0;
    visit_points({parts.begin(), parts.begin() + 5}, 20, [&](const auto& d) {
      const double radius = 1.5 + (top - 1.5) * d.point[2] / 2;
      worst = std::max(worst, std::abs(std::hypot(d.point[0], d.point[1]) - radius));
    });
    CHECK(worst < tight);
    check_outward(parts, [](const Vec<3>& X) { return Vec<3>(X - Vec<3>(0, 0, 1)); });
    CHECK(moments(parts).volume == doctest::Approx(M_PI * 2 / 3 * (1.5 * 1.5 + 1.5 * top + top * top)).epsilon(1e-12));
    const double slant = std::hypot(2, 1.5 - top);
    CHECK(area(parts) == doctest::Approx(M_PI * ((1.5 + top) * slant + 1.5 * 1.5 + top * top)).epsilon(1e-9));
  }
}

TEST_CASE("extrusion: plane profile and caps of every kind enclose area times height") {
  Extrusion extrusion;
  extrusion.by << 0.3, 0.1, 2;
  const auto check_solid = [&](const Profile& profile, Caps caps, size_t n_parts, double profile_area) {
    extrusion.profile = profile;
    extrusion.caps = caps;
    const Parts parts = make_parts(extrusion);
    CHECK(parts.size() == n_parts);
    check_joined(parts);
    const Moments<3> m = moments(parts);
    CHECK(m.volume == doctest::Approx(2 * profile_area).epsilon(1e-12));
    return parts;
  };
  const Parts box = check_solid(rectangle(0, 0, 2, 1), Caps::coons, 6, 2);
  CHECK(box[0].name == "bottom");  // of the rectangle
  CHECK(box[5].name == "end");
  check_outward(box, [](const Vec<3>& X) { return Vec<3>(X - Vec<3>(1.15, 0.55, 1)); });
  const Parts rod = check_solid(disc(1), Caps::fan, 12, M_PI);
  check_outward(rod, [](const Vec<3>& X) { return Vec<3>(X - Vec<3>(0.15, 0.05, 1)); });
  check_solid(disc(1), Caps::coons, 6, M_PI);
  shapes2d::Annulus annulus;
  check_solid(shapes2d::make_parts(annulus), Caps::ring, 8 + 8, 3 * M_PI);
}

TEST_CASE("revolution: whole and partial turns, poles on the axis, parts on the axis left out") {
  Revolution ball;  // half a disc: path of a half circle is two arcs of the disc
  const Profile circle = disc(1);
  ball.profile = {circle[3], circle[0]};
  ball.n_parts = 3;
  const Parts parts = make_parts(ball);
  REQUIRE(parts.size() == 6);
  check_joined(parts);
  check_outward(parts, [](const Vec<3>& X) { return X; });
  CHECK(moments(parts).volume == doctest::Approx(4 * M_PI / 3).epsilon(1e-12));

  Revolution pie;  // a rectangle with a side on the axis, 80 degrees
  pie.profile = rectangle(0, 0, 2, 1);
  pie.angle = 80 * M_PI / 180;
  pie.n_parts = 2;
  pie.caps = Caps::coons;
  const Parts piece = make_parts(pie);
  REQUIRE(piece.size() == 3 * 2 + 2);
  CHECK(moments(piece).volume == doctest::Approx(4 * pie.angle / 2).epsilon(1e-12));
  check_outward(piece, [&](const Vec<3>& X) { return Vec<3>(X - Vec<3>(std::cos(pie.angle / 2), std::sin(pie.angle / 2), 0.5)); });

  Revolution ring;  // Pappus
  ring.profile = rectangle(1, -0.5, 2, 0.5);
  const Parts closed = make_parts(ring);
  check_joined(closed);
  CHECK(moments(closed).volume == doctest::Approx(2 * M_PI * 1.5).epsilon(1e-12));
}

TEST_CASE("loft: through its sections exactly; of scaled discs a solid of known volume") {
  // Radii 1, 1.5, 2 at heights 0, 1, 2: a cone frustum, as chords are proportional to heights.
  Loft loft;
  for (int k = 0; k < 3; ++k) {
    Loft::Section section{disc(1), {}};
    section.placement.scale = Vec<3>(1 + 0.5 * k, 1 + 0.5 * k, 1);
    section.placement.move[2] = k;
    loft.sections.push_back(section);
  }
  loft.degree = 2;
  const Parts cone = make_parts(loft);
  REQUIRE(cone.size() == 12);
  check_joined(cone);
  CHECK(moments(cone).volume == doctest::Approx(M_PI * 2 / 3 * (1 + 2 + 4)).epsilon(1e-12));
  check_outward(cone, [](const Vec<3>& X) { return Vec<3>(X - Vec<3>(0, 0, 1)); });

  // A bent, tapering limb; every section lies on it.
  Loft limb;
  for (int k = 0; k < 5; ++k) {
    Loft::Section section{disc(1), {}};
    section.placement.scale = Vec<3>::Constant(1 - 0.15 * k);
    section.placement.axis = Vec<3>(0, 1, 0);
    section.placement.angle = 0.3 * k;
    section.placement.move = Vec<3>(0.4 * k * k, 0, 2 * k);
    limb.sections.push_back(section);
  }
  const Parts parts = make_parts(limb);
  check_joined(parts);
  for (const auto& section : limb.sections) {
    const Curve curve = mapped(in_space(section.profile[1].shape, Vec<3>::Zero(), Vec<3>::UnitX(), Vec<3>::UnitY()),
                               section.placement.linear(), section.placement.move);
    const auto surface = prepare(parts[1].shape);
    for (double u : {0.0, 0.3, 0.7, 1.0})
      CHECK(closest_point(surface, point(curve, Param<1>(u))).distance < 1e-13);
  }
  CHECK(moments(parts).volume > 0);
}

TEST_CASE("ruled: a hyperbolic paraboloid's points and lines") {
  Curve a, b;
  a.degree = b.degree = {1};
  a.knots[0] = b.knots[0] = {0, 0, 1, 1};
  a.control_points.resize(3, 2);
  b.control_points.resize(3, 2);
  a.control_points << 0, 1, 0, 0, 0, 1;
  b.control_points << 0, 1, 1, 1, 1, 0;
  a.weights.setOnes(2);
  b.weights.setOnes(2);
  const Patch patch = ruled(a, b);
  for (double u : {0.0, 0.3, 1.0})
    for (double v : {0.0, 0.6, 1.0})
      CHECK((point(patch, Param<2>(u, v)) - Vec<3>(u, v, (1 - v) * u + v * (1 - u))).norm() < 1e-15);
}

TEST_CASE("curves of different degree and knots are made alike and stay the same curves") {
  const auto raw = [](std::vector<double> knots, int degree, int n, double w) {
    Curve c;
    c.degree = {degree};
    c.knots[0] = std::move(knots);
    c.control_points.resize(3, n);
    for (int i = 0; i < n; ++i) c.control_points.col(i) << i, std::sin(2.0 * i), std::cos(3.0 * i);
    c.weights.setOnes(n);
    c.weights[1] = w;
    return c;
  };
  const std::vector<Curve> before = {raw({0, 0, 1, 1}, 1, 2, 1), raw({0, 0, 0, 1, 3, 3, 3}, 2, 4, 0.5),
                                     raw({1, 1, 1, 1, 2, 2, 2, 2}, 3, 4, 2)};
  const auto after = compatible(before);
  for (size_t k = 0; k < 3; ++k) {
    CHECK(after[k].degree[0] == 3);
    CHECK(after[k].knots[0] == after[0].knots[0]);
    const auto [lower, upper] = domain(before[k], 0);
    for (double s : {0.0, 0.2, 0.5, 0.9, 1.0})
      CHECK((point(after[k], Param<1>(s)) - point(before[k], Param<1>(lower + s * (upper - lower)))).norm() < tight);
  }
}

TEST_CASE("Coons patch: contains its four curves, arcs with weights included") {
  // A quarter of the unit sphere's equator and others like it: four arcs of 90 degrees on the cylinder x^2 + z^2 = 1.
  const Curve lower = in_space(disc(1)[0].shape, Vec<3>::Zero(), Vec<3>::UnitX(), Vec<3>::UnitZ());
  const Curve upper = mapped(lower, Mat<3>::Identity(), Vec<3>(0, 2, 0));
  Curve left;
  left.degree = {2};
  left.knots[0] = {0, 0, 0, 1, 1, 1};
  left.control_points.resize(3, 3);
  left.control_points << 1, 1.4, 1, 0, 1, 2, 0, 0, 0;
  left.weights = Eigen::Vector3d(1, 0.7, 1);
  Curve right = left;
  right.control_points << 0, 0, 0, 0, 1, 2, 1, 1.3, 1;
  const Patch patch = coons(lower, upper, left, right);
  CHECK_NOTHROW(check(patch, "", "patch"));
  for (int k = 0; k <= 10; ++k) {
    const double s = k / 10.0;
    CHECK((point(patch, Param<2>(s, 0)) - point(lower, Param<1>(s))).norm() < tight);
    CHECK((point(patch, Param<2>(s, 1)) - point(upper, Param<1>(s))).norm() < tight);
    CHECK((point(patch, Param<2>(0, s)) - point(left, Param<1>(s))).norm() < tight);
    CHECK((point(patch, Param<2>(1, s)) - point(right, Param<1>(s))).norm() < tight);
  }
}

TEST_CASE("any shape: split, raised and placed it is the same solid, joined bit for bit") {
  Parts parts = make_parts(Torus());
  elevate(parts, 3);
  split(parts, {2, 3});
  Placement placement;
  placement.scale << 1, 2, 0.5;
  placement.axis << 1, 1, 1;
  placement.angle = 0.7;
  placement.move << 3, 2, 1;
  place(parts, placement);
  weld(parts);
  REQUIRE(parts.size() == 16 * 6);
  CHECK(parts[5].name == "torus.1.6");
  check_joined(parts);
  const Moments<3> m = moments(parts);
  CHECK(m.volume == doctest::Approx(4 * M_PI * M_PI).epsilon(1e-11));
  CHECK((m.first / m.volume - Vec<3>(3, 2, 1)).norm() < 1e-11);
  // Turns: quarter turns are exact, the axis stays.
  Placement quarter;
  quarter.angle = M_PI / 2;
  CHECK(Vec<3>(quarter.linear() * Vec<3>(1, 2, 3)) == Vec<3>(-2, 1, 3));
  CHECK((placement.linear() * placement.scale.cwiseInverse().asDiagonal() * placement.axis - placement.axis).norm() < 1e-15);
}
