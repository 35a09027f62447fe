#include "sem/method/interior_rule.h"

#include "sem/base/error.h"
#include "sem/method/boundary_integrals.h"

namespace sem {

template <int Dim>
Quadrature<Dim> interior_rule(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                              const Rays<Dim>& rays, const IntervalOptions& on_rays,
                              const InteriorOptions& options, InteriorReport<Dim>& report) {
  if (options.fit < 0)
    throw InputError("", "method.quadrature.fit", std::to_string(options.fit), "0 (off) or more");
  if (options.compress < 0)
    throw InputError("", "method.quadrature.compress", std::to_string(options.compress),
                     "0 (off) or more");
  report = {};
  Quadrature<Dim> rule;
  if (options.rule == InteriorRule::rays) {
    rule = quadrature_on_rays(rays, on_rays);
  } else {
    auto exact = exact_rule(boundary, loops, options);
    rule = std::move(exact.quadrature);
    report.components = std::move(exact.components);
    report.error = exact.error;
  }
  if (options.fit == 0 && options.compress == 0) return rule;
  report.original = rule;
  const Vec<Dim> center = (boundary.box.lower + boundary.box.upper) / 2;
  const double size = (boundary.box.upper - boundary.box.lower).maxCoeff();
  if (options.fit > 0) {
    const auto truth = boundary_moments_to_degree(boundary, loops, options.fit, center, size);
    report.fit_has_truth = truth.has_value();
    if (truth) report.fit = fit_moments(rule, options.fit, center, size, *truth);
  }
  if (options.compress > 0) report.compression = compress(rule, options.compress, center, size);
  return rule;
}

template Quadrature<2> interior_rule<2>(const Boundary<2>&, const Loops<2>&, const Rays<2>&,
                                        const IntervalOptions&, const InteriorOptions&,
                                        InteriorReport<2>&);
template Quadrature<3> interior_rule<3>(const Boundary<3>&, const Loops<3>&, const Rays<3>&,
                                        const IntervalOptions&, const InteriorOptions&,
                                        InteriorReport<3>&);

}  // namespace sem
