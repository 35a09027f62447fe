#include "sem/method/exact_rule.h"

#include <cmath>
#include <numeric>

#include "sem/base/error.h"
#include "sem/method/fan.h"
#include "sem/method/split_rays.h"

namespace sem {
namespace {

constexpr double share_of_tolerance = 0.8;
constexpr double least_integral =
    0.3;                               // of that of |f|; integrals that cancel below it count as it
constexpr double grossly_wrong = 0.1;  // difference of the area from that of the first look

template <int Dim>
struct CandidateRule {
  ComponentRule report;
  CellRule<Dim> rule;
};

// Scales of the relative errors, from a few hundred rays.
template <int Dim>
struct FirstLook {
  Yardstick<Dim> yardstick;
  double measure;  // area, volume
};
// 24 rays across, along the axis on which they find most of the inside: none lies flat on a thin component.
template <int Dim>
Rays<Dim> first_rays(const Component<Dim>& component) {
  Rays<Dim> best;
  double most = -1;
  for (int axis = 0; axis < Dim; ++axis) {
    Rays<Dim> rays = cast_rays(component.boundary, component.loops, {.axis = axis, .n_rays = 24});
    double measure = 0;
    for (const auto& ray : rays.rays)
      for (const auto& interval : ray.intervals) measure += ray.weight * (interval.end - interval.begin);
    if (measure <= most) continue;
    most = measure;
    best = std::move(rays);
  }
  return best;
}

template <int Dim>
FirstLook<Dim> look_at(const Component<Dim>& component, double size,
                       const InteriorOptions& options) {
  const Rays<Dim> rays = first_rays(component);
  const Vec<Dim> center = (component.boundary.box.lower + component.boundary.box.upper) / 2;
  FirstLook<Dim> look{{SmoothIntegrands<Dim>(center, size, options.waves),
                       {},
                       share_of_tolerance * options.tolerance},
                      0};
  const auto& f = look.yardstick.integrands;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(f.size()), magnitude = sum;
  const LineRule& rule = gauss_on_strand(16);
  for (const auto& ray : rays.rays)
    for (const auto& interval : ray.intervals)
      for (size_t k = 0; k < rule.node.size(); ++k) {
        Vec<Dim> X = ray.origin;
        X[rays.axis] = interval.begin + rule.node[k] * (interval.end - interval.begin);
        const double weight = ray.weight * rule.weight[k] * (interval.end - interval.begin);
        const Eigen::VectorXd values = f.values(X);
        sum += weight * values;
        magnitude += weight * values.cwiseAbs();
      }
  look.yardstick.scale = sum.cwiseAbs().cwiseMax(least_integral * magnitude);
  look.measure = sum[0];
  return look;
}

template <int Dim>
std::vector<CandidateRule<Dim>> candidate_rules(const Component<Dim>& component,
                                                const FirstLook<Dim>& look, InteriorRule rule) {
  std::vector<CandidateRule<Dim>> result;
  const auto add = [&](const std::string& name, const std::vector<Cell<Dim>>& cells) {
    if (cells.empty()) return;
    CandidateRule<Dim>& made = result.emplace_back();
    made.rule = cheapest_rule(cells, look.yardstick);
    const auto& weight = made.rule.weight;
    const double off =
        std::abs(std::accumulate(weight.begin(), weight.end(), 0.0) / look.measure - 1);
    if (!(off < grossly_wrong)) made.rule.error = std::max(made.rule.error, off);
    made.report = {name, int(cells.size()), int(made.rule.weight.size()), made.rule.error};
  };
  if (rule != InteriorRule::split_rays) add("fan", fan_cells(component, look.yardstick));
  const bool fan = !result.empty() && result.front().rule.error <= look.yardstick.tolerance;
  if (rule == InteriorRule::fans && fan) return result;
  for (int axis = 0; axis < Dim; ++axis) {
    add(std::string("rays along ") + DimTraits<Dim>::axis_name[axis],
        ray_cells(component, axis, look.yardstick));
    // Another axis is not worth the time where a fan is far better than this one.
    if (fan && result.front().report.n_points < 0.7 * result.back().report.n_points) break;
  }
  return result;
}

// Whether a is preferred: within the tolerance, then fewer points.
template <int Dim>
bool is_better(const CandidateRule<Dim>& a, const CandidateRule<Dim>& b, double tolerance) {
  const bool a_right = a.rule.error <= tolerance, b_right = b.rule.error <= tolerance;
  if (a_right != b_right) return a_right;
  return a_right ? a.report.n_points < b.report.n_points : a.rule.error < b.rule.error;
}

}  // namespace

template <int Dim>
ExactRule<Dim> exact_rule(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                          const InteriorOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw InputError("", "method.quadrature.tolerance", std::to_string(options.tolerance),
                     "a number > 0 and < 1");
  if (!(options.waves > 0))
    throw InputError("", "method.quadrature.waves", std::to_string(options.waves), "a number > 0");
  const double size = (boundary.box.upper - boundary.box.lower).maxCoeff();
  ExactRule<Dim> result;
  std::vector<CellRule<Dim>> chosen;
  for (const auto& component : split_into_components(boundary, loops)) {
    const auto look = look_at(component, size, options);
    if (!(look.measure > 0)) continue;
    auto all = candidate_rules(component, look, options.rule);
    if (all.empty()) continue;  // thinner than the rounding of critical values
    size_t best = 0;
    for (size_t k = 1; k < all.size(); ++k)
      if (is_better(all[k], all[best], options.tolerance)) best = k;
    result.components.push_back(all[best].report);
    result.error = std::max(result.error, all[best].report.error);
    chosen.push_back(std::move(all[best].rule));
  }
  size_t n = 0, next = 0;
  for (const auto& rule : chosen) n += rule.weight.size();
  if (n == 0) throw InputError("", "solids", "no interior", "parts that enclose a region");
  result.quadrature.position.resize(Dim, n);
  result.quadrature.weight.resize(n);
  for (const auto& rule : chosen)
    for (size_t k = 0; k < rule.weight.size(); ++k, ++next) {
      result.quadrature.position.col(next) = rule.position.col(k);
      result.quadrature.weight[next] = rule.weight[k];
      result.quadrature.solid.push_back(rule.solid[k]);
    }
  return result;
}

template ExactRule<2> exact_rule<2>(const Boundary<2>&, const Loops<2>&, const InteriorOptions&);
template ExactRule<3> exact_rule<3>(const Boundary<3>&, const Loops<3>&, const InteriorOptions&);

}  // namespace sem
