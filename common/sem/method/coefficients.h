#pragma once
// Stage 8 of the condensed formulation: the coefficients themselves are the unknowns.
//
// The paper's projection invents what the samples of a part do not determine (on a straight edge:
// every derivative along the normal) and, with the diffuse gradient, its map does not converge.
// Here the polynomial of a part is not fitted but free,
//   x(X) = a0 + A X + sum_i w_i(X) P_i(X),   P_i in the polynomials of degree n,
// a partition-of-unity method whose functions come from the boundary alone (Babuska and Melenk
// 1997). The affine field is shared by all parts, so that rigid motions are exact to rounding; what
// makes the blended functions depend on each other and on it (sum w_i = 1) is left out.

#include "sem/method/map.h"
#include "sem/method/unknowns.h"

namespace sem {

/// The functions that became unknowns, in the form that the blended map takes.
template <int Dim>
struct FreeCoefficients {
  Origins<Dim> origins;  ///< one per part: the centroid of its weight
  Projection<Dim>
      projection;  ///< c_i and t_i are the unknowns of part i themselves and the affine field's
  Unknowns<Dim> unknowns;  ///< S empty until boundary_output
};

/// Chooses the unknowns by a Cholesky factorisation with pivots of the candidates' Gram matrix
///   G = sum_k v_k (grad phi_k . grad phi_k^T + phi_k phi_k^T / L^2),  L: size of the points' box,
/// scaled to a unit diagonal: a function is left out when the square of its distance to the span of
/// those chosen falls below `tolerance`. The affine field comes first.
/// `weights` need their gradients. `degree`: of every part of the weights; throws InputError (field
/// `method.degree`) outside 1..5.
template <int Dim>
FreeCoefficients<Dim> free_coefficients(const Points<Dim>& position, const Eigen::VectorXd& volume,
                                        const BlendingWeights<Dim>& weights, const std::vector<int>& degree,
                                        double tolerance = 1e-10);

/// Blended polynomials w_i q of a degree from 0 to `degree` of the map's, as a basis of a scalar field on the
/// same points (values only, dependent ones left out as above, by their values alone).
/// For the pressure of a mixed energy (mechanics/pressure.h).
template <int Dim>
struct BlendedField {
  Origins<Dim> origins;
  Projection<Dim> projection;
  int n_functions = 0;
};
template <int Dim>
BlendedField<Dim> blended_field(const Points<Dim>& position, const Eigen::VectorXd& volume,
                                const BlendingWeights<Dim>& weights, int degree, double tolerance = 1e-10);

/// S of p = S z: the control points follow the map, each part by least squares on its samples.
/// #control points by n. A control point that no sample determines stays in the least-norm
/// position.
template <int Dim>
Eigen::MatrixXd boundary_output(const Samples<Dim>& samples, const Map<Dim>& on_boundary,
                                int n_controls);

}  // namespace sem
