#pragma once
// A NURBS whose parameter runs evenly where weights made it run unevenly.

#include "sem/nurbs/nurbs.h"

namespace sem {

/// The same set of points, with the same rational basis function for every control point, in
/// another parameter.
///
/// Along an axis with domain [0, 1], u = t / b(t) with b(t) = t + m (1 - t) runs over the same
/// curve. A denominator W(u) of degree p becomes b(t)^p W(u(t)); its polar form (Ramshaw) at t_1,
/// ..., t_p is b(t_1) ... b(t_p) times that of W at u_1, ..., u_p: knots go to t(u) = m u / (1 - u
/// + m u), and the weight of a control point is divided by the product of 1 - u_k + m u_k over its
/// p inner knots (b(t(u)) but for a factor). m = (W(1) / W(0))^(1/p) makes the weights at both ends
/// equal: weights 1, w, w^2, ... become 1, 1, 1, ....
///
/// Done along each axis whose weights at the ends differ by more than a factor of 4 (surfaces:
/// their geometric means) and whose knots all lie in its domain (clamped ends); others are left as
/// they are.
template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> even_weights(Nurbs<ParamDim, Dim> nurbs);

}  // namespace sem
