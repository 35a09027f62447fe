#pragma once
// Stage 4 where materials differ within a solid: whose region a point lies in, and who reaches into it.
//
// A point has the material of the part with the largest theta. Where that is much stiffer than its
// neighbours, a function that acts on both sides is held by the stiff side: as the ratio grows all of
// them are, and the soft side locks. So softer parts end where a stiffer material begins. What is stiff
// still acts in the soft region, which keeps the map continuous across the border of both.

#include "sem/method/distance_weights.h"

namespace sem {

/// Multiplies theta_i by max(0, 1 - S / O), S the largest theta of the parts of its solid that are stiffer, O of
/// the others: 0 from the border of the stiffer material on. Corner patches count as the softest part. With
/// the gradients where theta has them; entries that vanish are left out. `stiffness`: #parts, any unit;
/// empty: all alike, nothing changes.
template <int Dim>
void keep_out_of_stiffer(const std::vector<double>& stiffness, const Boundary<Dim>& boundary,
                         DistanceWeights<Dim>& theta);

/// Of parts and weights of one point, after that: the part whose region the point lies in, which is the
/// heaviest of the softest of a solid.
int part_of_region(const std::vector<double>& stiffness, const std::vector<int>& solid, const int* part,
                   const double* w, int n);

}  // namespace sem
