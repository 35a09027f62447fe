#pragma once
// Stage 7: deformation origins (draft eq. 4: one for all).

#include <vector>

#include "sem/method/blending_weights.h"
#include "sem/method/samples.h"

namespace sem {

enum class OriginChoice {
  one,           ///< the centroid of all samples (the draft)
  shared_parts,  ///< a candidate for each set of parts that share quadrature points (published)
};

/// Origins and which part uses which.
template <int Dim>
struct Origins {
  std::vector<std::vector<int>> members;  ///< #origins: parts whose samples make the centroid, ascending
  Points<Dim> position;                   ///< Dim by #origins: rest position, the weighted mean of the samples
  std::vector<int> of_part;               ///< #parts: index of the part's origin
  std::vector<int> ties;                  ///< parts for which two candidates were equally good
  std::vector<int> fallback;              ///< parts in no group of two or more: they use the mean of all
};

/// Candidates: quadrature points grouped by the set of parts with w > 1e-4,
/// sets of two or more; not sets that lie on one line or plane, which would put
/// the origin there and leave a direction of the linear fit open (our addition:
/// with a cutoff of half the height, two neighbours on the edge of a beam). Part i takes the candidate with the largest sum over
/// the group of v_k w_i: the min-cost flow of the published method decouples,
/// as no capacity binds. Sums that agree to 1e-9 are a tie, won by the larger
/// set, then by the lexicographically smaller one. A part in no candidate
/// takes the mean of all parts. Unused candidates are dropped.
template <int Dim>
Origins<Dim> choose_origins(OriginChoice choice, const BlendingWeights<Dim>& weights,
                            const Eigen::VectorXd& quadrature_weight, const Samples<Dim>& samples);

/// Origins from given sets: the centroid of each set's samples.
template <int Dim>
Origins<Dim> origins_from_sets(const std::vector<std::vector<int>>& members,
                               const std::vector<int>& of_part, const Samples<Dim>& samples);

}  // namespace sem
