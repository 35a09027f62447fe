#pragma once
// Stage 3 as a whole: the interior rule that the options ask for.

#include "sem/method/exact_rule.h"
#include "sem/method/moment_rules.h"

namespace sem {

/// How the interior rule came about.
template <int Dim>
struct InteriorReport {
  std::vector<ComponentRule> components;  ///< of an exact rule; empty for the grid of rays
  double error = 0;                       ///< of an exact rule: the largest of the components
  MomentReport fit, compression;          ///< degree 0: not asked for
  bool fit_has_truth =
      true;  ///< false: the boundary's moments are not available, nothing was fitted
  Quadrature<Dim> original;  ///< before fit and compression, if there were any
};

/// The rule on the given rays or an exact one; then moment fitting against
/// boundary_moments_to_degree, then compression. Throws InputError as quadrature_on_rays and
/// exact_rule do.
template <int Dim>
Quadrature<Dim> interior_rule(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                              const Rays<Dim>& rays, const IntervalOptions& on_rays,
                              const InteriorOptions& options, InteriorReport<Dim>& report);

}  // namespace sem
