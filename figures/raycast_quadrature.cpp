// The draft's figure 5: rays, hits, intervals and points of the interior quadrature.
#include <algorithm>
#include <cmath>

#include "figures/blob.h"
#include "sem/draw/view.h"

namespace sem::figures {
namespace {

// What a row of the data is; x2 ends rays and intervals, value is the part or the weight.
constexpr double curve = 0, ray = 1, interval = 2, hit = 3, quadrature_point = 4;

// As in the sketch the grid of rays reaches beyond the body, so that the outer rays miss it.
Data compute() {
  auto body = builtin_body("blob");
  body.boundary.box.lower[1] -= 0.2;
  body.boundary.box.upper[1] += 0.2;
  const Rays<2> rays = cast_rays(body.boundary, body.loops, {.axis = 0, .n_rays = 13});
  const auto quadrature = quadrature_on_rays(rays, {.spacing = 0.2});
  Data data{{"kind", "x", "y", "x2", "value"}, {}};
  for (const auto& [part, x, y] : part_points(body.boundary))
    data.rows.push_back({curve, x, y, 0, part});
  const auto& box = body.boundary.box;
  for (const auto& one : rays.rays) {
    const double y = one.origin[1];
    data.rows.push_back({ray, box.lower[0] - 0.2, y, box.upper[0] + 0.2, 0});
    for (const auto& stretch : one.intervals)
      data.rows.push_back({interval, stretch.begin, y, stretch.end, 0});
    for (const auto& at : one.hits) data.rows.push_back({hit, at.t, y, 0, double(at.part)});
  }
  for (int k = 0; k < quadrature.size(); ++k)
    data.rows.push_back({quadrature_point, quadrature.position(0, k), quadrature.position(1, k), 0,
                         quadrature.weight[k]});
  return data;
}

constexpr double hit_size = 3.6 * point, point_size = 5 * point;
constexpr Color ray_color{0.75, 0.75, 0.75}, interval_color{0.45, 0.45, 0.45};

void draw_legend(Canvas& canvas, double y) {
  const TextStyle text{.size = text_size, .vertical = TextStyle::Vertical::middle};
  const auto line = [&](double x, const Color& color, double width) {
    canvas.line({x * point, y}, {(x + 14) * point, y}, {.color = color, .width = width});
  };
  line(8, ray_color, 0.6 * point);
  canvas.text({26 * point, y}, "ray", text);
  line(52, interval_color, 1.4 * point);
  canvas.text({70 * point, y}, "inside", text);
  canvas.marker({111 * point, y}, MarkerShape::square, hit_size, colors::black);
  canvas.text({117 * point, y}, "hit", text);
  canvas.marker({146 * point, y}, MarkerShape::circle, point_size, colors::viridis(0.5));
  canvas.text({152 * point, y}, "quadrature point", text);
}

void draw(Canvas& canvas, const Data& data) {
  Box<2> world;
  for (const auto& row : data.rows) {
    world.include(Vec<2>(row[1], row[2]));
    if (row[0] == ray) world.include(Vec<2>(row[3], row[2]));
  }
  const View2 view(world, {Vec<2>(6 * point, 6 * point),
                           Vec<2>(canvas.width() - 50 * point, canvas.height() - 24 * point)});
  Polyline outline;
  for (const auto& row : data.where("kind", curve).rows)
    outline.push_back(view.map({row[1], row[2]}));
  canvas.fill(outline, {0.95, 0.95, 0.96});
  const auto horizontal = [&](const std::vector<double>& row, const Color& color, double width) {
    canvas.line(view.map({row[1], row[2]}), view.map({row[3], row[2]}),
                {.color = color, .width = width});
  };
  for (const auto& row : data.where("kind", ray).rows) horizontal(row, ray_color, 0.6 * point);
  for (const auto& row : data.where("kind", interval).rows)
    horizontal(row, interval_color, 1.4 * point);
  draw_parts(canvas, view, data.where("kind", curve), "value", -1);
  const auto points = data.where("kind", quadrature_point);
  const auto weights = points.column("value");
  const auto [least, largest] = std::minmax_element(weights.begin(), weights.end());
  for (const auto& row : points.rows)
    canvas.marker(view.map({row[1], row[2]}), MarkerShape::circle, point_size,
                  colors::viridis((row[4] - *least) / (*largest - *least)));
  for (const auto& row : data.where("kind", hit).rows)
    canvas.marker(view.map({row[1], row[2]}), MarkerShape::square, hit_size, colors::black);
  const double left = canvas.width() - 42 * point;
  color_bar(canvas,
            {Vec<2>(left, 16 * point), Vec<2>(left + 7 * point, canvas.height() - 34 * point)},
            *least, *largest, "weight (m²)");
  draw_legend(canvas, canvas.height() - 10 * point);
}

}  // namespace

Figure raycast_quadrature() {
  return {"raycast_quadrature",
          "Draft figure 5: raycast quadrature of the three-curve blob",
          3.3,
          3.3,
          compute,
          draw};
}

}  // namespace sem::figures
