#include "sem/method/quadrature.h"

#include <cmath>

#include "sem/base/error.h"
#include "sem/method/line_rules.h"

namespace sem {
namespace {
constexpr double max_points = 1e7;  // some GB of operators
}

template <int Dim>
Quadrature<Dim> quadrature_on_rays(const Rays<Dim>& rays, const IntervalOptions& options) {
  if (options.spacing == 0 && options.points < 1)
    throw InputError("", "method.quadrature.points", std::to_string(options.points), "at least 1");
  if (!(options.spacing >= 0))
    throw InputError("", "method.quadrature.spacing", std::to_string(options.spacing),
                     "0 (a fixed number of points) or a positive length");
  Quadrature<Dim> quadrature;
  std::vector<Vec<Dim>> position;
  std::vector<double> weight;
  LineRule rule;
  for (const Ray<Dim>& ray : rays.rays)
    for (const RayInterval& interval : ray.intervals) {
      const double length = interval.end - interval.begin;
      const double wanted = options.spacing > 0 ? std::max(1.0, std::ceil(length / options.spacing)) : options.points;
      if (double(weight.size()) + wanted > max_points)
        throw InputError("", "method.quadrature", "more than 1e7 points", "fewer rays or points, or a larger spacing");
      const int n = int(wanted);
      if (int(rule.node.size()) != n)
        rule = options.rule == IntervalRule::gauss ? gauss_legendre(n) : midpoint_rule(n);
      for (int k = 0; k < n; ++k) {
        Vec<Dim> X = ray.origin;
        X[rays.axis] = interval.begin + length * (1 + rule.node[k]) / 2;
        position.push_back(X);
        weight.push_back(ray.weight * length * rule.weight[k] / 2);
        quadrature.solid.push_back(interval.solid);
      }
    }
  if (weight.empty())
    throw InputError("", "solids", "no interior along any of " + std::to_string(rays.rays.size()) + " rays",
                     "parts that enclose a region, and enough rays to meet it");
  quadrature.position.resize(Dim, weight.size());
  for (size_t k = 0; k < weight.size(); ++k) quadrature.position.col(k) = position[k];
  quadrature.weight = Eigen::Map<Eigen::VectorXd>(weight.data(), weight.size());
  return quadrature;
}

template Quadrature<2> quadrature_on_rays<2>(const Rays<2>&, const IntervalOptions&);
template Quadrature<3> quadrature_on_rays<3>(const Rays<3>&, const IntervalOptions&);

}  // namespace sem
