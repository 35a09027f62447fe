#pragma once
// A manufactured solution: a smooth displacement whose body force and traction are applied to a
// free body. No clamp, no corner singularity: what is left of the error is the map's and the
// quadrature's.

#include <array>

#include "sem/scene/model.h"

namespace sem {

/// u_a = product over the axes b of f_ab(k X_b), m: a row of sines and exponentials a component; 2D
/// (plane strain) has the upper left corner of the table,
///   sin s         cos 0.7 s         cos(0.5 s + 0.2)
///   exp(s / 2)    sin(s + 0.3)      cos 0.6 s
///   cos 0.8 s     sin(0.5 s + 0.4)  exp(-s / 2)
template <int Dim>
struct Manufactured {
  Material material{MaterialModel::linear, 1, 0.3, 0};
  double wave_number = 2;  ///< k, 1/m
  int taylor =
      0;  ///< 1, 2: in place of u its Taylor polynomial about X = 0 of this order, for patch tests

  Vec<Dim> displacement(const Vec<Dim>& X) const;  ///< u, m
  Mat<Dim> gradient(const Vec<Dim>& X) const;      ///< du/dX
  Mat<Dim> stress(const Vec<Dim>& X) const;        ///< first Piola stress, Pa
  Vec<Dim> traction(const Vec<Dim>& X, const Vec<Dim>& N) const { return stress(X) * N; }  ///< Pa
  /// -div stress, N/m^3, by the chain rule through the material's dP/dF.
  Vec<Dim> body_force(const Vec<Dim>& X) const;
};

/// What a discretised free body makes of it.
struct ManufacturedSolution {
  Eigen::VectorXd u;        ///< of z, with the mean displacement and rotation of the exact one
  double energy = 0;        ///< relative error in the energy norm, |F(u) - du/dX|_E / |du/dX|_E
  double displacement = 0;  ///< relative error in L2, of x(X) - X
};

/// f of the body force and traction: their work on u is f . u.
template <int Dim>
Eigen::VectorXd manufactured_load(const Discretization<Dim>& body, const Manufactured<Dim>& exact);
/// f of the exact stress: f . u = int stress : F(u). Equal to the load wherever F is the gradient
/// of the map and the map does not jump; the u that solves K u = f is then, in any case, the one
/// nearest to the exact solution in the energy norm.
template <int Dim>
Eigen::VectorXd manufactured_stress(const Discretization<Dim>& body,
                                    const Manufactured<Dim>& exact);

/// The least 1/2 u . K u - f . u, K = V'' of a linear material at rest. F(u) is that of
/// body.interior. Throws std::runtime_error if K has a kernel beside rigid motions.
template <int Dim>
ManufacturedSolution solve_manufactured(const Discretization<Dim>& body, Potential& V,
                                        const Eigen::VectorXd& f, const Manufactured<Dim>& exact);

struct ManufacturedError {
  double energy = 0, displacement = 0;  ///< as above
  int n_unknowns = 0, n_points = 0;
};

/// Solves for it on a body without pins by either formulation.
template <int Dim>
ManufacturedError solve_manufactured(const std::vector<ScenePart<Dim>>& parts,
                                     const MethodOptions& method,
                                     const Manufactured<Dim>& exact = {});

}  // namespace sem
