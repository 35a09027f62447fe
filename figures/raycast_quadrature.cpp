// The draft's figure 5: rays, hits, intervals and points of the interior quadrature.
#include <cmath>

#include "figures/blob.h"
#include "sem/nurbs/basis.h"

namespace sem::figures {
namespace {

constexpr int rays_between =
    6;  // strips from the dip's lowest point to the highest point of the blob
constexpr double touching = 1e-6;  // m: crossings as close as that are a ray that touches

// y of the point of the curve between the parameters where dy/du = 0, by bisection.
double extremum(const Nurbs<1, 2>& curve, double u0, double u1) {
  const auto slope = [&](double u) { return derivatives(curve, Param<1>(u), 1).first(1, 0); };
  const bool rises = slope(u0) > 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = (u0 + u1) / 2;
    ((slope(middle) > 0) == rises ? u0 : u1) = middle;
  }
  return sem::point(curve, Param<1>((u0 + u1) / 2))[1];
}

// The grid of rays reaches beyond the body, as in the sketch, so that the outer rays miss it, and
// stands so that one ray touches the dip between the bumps and one the top.
Rays<2> sketched_rays(Discretization<2>& body) {
  const auto& red = body.boundary.parts[0].nurbs;
  const double dip = extremum(red, 1.5, 3.5), top = extremum(red, 4.5, 6.5);
  const double strip = (top - dip) / rays_between;
  Box<2>& box = body.boundary.box;
  const int n_below = int(std::ceil((dip - box.lower[1]) / strip)),
            n_rays = n_below + rays_between + 2;
  box.lower[1] = dip - (n_below + 0.5) * strip;
  box.upper[1] = box.lower[1] + n_rays * strip;
  return cast_rays(body.boundary, body.loops, {.axis = 0, .n_rays = n_rays});
}

// Number of hits at or within rounding of hit h.
bool touches(const Ray<2>& ray, size_t h) {
  if (!ray.hits[h].crosses) return true;
  for (size_t other = 0; other < ray.hits.size(); ++other)
    if (other != h && std::abs(ray.hits[other].t - ray.hits[h].t) < touching) return true;
  return false;
}

Data compute() {
  auto body = builtin_body("blob");
  const Rays<2> rays = sketched_rays(body);
  const auto quadrature = quadrature_on_rays(rays, {.spacing = 0.2});
  Data data;
  add_curves(data, body.boundary);
  const auto& box = body.boundary.box;
  auto& lines = data.add("rays", {"y", "x_begin", "x_end", "n_hits", "n_touching"});
  for (const auto& ray : rays.rays) {
    int n_touching = 0;
    for (size_t h = 0; h < ray.hits.size(); ++h) n_touching += touches(ray, h);
    lines.add({ray.origin[1], box.lower[0] - 0.2, box.upper[0] + 0.2, double(ray.hits.size()),
               double(n_touching)});
  }
  auto& intervals = data.add("intervals", {"y", "x_begin", "x_end"});
  for (const auto& ray : rays.rays)
    for (const auto& inside : ray.intervals)
      intervals.add({ray.origin[1], inside.begin, inside.end});
  auto& hits = data.add("hits", {"x", "y", "part", "touches"});
  for (const auto& ray : rays.rays)
    for (size_t h = 0; h < ray.hits.size(); ++h)
      hits.add({ray.hits[h].t, ray.origin[1], double(ray.hits[h].part), double(touches(ray, h))});
  auto& points = data.add("points", {"x", "y", "weight"});
  for (int k = 0; k < quadrature.size(); ++k)
    points.add({quadrature.position(0, k), quadrature.position(1, k), quadrature.weight[k]});
  return data;
}

void draw(Plot& plot, const Data& data) {
  Panel& panel = plot.panel();
  panel.equal = true;
  panel.frame = false;
  panel.legend = LegendPlace::below;
  panel.area({outline(data)}, {0.95, 0.95, 0.96});
  const DataTable &rays = data["rays"], &points = data["points"], &hits = data["hits"];
  const auto lines = [&](const DataTable& table, const Series& style) {
    panel.segments(zip(table["x_begin"], table["y"]), zip(table["x_end"], table["y"]), style);
  };
  lines(rays, {.label = "ray", .color = {0.75, 0.75, 0.75}, .width = 0.6});
  lines(data["intervals"], {.label = "inside", .color = {0.45, 0.45, 0.45}, .width = 1.4});
  draw_parts(panel, data);
  const ColorScale scale = scale_of(points["weight"]);
  panel.markers(zip(points["x"], points["y"]), points["weight"], scale, 4.5);
  const DataTable crossings = hits.where("touches", 0), touched = hits.where("touches", 1);
  panel.curve(crossings["x"], crossings["y"],
              {.label = "hit", .width = 0, .marker = MarkerShape::square, .marker_size = 3.6});
  panel.curve(touched["x"], touched["y"],
              {.label = "hit that touches",
               .color = colors::okabe_ito[3],
               .width = 0,
               .marker = MarkerShape::triangle,
               .marker_size = 6});
  panel.legend_entry({.label = "quadrature point",
                      .color = colors::viridis(0.5),
                      .width = 0,
                      .marker = MarkerShape::circle,
                      .marker_size = 4.5});
  for (int r = 0; r < rays.n_rows(); ++r) {
    const double n_hits = rays["n_hits"][r], n_touching = rays["n_touching"][r];
    const std::string text = n_hits == 0 ? "misses" : n_touching > 0 ? "touches" : "";
    if (!text.empty())
      panel.note({rays["x_begin"][r], rays["y"][r]}, text, {.offset = {0, 2.5}, .size = 7});
  }
  panel.color_bar(scale, "weight (m²)");
}

}  // namespace

Figure raycast_quadrature() {
  return {"raycast_quadrature",
          "Draft figure 5: raycast quadrature of the blob; a ray that misses has no hit, one that "
          "touches "
          "the boundary keeps its interval whole",
          3.3,
          3.6,
          compute,
          draw};
}

}  // namespace sem::figures
