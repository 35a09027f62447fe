// The draft's figure 5: rays, hits, intervals and points of the interior quadrature.
#include <algorithm>
#include <cmath>

#include "figures/blob.h"
#include "sem/draw/view.h"

namespace sem::figures {
namespace {

// What a row of the data is; x2 ends rays and intervals, value is the part or the weight.
constexpr double curve = 0, ray = 1, interval = 2, hit = 3, quadrature_point = 4;

Data compute() {
  const auto body = builtin_body("blob", {"method.quadrature.rays=11", "method.quadrature.spacing=0.22"});
  Data data{{"kind", "x", "y", "x2", "value"}, {}};
  for (const auto& [part, x, y] : part_points(body.boundary)) data.rows.push_back({curve, x, y, 0, part});
  const auto& box = body.boundary.box;
  const double room = 0.06 * box.diagonal();
  for (const auto& one : body.rays.rays) {
    data.rows.push_back({ray, box.lower[0] - room, one.origin[1], box.upper[0] + room, 0});
    for (const auto& stretch : one.intervals) data.rows.push_back({interval, stretch.begin, one.origin[1], stretch.end, 0});
    for (const auto& at : one.hits) data.rows.push_back({hit, at.t, one.origin[1], 0, double(at.part)});
  }
  for (int k = 0; k < body.quadrature.size(); ++k)
    data.rows.push_back({quadrature_point, body.quadrature.position(0, k), body.quadrature.position(1, k), 0, body.quadrature.weight[k]});
  return data;
}

void draw(Canvas& canvas, const Data& data) {
  Box<2> world;
  for (const auto& row : data.rows) {
    world.include(Vec<2>(row[1], row[2]));
    if (row[0] == ray) world.include(Vec<2>(row[3], row[2]));
  }
  const View2 view(world, {Vec<2>(6 * point, 6 * point), Vec<2>(canvas.width() - 52 * point, canvas.height() - 30 * point)});
  for (const auto& row : data.where("kind", ray).rows)
    canvas.line(view.map({row[1], row[2]}), view.map({row[3], row[2]}), {.color = colors::light_gray, .width = 0.6 * point});
  for (const auto& row : data.where("kind", interval).rows)
    canvas.line(view.map({row[1], row[2]}), view.map({row[3], row[2]}), {.color = colors::gray, .width = 1.4 * point});
  for (int part = 0; part < 3; ++part) {
    Polyline line;
    for (const auto& row : data.where("kind", curve).rows)
      if (row[4] == part) line.push_back(view.map({row[1], row[2]}));
    canvas.stroke(line, {.color = part_color(part), .width = 2 * point, .cap = Stroke::Cap::round});
  }
  const auto points = data.where("kind", quadrature_point);
  const auto weights = points.column("value");
  const double largest = *std::max_element(weights.begin(), weights.end());
  for (const auto& row : points.rows)
    canvas.marker(view.map({row[1], row[2]}), MarkerShape::circle, 4.5 * point, colors::viridis(row[4] / largest));
  for (const auto& row : data.where("kind", hit).rows)
    canvas.marker(view.map({row[1], row[2]}), MarkerShape::square, 4 * point, colors::black);
  const double right = canvas.width() - 40 * point;
  color_bar(canvas, {Vec<2>(right, 20 * point), Vec<2>(right + 7 * point, canvas.height() - 50 * point)}, 0, largest,
            "weight v (m²)");
  const double y = canvas.height() - 14 * point;
  const TextStyle text{.size = text_size, .vertical = TextStyle::Vertical::middle};
  canvas.marker({14 * point, y}, MarkerShape::square, 4 * point, colors::black);
  canvas.text({20 * point, y}, "hit", text);
  canvas.line({46 * point, y}, {60 * point, y}, {.color = colors::gray, .width = 1.4 * point});
  canvas.text({64 * point, y}, "interval inside", text);
  canvas.marker({136 * point, y}, MarkerShape::circle, 4.5 * point, colors::viridis(0.8));
  canvas.text({142 * point, y}, "point", text);
}

}  // namespace

Figure raycast_quadrature() {
  return {"raycast_quadrature", "Draft figure 5: raycast quadrature of the three-curve blob", 3.3, 3.4, compute, draw};
}

}  // namespace sem::figures
