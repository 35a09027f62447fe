#include "src3d/shapes/solids.h"

#include <cassert>
#include <cmath>

#include "sem/nurbs/refine.h"

namespace sem::shapes3d {
namespace {

std::string numbered(const std::string& name, int number, int n) {
  return n > 1 ? name + '.' + std::to_string(number) : name;
}

Vec<3> mean_of_controls(const std::vector<Curve>& curves) {
  Vec<3> sum = Vec<3>::Zero();
  int n = 0;
  for (const Curve& curve : curves) {
    sum += curve.control_points.rowwise().sum();
    n += int(curve.control_points.cols());
  }
  return sum / n;
}

// Closes a loop of curves; the normal points to where the curves run anticlockwise (as_is) or the
// other way.
void append_caps(const std::string& name, const std::vector<Curve>& curves, Caps caps, bool as_is,
                 Parts& parts) {
  std::vector<Patch> patches;
  const int n = int(curves.size());
  if (caps == Caps::fan) {
    const Vec<3> middle = mean_of_controls(curves);
    for (const Curve& curve : curves) patches.push_back(fan(curve, middle));
  } else if (caps == Caps::coons) {
    assert(n == 4);
    patches.push_back(coons(curves[0], reversed(curves[2], 0), reversed(curves[3], 0), curves[1]));
  } else if (caps == Caps::ring) {
    assert(n % 2 == 0);
    for (int k = 0; k < n / 2; ++k) patches.push_back(ruled(curves[n / 2 + k], curves[k]));
  }
  const int n_patches = int(patches.size());
  for (int k = 0; k < n_patches; ++k)
    parts.push_back(
        {numbered(name, k + 1, n_patches), as_is ? patches[k] : reversed(patches[k], 0), {}});
}

// The plane profile (x, y, 0) or, in the half plane of an angle about z, (x cos, x sin, y).
std::vector<Curve> placed(const Profile& profile, const Vec<3>& origin, const Vec<3>& e1,
                          const Vec<3>& e2) {
  std::vector<Curve> curves;
  for (const auto& part : profile) curves.push_back(in_space(part.shape, origin, e1, e2));
  return curves;
}

bool on_axis(const Nurbs<1, 2>& curve) { return curve.control_points.row(0).isZero(0); }

// Product of two biquadratic Bezier polynomials as a biquartic one; coefficients 3 x 3, 5 x 5.
Eigen::Matrix<double, 5, 5> product(const Mat<3>& a, const Mat<3>& b) {
  const double two[] = {1, 2, 1}, four[] = {1, 4, 6, 4, 1};
  Eigen::Matrix<double, 5, 5> c = Eigen::Matrix<double, 5, 5>::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          c(i + k, j + l) +=
              two[i] * two[j] * two[k] * two[l] / (four[i + k] * four[j + l]) * a(i, j) * b(k, l);
  return c;
}

// The top face: (X, Y, W) bounds the stereographic image, from -z, of the cube's face by arcs of 30
// degrees.
Patch sphere_top() {
  const double corner = (std::sqrt(3.0) - 1) / 2, edge = 2 * std::sqrt(3.0) - 3;
  const double weight = (std::sqrt(6.0) + std::sqrt(2.0)) / 4;  // cos 15
  Mat<3> X, W;                                                  // row: u, column: v
  X << -corner, -weight * edge, -corner, 0, 0, 0, corner, weight * edge, corner;
  W << 1, weight, 1, weight, 2 * weight - 1, weight, 1, weight, 1;
  const Mat<3> Y = X.transpose();
  const Eigen::Matrix<double, 5, 5> XX = product(X, X), YY = product(Y, Y), WW = product(W, W);
  const Eigen::Matrix<double, 5, 5> x = 2 * product(X, W), y = 2 * product(Y, W), z = WW - XX - YY,
                                    w = WW + XX + YY;
  Patch patch;
  patch.degree = {4, 4};
  patch.knots.fill({0, 0, 0, 0, 0, 1, 1, 1, 1, 1});
  patch.control_points.resize(3, 25);
  patch.weights.resize(25);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) {
      patch.control_points.col(i + 5 * j) << x(i, j) / w(i, j), y(i, j) / w(i, j),
          z(i, j) / w(i, j);
      patch.weights[i + 5 * j] = w(i, j);
    }
  return patch;
}

}  // namespace

Parts make_parts(const Cylinder& cylinder) {
  Nurbs<1, 2> side;
  side.degree = {1};
  side.knots[0] = {0, 0, 1, 1};
  side.control_points.resize(2, 2);
  side.control_points << cylinder.radius, cylinder.top_radius, 0, cylinder.height;
  side.weights.setOnes(2);
  Nurbs<1, 2> bottom = side, top = side;
  bottom.control_points << 0, cylinder.radius, 0, 0;
  top.control_points << cylinder.top_radius, 0, cylinder.height, cylinder.height;
  Revolution revolution{{{"side", side, {}}}, 2 * M_PI, cylinder.n_arcs, Caps::none};
  if (cylinder.caps) {
    revolution.profile.push_back({"bottom", bottom, {}});
    revolution.profile.push_back({"top", top, {}});
  }
  Parts parts = make_parts(revolution);
  Placement placement;
  placement.move = cylinder.center;
  place(parts, placement);
  return parts;
}

Parts make_parts(const Sphere& sphere) {
  // Images of (x, y, z) under turns of the cube: new coordinate a is sign[a] times old coordinate
  // axis[a].
  struct Face {
    const char* name;
    int axis[3];
    double sign[3];
  };
  static const Face faces[] = {{"left", {2, 0, 1}, {-1, -1, 1}},   {"right", {2, 0, 1}, {1, 1, 1}},
                               {"front", {1, 2, 0}, {-1, -1, 1}},  {"back", {1, 2, 0}, {1, 1, 1}},
                               {"bottom", {0, 1, 2}, {1, -1, -1}}, {"top", {0, 1, 2}, {1, 1, 1}}};
  const Patch top = sphere_top();
  Parts parts;
  for (const Face& face : faces) {
    Patch patch = top;
    for (int a = 0; a < 3; ++a)
      patch.control_points.row(a) = face.sign[a] * top.control_points.row(face.axis[a]);
    patch.control_points =
        ((sphere.radius * patch.control_points).colwise() + sphere.center).eval();
    parts.push_back({face.name, std::move(patch), {}});
  }
  weld(parts);
  return parts;
}

Parts make_parts(const Torus& torus) {
  // The tube's circle is a revolution of its own: arcs about z, turned up into the plane of x and
  // z.
  Curve start;  // the point at +x as a curve of no length
  start.degree = {1};
  start.knots[0] = {0, 0, 1, 1};
  start.control_points = Vec<3>(torus.tube_radius, 0, 0).replicate(1, 2);
  start.weights.setOnes(2);
  const auto [n_around, n_tube] = torus.n_parts;
  Revolution revolution{{}, 2 * M_PI, n_around, Caps::none};
  for (int k = 0; k < n_tube; ++k) {
    const Patch arc = revolved(start, 2 * M_PI * k / n_tube, 2 * M_PI * (k + 1) / n_tube);
    const int n = n_control(arc, 0);
    Nurbs<1, 2> part;
    part.degree = {arc.degree[0]};
    part.knots = {arc.knots[0]};
    part.control_points = arc.control_points.topLeftCorner(2, n);
    part.control_points.row(0).array() += torus.radius;
    part.weights = arc.weights.head(n);
    revolution.profile.push_back({"torus", part, {}});
  }
  Parts parts = make_parts(revolution);
  for (size_t k = 0; k < parts.size(); ++k) parts[k].name = "torus." + std::to_string(k + 1);
  Placement placement;
  placement.move = torus.center;
  place(parts, placement);
  return parts;
}

Parts make_parts(const Extrusion& extrusion) {
  const auto curves = placed(extrusion.profile, Vec<3>::Zero(), Vec<3>::UnitX(), Vec<3>::UnitY());
  Parts parts;
  std::vector<Curve> top;
  for (size_t k = 0; k < curves.size(); ++k) {
    parts.push_back({extrusion.profile[k].name, extruded(curves[k], extrusion.by), {}});
    top.push_back(mapped(curves[k], Mat<3>::Identity(), extrusion.by));
  }
  append_caps("start", curves, extrusion.caps, false, parts);
  append_caps("end", top, extrusion.caps, true, parts);
  weld(parts);
  return parts;
}

Parts make_parts(const Revolution& revolution) {
  const auto curves = placed(revolution.profile, Vec<3>::Zero(), Vec<3>::UnitX(), Vec<3>::UnitZ());
  const int n = revolution.n_parts;
  Parts parts;
  for (size_t k = 0; k < curves.size(); ++k) {
    if (on_axis(revolution.profile[k].shape)) continue;
    for (int i = 0; i < n; ++i)
      parts.push_back(
          {numbered(revolution.profile[k].name, i + 1, n),
           revolved(curves[k], revolution.angle * i / n, revolution.angle * (i + 1) / n),
           {}});
  }
  if (revolution.caps != Caps::none) {
    const Vec<2> e = direction(revolution.angle);
    append_caps("start", curves, revolution.caps, true, parts);
    append_caps("end", placed(revolution.profile, Vec<3>::Zero(), {e[0], e[1], 0}, Vec<3>::UnitZ()),
                revolution.caps, false, parts);
  }
  weld(parts);
  return parts;
}

Parts make_parts(const Loft& loft) {
  std::vector<std::vector<Curve>> sections;
  for (const auto& section : loft.sections) {
    sections.push_back(placed(section.profile, Vec<3>::Zero(), Vec<3>::UnitX(), Vec<3>::UnitY()));
    for (Curve& curve : sections.back())
      curve = mapped(curve, section.placement.linear(), section.placement.move);
  }
  Parts parts;
  const std::vector<Patch> sides = lofted(sections, loft.degree);
  for (size_t k = 0; k < sides.size(); ++k)
    parts.push_back({loft.sections[0].profile[k].name, sides[k], {}});
  append_caps("start", sections.front(), loft.caps, false, parts);
  append_caps("end", sections.back(), loft.caps, true, parts);
  weld(parts);
  return parts;
}

}  // namespace sem::shapes3d
