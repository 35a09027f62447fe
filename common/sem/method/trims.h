#pragma once
// Trimmed surfaces: loops of curves in the parameter plane, through the 2D code.

#include <memory>

#include "sem/nurbs/prepared.h"

namespace sem {

/// Throws InputError unless every loop has a curve, curves are valid, lie in the shape's domain (to
/// 1e-7 of its diagonal) and close (to 1e-6 of it). `field` names the trims in the file; the error
/// names the curve, "parts[2].trims[0].curves[1]".
template <int Dim>
void check_trims(const Nurbs<Dim - 1, Dim>& shape, const TrimLoops& trims, const std::string& file,
                 const std::string& field);

/// The region inside loops of curves, by the rule of find_loops<2>: parity of nesting decides,
/// whatever the orientation. Null without loops, hence for all curves. Throws InputError (field
/// `trims`) if the loops enclose nothing.
///
/// Rule: rays along u at Gauss points of v between the critical values of the loops, the surface's
/// knots and where loops cross its knot lines, with the end substitutions of rule_between;
/// intervals cut at knots. Strips with curved borders have at least 8 rays.
template <int Dim>
std::shared_ptr<const Region<Dim - 1, Dim>> make_region(const PreparedNurbs<Dim - 1, Dim>& part,
                                                        const TrimLoops& trims);

template <>
void check_trims<2>(const Nurbs<1, 2>&, const TrimLoops&, const std::string&, const std::string&);
template <>
void check_trims<3>(const Nurbs<2, 3>&, const TrimLoops&, const std::string&, const std::string&);
template <>
std::shared_ptr<const Region<1, 2>> make_region<2>(const PreparedNurbs<1, 2>&, const TrimLoops&);
template <>
std::shared_ptr<const Region<2, 3>> make_region<3>(const PreparedNurbs<2, 3>&, const TrimLoops&);

}  // namespace sem
