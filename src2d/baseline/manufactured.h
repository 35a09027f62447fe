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

  Mat<2> gradient(const Vec<2>& X) const;    ///< du/dX
  Mat<2> stress(const Vec<2>& X) const;      ///< Pa
  Vec<2> body_force(const Vec<2>& X) const;  ///< -div stress, N/m^3
};

struct ManufacturedError {
  double energy = 0;  ///< relative error in the energy norm, |u_h - u|_E / |u|_E
  int n_unknowns = 0, n_points = 0;
};

/// Solves for it on a body with free coefficients (method.formulation condensed, no pins). Rigid motions
/// are held in the affine field.
ManufacturedError solve_manufactured(const std::vector<ScenePart<2>>& parts, const MethodOptions& method,
                                     const Manufactured& exact = {});

}  // namespace sem::baseline
