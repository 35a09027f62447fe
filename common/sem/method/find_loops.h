#pragma once
// The part of find_loops that depends on the dimension.

#include "sem/method/loops.h"

namespace sem::detail {

/// Groups the parts of every solid into loops and closes their gaps with caps
/// (2D: find_loops_2d.cpp; 3D: find_loops_3d.cpp). Fills Loops::loops (parts,
/// caps), caps, cap_length.
template <int Dim>
Loops<Dim> join_parts(const Boundary<Dim>& boundary);
template <>
Loops<2> join_parts<2>(const Boundary<2>& boundary);
template <>
Loops<3> join_parts<3>(const Boundary<3>& boundary);

}  // namespace sem::detail
