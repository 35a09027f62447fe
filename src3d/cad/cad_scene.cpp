#include "src3d/cad/cad_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>

#include "sem/base/error.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/loops.h"
#include "sem/method/rays.h"
#include "sem/nurbs/closest.h"
#include "sem/scene/files.h"
#include "src3d/cad/cad.h"

namespace sem {
namespace {

constexpr const char* sides[] = {"left", "right", "front", "back", "bottom", "top"};

struct NamedMaterial {
  const char* name;
  Material material;
};
const NamedMaterial materials[] = {{"rubber", {MaterialModel::neo_ref, 1e6, 0.45, 1000}},
                                   {"jelly", {MaterialModel::neo_ref, 5e3, 0.45, 1000}},
                                   {"steel", {MaterialModel::neo_ref, 2e11, 0.3, 7800}}};

const NamedMaterial& material_named(const std::string& name) {
  for (const auto& known : materials)
    if (name == known.name) return known;
  throw InputError("", "--material", "'" + name + "'", "rubber, jelly or steel");
}

std::string rounded(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string vector_text(const Vec<3>& X) {
  return "[" + exact_text(X[0]) + ", " + exact_text(X[1]) + ", " + exact_text(X[2]) + "]";
}

// As a string of JSON.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

// True if three of the points make a triangle of some size.
bool spans_plane(const std::vector<Vec<3>>& points, double size) {
  if (points.empty()) return false;
  const auto farthest =
      *std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
        return (a - points[0]).norm() < (b - points[0]).norm();
      });
  const Vec<3> along = farthest - points[0];
  return std::any_of(points.begin(), points.end(), [&](const Vec<3>& X) {
    return along.cross(X - points[0]).norm() > 1e-3 * size * along.norm();
  });
}

class SceneOfCad {
 public:
  SceneOfCad(const std::string& file, const BareScene& options)
      : file_(file), options_(options), model_(read_cad(file, false)) {
    if (!(options.scale > 0) || !std::isfinite(options.scale))
      throw InputError("", "--scale", exact_text(options.scale), "a number > 0");
    std::vector<std::vector<Nurbs<2, 3>>> solids(model_.n_solids);
    std::vector<TrimLoops> trims;
    for (auto& part : model_.parts) part.shape.control_points *= options.scale;
    std::stable_sort(model_.parts.begin(), model_.parts.end(),
                     [](const auto& a, const auto& b) { return a.solid < b.solid; });
    for (const auto& part : model_.parts) {
      solids[part.solid].push_back(part.shape);
      trims.push_back(part.trims);
    }
    boundary_ = make_boundary<3>(solids, trims);
    loops_ = find_loops(boundary_);
  }

  std::string text(const std::string& path) const {
    const NamedMaterial& named = material_named(options_.material);
    const auto pin = pinned_box();
    std::ostringstream out;
    write_head(out, named, pin);
    out << "{\n  \"name\": " << quoted(std::filesystem::path(file_).stem().string())
        << ",\n  \"description\": "
        << quoted("made of " + std::filesystem::path(file_).filename().string())
        << ",\n  \"dimension\": 3,\n\n  \"solids\": [\n";
    for (int s = 0; s < model_.n_solids; ++s)
      write_solid(out, s, path, named.material, s + 1 < model_.n_solids ? "," : "");
    out << "  ],\n\n";
    write_method(out);
    out << "  \"gravity\": [0, 0, -9.81],\n\n  \"pins\": [";
    if (pin)
      out << "{ \"box\": { \"lower\": " << vector_text(pin->lower)
          << ", \"upper\": " << vector_text(pin->upper) << " } }";
    out << "],\n\n  \"analysis\": { \"type\": \"dynamic\", \"time_step\": 0.01, \"duration\": 1 "
           "},\n\n"
        << "  \"output\": { \"error_estimate\": false }\n}\n";
    return out.str();
  }

 private:
  void write_head(std::ostream& out, const NamedMaterial& material,
                  const std::optional<Box<3>>& pin) const {
    const Vec<3> size = boundary_.box.upper - boundary_.box.lower;
    out << "// " << std::filesystem::path(file_).filename().string() << " (" << model_.unit
        << "): " << model_.n_solids << (model_.n_solids == 1 ? " solid, " : " solids, ")
        << model_.parts.size() << " parts, " << rounded(size[0]) << " x " << rounded(size[1])
        << " x " << rounded(size[2]) << " m.\n// Of " << material.name
        << " (E = " << rounded(material.material.youngs_modulus) << " Pa), ";
    if (pin)
      out << "held: --pin " << options_.pin << ", " << n_held(*pin) << " control points in ["
          << text_of(pin->lower.cwiseMax(boundary_.box.lower)) << "] to ["
          << text_of(pin->upper.cwiseMin(boundary_.box.upper)) << "] m.\n";
    else
      out << "held nowhere.\n";
    for (const auto& note : model_.notes) out << "// Mended: " << note << ".\n";
  }

  static std::string text_of(const Vec<3>& X) {
    return rounded(X[0]) + ", " + rounded(X[1]) + ", " + rounded(X[2]);
  }

  void write_solid(std::ostream& out, int s, const std::string& path, const Material& m,
                   const char* comma) const {
    out << "    {\n      \"name\": \"solid." << s + 1
        << "\",\n      \"material\": { \"model\": \"neo_ref\", "
        << "\"youngs_modulus\": " << exact_text(m.youngs_modulus)
        << ", \"poisson_ratio\": " << exact_text(m.poisson_ratio)
        << ", \"density\": " << exact_text(m.density) << " },\n"
        << "      \"shape\": { \"type\": \"file\", \"path\": " << quoted(path);
    if (model_.n_solids > 1) out << ", \"solid\": " << s + 1;
    if (options_.scale != 1)
      out << ", \"scale\": " << vector_text(Vec<3>::Constant(options_.scale));
    out << " }\n    }" << comma << "\n";
  }

  // An exact rule where the boundary tells its volume, with waves enough for the weights; else rays along x, some through every part.
  std::string quadrature() const {
    constexpr int most_parts = 100;  // exact rules of more take minutes
    if (boundary_.n_parts() <= most_parts && boundary_moments(boundary_, loops_).available)
      return "{ \"method\": \"exact\", \"tolerance\": 0.001, \"waves\": 6 }";
    std::ostringstream out;
    const double size = part_size();
    const double across = (boundary_.box.upper - boundary_.box.lower).tail<2>().maxCoeff();
    const int rays = int(std::clamp(std::ceil(3 * across / size), 16.0, 40.0));
    const double spacing = std::max(size / 3, boundary_.box.diagonal() / 300);
    out << "{ \"method\": \"rays\", \"axis\": \"x\", \"grid\": \"gauss\", \"rule\": \"gauss\", \"rays\": " << rays
        << ", \"spacing\": " << rounded(spacing) << " }";
    return out.str();
  }

  void write_method(std::ostream& out) const {
    out << "  \"method\": {\n    \"formulation\": \"condensed\",\n    \"degree\": 2,\n    "
           "\"own_pressure\": \"never\", // which couples all parts with each other\n"
        << "    \"quadrature\": " << quadrature() << ",\n    \"weights\": { \"cutoff\": " << rounded(1.5 * depth())
        << " } // covers the inside\n  },\n\n";
  }

  // Width of the parts' boxes, the second of their three extents, that nine in ten have at least,
  // m.
  double part_size() const {
    std::vector<double> widths;
    for (const auto& part : boundary_.parts) {
      Vec<3> extent = part.box.upper - part.box.lower;
      std::sort(extent.begin(), extent.end());
      widths.push_back(extent[1]);
    }
    std::sort(widths.begin(), widths.end());
    return std::max(widths[widths.size() / 10], 1e-3 * boundary_.box.diagonal());
  }

  // How far inside points on some rays lie from the closest part at most, m.
  double depth() const {
    double depth = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const auto& ray : cast_rays(boundary_, loops_, {axis, 7, RayGrid::midpoint}).rays)
        for (const auto& interval : ray.intervals)
          for (const double s : {0.2, 0.5, 0.8}) {
            Vec<3> X = ray.origin;
            X[axis] = interval.begin + s * (interval.end - interval.begin);
            double least = std::numeric_limits<double>::infinity();
            for (const auto& part : boundary_.parts)
              least = std::min(least, closest_point(part, X, least).distance);
            depth = std::max(depth, least);
          }
    return depth > 0 ? depth : boundary_.box.diagonal() / 6;
  }

  // What the option asks for; none: nothing is held.
  std::optional<Box<3>> pinned_box() const {
    if (options_.pin == "none") return {};
    const auto side = std::find(std::begin(sides), std::end(sides), options_.pin);
    return side != std::end(sides) ? slab(int(side - std::begin(sides))) : given_box();
  }

  Box<3> given_box() const {
    const std::string allowed =
        "left, right, front, back, bottom, top, none, or a box x0,y0,z0,x1,y1,z1 in m";
    std::istringstream in(options_.pin);
    std::vector<double> values;
    std::string word;
    while (std::getline(in, word, ',')) {
      char* end = nullptr;
      values.push_back(std::strtod(word.c_str(), &end));
      if (word.empty() || *end != '\0' || !std::isfinite(values.back()))
        throw InputError("", "--pin", "'" + options_.pin + "'", allowed);
    }
    if (values.size() != 6) throw InputError("", "--pin", "'" + options_.pin + "'", allowed);
    const Box<3> box{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
    if ((box.lower.array() > box.upper.array()).any())
      throw InputError("", "--pin", "'" + options_.pin + "'",
                       "a box whose first corner is the lower one");
    if (n_held(box) == 0)
      throw InputError("", "--pin", "a box without control points",
                       "one that meets [" + text_of(boundary_.box.lower) + "] to [" +
                           text_of(boundary_.box.upper) + "] m");
    return box;
  }

  Box<3> slab(int side) const {
    const int axis = side / 2;
    const double size = boundary_.box.diagonal();
    Box<3> box;
    for (const double share : {0.01, 0.05, 0.1, 0.2, 0.4}) {
      // Beyond the box: control points of trimmed parts may lie there.
      box = {boundary_.box.lower - Vec<3>::Constant(size),
             boundary_.box.upper + Vec<3>::Constant(size)};
      const double thickness = share * (boundary_.box.upper - boundary_.box.lower)[axis];
      if (side % 2 == 0)
        box.upper[axis] = boundary_.box.lower[axis] + thickness;
      else
        box.lower[axis] = boundary_.box.upper[axis] - thickness;
      if (spans_plane(held(box), size)) break;
    }
    return box;
  }

  std::vector<Vec<3>> held(const Box<3>& box) const {
    std::vector<Vec<3>> points;
    const Points<3> p = rest_controls(boundary_);
    for (int c = 0; c < p.cols(); ++c)
      if ((p.col(c).array() >= box.lower.array()).all() &&
          (p.col(c).array() <= box.upper.array()).all())
        points.push_back(p.col(c));
    return points;
  }
  size_t n_held(const Box<3>& box) const { return held(box).size(); }

  std::string file_;
  BareScene options_;
  CadModel model_;
  Boundary<3> boundary_;
  Loops<3> loops_;
};

}  // namespace

std::string cad_scene(const std::string& file, const std::string& path, const BareScene& options) {
  return SceneOfCad(file, options).text(path);
}

}  // namespace sem
