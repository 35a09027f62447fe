#pragma once
// Dead loads as vectors f in the unknowns: the work of the load is f . z.

#include <functional>

#include "sem/method/discretization.h"

namespace sem {

/// f += sum_k force_density(k) v_k Gamma_k: a force per rest volume, N/m^3,
/// constant direction, magnitude per point (size #points, already times v_k).
template <int Dim>
void add_body_force(const Map<Dim>& interior, const Eigen::VectorXd& magnitude,
                    const Vec<Dim>& direction, Eigen::VectorXd& f);

/// A force in N at rest point `at` (of the map). 2D: per unit thickness.
template <int Dim>
void add_point_force(const Discretization<Dim>& discretization, const Vec<Dim>& at,
                     const Vec<Dim>& force, Eigen::VectorXd& f);

/// Traction on the boundary in N/m^(Dim-1) of rest boundary, from the rest
/// position, the part and its outward unit normal; acts on the map. Integrated
/// by boundary_rule.
template <int Dim>
using Traction = std::function<Vec<Dim>(int part, const Vec<Dim>& X, const Vec<Dim>& normal)>;
/// Returns the rest measure of the boundary on which the traction is not zero.
template <int Dim>
double add_traction(const Discretization<Dim>& discretization, const Traction<Dim>& traction,
                    Eigen::VectorXd& f);

}  // namespace sem
