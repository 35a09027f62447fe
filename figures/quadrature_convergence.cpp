// Area and second moments by rays against the boundary integrals, for the paper's midpoints and for
// Gauss rules.
#include <cmath>

#include "figures/blob.h"
#include "sem/method/boundary_integrals.h"

namespace sem::figures {
namespace {

const std::string bodies[] = {"disc", "annulus", "blob"};
const char* const quantities[] = {"relative_error_of_area", "relative_error_of_second_moments"};

// Powers of sqrt(2): errors of single numbers of rays scatter.
std::vector<int> ray_counts() {
  std::vector<int> counts;
  for (int k = 4; k <= 20; ++k) counts.push_back(int(std::lround(std::pow(2, k / 2.0))));
  return counts;
}

// Midpoints: half as many in each interval as there are rays; Gauss: 8, exact for these integrands.
Moments<2> moments_by_rays(const Discretization<2>& d, int n, bool gauss) {
  const auto rays =
      cast_rays(d.boundary, d.loops, {0, n, gauss ? RayGrid::gauss : RayGrid::midpoint}, 2);
  const IntervalOptions interval{gauss ? IntervalRule::gauss : IntervalRule::midpoint,
                                 gauss ? 8 : (n + 1) / 2, 0};
  const auto q = quadrature_on_rays(rays, interval);
  return quadrature_moments(q.position, q.weight);
}

// Not below what a logarithmic axis shows.
double shown(double error) { return std::max(error, 1e-16); }

Data compute() {
  Data data;
  auto& errors = data.add("errors", {"body", "gauss", "rays", quantities[0], quantities[1]});
  for (int body = 0; body < 3; ++body) {
    const auto d = builtin_body(bodies[body]);
    const auto truth = boundary_moments(d.boundary, d.loops);
    for (const int gauss : {0, 1})
      for (const int n : ray_counts()) {
        const auto found = moments_by_rays(d, n, gauss);
        errors.add({double(body), double(gauss), double(n),
                    shown(std::abs(found.volume / truth.volume - 1)),
                    shown((found.second - truth.second).norm() / truth.second.norm())});
      }
  }
  return data;
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  const char* const rules[] = {"midpoints", "Gauss"};
  const char* const titles[] = {"Area", "Second moments"};
  for (int q = 0; q < 2; ++q) {
    Panel& panel = plot.panel(0, q);
    panel.title = titles[q];
    panel.x = {.label = "number of rays", .logarithmic = true};
    panel.y = {.label = q == 0 ? "relative error" : "",
               .lower = 1e-10,
               .upper = 1,
               .logarithmic = true,
               .tick_labels = q == 0};
    for (int body = 0; body < 3; ++body)
      for (const int gauss : {0, 1}) {
        const DataTable line = data["errors"].where("body", body).where("gauss", gauss);
        Series style = series(body, bodies[body] + ", " + rules[gauss]);
        style.dash = gauss ? std::vector<double>{} : std::vector<double>{3, 2};
        style.marker_size = 3;
        panel.curve(line["rays"], line[quantities[q]], style);
      }
    panel.slope(-1.5, 100, 400, 2e-2);
    panel.slope(-3, 8, 28, 2e-6);
  }
}

}  // namespace

Figure quadrature_convergence() {
  return {
      "quadrature_convergence",
      "Area and second moments by rays against the boundary integrals: midpoints are of order 3/2; "
      "Gauss rays are of order 3 where the length of a ray is smooth between its ends, and no "
      "better than midpoints where it has kinks, as at a hole or a dent",
      7,
      3,
      compute,
      draw};
}

}  // namespace sem::figures
