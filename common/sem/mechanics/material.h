#pragma once
// Hyperelastic materials: energy density, stress and stress derivative.
//
// Conventions: F = dx/dX, J = det F, strain energy Psi per rest volume, P =
// dPsi/dF (first Piola stress). In 2D plane strain per unit thickness: F is
// completed by F33 = 1, so that tr F^T F counts 1 more than its in-plane part.
//
// With lambda = E nu / ((1+nu)(1-2nu)), mu = E / (2(1+nu)), j = J - 1:
//   linear     lambda/2 tr(e)^2 + mu e:e,  e = sym(F - I); not rotation invariant
//   stvk       lambda/2 tr(E)^2 + mu E:E,  E = (F^T F - I) / 2
//   corotated  mu |F - R|^2 + lambda/2 j^2, R = rotation nearest to F (Stomakhin et al. 2012)
//   neo_log    mu/2 (tr F^T F - 3) - mu ln J + lambda/2 (ln J)^2
//   neo_ref    mu/2 (tr F^T F - 3 - 2 ln J) + lambda/2 j^2
//   neo_iso    mu/2 (J^(-2/3) tr F^T F - 3) + lambda/2 j^2
// At F = I all have the Hessian of linear elasticity with (lambda, mu), except
// neo_iso: there lambda is the bulk modulus, so the Hessian is that of linear
// elasticity with (lambda - 2/3 mu, mu).
//
// Domain: the three neo-Hookean models need J > 0. At J <= 0 their energy is
// +infinity (line searches reject it); stress and derivative must not be
// called there (assert). The others are defined for every F.

#include <string>

#include "sem/base/dim.h"

namespace sem {

enum class MaterialModel { linear, stvk, corotated, neo_log, neo_ref, neo_iso };

/// "linear", "stvk", "corotated", "neo_log", "neo_ref", "neo_iso".
const char* name(MaterialModel model);

/// Inverse of name(). Throws InputError(file, field, ...) for an unknown name.
MaterialModel material_model(const std::string& text, const std::string& file = "",
                             const std::string& field = "model");

struct Material {
  MaterialModel model = MaterialModel::neo_log;
  double youngs_modulus = 1e5;  ///< E > 0, Pa
  double poisson_ratio = 0.3;   ///< -1 < nu < 0.5
  double density = 1000;        ///< rho >= 0, kg/m^3

  double lame_lambda() const {
    return youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
  double lame_mu() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
};

/// Throws InputError naming `field`.youngs_modulus, .poisson_ratio or .density
/// unless E > 0, -1 < nu < 0.5, rho >= 0, all finite.
void check(const Material& material, const std::string& file, const std::string& field);

/// True if the energy is quadratic in F: the stiffness is constant.
bool is_quadratic(MaterialModel model);

/// d vec(P) / d vec(F), Dim^2 by Dim^2, symmetric; vec stacks columns: F_ij is
/// entry i + Dim j.
template <int Dim>
using StressDerivative = Eigen::Matrix<double, Dim * Dim, Dim * Dim>;

/// Psi(F), J/m^3; accurate relative to its own size for F near I. +infinity
/// outside the model's domain.
///
/// Here and below, `pressure` p (Pa, positive in tension) that is given takes the place of lambda g
/// (volume_measure): Psi - lambda/2 g^2 + p g and its derivatives at fixed p, what a mixed energy is made of.
template <int Dim>
double energy_density(const Material& material, const Mat<Dim>& F, const double* pressure = nullptr);

/// P = dPsi/dF, Pa.
template <int Dim>
Mat<Dim> first_piola(const Material& material, const Mat<Dim>& F, const double* pressure = nullptr);

/// dP/dF, Pa. Corotated: at the F where the nearest rotation is not unique the
/// derivative is unbounded; it is limited (finite, not exact) there.
template <int Dim>
StressDerivative<Dim> stress_derivative(const Material& material, const Mat<Dim>& F,
                                        const double* pressure = nullptr);

/// Every model's energy contains lambda/2 g(F)^2 with a measure g of the volume's change, 0 at rest:
/// tr e (linear), tr E (stvk), ln J (neo_log), J - 1 (the others). g with its derivatives by vec(F).
template <int Dim>
struct VolumeMeasure {
  double value;
  Mat<Dim> first;
  StressDerivative<Dim> second;
};
/// Needs J > 0 for neo_log.
template <int Dim>
VolumeMeasure<Dim> volume_measure(MaterialModel model, const Mat<Dim>& F);

/// The nearest positive semi-definite matrix in the Frobenius norm: negative
/// eigenvalues of the symmetric H are set to zero. Call as project_to_psd<Dim>(H).
template <int Dim>
StressDerivative<Dim> project_to_psd(const StressDerivative<Dim>& H);

/// Cauchy stress P F^T / J, Pa (in-plane part in 2D); linear: the stress of the
/// small strain, which is P. Needs J != 0 unless linear.
template <int Dim>
Mat<Dim> cauchy_stress(const Material& material, const Mat<Dim>& F, const double* pressure = nullptr);

}  // namespace sem
