#include "sem/scene/selection.h"

#include <algorithm>
#include <set>

#include "sem/base/error.h"

namespace sem {

template <int Dim>
std::vector<PartInfo> part_infos(const Scene<Dim>& scene) {
  std::vector<PartInfo> infos;
  for (const auto& solid : scene.solids)
    for (const auto& part : solid.parts) {
      const Material* own = part.material ? &*part.material : nullptr;
      infos.push_back({solid.name, part.name, own, own ? own : &solid.material});
    }
  return infos;
}

bool matches_part(const std::string& selected, const PartInfo& part) {
  // A half "top.2~1" answers to the name of the whole, "top.2".
  const std::string whole = part.name.substr(0, part.name.find('~'));
  const auto is_group = [&](const std::string& name) {
    return whole.starts_with(name) && (whole.size() == name.size() || whole[name.size()] == '.');
  };
  const bool in_solid = selected.starts_with(part.solid + "/");
  const std::string name = in_solid ? selected.substr(part.solid.size() + 1) : selected;
  return name == part.name || is_group(name) || selected == part.name || is_group(selected);
}

template <int Dim>
bool in_box(const Box<Dim>& box, const Vec<Dim>& X, double tolerance) {
  return ((X - box.lower).array() >= -tolerance).all() && ((box.upper - X).array() >= -tolerance).all();
}

template <int Dim>
bool selects_all(const Selector<Dim>& where, const PartInfo& part, const Nurbs<Dim - 1, Dim>& shape, double tolerance) {
  if (!where.part.empty() && !matches_part(where.part, part)) return false;
  const std::set<int> listed(where.control_points.begin(), where.control_points.end());
  if (!listed.empty() && int(listed.size()) < int(shape.control_points.cols())) return false;
  if (!where.box) return true;
  for (int c = 0; c < int(shape.control_points.cols()); ++c)
    if (!in_box(*where.box, Vec<Dim>(shape.control_points.col(c)), tolerance)) return false;
  return true;
}

template <int Dim>
std::vector<int> select_controls(const Boundary<Dim>& boundary, const std::vector<PartInfo>& parts,
                                 const Selector<Dim>& where, const std::string& file, const std::string& field) {
  const Points<Dim> p = rest_controls(boundary);
  std::set<int> controls;
  for (int i = 0; i < boundary.n_parts(); ++i) {
    if (!where.part.empty() && !matches_part(where.part, parts[i])) continue;
    const int n = boundary.first_control[i + 1] - boundary.first_control[i];
    for (const int index : where.control_points)
      if (index < 0 || index >= n)
        throw InputError(file, field + ".control_points", std::to_string(index),
                         "0 to " + std::to_string(n - 1) + " for part '" + parts[i].name + "'");
    for (int c = 0; c < n; ++c) {
      const bool listed = where.control_points.empty() ||
                          std::count(where.control_points.begin(), where.control_points.end(), c);
      const int control = boundary.first_control[i] + c;
      if (listed && (!where.box || in_box(*where.box, Vec<Dim>(p.col(control)), boundary.tolerance())))
        controls.insert(control);
    }
  }
  for (const auto& group : coincident_controls(boundary))
    if (std::any_of(group.begin(), group.end(), [&](int c) { return controls.count(c) > 0; }))
      controls.insert(group.begin(), group.end());
  return {controls.begin(), controls.end()};
}

#define SEM_INSTANTIATE(Dim)                                                                          \
  template std::vector<PartInfo> part_infos<Dim>(const Scene<Dim>&);                                   \
  template bool in_box<Dim>(const Box<Dim>&, const Vec<Dim>&, double);                                 \
  template bool selects_all<Dim>(const Selector<Dim>&, const PartInfo&, const Nurbs<Dim - 1, Dim>&, double);           \
  template std::vector<int> select_controls<Dim>(const Boundary<Dim>&, const std::vector<PartInfo>&,   \
                                                 const Selector<Dim>&, const std::string&, const std::string&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
