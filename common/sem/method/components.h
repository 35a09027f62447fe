#pragma once
// Parts of the body that lie apart from each other.

#include "sem/method/loops.h"

namespace sem {

/// A group of loops, with its parts and caps alone (in the body's order, solids numbered as there).
template <int Dim>
struct Component {
  Boundary<Dim> boundary;
  Loops<Dim> loops;
};

/// Groups the loops whose boxes meet, directly or by way of others. The union of the components'
/// insides is the body's inside.
template <int Dim>
std::vector<Component<Dim>> split_into_components(const Boundary<Dim>& boundary,
                                                  const Loops<Dim>& loops);

}  // namespace sem
