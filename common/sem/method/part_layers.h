#pragma once
// Parts whose own extent is small beside the cutoff get further weights that reach less far.
//
// The cutoff has to cover the body and so belongs to its large parts, but around a small hole in a large plate the
// solution changes over the hole's size: one polynomial, as far as the cutoff, cannot follow it. A solution without
// singular loads inside varies over lengths in proportion to the distance from what disturbs it on the boundary;
// weights that reach half as far each time are the graded mesh of that. Layers are further parts of the weights.

#include "sem/method/distance_weights.h"

namespace sem {

/// A further weight of a part.
struct PartLayer {
  int part;
  double reach;  ///< m
};

/// Of every part: reaches of twice its extent (2D: length, 3D: root of the area), 4, 8, ... times it up to half of the
/// cutoff; where these were more than `n_layers`, so many in larger steps. None is shorter than 1/64 of the cutoff.
/// By parts.
template <int Dim>
std::vector<PartLayer> find_part_layers(const Boundary<Dim>& boundary, double cutoff, int n_layers);

/// Adds theta of every layer, the part's sided theta with the layer's reach in place of the cutoff, as parts n_parts,
/// n_parts + 1, ... of theta; with its gradient where theta has gradients. `distances`: sided, those that theta was
/// made of.
template <int Dim>
void add_part_layers(const std::vector<PartLayer>& layers, const Boundary<Dim>& boundary,
                     const Distances<Dim>& distances, const Points<Dim>& position, DistanceWeights<Dim>& theta);

}  // namespace sem
