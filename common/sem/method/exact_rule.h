#pragma once
// Stage 3 another way: interior rules with few points, positive weights and all points inside, that
// are exact to a tolerance for smooth integrands.

#include "sem/method/quadrature.h"

namespace sem {

enum class InteriorRule {
  rays,        ///< the grid of rays of RayOptions and IntervalOptions (the paper's)
  split_rays,  ///< rays between critical values (split_rays.h), along the axis that needs fewer
               ///< points
  fans,        ///< a fan from a center (fan.h) wherever there is one, else split rays
  exact,       ///< of these two the one with fewer points
  resolved,    ///< cells refined until they resolve the blending weights (resolved_rule.h)
};

/// Of the whole stage (interior_rule.h); exact_rule looks at the first three.
struct InteriorOptions {
  InteriorRule rule = InteriorRule::rays;
  double tolerance = 1e-10;  ///< relative error aimed at, of rules other than `rays`
  double waves = 2;          ///< waves over the body's largest extent that the rule resolves
  double weight_tolerance = 3e-4;  ///< ResolvedOptions::tolerance
  int fit = 0;               ///< > 0: new weights that match the boundary's moments to this degree
  int compress = 0;          ///< > 0: few points with the same moments to this degree
};

/// What was chosen for a group of loops that lies apart from the others.
struct ComponentRule {
  std::string rule;  ///< "rays along x", "fan"
  int n_cells = 0;
  int n_points = 0;
  double error = 0;  ///< measured: largest relative error over SmoothIntegrands
};

template <int Dim>
struct ExactRule {
  Quadrature<Dim> quadrature;
  std::vector<ComponentRule> components;
  double error = 0;  ///< the largest of the components
};

/// Splits the body into components that lie apart, each of them into cells of strands, and gives
/// every cell as many strands, every strand as many points as it takes to integrate the
/// SmoothIntegrands of the body's size (moments to degree 6, exp, waves) with an error of 0.8 of
/// the tolerance: relative to the integral, or to 0.3 of that of |f| where it cancels; measured
/// against the same cells with many more strands. The inside is what rays say it is (loops.h): a
/// candidate whose area differs from that of a coarse grid of rays by more than a tenth is as wrong
/// as that. Where the tolerance is out of reach the error says so. Throws InputError as
/// quadrature_on_rays does, and for a tolerance not in (0, 1) or waves <= 0.
template <int Dim>
ExactRule<Dim> exact_rule(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                          const InteriorOptions& options);

}  // namespace sem
