#pragma once
// What every body has to get right, whatever its shape: facts that need no reference solution.

#include "sem/scene/model.h"
#include "tests/hard_cases/case.h"
#include "tests/hard_cases/shapes.h"

namespace sem::stability {

inline constexpr Formulation both_formulations[] = {Formulation::projected, Formulation::condensed};

/// "2D projected".
template <int Dim>
std::string variant(Formulation formulation);

/// Relative bounds.
struct Bounds {
  double volume = 0;       ///< of the interior rule against the closed form, beside what the rule promises:
                           ///< ten times the tolerance of rays between critical values, the tolerance of a
                           ///< resolved rule
  double identity = 1e-8;  ///< |x(X) - X| / size, |F - I| of the undeformed map
  double energy = 1e-8;    ///< of an affine field against Psi(F) times the volume
  double fall = 1e-8;      ///< of a step's way against g dt^2 n (n + 1) / 2
  double balance = 1e-6;   ///< of the pins' force against the weight
};

/// The scene of a body: St. Venant-Kirchhoff, E = 1e5 Pa, nu = 0.3, density 1000 kg/m^3; lengths scale with
/// the body's size. Projected: the published weights with a cutoff of the size, rays between critical
/// values; condensed: sided weights, in 2D the resolved rule. Parts are named "part.1", ...
template <int Dim>
Scene<Dim> scene_of(const Body<Dim>& body, Formulation formulation);

/// A pin of all components of one part.
template <int Dim>
Pin<Dim> pin_on(const std::string& part);

/// Throws Refusal with the status' description unless it is converged.
void require(Status status, const std::string& what);

/// Deformation gradients of an affine field that stores St. Venant-Kirchhoff energy, and of a rotation.
template <int Dim>
Mat<Dim> stretch();
template <int Dim>
Mat<Dim> rotation(double angle);

/// Volume, identity, energy of an affine and of a rotated field.
template <int Dim>
void check_model(const Scene<Dim>& scene, const Model<Dim>& model, const Body<Dim>& body, const Bounds& bounds,
                 Checks& checks);

/// Three steps of free fall: every point follows the closed form of linearly implicit Euler steps.
template <int Dim>
void check_fall(Scene<Dim> scene, const Body<Dim>& body, const Bounds& bounds, Checks& checks);

/// Linear statics, held at the first part under its weight: the pin carries rho g V, the load's work is twice the
/// stored energy. Returns the mean displacement along gravity by size, for comparisons.
template <int Dim>
double check_hanging(Scene<Dim> scene, const Body<Dim>& body, const Bounds& bounds, Checks& checks);

/// All of them, with options of scene_of changed; hanging only where the body is connected (returns
/// its displacement, else 0).
template <int Dim>
double check_body(const Body<Dim>& body, Formulation formulation, const Bounds& bounds,
                  const std::function<void(MethodOptions&)>& method, Checks& checks);

}  // namespace sem::stability
