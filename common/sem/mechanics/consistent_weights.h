#pragma once
// Quadrature weights by which the divergence theorem holds for every function of a map.

#include "sem/method/discretization.h"

namespace sem {

/// Weights of the points inside and of boundary_rule's samples, all > 0.
struct ConsistentWeights {
  Eigen::VectorXd interior, boundary;
  double defect = 0;   ///< largest of the theorem's before, relative to the sums of its terms' sizes
  bool reached = true; ///< false: none were found, and these are the ones given
};

/// With weights v inside and s on the boundary,
///   sum_k v_k grad phi_j(X_k) = sum_q s_q phi_j(Y_q) N_q   for every function phi_j.
/// Without it a rule's error in grad w is a spurious load even in a state of uniform stress (integration constraints:
/// Chen, Hillman, Rueter 2013); with it such states are exact to rounding. There the gradients are changed; that
/// changes strains, and as what neighbours get cancels only under the same stress, a thin ring under pressure
/// ovalises by percents. Here gradients stay as they are and the weights change, by the least relative entropy
/// sum_k v'_k (log(v'_k / v_k) - 1) + l sum_q ..., l = volume / area: with the multipliers' field lambda in the
/// span of the functions
///   v'_k = v_k exp(-div lambda(X_k)),   s'_q = s_q exp((lambda(Y_q) . N_q + mu) / l),
/// mu such that the weights of each part keep their sum; by Newton's method. Not reached where boundary and rule
/// contradict each other: the affine field itself violates the theorem by more than 1e-3 (gaps, overlaps), or weights
/// would have to change by more than a factor e (too few points). `d`: condensed.
template <int Dim>
ConsistentWeights consistent_weights(const Discretization<Dim>& d);

}  // namespace sem
