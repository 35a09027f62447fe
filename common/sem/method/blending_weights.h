#pragma once
// Stage 5: blending weights w_i(X) (draft eq. 23-24).

#include <vector>

#include "sem/method/distance_weights.h"

namespace sem {

/// w > 0 of every point, in rows; each row sums to 1.
template <int Dim>
struct BlendingWeights {
  std::vector<int> begin;          ///< #points + 1
  std::vector<int> part;           ///< #entries
  std::vector<double> w;           ///< #entries, in (0, 1]
  std::vector<Vec<Dim>> gradient;  ///< #entries: grad w, 1/m, sums to 0 in a row; empty if theta's is
  std::vector<int> uncovered;      ///< points where all theta vanish
  int n_parts = 0;

  int n_points() const { return int(begin.size()) - 1; }
};

/// argmin w^T diag(1/theta) w, sum w = 1, 0 <= w <= 1 has the closed form
/// w_i = theta_i / sum_j theta_j (Lagrange: w_i / theta_i equal for all i; the
/// bounds then hold by themselves). Where all theta vanish w is undefined:
/// the point follows the part it is closest to (the lowest index on a tie),
/// and is listed in uncovered.
template <int Dim>
BlendingWeights<Dim> blending_weights(const DistanceWeights<Dim>& theta, const Boundary<Dim>& boundary,
                                      const Points<Dim>& position);

}  // namespace sem
