#include "sem/method/boundary.h"

#include <numeric>

#include "sem/base/error.h"
#include "sem/method/trims.h"
#include "sem/nurbs/even_weights.h"
#include "sem/nurbs/refine.h"

namespace sem {

namespace {

// The box of a part, of its region if it is trimmed, else from the control points; from those of refined pieces where weights differ so much
// that it may stay far from some of its control points.
template <int Dim>
Box<Dim> close_box(const PreparedNurbs<Dim - 1, Dim>& part) {
  if (part.region) return part.region->box();
  const auto& weights = part.nurbs.weights;
  if (weights.maxCoeff() <= 4 * weights.minCoeff()) return part.box;
  Nurbs<Dim - 1, Dim> refined = part.nurbs;
  for (int halving = 0; halving < 4; ++halving)
    for (int axis = 0; axis < Dim - 1; ++axis)
      for (const auto& [a, b] : spans(refined, axis)) refined = insert_knot(refined, axis, (a + b) / 2);
  return prepare(refined).box;
}

}  // namespace

template <int Dim>
Boundary<Dim> make_boundary(const std::vector<std::vector<Nurbs<Dim - 1, Dim>>>& solids,
                            const std::vector<TrimLoops>& trims) {
  Boundary<Dim> boundary;
  boundary.n_solids = int(solids.size());
  boundary.first_control.push_back(0);
  for (int s = 0; s < boundary.n_solids; ++s)
    for (const auto& shape : solids[s]) {
      const bool trimmed = !trims.empty() && !trims.at(boundary.parts.size()).empty();
      auto& part = boundary.parts.emplace_back(prepare(trimmed ? shape : even_weights(shape)));
      if (!trims.empty()) part.region = make_region<Dim>(part, trims.at(boundary.parts.size() - 1));
      boundary.solid.push_back(s);
      boundary.first_control.push_back(boundary.first_control.back() +
                                       int(shape.control_points.cols()));
      boundary.box.include(close_box<Dim>(boundary.parts.back()));
    }
  if (boundary.parts.empty()) throw InputError("", "solids", "no part", "at least one part");
  return boundary;
}

template <int Dim>
Points<Dim> rest_controls(const Boundary<Dim>& boundary) {
  Points<Dim> p(Dim, boundary.n_controls());
  for (int i = 0; i < boundary.n_parts(); ++i) {
    const auto& own = boundary.parts[i].nurbs.control_points;
    p.middleCols(boundary.first_control[i], own.cols()) = own;
  }
  return p;
}

template <int Dim>
std::vector<std::vector<int>> coincident_controls(const Boundary<Dim>& boundary) {
  const Points<Dim> p = rest_controls(boundary);
  const double tolerance = boundary.tolerance();
  std::vector<int> order(p.cols());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return p(0, a) < p(0, b); });
  std::vector<bool> used(p.cols(), false);
  std::vector<std::vector<int>> groups;
  for (size_t i = 0; i < order.size(); ++i) {
    if (used[order[i]]) continue;
    std::vector<int> group = {order[i]};
    for (size_t j = i + 1; j < order.size() && p(0, order[j]) - p(0, order[i]) <= tolerance; ++j)
      if (!used[order[j]] && (p.col(order[j]) - p.col(order[i])).norm() <= tolerance) {
        group.push_back(order[j]);
        used[order[j]] = true;
      }
    if (group.size() < 2) continue;
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

#define SEM_INSTANTIATE(Dim)                                                                     \
  template Boundary<Dim> make_boundary<Dim>(                                                     \
      const std::vector<std::vector<Nurbs<Dim - 1, Dim>>>&, const std::vector<TrimLoops>&);                                     \
  template Points<Dim> rest_controls<Dim>(const Boundary<Dim>&);                                 \
  template std::vector<std::vector<int>> coincident_controls<Dim>(const Boundary<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
