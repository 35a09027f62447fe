#pragma once
// The means against locking: a pressure of its own for materials that hardly change their volume.
//
// Near nu = 1/2 the term lambda/2 g(F)^2 (material.h) asks for g = 0 at every point, which a map with few
// unknowns can only meet by not moving. The pressure p = sum_a y_a q_a takes its place in functions q_a of
// lower degree than the map's, and the energy is its largest value over y,
//   V = sum_k v_k (Psi - lambda/2 g^2 + p g)_k + V_D(p) - 1/2 sum_k v_k p_k^2 / lambda_k
//     = sum_k v_k (Psi - lambda/2 g^2)_k + V_D(0) + 1/2 b^T M^-1 b,
//   b_a = sum_k v_k q_a g_k + dV_D/dp . q_a,   M_ab = sum_k v_k q_a q_b / lambda_k,
// where p enters the clamps' V_D through P(F): two fields (Herrmann 1965), the pressure eliminated by
// M y = b. Where g is itself a q (uniform changes of volume) nothing changes.

#include "sem/mechanics/clamps.h"
#include "sem/method/join_blocks.h"
#include "sem/solve/cholesky.h"
#include "sem/solve/symmetric_matrix.h"

namespace sem {

/// The functions q_a at the interior points and at the clamps.
template <int Dim>
struct PressureFunctions {
  Map<Dim> interior;         ///< values, blocks with the same points as those of the map of the body
  Eigen::MatrixXd on_clamps; ///< #held points by #functions
  Eigen::VectorXd lambda;    ///< at the interior points, Pa; 0: the material there keeps its own pressure
  std::vector<bool> clamp_mixed; ///< #held points: the material there takes p
};

/// Solves for the pressure and holds what energy, gradient and Hessian need of it.
template <int Dim>
class Pressure {
 public:
  Pressure() = default;
  /// weight: v_k. Functions must be independent on the points with lambda > 0.
  Pressure(PressureFunctions<Dim> functions, const Eigen::VectorXd& weight);

  /// Joins the blocks of the functions as those of the body's map (join_blocks.h).
  void join(const std::vector<std::vector<int>>& lists) { functions_.interior = joined(functions_.interior, lists); }

  bool empty() const { return functions_.interior.n_columns == 0; }

  /// From g at the interior points and the clamps' volume work.
  void solve(const Eigen::VectorXd& g, const Eigen::VectorXd& clamp_work);
  /// p at interior point k, null if the material there keeps lambda g.
  const double* at(int k) const { return functions_.lambda[k] > 0 ? &interior_[k] : nullptr; }
  /// p at the held points, NaN where the material keeps lambda g.
  const double* on_clamps() const { return on_clamps_.data(); }
  /// y of the last solve.
  const Eigen::VectorXd& coefficients() const { return y_; }
  /// 1/2 b . y
  double half_work() const { return b_.dot(y_) / 2; }

  const PressureFunctions<Dim>& functions() const { return functions_; }
  /// H += G^T M^-1 G, where every unknown meets every other; G: #functions by #entries of z.
  void add_to_hessian(const Eigen::MatrixXd& G, SymmetricMatrix& H) const;

 private:
  PressureFunctions<Dim> functions_;
  Eigen::VectorXd weight_;
  Cholesky factor_;  // of M
  Eigen::VectorXd b_, y_, interior_, on_clamps_;
};

}  // namespace sem
