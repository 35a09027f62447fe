#pragma once
// Which parts lie near a point, without a look at all of them.

#include <algorithm>
#include <array>
#include <vector>

#include "sem/method/boundary.h"

namespace sem {

/// A uniform grid over the parts' boxes, each larger by a distance on all sides.
template <int Dim>
class NearParts {
 public:
  /// `distance` > 0, m, may be infinite. The boundary must outlive this. About as many cells as
  /// parts, none smaller than half the distance.
  NearParts(const Boundary<Dim>& boundary, double distance);

  /// Calls visit(part), ascending, for every part whose box is within the distance of X: all parts
  /// that have a point as near, and closed parts around X.
  template <class Visit>
  void visit(const Vec<Dim>& X, const Visit& visit) const {
    int cell = 0;
    for (int a = 0; a < Dim; ++a) {
      const double at = n_[a] > 1 ? (X[a] - grid_.lower[a]) / size_[a] : 0;
      if (!(at >= 0 && at <= n_[a])) return;
      cell = cell * n_[a] + std::min(int(at), n_[a] - 1);
    }
    for (int k = first_[cell]; k < first_[cell + 1]; ++k)
      if (is_near(boundary_.parts[part_[k]].box, X)) visit(part_[k]);
  }

 private:
  bool is_near(const Box<Dim>& box, const Vec<Dim>& X) const {
    return (box.lower - X).cwiseMax(X - box.upper).cwiseMax(0).squaredNorm() <=
           distance_ * distance_;
  }

  const Boundary<Dim>& boundary_;
  double distance_;
  Box<Dim> grid_;
  std::array<int, Dim> n_;         // cells along each axis
  Vec<Dim> size_;                  // of a cell
  std::vector<int> first_, part_;  // of each cell: where its parts start
};

}  // namespace sem
