#pragma once
// Where the boundary is held, for unknowns of which it is no entry: Nitsche's method on the map.
//
// With the residual r = x(X) - d(X) - X on the held part D of the boundary (components that are not
// held are left out of r), the outward rest normal N and Lame's constants of the rest shape,
//   V_D = int_D [ -P(F) N . r + beta/(2 h) (2 mu |r|^2 + lambda (r . N)^2) ] da.
// V_D is stationary at the exact solution whatever beta is (Nitsche 1971): the first term supplies
// the reaction that a penalty alone needs a gap for. beta/h must exceed what the inverse inequality
// of the functions asks for; it grows where a neo-Hookean layer is crushed below half of its
// thickness (clamps.cpp). Of materials with a pressure of their own lambda counts up to 10 mu. d is
// the displacement of the pin, d0 + D (X - center): columns of z of its own that are always pinned;
// the force on d0 is the pin's reaction. The penalty's N stays that of the rest shape where a pin
// turns: consistent, but a turned body's discrete answer differs a little from the turned answer.

#include "sem/mechanics/material.h"
#include "sem/method/discretization.h"
#include "sem/solve/symmetric_matrix.h"

namespace sem {

/// Points of the boundary at which the map is held.
template <int Dim>
struct ClampedPoints {
  Map<Dim> map;                    ///< value of x - d (the pins' columns included), gradient of x
  Points<Dim> position, normal;    ///< rest position; outward unit normal
  Eigen::VectorXd weight;          ///< da, m^(Dim-1)
  Eigen::VectorXd penalty;         ///< beta / h, 1/m
  std::vector<Material> material;  ///< #points
  Points<Dim> held;                ///< 1 where a component is held, 0 where it is free

  int size() const { return int(weight.size()); }
};

/// A control point p_j held by a spring, stiffness/2 |p_j - d - P_j|^2: for pins that hold
/// no stretch of boundary (a corner, one control point).
template <int Dim>
struct HeldControl {
  Eigen::RowVectorXd output;  ///< of p_j - d in z, n_columns
  Vec<Dim> rest;              ///< P_j, m
  Vec<Dim> held;              ///< 1 or 0 per component
  double stiffness;           ///< N/m (2D: per unit thickness)
};

/// V_D and the springs, with gradient and Hessian in z.
template <int Dim>
class Clamps {
 public:
  Clamps() = default;
  Clamps(ClampedPoints<Dim> points, std::vector<HeldControl<Dim>> controls);

  bool empty() const { return points_.size() == 0 && controls_.empty(); }
  /// Points at which the boundary is held.
  const ClampedPoints<Dim>& points() const { return points_; }

  /// +infinity where a held point is outside of its material's domain. `pressure`, here and below:
  /// Pa at the held points, in place of lambda g (material.h), NaN where it is not; null: nowhere.
  double energy(const Eigen::VectorXd& z, const double* pressure = nullptr) const;
  void add_gradient(const Eigen::VectorXd& z, Eigen::VectorXd& g,
                    const double* pressure = nullptr) const;
  /// The third derivative of Psi, which -P(F) N . r brings, by central differences of its second
  /// along r (x) N: exact to 1e-8 of a term that vanishes with r. `approximate`: without it.
  void add_hessian(const Eigen::VectorXd& z, bool approximate, SymmetricMatrix& H,
                   const double* pressure = nullptr) const;
  /// Unknowns that meet in it, for plan_elimination.
  std::vector<std::vector<int>> couplings() const;

  /// d V_D / d p at the held points, -da (dg/dF N) . r: what the clamps add to the volume's change
  /// that a pressure works on.
  Eigen::VectorXd volume_work(const Eigen::VectorXd& z) const;
  /// G += Q^T d(volume_work)/dz, Q the values of functions at the held points, #points by
  /// #functions.
  void add_volume_work_derivative(const Eigen::VectorXd& z, const Eigen::MatrixXd& Q,
                                  Eigen::MatrixXd& G) const;

 private:
  ClampedPoints<Dim> points_;
  std::vector<HeldControl<Dim>> controls_;
};

}  // namespace sem
