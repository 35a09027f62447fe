#pragma once
// Changes of representation that keep the map u -> X, exact to rounding.
// Every one of them replaces control points along one axis by affine
// combinations of their neighbours (the polar form of the curve).

#include <array>

#include "sem/nurbs/nurbs.h"

namespace sem {

/// Knot insertion (Boehm) along an axis, `times` times. u lies inside the
/// domain and ends up with multiplicity <= degree + 1 (assert).
template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> insert_knot(const Nurbs<ParamDim, Dim>& nurbs, int axis, double u,
                                 int times = 1);

/// Degree elevation along an axis by `times`; continuity is kept, i.e. each
/// knot of the domain is repeated once more for each degree.
template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> elevate_degree(const Nurbs<ParamDim, Dim>& nurbs, int axis, int times = 1);

/// The same NURBS with clamped ends along an axis.
template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> clamped(const Nurbs<ParamDim, Dim>& nurbs, int axis);

/// The NURBS before and after u (strictly inside the domain) along an axis,
/// each clamped there, with the parameters they had.
template <int ParamDim, int Dim>
std::array<Nurbs<ParamDim, Dim>, 2> split_at(const Nurbs<ParamDim, Dim>& nurbs, int axis, double u);

/// Runs the axis backwards over the same domain: X(u) becomes
/// X(lower + upper - u).
template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> reversed(const Nurbs<ParamDim, Dim>& nurbs, int axis);

/// Maps the domain of an axis affinely onto [lower, upper].
template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> with_domain(const Nurbs<ParamDim, Dim>& nurbs, int axis, Interval interval);

}  // namespace sem
