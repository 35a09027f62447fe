#pragma once
// Exact surfaces from curves. Equations: Piegl and Tiller, The NURBS Book, 2nd edition (P&T).
// Combinations of rational curves are those of their homogeneous control points (w X, w).

#include <vector>

#include "sem/nurbs/nurbs.h"

namespace sem::shapes3d {

using Curve = Nurbs<1, 3>;
using Patch = Nurbs<2, 3>;

/// The plane curve (x, y) as origin + x e1 + y e2.
Curve in_space(const Nurbs<1, 2>& curve, const Vec<3>& origin, const Vec<3>& e1, const Vec<3>& e2);

/// The curve under X -> A X + b.
Curve mapped(const Curve& curve, const Mat<3>& A, const Vec<3>& b);

/// The same curves on [0, 1], clamped, of one degree and one knot vector (P&T 5.2, 5.5).
std::vector<Curve> compatible(std::vector<Curve> curves);

/// (1 - v) a(u) + v b(u) (P&T 8.4).
Patch ruled(const Curve& a, const Curve& b);

/// Ruled from the curve to a point, at which the edge v = 1 is collapsed.
Patch fan(const Curve& curve, const Vec<3>& apex);

/// Ruled from the curve to the curve moved by a vector (P&T 8.3).
Patch extruded(const Curve& curve, const Vec<3>& by);

/// The curve turned about the z axis from one angle to another, rad, from < to <= from + 2 pi
/// (P&T 8.5): u along the arc, of rational quadratic pieces of at most 90 degrees, v along the
/// curve.
Patch revolved(const Curve& curve, double from, double to);

/// Sections of as many curves each: surface k is skinned through curve k of all sections (P&T 10.3,
/// homogeneous): u along the curves, v across, of the given degree (at most #sections - 1), at
/// parameters by mean chord length (eq. 10.8), the same for all k so that neighbours stay joined,
/// and averaged knots (eq. 9.8). Through every curve exactly; weights between curves whose weights
/// differ may be <= 0, which check() rejects.
std::vector<Patch> lofted(const std::vector<std::vector<Curve>>& sections, int degree);

/// Bilinearly blended Coons patch (P&T 10.6) of the curves at v = 0, v = 1, u = 0, u = 1, whose
/// ends meet with the same weights. Contains them.
Patch coons(const Curve& lower, const Curve& upper, const Curve& left, const Curve& right);

/// The parts of a patch cut at equal steps of both parameters, u running fastest.
std::vector<Patch> split(const Patch& patch, int n_u, int n_v);

/// The same patch with both degrees raised to at least this.
Patch elevated(Patch patch, int degree);

/// (cos, sin) of an angle in rad; exact at multiples of 90 degrees.
Vec<2> direction(double angle);

}  // namespace sem::shapes3d
