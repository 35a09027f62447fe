#include "sem/method/joint_patches.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sem/method/sided_weight.h"
#include "sem/nurbs/closest.h"

namespace sem {
namespace {

constexpr double radius_ratio = 0.5;      // of a level to the one before
constexpr double least_reentrant = 0.05;  // sine of the angle
constexpr double nearest = 1e-6;          // of the largest radius

// A part at a point of one of its edges (2D: ends).
template <int Dim>
struct EdgePoint {
  Vec<Dim> position, leaving;  // unit vector into the part
  double extent;               // m, to the opposite edge
};

// The part at parameter u on its edge `axis` = lower or upper end.
template <int Dim>
EdgePoint<Dim> edge_point(const PreparedNurbs<Dim - 1, Dim>& part, Param<Dim - 1> u, int axis,
                          bool upper) {
  const Interval range = domain(part.nurbs, axis);
  u[axis] = upper ? range.upper : range.lower;
  const Param<Dim - 1> regular = regular_parameter<Dim>(part.nurbs, u);
  const Vec<Dim> X = point(part, u);
  const Vec<Dim> tangent = derivatives(part.nurbs, regular, 1).first.col(axis).normalized();
  u[axis] = upper ? range.lower : range.upper;
  return {X, upper ? -tangent : tangent, (point(part, u) - X).norm()};
}

// The edge of the part that u lies on, if any.
template <int Dim>
std::optional<EdgePoint<Dim>> edge_at(const PreparedNurbs<Dim - 1, Dim>& part,
                                      const Param<Dim - 1>& u) {
  for (int axis = 0; axis < Dim - 1; ++axis) {
    const Interval range = domain(part.nurbs, axis);
    const double near = 1e-6 * (range.upper - range.lower);
    if (u[axis] - range.lower <= near) return edge_point<Dim>(part, u, axis, false);
    if (range.upper - u[axis] <= near) return edge_point<Dim>(part, u, axis, true);
  }
  return {};
}

// Points along the edge: 2D the end, 3D three. An edge that is a point has none.
template <int Dim>
std::vector<Param<Dim - 1>> points_along(const PreparedNurbs<Dim - 1, Dim>& part, int axis,
                                         bool upper, double tolerance) {
  std::vector<Param<Dim - 1>> points(1);
  const Interval range = domain(part.nurbs, axis);
  points[0][axis] = upper ? range.upper : range.lower;
  if constexpr (Dim == 3) {
    const Interval along = domain(part.nurbs, 1 - axis);
    points.assign(3, points[0]);
    for (int k = 0; k < 3; ++k)
      points[k][1 - axis] = along.lower + (k + 1) / 4. * (along.upper - along.lower);
    if ((point(part, points[0]) - point(part, points[2])).norm() <= tolerance) points.clear();
  }
  return points;
}

template <int Dim>
class JointFinder {
 public:
  JointFinder(const Boundary<Dim>& boundary, const Loops<Dim>& loops)
      : boundary_(boundary), loops_(loops), tolerance_(10 * boundary.tolerance()) {}

  struct Joint {
    double extent;
    bool reentrant;
  };

  // How parts a and b meet, along an edge of either.
  std::optional<Joint> joint(int a, int b) const {
    if (boundary_.solid[a] != boundary_.solid[b] || boundary_.parts[a].region ||
        boundary_.parts[b].region)
      return {};
    const auto &box = boundary_.parts[a].box, &other = boundary_.parts[b].box;
    if ((box.lower - other.upper).cwiseMax(other.lower - box.upper).maxCoeff() > tolerance_)
      return {};
    std::optional<Joint> found;
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)})
      for (int axis = 0; axis < Dim - 1; ++axis)
        for (const bool upper : {false, true}) {
          const auto at_edge = meet(i, axis, upper, j);
          if (!at_edge) continue;
          if (!found) found = Joint{0, false};
          found->extent = std::max(found->extent, at_edge->extent);
          found->reentrant |= at_edge->reentrant;
        }
    return found;
  }

 private:
  // The edge of part i as it lies on the border of part j.
  std::optional<Joint> meet(int i, int axis, bool upper, int j) const {
    std::optional<Joint> joint;
    for (const auto& u : points_along<Dim>(boundary_.parts[i], axis, upper, tolerance_)) {
      const auto here = edge_point<Dim>(boundary_.parts[i], u, axis, upper);
      const auto foot = closest_point(boundary_.parts[j], here.position, 2 * tolerance_);
      if (!(foot.distance <= tolerance_)) return {};
      const auto there = edge_at<Dim>(boundary_.parts[j], foot.u);
      if (!there) return {};
      if (!joint) joint = Joint{0, false};
      joint->extent = std::max({joint->extent, here.extent, there->extent});
      joint->reentrant |= inward_normal(i, u).dot(there->leaving) < -least_reentrant ||
                          inward_normal(j, foot.u).dot(here.leaving) < -least_reentrant;
    }
    return joint;
  }

  Vec<Dim> inward_normal(int i, const Param<Dim - 1>& u) const {
    return -loops_.orientation[i] * unit_normal<Dim>(boundary_.parts[i].nurbs, u);
  }

  const Boundary<Dim>& boundary_;
  const Loops<Dim>& loops_;
  const double tolerance_;
};

// How far X lies inside at a joint, with its gradient if asked for.
template <int Dim>
SideStep<Dim> joint_side(const JointPatch& patch, const SideStep<Dim>& a, const SideStep<Dim>& b) {
  if (patch.reentrant)
    return {1 - (1 - a.value) * (1 - b.value),
            (1 - b.value) * a.gradient + (1 - a.value) * b.gradient};
  return {a.value * b.value, b.value * a.gradient + a.value * b.gradient};
}

}  // namespace

template <int Dim>
std::vector<JointPatch> find_joint_patches(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                           const std::vector<int>& condition, double cutoff,
                                           int n_levels) {
  std::vector<JointPatch> patches;
  if (n_levels == 0) return patches;
  const JointFinder<Dim> finder(boundary, loops);
  for (int a = 0; a < boundary.n_parts(); ++a)
    for (int b = a + 1; b < boundary.n_parts(); ++b) {
      const auto joint = finder.joint(a, b);
      const bool changes = !condition.empty() && condition[a] != condition[b];
      if (!joint || !(joint->reentrant || changes)) continue;
      double radius = std::min(cutoff, 2 * joint->extent);
      const int n = joint->reentrant ? n_levels + n_levels / 2 : n_levels;
      for (int level = 0; level < n; ++level, radius *= radius_ratio)
        patches.push_back({a, b, radius, level, joint->reentrant});
    }
  return patches;
}

template <int Dim>
void add_joint_patches(const std::vector<JointPatch>& patches, const Boundary<Dim>& boundary,
                       const Distances<Dim>& distances, const Points<Dim>& position,
                       DistanceWeights<Dim>& theta) {
  if (patches.empty()) return;
  const bool with_gradient = !theta.gradient.empty(), sided = !distances.side.empty();
  // Patches come by their part a: where those of each begin.
  std::vector<int> first(boundary.n_parts() + 1, 0);
  for (const auto& patch : patches) ++first[patch.a + 1];
  for (int i = 0; i < boundary.n_parts(); ++i) first[i + 1] += first[i];

  DistanceWeights<Dim> all;
  all.cutoff = theta.cutoff;
  all.side_ramp = theta.side_ramp;
  all.n_parts = theta.n_parts + int(patches.size());
  all.begin.push_back(0);
  const auto side_of = [&](int pair, const Vec<Dim>& X) -> SideStep<Dim> {
    if (!sided) return {1, Vec<Dim>::Zero()};
    if (!with_gradient)
      return {side_step(distances.side[pair], theta.side_ramp).value, Vec<Dim>::Zero()};
    return side_at(boundary.parts[distances.part[pair]], distances, pair, X, theta.side_ramp);
  };
  for (int k = 0; k < position.cols(); ++k) {
    const Vec<Dim> X = position.col(k);
    all.append_row(theta, k);
    const int begin = distances.begin[k], end = distances.begin[k + 1];
    for (int at_a = begin; at_a < end; ++at_a) {
      const int a = distances.part[at_a];
      for (int p = first[a]; p < first[a + 1];) {
        const int joint = p;
        const auto& largest = patches[joint];
        while (p < first[a + 1] && patches[p].b == largest.b) ++p;
        const auto found =
            std::find(distances.part.begin() + at_a, distances.part.begin() + end, largest.b);
        const int at_b = int(found - distances.part.begin());
        if (at_b == end) continue;
        const double r = std::hypot(distances.closest[at_a], distances.closest[at_b]);
        if (!(r < largest.radius)) continue;
        const SideStep<Dim> side = joint_side(largest, side_of(at_a, X), side_of(at_b, X));
        if (!(side.value > 0)) continue;
        const double cut = std::max(r, nearest * largest.radius);
        const Vec<Dim> offset = 2 * X - distances.foot[at_a] - distances.foot[at_b];  // r grad r
        for (int q = joint; q < p; ++q) {
          const double t = cut / patches[q].radius, s = 1 - t;
          if (!(s > 0)) break;
          const double profile = s * s * s * s / (t * t),
                       slope = -(4 * t + 2 * s) * s * s * s / (t * t * t);
          all.part.push_back(theta.n_parts + q);
          all.theta.push_back(side.value * profile);
          all.piece.push_back(-1);
          if (with_gradient)
            all.gradient.push_back(profile * side.gradient +
                                   side.value * slope / (patches[q].radius * cut) * offset);
        }
      }
    }
    all.begin.push_back(int(all.part.size()));
  }
  theta = std::move(all);
}

template <int Dim>
Box<Dim> support_of(const JointPatch& patch, const Boundary<Dim>& boundary) {
  const auto &a = boundary.parts[patch.a].box, &b = boundary.parts[patch.b].box;
  Box<Dim> box;
  box.lower =
      (a.lower.cwiseMax(b.lower).array() - patch.radius).matrix().cwiseMax(boundary.box.lower);
  box.upper =
      (a.upper.cwiseMin(b.upper).array() + patch.radius).matrix().cwiseMin(boundary.box.upper);
  return box;
}

#define SEM_INSTANTIATE(Dim)                                                                 \
  template std::vector<JointPatch> find_joint_patches<Dim>(                                  \
      const Boundary<Dim>&, const Loops<Dim>&, const std::vector<int>&, double, int);        \
  template void add_joint_patches<Dim>(const std::vector<JointPatch>&, const Boundary<Dim>&, \
                                       const Distances<Dim>&, const Points<Dim>&,            \
                                       DistanceWeights<Dim>&);                               \
  template Box<Dim> support_of<Dim>(const JointPatch&, const Boundary<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
