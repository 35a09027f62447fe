#pragma once
// The parts of a body as chains of points on their curves, for drawing only.

#include "sem/draw/canvas.h"
#include "sem/scene/model.h"

namespace sem {

/// Samples every part once; deformed positions then are sums over control points.
class Outline {
 public:
  explicit Outline(const Discretization<2>& discretization);

  int n_parts() const { return int(curves_.size()); }
  /// Points along a part for control points p, m.
  Polyline part(int part, const Points<2>& p) const;

  /// What encloses material, by the rule of the inside (loops.h): each region is a loop with the
  /// holes in it, to be filled by parity. Gaps are closed by straight lines. m.
  struct Region {
    int solid;
    std::vector<Polyline> loops;
  };
  std::vector<Region> regions(const Points<2>& p) const;

 private:
  // A part; point k is sum_e value[e] p[column[e]], e in [row[k], row[k+1]).
  struct Curve {
    std::vector<int> row, column;
    std::vector<double> value;
  };
  // A loop as its parts in their order along it, and whether they are run through backward.
  using Walk = std::vector<std::pair<int, bool>>;
  struct WalkRegion {
    int solid;
    std::vector<Walk> walks;
  };

  static Curve sample(const PreparedNurbs<1, 2>& part, int first_control);
  static Walk walk(const Discretization<2>& discretization, const Loop<2>& loop);
  Polyline loop(const Walk& walk, const Points<2>& p) const;

  std::vector<Curve> curves_;
  std::vector<WalkRegion> regions_;
};

}  // namespace sem
