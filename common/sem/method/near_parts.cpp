#include "sem/method/near_parts.h"

#include <algorithm>
#include <cmath>

namespace sem {

template <int Dim>
NearParts<Dim>::NearParts(const Boundary<Dim>& boundary, double distance) : boundary_(boundary) {
  // Boxes and closest points are rounded.
  distance_ = distance + 1e-12 * boundary.box.diagonal();
  for (const auto& part : boundary.parts) grid_.include(part.box);
  n_.fill(1);
  size_.setZero();
  if (std::isfinite(distance)) {
    grid_.lower.array() -= distance_;
    grid_.upper.array() += distance_;
    const Vec<Dim> extent = grid_.upper - grid_.lower;
    const double even = std::pow(extent.prod() / boundary.n_parts(), 1.0 / Dim);
    for (int a = 0; a < Dim; ++a) {
      n_[a] = std::max(1, int(extent[a] / std::max(even, distance_ / 2)));
      size_[a] = extent[a] / n_[a];
    }
  }
  // The cells that a part's box meets, along each axis.
  const auto range = [&](const Box<Dim>& box, int a) {
    if (n_[a] == 1) return std::array<int, 2>{0, 0};
    const auto cell = [&](double x) {
      return std::clamp(int((x - grid_.lower[a]) / size_[a]), 0, n_[a] - 1);
    };
    return std::array<int, 2>{cell(box.lower[a] - distance_), cell(box.upper[a] + distance_)};
  };
  int n_cells = 1;
  for (const int n : n_) n_cells *= n;
  std::vector<std::vector<int>> parts(n_cells);
  for (int i = 0; i < boundary.n_parts(); ++i) {
    std::array<std::array<int, 2>, Dim> ranges;
    int n_met = 1;
    for (int a = 0; a < Dim; ++a) {
      ranges[a] = range(boundary.parts[i].box, a);
      n_met *= ranges[a][1] - ranges[a][0] + 1;
    }
    for (int k = 0; k < n_met; ++k) {
      int cell = 0;
      for (int a = 0, rest = k; a < Dim; ++a) {
        const int n = ranges[a][1] - ranges[a][0] + 1;
        cell = cell * n_[a] + ranges[a][0] + rest % n;
        rest /= n;
      }
      parts[cell].push_back(i);
    }
  }
  first_.push_back(0);
  for (const auto& list : parts) {
    part_.insert(part_.end(), list.begin(), list.end());
    first_.push_back(int(part_.size()));
  }
}

template class NearParts<2>;
template class NearParts<3>;

}  // namespace sem
