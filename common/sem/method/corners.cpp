#include "sem/method/corners.h"

#include <algorithm>
#include <cmath>

#include "sem/method/sided_weight.h"
#include "sem/nurbs/closest.h"

namespace sem {
namespace {

constexpr double next_level = 0.3;

// A part at one of its ends.
struct PartEnd {
  Vec<2> point, inward_normal,
      leaving;   // `leaving`: unit tangent away from the end, along the part
  double reach;  // distance to the part's other end
};

std::vector<PartEnd> ends_of_parts(const Boundary<2>& boundary, const Loops<2>& loops) {
  std::vector<PartEnd> ends;
  for (int i = 0; i < boundary.n_parts(); ++i) {
    const auto& shape = boundary.parts[i].nurbs;
    const Interval u = domain(shape, 0);
    const auto lower = derivatives(shape, Param<1>(u.lower), 1),
               upper = derivatives(shape, Param<1>(u.upper), 1);
    const double reach = (upper.point - lower.point).norm();
    for (const bool at_upper : {false, true}) {
      const auto& at = at_upper ? upper : lower;
      const Vec<2> tangent = (at_upper ? -1 : 1) * Vec<2>(at.first).normalized();
      ends.push_back(
          {at.point,
           -loops.orientation[i] * unit_normal<2>(shape, Param<1>(at_upper ? u.upper : u.lower)),
           tangent, reach});
    }
  }
  return ends;
}

double distance_to_others(const Boundary<2>& boundary, const Vec<2>& corner, double tolerance) {
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& part : boundary.parts) {
    const double d = closest_point(part, corner, distance).distance;
    if (d > tolerance) distance = std::min(distance, d);
  }
  return distance;
}

}  // namespace

template <>
std::vector<CornerPatch<2>> find_corners<2>(const Boundary<2>& boundary, const Loops<2>& loops,
                                            double cutoff, int n_levels) {
  std::vector<CornerPatch<2>> corners;
  if (n_levels == 0) return corners;
  const double tolerance = 10 * boundary.tolerance();
  const auto ends = ends_of_parts(boundary, loops);
  std::vector<bool> done(ends.size(), false);
  for (size_t i = 0; i < ends.size(); ++i) {
    if (done[i]) continue;
    double radius = cutoff;
    bool reentrant = false;
    for (size_t j = i; j < ends.size(); ++j) {
      if ((ends[j].point - ends[i].point).norm() > tolerance) continue;
      done[j] = true;
      radius = std::min(radius, ends[j].reach > tolerance ? ends[j].reach : std::numeric_limits<double>::infinity());
      for (size_t k = i; k < ends.size(); ++k)
        reentrant |= k != j && (ends[k].point - ends[i].point).norm() <= tolerance &&
                     ends[j].inward_normal.dot(ends[k].leaving) < -0.05;
    }
    if (!reentrant) continue;
    radius = std::min(radius, distance_to_others(boundary, ends[i].point, tolerance));
    for (int level = 0; level < n_levels; ++level, radius *= next_level)
      corners.push_back({ends[i].point, radius});
  }
  return corners;
}

template <>
std::vector<CornerPatch<3>> find_corners<3>(const Boundary<3>&, const Loops<3>&, double, int) {
  return {};
}

template <int Dim>
void add_corners(const std::vector<CornerPatch<Dim>>& corners, const Points<Dim>& position,
                 DistanceWeights<Dim>& theta) {
  if (corners.empty()) return;
  const bool with_gradient = !theta.gradient.empty();
  DistanceWeights<Dim> all;
  all.cutoff = theta.cutoff;
  all.side_ramp = theta.side_ramp;
  all.n_parts = theta.n_parts + int(corners.size());
  all.begin.push_back(0);
  for (int k = 0; k < position.cols(); ++k) {
    for (int e = theta.begin[k]; e < theta.begin[k + 1]; ++e) {
      all.part.push_back(theta.part[e]);
      all.theta.push_back(theta.theta[e]);
      all.piece.push_back(theta.piece[e]);
      if (with_gradient) all.gradient.push_back(theta.gradient[e]);
    }
    for (size_t c = 0; c < corners.size(); ++c) {
      const Vec<Dim> r = position.col(k) - corners[c].center;
      // At the corner itself theta is infinite; from 1e-6 of the radius on all other weights are
      // rounding.
      const double t = std::max(r.norm() / corners[c].radius, 1e-6), s = 1 - t;
      if (!(s > 0)) continue;
      const double slope = -(4 * t + 2 * s) * s * s * s / (t * t * t);
      all.part.push_back(theta.n_parts + int(c));
      all.theta.push_back(s * s * s * s / (t * t));
      all.piece.push_back(-1);
      if (with_gradient)
        all.gradient.push_back(slope / (t * corners[c].radius * corners[c].radius) * r);
    }
    all.begin.push_back(int(all.part.size()));
  }
  theta = std::move(all);
}

template void add_corners<2>(const std::vector<CornerPatch<2>>&, const Points<2>&,
                             DistanceWeights<2>&);
template void add_corners<3>(const std::vector<CornerPatch<3>>&, const Points<3>&,
                             DistanceWeights<3>&);

}  // namespace sem
