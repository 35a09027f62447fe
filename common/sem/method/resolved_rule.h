#pragma once
// Stage 3 for integrands with kinks inside the solid: cells that are halved until they resolve
// them.
//
// Blending weights are smooth only on pieces: they have kinks where a support ends or a closest
// point leaves its part, and change fast near corners. A rule that is exact for smooth integrands
// misses that energy. Here cells lie in blocks of rays (ray_blocks.h) and along
// their intervals; each has a Gauss rule, and is halved across the direction in which that changes
// its integrals most, until the changes left add up to less than the tolerance.

#include <functional>

#include "sem/method/quadrature.h"

namespace sem {

/// Values >= 0 at points whose integrals a rule is to get right: per point a sparse row.
struct Indicators {
  std::vector<int> begin;     ///< #points + 1
  std::vector<int> index;     ///< #entries, 0..n - 1
  std::vector<double> value;  ///< #entries
  int n = 0;
};
template <int Dim>
using IndicatorsAt = std::function<Indicators(const Points<Dim>&)>;

/// What scenes ask of `tolerance` unless they say otherwise. In space points are dear: a beam of 10 and 14 parts (n = 3, a
/// thousandth of its weight) sags to 98.1 and 99.7 % of the truth at 3e-3; at 1e-2, with 14, to 104, with patches to 115 %.
template <int Dim>
inline constexpr double usual_weight_tolerance = 3e-4;
template <>
inline constexpr double usual_weight_tolerance<3> = 3e-3;

struct ResolvedOptions {
  int axis = 0;             ///< of the rays
  int points = 5;           ///< Gauss points of a cell per direction
  double tolerance = 3e-4;  ///< mean over the indicators: sum of the cells' changes when halved, relative to the
                            ///< indicator's own integral or 1e-4 of the mean one, whichever is larger
  int max_depth = 10;       ///< halvings of a cell per direction
  int max_points = 200000;
  int min_points = 0;       ///< cells are halved until there are as many, whatever their change
};

template <int Dim>
struct ResolvedRule {
  Quadrature<Dim> quadrature;
  double error = 0;  ///< what the tolerance bounds; an estimate
  int n_cells = 0;
  bool reached = true;  ///< false: depth or points ran out first
};

/// Points inside, weights > 0. Throws InputError as quadrature_on_rays does.
template <int Dim>
ResolvedRule<Dim> resolved_rule(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                const IndicatorsAt<Dim>& indicators, const ResolvedOptions& options,
                                int n_threads = 1);

}  // namespace sem
