// Area by rays against the boundary integral's, for the paper's rule and for Gauss rules.
#include <cmath>

#include "figures/blob.h"
#include "sem/method/boundary_integrals.h"

namespace sem::figures {
namespace {

const char* const bodies[] = {"disc", "blob"};
const int ray_counts[] = {4, 8, 16, 32, 64, 128, 256, 512, 1024};

Data compute() {
  Data data{{"body", "gauss", "rays", "relative_error_of_area"}, {}};
  for (int body = 0; body < 2; ++body) {
    const auto d = builtin_body(bodies[body]);
    const double truth = boundary_moments(d.boundary, d.loops).volume;
    for (const int gauss : {0, 1})
      for (const int n : ray_counts) {
        const auto rays =
            cast_rays(d.boundary, d.loops, {0, n, gauss ? RayGrid::gauss : RayGrid::midpoint}, 2);
        const double area =
            quadrature_on_rays(rays, {gauss ? IntervalRule::gauss : IntervalRule::midpoint, 8, 0})
                .weight.sum();
        data.rows.push_back(
            {double(body), double(gauss), double(n), std::max(std::abs(area / truth - 1), 1e-16)});
      }
  }
  return data;
}

void draw(Canvas& canvas, const Data& data) {
  const Box<2> area{Vec<2>(42 * point, 8 * point),
                    Vec<2>(canvas.width() - 10 * point, canvas.height() - 32 * point)};
  const Panel panel(canvas, area, {"number of rays", 3, 1500, true},
                    {"relative error of the area", 1e-11, 1, true});
  const char* names[] = {"disc, midpoints", "disc, Gauss", "blob, midpoints", "blob, Gauss"};
  const MarkerShape markers[] = {MarkerShape::circle, MarkerShape::square, MarkerShape::triangle,
                                 MarkerShape::diamond};
  for (int k = 0; k < 4; ++k) {
    const Data line = data.where("body", k / 2).where("gauss", k % 2);
    const Color color = colors::okabe_ito[k < 2 ? 0 : 1];
    const std::vector<double> dash =
        k % 2 ? std::vector<double>{4 * point, 2.5 * point} : std::vector<double>{};
    panel.curve(line.column("rays"), line.column("relative_error_of_area"), color, markers[k],
                dash);
    panel.legend(3 - k, names[k], color, markers[k], dash);
  }
  panel.slope(130, 500, 3e-2, -1.5, "−3/2");
  panel.slope(130, 500, 3e-8 * 100, -3, "−3");
}

}  // namespace

Figure quadrature_convergence() {
  return {"quadrature_convergence",
          "Area by rays against the boundary integral, midpoint and Gauss rules",
          3.3,
          2.7,
          compute,
          draw};
}

}  // namespace sem::figures
