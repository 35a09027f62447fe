#pragma once
// Rational basis functions of a NURBS and what follows from them: the sparse
// row J(u) of the D-NURBS Jacobian, points and derivatives.

#include <array>
#include <vector>

#include "sem/nurbs/nurbs.h"

namespace sem {

/// Number of second derivatives: uu (curve); uu, uv, vv (surface).
template <int ParamDim>
constexpr int n_second = ParamDim*(ParamDim + 1) / 2;

/// Basis values at one parameter. Position there = sum_k value[k] *
/// control_points.col(column[k]); the same with `first` and `second` for
/// the derivatives. All vectors have prod (degree + 1) entries, or none for
/// an order that was not asked for.
template <int ParamDim>
struct BasisValues {
  std::vector<int> column;                                     ///< control points, u fastest
  std::vector<double> value;                                   ///< R_k(u), sums to 1
  std::array<std::vector<double>, ParamDim> first;             ///< d/du, d/dv
  std::array<std::vector<double>, n_second<ParamDim>> second;  ///< uu, uv, vv
};

/// The basis functions that do not vanish at u and their derivatives up to
/// `order` (0 to 2): J(u) of draft eq. 9. At a knot the right limit, at the
/// end of the domain the left limit; u outside the domain is moved to its
/// end. Does not allocate once `out` has been used for this NURBS.
template <int ParamDim, int Dim>
void evaluate_basis(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u, int order,
                    BasisValues<ParamDim>& out);

/// Position and derivatives at one parameter.
template <int ParamDim, int Dim>
struct Derivatives {
  Vec<Dim> point;
  Eigen::Matrix<double, Dim, ParamDim> first;       ///< dX/du, dX/dv
  std::array<Vec<Dim>, n_second<ParamDim>> second;  ///< uu, uv, vv
};

/// Position at u, same conventions as evaluate_basis. Does not allocate.
template <int ParamDim, int Dim>
Vec<Dim> point(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u);

/// Position and derivatives up to `order` (0 to 2; higher ones are set to 0),
/// same conventions. Does not allocate.
template <int ParamDim, int Dim>
Derivatives<ParamDim, Dim> derivatives(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u,
                                       int order = 2);

}  // namespace sem
