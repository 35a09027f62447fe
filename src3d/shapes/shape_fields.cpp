#include "src3d/shapes/shape_fields.h"

#include <algorithm>

#include "sem/scene/files.h"
#include "src2d/shapes/shape_fields.h"
#include "src3d/shapes/box.h"
#include "src3d/shapes/solids.h"

namespace sem::shapes3d {
namespace {

constexpr int max_parts = 1000;

void describe_counts(Fields& fields, const char* key, std::array<int, 2>& counts,
                     const char* meaning, const char* both) {
  std::vector<int> values(counts.begin(), counts.end());
  fields.integers(key, values, 1, meaning);
  if (values.size() != 2) fields.reject(key, std::to_string(values.size()) + " counts", both);
  for (int a = 0; a < 2 && fields.reading(); ++a) {
    counts[a] = values[a];
    if (counts[a] > max_parts)
      fields.reject(key, std::to_string(counts[a]), "at most " + std::to_string(max_parts));
  }
}

void describe_caps(Fields& fields, Caps& caps, const Profile& profile) {
  fields.choice(
      "caps", caps, {"none", "fan", "coons", "ring"},
      "extrude, revolve (less than a whole turn), loft: ends; fan: a patch for each part of the "
      "profile, to its "
      "middle; coons: one patch, profiles of four parts; ring: between the halves of an annulus");
  const size_t n = profile.size();
  if (caps == Caps::coons && n != 4)
    fields.reject("caps", "\"coons\" with " + std::to_string(n) + " parts", "a profile of 4 parts");
  if (caps == Caps::ring && n % 2)
    fields.reject("caps", "\"ring\" with " + std::to_string(n) + " parts", "an annulus");
}

void describe_profile(Fields& fields, Profile& profile) {
  fields.require("profile");
  fields.object("profile", "extrude, revolve, loft: a shape of the plane",
                [&](Fields& f) { shapes2d::describe_shape(f, profile); });
}

void describe_placement(Fields& fields, Placement& p) {
  std::vector<double> scale(p.scale.begin(), p.scale.end());
  fields.numbers("scale", scale, 3, positive, "", "factors along x, y and z; applied first");
  for (int a = 0; a < 3; ++a) p.scale[a] = scale[a];
  if (fields.optional("rotate", false)) {
    fields.object("rotate", "applied second", [&](Fields& f) {
      f.vector<3>("axis", p.axis, "", "through 0");
      if (p.axis.isZero(0)) f.reject("axis", "[0, 0, 0]", "a direction");
      f.number("angle", p.angle, any_number, "rad", "anticlockwise seen against the axis");
    });
  }
  fields.vector<3>("move", p.move, "m", "applied last");
}

Parts describe(Fields& fields, Box box) {
  fields.vector<3>("lower", box.lower, "m", "box: lowest corner");
  fields.vector<3>("upper", box.upper, "m", "box: highest corner, more than 'lower' in x, y and z");
  for (int a = 0; a < 3; ++a)
    if (!(box.lower[a] < box.upper[a]))
      fields.reject("upper", exact_text(box.upper[a]) + " for " + DimTraits<3>::axis_name[a],
                    "more than that of 'lower', " + exact_text(box.lower[a]));
  std::vector<int> counts(box.n_parts.begin(), box.n_parts.end());
  fields.integers("parts", counts, 1,
                  "box: equal parts along x, y and z; torus: around the axis, around the tube; "
                  "revolve: around");
  if (counts.size() != 3)
    fields.reject("parts", std::to_string(counts.size()) + " counts", "3, for x, y and z");
  for (int a = 0; a < 3 && fields.reading(); ++a) {
    box.n_parts[a] = counts[a];
    if (counts[a] > max_parts)
      fields.reject("parts", std::to_string(counts[a]), "at most " + std::to_string(max_parts));
  }
  return make_parts(box);
}

Parts describe(Fields& fields, Cylinder cylinder) {
  fields.vector<3>("center", cylinder.center, "m",
                   "cylinder: middle of the bottom; sphere, torus: middle");
  fields.number("radius", cylinder.radius, positive, "m",
                "cylinder: of the bottom; sphere; torus: of the tube's middle");
  cylinder.top_radius = cylinder.radius;
  fields.number("top_radius", cylinder.top_radius, positive, "m",
                "cylinder: of the top; as 'radius' if absent");
  fields.number("height", cylinder.height, positive, "m", "cylinder: along z");
  fields.integer("arcs", cylinder.n_arcs, 3, max_parts, "cylinder: parts around");
  fields.boolean("caps", cylinder.caps, "cylinder: closed at bottom and top");
  return make_parts(cylinder);
}

Parts describe(Fields& fields, Sphere sphere) {
  fields.vector<3>("center", sphere.center, "m", "sphere: middle");
  fields.number("radius", sphere.radius, positive, "m", "sphere: radius");
  return make_parts(sphere);
}

Parts describe(Fields& fields, Torus torus) {
  fields.vector<3>("center", torus.center, "m", "torus: middle; its axis is z");
  fields.number("radius", torus.radius, positive, "m", "torus: of the tube's middle");
  fields.number("tube_radius", torus.tube_radius, positive, "m",
                "torus: of the tube, less than 'radius'");
  if (!(torus.tube_radius < torus.radius))
    fields.reject("tube_radius", exact_text(torus.tube_radius),
                  "less than 'radius', " + exact_text(torus.radius));
  describe_counts(fields, "parts", torus.n_parts, "torus: around the axis, around the tube",
                  "2, around the axis and around the tube");
  return make_parts(torus);
}

Parts describe(Fields& fields, Extrusion extrusion) {
  describe_profile(fields, extrusion.profile);
  fields.vector<3>("by", extrusion.by, "m",
                   "extrude: where the profile is moved to, not along its plane");
  if (extrusion.by[2] == 0) fields.reject("by", "0 along z", "a way out of the profile's plane");
  describe_caps(fields, extrusion.caps, extrusion.profile);
  return fields.reading() ? make_parts(extrusion) : Parts();
}

Parts describe(Fields& fields, Revolution revolution) {
  describe_profile(fields, revolution.profile);
  for (const auto& part : revolution.profile)
    if ((part.shape.control_points.row(0).array() < 0).any())
      fields.reject("profile", "part '" + part.name + "' at x < 0",
                    "x >= 0, the distance from the axis z");
  if (std::all_of(revolution.profile.begin(), revolution.profile.end(),
                  [](const auto& part) { return part.shape.control_points.row(0).isZero(0); }))
    fields.reject("profile", "nothing off the axis", "x > 0 somewhere");
  fields.number("angle", revolution.angle, {0, 2 * M_PI, true, false}, "rad", "revolve: about z");
  fields.integer("parts", revolution.n_parts, 1, max_parts,
                 "revolve: parts around, of each part of the profile");
  describe_caps(fields, revolution.caps, revolution.profile);
  return fields.reading() ? make_parts(revolution) : Parts();
}

Parts describe(Fields& fields, Loft loft) {
  fields.require("sections");
  fields.items<Loft::Section>("sections", loft.sections,
                              "loft: 2 or more profiles of as many parts, in order",
                              [](Fields& f, Loft::Section& section) {
                                describe_profile(f, section.profile);
                                describe_placement(f, section.placement);
                              });
  const size_t n = loft.sections.size();
  if (n < 2) fields.reject("sections", std::to_string(n) + " sections", "at least 2");
  for (const auto& section : loft.sections)
    if (section.profile.size() != loft.sections[0].profile.size())
      fields.reject("sections", std::to_string(section.profile.size()) + " parts in a profile",
                    std::to_string(loft.sections[0].profile.size()) + " as in the first");
  fields.integer("along_degree", loft.degree, 1, 9, "loft: degree from section to section");
  describe_caps(fields, loft.caps, fields.reading() ? loft.sections[0].profile : Profile());
  return fields.reading() ? make_parts(loft) : Parts();
}

Curve describe_curve(Fields& fields) {
  Curve curve;
  fields.require("control_points");
  fields.points<3>("control_points", curve.control_points, "m", "ruled, coons: of a curve");
  const int n = int(curve.control_points.cols());
  curve.degree = {std::clamp(n - 1, 1, 3)};
  fields.integer("degree", curve.degree[0], 1, 9,
                 "ruled, coons: of a curve; 3 if absent and there are points enough");
  const int p = curve.degree[0];
  for (int k = 0; k < n + p + 1; ++k)
    curve.knots[0].push_back(std::clamp(k - p, 0, std::max(0, n - p)));
  if (fields.optional("knots", false))
    fields.numbers("knots", curve.knots[0], 0, any_number, "",
                   "ruled, coons: of a curve; clamped and uniform if absent");
  std::vector<double> weights(n, 1.0);
  if (fields.optional("weights", false))
    fields.numbers("weights", weights, fields.reading() ? std::max(1, n) : 0, positive, "",
                   "ruled, coons: of a curve; 1 if absent");
  curve.weights = Eigen::Map<const Eigen::VectorXd>(weights.data(), Eigen::Index(weights.size()));
  if (fields.reading()) check(curve, fields.file(), fields.path());
  return curve;
}

std::vector<Curve> describe_curves(Fields& fields, int n, const char* meaning) {
  std::vector<Curve> curves;
  fields.require("curves");
  fields.items<Curve>("curves", curves, meaning,
                      [](Fields& f, Curve& curve) { curve = describe_curve(f); });
  if (int(curves.size()) != n)
    fields.reject("curves", std::to_string(curves.size()) + " curves", std::to_string(n));
  return curves;
}

struct Ruled {};
Parts describe(Fields& fields, Ruled) {
  const auto curves = describe_curves(
      fields, 2, "ruled: two, v = 0 and 1; coons: four, v = 0, v = 1, u = 0, u = 1");
  if (!fields.reading()) return {};
  return {ScenePart<3>{"ruled", ruled(curves[0], curves[1]), {}, {}}};
}

struct Coons {};
Parts describe(Fields& fields, Coons) {
  const auto curves = describe_curves(fields, 4, "coons: four, v = 0, v = 1, u = 0, u = 1");
  if (!fields.reading()) return {};
  std::vector<Curve> ends;
  for (const Curve& curve : curves) ends.push_back(compatible({curve})[0]);
  const auto first = [](const Curve& c) {
    return std::pair<Vec<3>, double>(c.control_points.col(0), c.weights[0]);
  };
  const auto last = [](const Curve& c) {
    return std::pair<Vec<3>, double>(c.control_points.rightCols<1>(),
                                     c.weights[c.weights.size() - 1]);
  };
  const std::pair<Vec<3>, double> pairs[4][2] = {{first(ends[0]), first(ends[2])},
                                                 {last(ends[0]), first(ends[3])},
                                                 {first(ends[1]), last(ends[2])},
                                                 {last(ends[1]), last(ends[3])}};
  const double size =
      (ends[0].control_points.rowwise().maxCoeff() - ends[1].control_points.rowwise().minCoeff())
          .norm();
  for (const auto& [a, b] : pairs)
    if ((a.first - b.first).norm() > 1e-9 * size || std::abs(a.second - b.second) > 1e-9 * a.second)
      fields.reject("curves", "ends that do not meet",
                    "four curves that meet in four corners, with the same weights there");
  return {ScenePart<3>{"coons", coons(ends[0], ends[1], ends[2], ends[3]), {}, {}}};
}

template <class Shape>
Parts described(Fields& fields) {
  return describe(fields, Shape());
}

}  // namespace

void describe_shape(Fields& fields, std::vector<ScenePart<3>>& parts) {
  struct Type {
    const char* name;
    Parts (*describe)(Fields&);
  };
  static const Type types[] = {
      {"box", described<Box>},           {"cylinder", described<Cylinder>},
      {"sphere", described<Sphere>},     {"torus", described<Torus>},
      {"extrude", described<Extrusion>}, {"revolve", described<Revolution>},
      {"loft", described<Loft>},         {"ruled", described<Ruled>},
      {"coons", described<Coons>}};
  std::vector<std::string> names;
  for (const Type& type : types) names.push_back(type.name);
  int chosen = 0;
  fields.require("type");
  fields.option("type", chosen, names, "which shape; fields that name types belong to these");
  Parts made;
  for (int t = 0; t < int(names.size()); ++t)
    if (fields.documenting() || t == chosen) made = types[t].describe(fields);
  int degree = 1;
  fields.integer("degree", degree, 1, 9, "all degrees of the patches are raised to at least this");
  std::array<int, 2> pieces = {1, 1};
  describe_counts(fields, "split", pieces, "cuts every patch along its two parameters",
                  "2, along u and v");
  Placement placement;
  describe_placement(fields, placement);
  if (!fields.reading()) return;
  elevate(made, degree);
  split(made, pieces);
  place(made, placement);
  weld(made);
  for (auto& part : made) {
    check(part.shape, fields.file(), fields.path() + " part '" + part.name + "'");
    parts.push_back(std::move(part));
  }
}

}  // namespace sem::shapes3d
