#pragma once
// Joints of the boundary at which the exact solution is singular: where sided weights of the
// condensed formulation get help.
//
// Where two parts meet at a re-entrant angle, or a held part meets a free one, derivatives of the
// solution grow without bound towards the joint. The weights of the two parts change across a fan
// through it, the steeper the closer, so that their polynomials have to agree just there. A patch
// around the joint, with a polynomial of its own and a weight that takes over towards it, removes
// that constraint; smaller patches inside refine towards the singularity. Patches are further parts
// of the weights.

#include "sem/method/distance_weights.h"

namespace sem {

/// The surroundings of the joint of parts a and b: points X with r < radius, r^2 = d_a^2 + d_b^2 of
/// the distances to them. r is the distance to the joint where parts are straight and meet at right
/// angles or in a line.
struct JointPatch {
  int a, b;
  double radius;  ///< m
  int level;      ///< 0: the largest at its joint
  bool
      reentrant;  ///< the solid takes up more than half of the surroundings (by 3 degrees at least)
};

/// Where patches stand: `n_levels` at every joint of two parts of a solid where conditions change, half as many more
/// at every one that is re-entrant (singular like r^0.54 at a right angle, r^0.7 where a face ends that is held). `condition`: #parts, parts with the same number are held and loaded
/// alike; empty: all are. The largest reaches as far as the cutoff or twice the larger part's
/// extent from the joint, whichever is less; each further one half as far. Parts meet where an edge
/// of the one (2D: an end) lies on the border of the other; trimmed parts have none here. Patches
/// of a joint stand beside each other, by levels.
template <int Dim>
std::vector<JointPatch> find_joint_patches(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                           const std::vector<int>& condition, double cutoff,
                                           int n_levels);

/// Adds theta = s (1 - t)^4 / t^2, t = r / radius, of every patch as parts n_parts, n_parts + 1,
/// ..., with its gradient where theta has gradients. s: how far X lies on the inner side of a AND b
/// (product of their side steps), at a re-entrant joint of a OR b: a patch does not reach across
/// gaps. theta is cut off at 1e-6 of the largest radius, in all levels alike: nearer, all other
/// weights are rounding. `distances`: those that theta was made of.
template <int Dim>
void add_joint_patches(const std::vector<JointPatch>& patches, const Boundary<Dim>& boundary,
                       const Distances<Dim>& distances, const Points<Dim>& position,
                       DistanceWeights<Dim>& theta);

/// Where a patch can act: the meet of the boxes of its parts, larger by its radius, and of the
/// body's.
template <int Dim>
Box<Dim> support_of(const JointPatch& patch, const Boundary<Dim>& boundary);

}  // namespace sem
