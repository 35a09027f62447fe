#pragma once
// A manufactured solution: a smooth displacement of linear elasticity whose body force and traction are
// applied to a free body. No clamp, no corner singularity: what is left of the error is the map's and the
// quadrature's.

#include "sem/scene/model.h"

namespace sem::baseline {

/// u = (sin(k x) cos(0.7 k y), exp(k x / 2) sin(k y + 0.3)) m, plane strain.
struct Manufactured {
  Material material{MaterialModel::linear, 1, 0.3, 0};
  double wave_number = 2;  ///< k, 1/m

  Vec<2> displacement(const Vec<2>& X) const;  ///< u, m
  Mat<2> gradient(const Vec<2>& X) const;    ///< du/dX
  Mat<2> stress(const Vec<2>& X) const;      ///< Pa
  Vec<2> body_force(const Vec<2>& X) const;  ///< -div stress, N/m^3
};

/// Bodies for it, of cubic parts: the unit square with m parts a side; the L that is left without its upper
/// right quarter, m parts on sides of 0.5 m, 2m on the two long ones.
std::vector<ScenePart<2>> manufactured_body(bool convex, int m);

/// What a discretised free body makes of it.
struct ManufacturedSolution {
  Eigen::VectorXd u;  ///< of z, with the mean displacement and rotation of the exact one
  double energy = 0;  ///< relative error in the energy norm, |F(u) - du/dX|_E / |du/dX|_E
};

/// f of the body force and traction: their work on u is f . u.
Eigen::VectorXd manufactured_load(const Discretization<2>& body, const Manufactured& exact);
/// f of the exact stress: f . u = int stress : F(u). Equal to the load wherever F is the gradient of the map
/// and the map does not jump; the u that solves K u = f is then, in any case, the one nearest to the exact
/// solution in the energy norm.
Eigen::VectorXd manufactured_stress(const Discretization<2>& body, const Manufactured& exact);

/// The least 1/2 u . K u - f . u, K = V'' of a linear material at rest. F(u) is that of body.interior. Throws
/// std::runtime_error if K has a kernel beside rigid motions.
ManufacturedSolution solve_manufactured(const Discretization<2>& body, Potential& V, const Eigen::VectorXd& f,
                                        const Manufactured& exact);

struct ManufacturedError {
  double energy = 0;  ///< as above
  int n_unknowns = 0, n_points = 0;
};

/// Solves for it on a body without pins by either formulation.
ManufacturedError solve_manufactured(const std::vector<ScenePart<2>>& parts, const MethodOptions& method,
                                     const Manufactured& exact = {});

}  // namespace sem::baseline
