#pragma once
// Which parts and control points of a body a scene's selectors mean.

#include <string>
#include <vector>

#include "sem/method/discretization.h"
#include "sem/scene/scene.h"

namespace sem {

/// A part of a scene; the order is that of the boundary: solid after solid.
struct PartInfo {
  std::string solid, name;
  const Material* own = nullptr;  ///< null: none of its own
  const Material* material;       ///< its own, or the solid's
};
/// Refers to the scene's materials.
template <int Dim>
std::vector<PartInfo> part_infos(const Scene<Dim>& scene);

/// True if the name, one of its groups (the text before a dot) or "solid/" and any of these is `selected`.
bool matches_part(const std::string& selected, const PartInfo& part);

/// Within the box, its sides moved outwards by a tolerance, m.
template <int Dim>
bool in_box(const Box<Dim>& box, const Vec<Dim>& X, double tolerance);

/// True if the selector means all of a part, to a tolerance of its box, m.
template <int Dim>
bool selects_all(const Selector<Dim>& where, const PartInfo& part, const Nurbs<Dim - 1, Dim>& shape, double tolerance);

/// Control points selected, with all that coincide with them, ascending. Throws InputError(file, field, ...) for
/// indices that a part does not have.
template <int Dim>
std::vector<int> select_controls(const Boundary<Dim>& boundary, const std::vector<PartInfo>& parts,
                                 const Selector<Dim>& where, const std::string& file, const std::string& field);

}  // namespace sem
