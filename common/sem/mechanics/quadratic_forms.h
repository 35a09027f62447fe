#pragma once
// The constant matrices: mass and stability (draft eq. 20-22 and section 1.7).
// Scalar, n_columns by n_columns: the same for every component, so that the
// matrix on z is the Kronecker product with the Dim by Dim identity. In the plan of an elimination, or dense.

#include "sem/mechanics/assembly.h"
#include "sem/method/samples.h"
#include "sem/method/unknowns.h"

namespace sem {

/// M = sum_k density_k v_k Gamma_k^T Gamma_k, kg (2D: per unit thickness). Its
/// entries sum to the mass of the body: Gamma reproduces translations.
template <int Dim>
SymmetricMatrix mass_matrix(const Map<Dim>& interior, const Eigen::VectorXd& point_mass,
                            const std::shared_ptr<const Elimination>& plan);
template <int Dim>
Eigen::MatrixXd mass_matrix(const Map<Dim>& interior, const Eigen::VectorXd& point_mass);

/// sum_s a_s D_s^T D_s with D_s = Gamma_s - J_s S, m^(Dim-1): the integral of |x(X(u)) - J(u) p|^2
/// over the boundary, p = S z, is the quadratic form of this matrix in z, summed over components.
/// The stability (error) energy is gamma/2 of it, the kinetic one rho l/2 of
/// the same form in the velocities.
/// It is the mass matrix of the map D with a_s in place of the mass.
template <int Dim>
Map<Dim> mismatch_map(const Map<Dim>& on_boundary, const Samples<Dim>& samples, const Unknowns<Dim>& unknowns);
template <int Dim>
Eigen::MatrixXd stability_matrix(const Map<Dim>& on_boundary, const Samples<Dim>& samples,
                                 const Unknowns<Dim>& unknowns);

/// Kronecker product with the identity of size dim: what acts on z.
Eigen::MatrixXd expand(const Eigen::MatrixXd& scalar, int dim);

}  // namespace sem
