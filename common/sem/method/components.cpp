#include "sem/method/components.h"

#include <numeric>

namespace sem {
namespace {

template <int Dim>
std::vector<Box<Dim>> boxes_of_loops(const Boundary<Dim>& boundary, const Loops<Dim>& loops) {
  std::vector<Box<Dim>> boxes(loops.loops.size());
  for (size_t l = 0; l < boxes.size(); ++l) {
    for (const int part : loops.loops[l].parts) boxes[l].include(boundary.parts[part].box);
    for (const int cap : loops.loops[l].caps) boxes[l].include(loops.caps[cap].box);
  }
  return boxes;
}

// The lowest loop of the group of each.
template <int Dim>
std::vector<int> group_of_loop(const std::vector<Box<Dim>>& boxes) {
  std::vector<int> group(boxes.size());
  std::iota(group.begin(), group.end(), 0);
  const auto meet = [](const Box<Dim>& a, const Box<Dim>& b) {
    return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
  };
  for (size_t a = 0; a < boxes.size(); ++a)
    for (size_t b = 0; b < a; ++b) {
      if (group[a] == group[b] || !meet(boxes[a], boxes[b])) continue;
      const int kept = std::min(group[a], group[b]), merged = std::max(group[a], group[b]);
      for (int& g : group)
        if (g == merged) g = kept;
    }
  return group;
}

template <int Dim>
void append_loop(const Boundary<Dim>& boundary, const Loops<Dim>& loops, const Loop<Dim>& loop,
                 Component<Dim>& out) {
  Loop<Dim> copy = loop;
  for (int& part : copy.parts) {
    out.boundary.parts.push_back(boundary.parts[part]);
    out.boundary.solid.push_back(boundary.solid[part]);
    const int n_controls = boundary.first_control[part + 1] - boundary.first_control[part];
    out.boundary.first_control.push_back(out.boundary.first_control.back() + n_controls);
    out.boundary.box.include(boundary.parts[part].box);
    out.loops.orientation.push_back(loops.orientation[part]);
    part = out.boundary.n_parts() - 1;
  }
  for (int& cap : copy.caps) {
    out.loops.caps.push_back(loops.caps[cap]);
    out.loops.cap_length.push_back(loops.cap_length[cap]);
    out.loops.cap_orientation.push_back(loops.cap_orientation[cap]);
    cap = int(out.loops.caps.size()) - 1;
  }
  out.loops.loops.push_back(std::move(copy));
}

}  // namespace

template <int Dim>
std::vector<Component<Dim>> split_into_components(const Boundary<Dim>& boundary,
                                                  const Loops<Dim>& loops) {
  const auto group = group_of_loop(boxes_of_loops(boundary, loops));
  std::vector<Component<Dim>> components;
  for (int first = 0; first < int(group.size()); ++first) {
    if (group[first] != first) continue;
    auto& component = components.emplace_back();
    component.boundary.n_solids = boundary.n_solids;
    component.boundary.first_control = {0};
    for (size_t l = first; l < group.size(); ++l)
      if (group[l] == first) append_loop(boundary, loops, loops.loops[l], component);
    Box<Dim>& box = component.boundary.box;
    box.lower = box.lower.cwiseMax(boundary.box.lower);  // closer than the parts' control points
    box.upper = box.upper.cwiseMin(boundary.box.upper);
    component.loops.longest_gap = loops.longest_gap;
    component.loops.n_gaps = loops.n_gaps;
    component.loops.n_free_borders = loops.n_free_borders;
  }
  return components;
}

template std::vector<Component<2>> split_into_components<2>(const Boundary<2>&, const Loops<2>&);
template std::vector<Component<3>> split_into_components<3>(const Boundary<3>&, const Loops<3>&);

}  // namespace sem
