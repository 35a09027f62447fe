#include <algorithm>

#include "sem/method/critical_values.h"

namespace sem {

template <>
std::vector<double> critical_values<3>(const Boundary<3>& boundary, const Loops<3>& loops, int,
                                       int transverse_axis) {
  std::vector<double> all;
  const auto add = [&](const PreparedNurbs<2, 3>& shape) {
    if (shape.region) {
      all.push_back(shape.region->box().lower[transverse_axis]);
      all.push_back(shape.region->box().upper[transverse_axis]);
      for (const auto& border : shape.region->borders())
        for (const Vec<3>& end : {border.front(), border.back()}) all.push_back(end[transverse_axis]);
      return;
    }
    for (const auto& piece : shape.pieces) {
      all.push_back(piece.box.lower[transverse_axis]);
      all.push_back(piece.box.upper[transverse_axis]);
    }
  };
  for (const auto& part : boundary.parts) add(part);
  for (const auto& cap : loops.caps) add(cap);
  std::sort(all.begin(), all.end());
  const double rounding = 1e-12 * boundary.box.diagonal();
  std::vector<double> distinct;
  for (const double value : all)
    if (distinct.empty() || value - distinct.back() > rounding) distinct.push_back(value);
  return distinct;
}

}  // namespace sem
