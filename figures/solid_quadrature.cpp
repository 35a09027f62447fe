// Raycast quadrature in a solid, and how its error falls: the paper's uniform rule, Gauss points on
// the same rays, and the exact rules.
#include <cmath>

#include "figures/interior.h"
#include "figures/solid_view.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/exact_rule.h"
#include "sem/method/moment_rules.h"
#include "src3d/shapes/solids.h"

namespace sem::figures {
namespace {

constexpr int shown_rays = 13, degree = 6, n_rules = 3;
const char* const bodies[] = {"ball", "torus"};
const char* const rules[] = {"midpoints on uniform rays", "Gauss points on Gauss rays",
                             "split rays and fans, 1e-2 to 1e-8"};
const Color shell_color{0.55, 0.68, 0.85, 0.16};

std::vector<Nurbs<2, 3>> body_parts(int body) {
  std::vector<Nurbs<2, 3>> parts;
  for (const auto& part : body == 0 ? make_parts(shapes3d::Sphere{})
                                    : make_parts(shapes3d::Torus{{0, 0, 0}, 1, 0.45, {4, 2}}))
    parts.push_back(part.shape);
  return parts;
}

// Midpoints: half as many in each interval as there are rays along a side; Gauss: 8.
Quadrature<3> rule_on(const Rays<3>& rays, int n, bool by_gauss) {
  return quadrature_on_rays(
      rays, {by_gauss ? IntervalRule::gauss : IntervalRule::midpoint, by_gauss ? 8 : (n + 1) / 2});
}

void add_shown(Data& data, const Boundary<3>& boundary, const Loops<3>& loops) {
  const auto rays = cast_rays(boundary, loops, {.axis = 2, .n_rays = shown_rays});
  const auto quadrature = quadrature_on_rays(rays, {.spacing = 0.15});
  auto& lines = data.add("rays", {"x", "y", "z_begin", "z_end", "n_hits"});
  const double reach = 0.12;
  for (const auto& ray : rays.rays)
    lines.add({ray.origin[0], ray.origin[1], boundary.box.lower[2] - reach,
               boundary.box.upper[2] + reach, double(ray.hits.size())});
  auto& intervals = data.add("intervals", {"x", "y", "z_begin", "z_end"});
  for (const auto& ray : rays.rays)
    for (const auto& inside : ray.intervals)
      intervals.add({ray.origin[0], ray.origin[1], inside.begin, inside.end});
  auto& points = data.add("points", {"x", "y", "z", "weight"});
  for (int k = 0; k < quadrature.size(); ++k)
    points.add({quadrature.position(0, k), quadrature.position(1, k), quadrature.position(2, k),
                quadrature.weight[k]});
}

Data compute() {
  Data data;
  add_surfaces(data, body_parts(1));
  auto& errors = data.add("errors", {"body", "rule", "rays_a_side", "points",
                                     "relative_error_of_volume", "relative_error_of_moments"});
  for (int body = 0; body < 2; ++body) {
    const auto boundary = make_boundary<3>({body_parts(body)});
    const auto loops = find_loops(boundary);
    const double size = (boundary.box.upper - boundary.box.lower).maxCoeff();
    const Vec<3> center = (boundary.box.lower + boundary.box.upper) / 2;
    const auto truth = boundary_moments_to_degree(boundary, loops, degree, center, size).value();
    const auto add = [&](int rule, int n, const Quadrature<3>& quadrature) {
      errors.add({double(body), double(rule), double(n), double(quadrature.size()),
                  std::abs(quadrature.weight.sum() / truth[0] - 1),
                  moment_error(quadrature, degree, center, size, truth)});
    };
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8})
      add(2, 0, exact_rule(boundary, loops, {InteriorRule::exact, tolerance}).quadrature);
    for (const bool by_gauss : {false, true})
      for (int k = 4; k <= 12; ++k) {
        const int n = int(std::lround(std::pow(2, k / 2.0)));
        const auto rays =
            cast_rays(boundary, loops, {2, n, by_gauss ? RayGrid::gauss : RayGrid::midpoint}, 2);
        add(by_gauss, n, rule_on(rays, n, by_gauss));
      }
  }
  const auto boundary = make_boundary<3>({body_parts(1)});
  add_shown(data, boundary, find_loops(boundary));
  return data;
}

std::vector<render::Lines> ray_lines(const Data& data, double point) {
  std::vector<render::Lines> lines;
  for (const char* name : {"rays", "intervals"}) {
    const bool is_ray = name[0] == 'r';
    const DataTable& table = data[name];
    lines.push_back({{},
                     is_ray ? Color{0.6, 0.6, 0.62, 0.45} : Color{0.25, 0.25, 0.3},
                     (is_ray ? 0.3 : 0.55) * point});
    for (int r = 0; r < table.n_rows(); ++r) {
      const double x = table["x"][r], y = table["y"][r];
      if (is_ray && table["n_hits"][r] == 0) continue;
      lines.back().chains.push_back(
          {Vec<3>(x, y, table["z_begin"][r]), Vec<3>(x, y, table["z_end"][r])});
    }
  }
  return lines;
}

render::RenderScene scene_of(const Data& data, const ColorScale& scale, double point) {
  const auto parts = surfaces_of(data);
  const DataTable& points = data["points"];
  render::RenderScene scene;
  scene.meshes = meshes_of(parts, [](int) { return shell_color; });
  scene.lines = ray_lines(data, point);
  scene.lines.push_back(lines_of(parts, 0, Color{0.15, 0.25, 0.45}.with_alpha(0.7), 0.7 * point));
  for (int k = 0; k < points.n_rows(); ++k)
    scene.spheres.push_back({Vec<3>(points["x"][k], points["y"][k], points["z"][k]), 0.026,
                             scale(points["weight"][k])});
  scene.ground = -0.65;
  return scene;
}

void draw_errors(Panel& panel, const Data& data, const std::string& column, const char* label) {
  panel.x = {.label = "number of points", .upper = 2e5, .logarithmic = true};
  panel.y = {.label = label, .logarithmic = true};
  for (int body = 0; body < 2; ++body)
    for (int rule = 0; rule < n_rules; ++rule) {
      const DataTable line = data["errors"].where("body", body).where("rule", rule);
      Series style = series(rule, std::string(bodies[body]) + ", " + rules[rule]);
      style.marker = body == 0 ? MarkerShape::circle : MarkerShape::square;
      style.marker_size = 3;
      style.dash = body == 0 ? std::vector<double>{} : std::vector<double>{3, 2};
      panel.curve(line["points"], line[column], style);
    }
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.column_shares = {1.5, 1};
  plot.shared_legend = true;
  const ColorScale scale = scale_of(data["points"]["weight"]);
  Panel& solid = plot.panel(0, 0, 2, 1);
  draw_view(solid, {[data, scale](double point) { return scene_of(data, scale, point); },
                    framed(surfaces_of(data)),
                    {.from = {-0.3, -1, 0.75}}});
  solid.color_bar(scale, "weight (m³)");
  draw_errors(plot.panel(0, 1), data, "relative_error_of_volume", "error of volume");
  Panel& moments = plot.panel(1, 1);
  draw_errors(moments, data, "relative_error_of_moments", "error of moments");
  moments.slope(-2.0 / 3, 1e3, 1e4, 3e-3);
}

}  // namespace

Figure solid_quadrature() {
  return {"solid_quadrature",
          "Raycast quadrature of a torus: rays along z that hit it, the stretches inside and "
          "their points; relative errors of the volume and, the largest, of all moments to "
          "degree 6 against the boundary's own. With a grid of rays the error falls like a power "
          "of the number of points, whatever stands on the rays: the rays that begin and end to "
          "hit the solid limit it. Rules split where they do need few points",
          7,
          3.6,
          compute,
          draw};
}

}  // namespace sem::figures
