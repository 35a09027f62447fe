// Structure of the projection in 3D: a torus of four parts with two origins.
#include <cmath>

#include "figures/projection_pattern.h"
#include "figures/solid_view.h"
#include "src3d/shapes/solids.h"

namespace sem::figures {
namespace {

Discretization<3> torus() {
  std::vector<Nurbs<2, 3>> parts;
  for (const auto& part : make_parts(shapes3d::Torus{{0, 0, 0}, 1, 0.45, {2, 2}}))
    parts.push_back(part.shape);
  MethodOptions options;
  options.rays = {2, 16};
  options.interval.points = 6;
  options.weights.cutoff = 0.5;
  options.projection.degree = 2;
  return discretize<3>({parts}, options);
}

Data compute() {
  const auto body = torus();
  std::vector<Nurbs<2, 3>> parts;
  for (const auto& prepared : body.boundary.parts) parts.push_back(prepared.nurbs);
  Data data;
  add_surfaces(data, parts);
  add_projection_size(data, body);
  add_projection(data, "entries", body.projection);
  auto& origin_of = data.add("origin_of_part", {"part", "origin"});
  for (int i = 0; i < body.boundary.n_parts(); ++i)
    origin_of.add({double(i), double(body.origins.of_part[i])});
  auto& origins = data.add("origins", {"x", "y", "z"});
  for (Eigen::Index k = 0; k < body.origins.position.cols(); ++k)
    origins.add(
        {body.origins.position(0, k), body.origins.position(1, k), body.origins.position(2, k)});
  return data;
}

Color origin_color(int origin) { return colors::okabe_ito[origin == 0 ? 2 : 3]; }

render::RenderScene scene_of(const Data& data, double point) {
  const auto parts = surfaces_of(data);
  const DataTable &origin_of = data["origin_of_part"], &origins = data["origins"];
  render::RenderScene scene;
  scene.meshes = meshes_of(parts, [&](int i) {
    return colors::mix(origin_color(int(origin_of["origin"][i])), colors::white, i < 2 ? 0.2 : 0.5)
        .with_alpha(0.55);
  });
  scene.lines.push_back(lines_of(parts, 0, {0.12, 0.12, 0.15}, 0.9 * point));
  auto fine = lines_of(parts, 3, Color{0.12, 0.12, 0.15}.with_alpha(0.3), 0.35 * point);
  scene.lines.push_back(std::move(fine));
  for (int k = 0; k < origins.n_rows(); ++k)
    scene.spheres.push_back(
        {Vec<3>(origins["x"][k], origins["y"][k], origins["z"][k]), 0.075, origin_color(k)});
  scene.ground = -0.5;
  return scene;
}

// Where the parts' names stand, as shares of their parameters: on what is seen of each.
constexpr double places[4][2] = {{0.62, 0.35}, {0.62, 0.35}, {0.62, 0.12}, {0.62, 0.8}};

Vec<3> place_of_name(const Nurbs<2, 3>& part, const double (&share)[2]) {
  const Interval u = domain(part, 0), v = domain(part, 1);
  return sem::point(prepare(part), Param<2>(u.lower + share[0] * (u.upper - u.lower),
                                            v.lower + share[1] * (v.upper - v.lower)));
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.column_shares = {1.15, 1};
  const auto parts = surfaces_of(data);
  SolidView view{[data](double point) { return scene_of(data, point); },
                 framed(parts),
                 {.from = {-0.25, -1, 0.8}}};
  for (std::size_t i = 0; i < parts.size(); ++i)
    view.labels.push_back({place_of_name(parts[i], places[i % 4]), std::to_string(i + 1)});
  draw_view(plot.panel(0, 0), view);
  Panel& matrix = plot.panel(0, 1);
  draw_projection(matrix, data, "entries");
  matrix.legend = LegendPlace::below;
}

}  // namespace

Figure torus_origins() {
  return {"torus_origins",
          "A torus of four parts with two origins (balls), the centroids of the front and of the "
          "back half, shared by the parts of one colour; the polynomials of a part depend on the "
          "control points of the parts at its origin, in degree 2 on its own",
          7,
          3.1,
          compute,
          draw};
}

}  // namespace sem::figures
