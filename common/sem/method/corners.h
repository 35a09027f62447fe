#pragma once
// Re-entrant corners of the boundary: where sided weights of the condensed formulation get help.
//
// The weights of the parts that meet at such a corner change across a fan of lines through it, the
// steeper the closer, so that their polynomials have to agree at the corner, just where the exact
// solution is singular. A patch around the corner, with a polynomial of its own and a weight that
// takes over towards it, removes that constraint; smaller patches inside refine towards the
// singularity.

#include "sem/method/distance_weights.h"

namespace sem {

/// A disc (ball) around a corner, counted as one more part by the weights.
template <int Dim>
struct CornerPatch {
  Vec<Dim> center;
  double radius;  ///< m
};

/// Levels of patches, each 0.3 times as large as the one before, at the joints of parts where the
/// material takes up more than half of the surroundings (by 3 degrees at least). The largest
/// reaches the closest part that does not meet the corner, the end of the shortest that does, or
/// the cutoff, whichever is closest: patches do not reach across gaps. 3D: none yet (an edge needs
/// a tube).
template <int Dim>
std::vector<CornerPatch<Dim>> find_corners(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                           double cutoff, int n_levels);
template <>
std::vector<CornerPatch<2>> find_corners<2>(const Boundary<2>&, const Loops<2>&, double, int);
template <>
std::vector<CornerPatch<3>> find_corners<3>(const Boundary<3>&, const Loops<3>&, double, int);

/// Adds theta = (1 - t)^4 / t^2, t = distance / radius, of every patch as parts n_parts, n_parts +
/// 1, ..., with its gradient where theta has gradients.
template <int Dim>
void add_corners(const std::vector<CornerPatch<Dim>>& corners, const Points<Dim>& position,
                 DistanceWeights<Dim>& theta);

}  // namespace sem
