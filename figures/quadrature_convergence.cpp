// Interior rules against the boundary integrals: error against number of points, and against the
// time that making the rule takes, for the paper's midpoints, Gauss rays, split rays and fans.
#include <cmath>

#include "figures/blob.h"
#include "sem/base/timing.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/exact_rule.h"
#include "sem/method/moment_rules.h"

namespace sem::figures {
namespace {

const std::string bodies[] = {"disc", "annulus", "blob", "closed_curve"};
const char* const titles[] = {"Disc", "Annulus", "Blob of three curves", "Closed B-spline"};
enum Rule { midpoints, gauss, split, fan, n_rules };
const char* const rules[] = {"midpoints on rays", "Gauss rays", "split rays", "exact (cheapest)"};
constexpr int degree = 6;

// Powers of sqrt(2): errors of single numbers of rays scatter.
std::vector<int> ray_counts() {
  std::vector<int> counts;
  for (int k = 4; k <= 20; ++k) counts.push_back(int(std::lround(std::pow(2, k / 2.0))));
  return counts;
}

// Midpoints: half as many in each interval as there are rays; Gauss: 12, exact to rounding here.
Quadrature<2> rule_on_rays(const Discretization<2>& d, int n, bool by_gauss) {
  const auto rays =
      cast_rays(d.boundary, d.loops, {0, n, by_gauss ? RayGrid::gauss : RayGrid::midpoint}, 1);
  const IntervalOptions interval{by_gauss ? IntervalRule::gauss : IntervalRule::midpoint,
                                 by_gauss ? 12 : (n + 1) / 2, 0};
  return quadrature_on_rays(rays, interval);
}

// Moments to degree 6 and integrals of waves, from the boundary.
struct SmoothTruth {
  Vec<2> center;
  double size, wave_number, area = 0;
  Eigen::VectorXd moments;
  Vec<2> waves = Vec<2>::Zero();  // of cos(k x), cos(k y)

  explicit SmoothTruth(const Discretization<2>& d) {
    const Box<2>& box = d.boundary.box;
    center = (box.lower + box.upper) / 2;
    size = (box.upper - box.lower).maxCoeff();
    wave_number = 4 * M_PI / size;
    moments = boundary_moments_to_degree(d.boundary, d.loops, degree, center, size).value();
    area = moments[0];
    visit_boundary_flux<2>(d.boundary, d.loops, [&](const Vec<2>& X, double flux) {
      waves[0] += flux * std::sin(wave_number * X[0]) / wave_number;
      waves[1] += flux * X[0] * std::cos(wave_number * X[1]);
    });
  }

  // Largest error, relative to the integral of the magnitude (waves: to the area).
  double error(const Quadrature<2>& q) const {
    double worst = moment_error(q, degree, center, size, moments);
    for (int a = 0; a < 2; ++a) {
      const double found = q.weight.dot((wave_number * q.position.row(a).array()).cos().matrix());
      worst = std::max(worst, std::abs(found - waves[a]) / area);
    }
    return worst;
  }
};

// Not below what a logarithmic axis shows.
double shown(double error) { return std::max(error, 1e-15); }

Data compute() {
  Data data;
  auto& errors = data.add("errors", {"body", "rule", "setting", "points", "relative_error_of_area",
                                     "relative_error_of_smooth_integrals", "making_seconds"});
  for (int body = 0; body < 4; ++body) {
    const auto d = builtin_body(bodies[body]);
    const SmoothTruth truth(d);
    const auto add = [&](Rule rule, double setting, const auto& make) {
      Quadrature<2> q;
      const auto seconds = seconds_per_call(1, 2, [&](int) { return (q = make()).weight[0]; });
      errors.add({double(body), double(rule), setting, double(q.size()),
                  shown(std::abs(q.weight.sum() / truth.area - 1)), shown(truth.error(q)),
                  seconds[0]});
    };
    for (const Rule rule : {midpoints, gauss})
      for (const int n : ray_counts())
        add(rule, n, [&] { return rule_on_rays(d, n, rule == gauss); });
    for (const Rule rule : {split, fan})
      for (int k = 2; k <= 12; k += 2) {
        const InteriorOptions options{
            rule == split ? InteriorRule::split_rays : InteriorRule::exact, std::pow(10, -k)};
        add(rule, options.tolerance,
            [&] { return exact_rule(d.boundary, d.loops, options).quadrature; });
      }
  }
  return data;
}

void draw_against(Plot& plot, const Data& data, const std::string& column, Axis across) {
  plot.shared_legend = true;
  for (int body = 0; body < 4; ++body) {
    const int row = body / 2;
    Panel& panel = plot.panel(row, body % 2);
    panel.title = titles[body];
    panel.x = across;
    panel.x.logarithmic = true;
    panel.x.tick_labels = row == 1;
    if (row == 0) panel.x.label = "";
    panel.y = {.label = body % 2 == 0 ? "largest relative error" : "",
               .lower = 1e-14,
               .upper = 1,
               .logarithmic = true,
               .tick_labels = body % 2 == 0};
    for (int rule = 0; rule < n_rules; ++rule) {
      const DataTable line = data["errors"].where("body", body).where("rule", rule);
      Series style = series(rule, rules[rule]);
      style.dash =
          rule == midpoints || rule == fan ? std::vector<double>{3, 2} : std::vector<double>{};
      style.marker_size = rule == split ? 5 : 3;  // seen below the cheapest, often the same
      panel.curve(line[column], line["relative_error_of_smooth_integrals"], style);
    }
    if (column == "points") panel.slope(-0.75, 3e4, 2e5, 1e-5);
  }
}

void draw(Plot& plot, const Data& data) {
  draw_against(plot, data, "points", {.label = "number of points", .lower = 10, .upper = 1e6});
}

void draw_times(Plot& plot, const Data& data) {
  draw_against(plot, data, "making_seconds",
               {.label = "processor time (s)", .lower = 1e-6, .upper = 1});
}

}  // namespace

Figure quadrature_convergence() {
  return {
      "quadrature_convergence",
      "Interior rules: the largest relative error of all moments to degree 6 and of waves half as "
      "long as the body, against the boundary integrals. Midpoints on rays (the paper's) are of "
      "order 3/2 in the number of rays. Rays split where the boundary turns back, has joints or "
      "knots, and fans about an ellipse where they are cheaper, reach 1e-10 with some hundred "
      "points of positive weight, all inside",
      7,
      5,
      compute,
      draw};
}

Figure quadrature_work() {
  return {"quadrature_work",
          "The same rules and errors against the time that making them takes, one thread: exact "
          "rules look for turning "
          "points and joints first, which takes milliseconds, and are ahead below errors of 1e-4, on the disc of "
          "1e-6",
          7,
          5,
          compute,
          draw_times};
}

}  // namespace sem::figures
