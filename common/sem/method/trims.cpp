#include "sem/method/trims.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "sem/base/error.h"
#include "sem/method/border_curves.h"
#include "sem/method/critical_values.h"
#include "sem/method/ray_columns.h"
#include "sem/nurbs/hits.h"
#include "sem/nurbs/refine.h"

namespace sem {
namespace {

constexpr double rounding_share = 1e-9;  // of the domain's diagonal
constexpr double outside_share = 1e-7;
constexpr double open_share = 1e-6;
constexpr int least_rays_of_curved = 8;

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string text(const Vec<2>& u) { return "(" + text(u[0]) + ", " + text(u[1]) + ")"; }

Box<2> domain_box(const Nurbs<2, 3>& shape) {
  Box<2> box;
  for (int axis = 0; axis < 2; ++axis) {
    box.lower[axis] = domain(shape, axis).lower;
    box.upper[axis] = domain(shape, axis).upper;
  }
  return box;
}

std::vector<Nurbs<1, 2>> all_curves(const TrimLoops& trims) {
  std::vector<Nurbs<1, 2>> curves;
  for (const auto& loop : trims) curves.insert(curves.end(), loop.begin(), loop.end());
  return curves;
}

// The shape with every span of every axis halved some times.
template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> with_halved_spans(Nurbs<ParamDim, Dim> shape, int times) {
  for (int axis = 0; axis < ParamDim; ++axis)
    for (int halving = 0; halving < times; ++halving)
      for (const auto& [a, b] : spans(shape, axis)) shape = insert_knot(shape, axis, (a + b) / 2);
  return shape;
}

// Rays along u between two values of v between which the number of intervals does not change.
struct Strip {
  double lower, upper;
  EndKind at_lower = EndKind::smooth, at_upper = EndKind::smooth;
  bool straight = true;
};

class TrimRegion : public Region<2, 3> {
 public:
  TrimRegion(const PreparedNurbs<2, 3>& surface, const TrimLoops& trims)
      : surface_(surface),
        plane_(make_boundary<2>({all_curves(trims)})),
        loops_(find_loops(plane_)),
        diagonal_(domain_box(surface.nurbs).diagonal()) {
    for (const auto& curve : plane_.parts) curves_.push_back(&curve);
    for (const auto& cap : loops_.caps) curves_.push_back(&cap);
    for (const auto* curve : curves_)
      for (const auto& piece : prepare(with_halved_spans(curve->nurbs, 3)).pieces)
        cells_.push_back(piece.box);
    border_ = detail::BorderCurves(surface_, curves_);
    for (const auto& curve : plane_.parts) borders_.push_back(images(curve));
    find_box();
    find_strips();
  }

  bool contains(const Param<2>& u) const override {
    return inside(plane_, loops_, u) || near_border(u, rounding_share);
  }

  bool near_border(const Param<2>& u, double share) const override {
    const double near = share * diagonal_;
    return std::any_of(curves_.begin(), curves_.end(), [&](const auto* curve) {
      return closest_point(*curve, u, near).distance <= near;
    });
  }

  Overlap overlap(const Param<2>& lower, const Param<2>& upper) const override {
    const double near = rounding_share * diagonal_;
    for (const auto& cell : cells_)
      if ((cell.lower.array() - near <= upper.array()).all() &&
          (lower.array() <= cell.upper.array() + near).all())
        return Overlap::some;
    return inside(plane_, loops_, Vec<2>((lower + upper) / 2)) ? Overlap::all : Overlap::none;
  }

  ClosestPoint<3> closest_on_border(const Vec<3>& X, double cutoff) const override {
    return border_.closest(surface_, curves_, X, cutoff);
  }

  BorderPoint<2> border_near(const Param<2>& u) const override {
    ClosestPoint<2> best{Param<1>(), u, std::numeric_limits<double>::infinity()};
    const PreparedNurbs<1, 2>* curve = nullptr;
    for (const auto* candidate : curves_) {
      const auto found = closest_point(*candidate, u, best.distance);
      if (!(found.distance < best.distance)) continue;
      best = found;
      curve = candidate;
    }
    const auto at = derivatives(curve->nurbs, best.u);
    return {at.point, at.first, at.second[0]};
  }

  const Box<3>& box() const override { return box_; }
  const std::vector<std::vector<Vec<3>>>& borders() const override { return borders_; }

  ParameterRule<2> rule(int n) const override {
    ParameterRule<2> result;
    const LineRule along = gauss_legendre(n);
    for (const auto& strip : strips_) {
      const int n_rays = strip.straight ? n : std::max(n, least_rays_of_curved);
      const LineRule across = rule_between(strip.at_lower, strip.at_upper, n_rays);
      std::vector<double> v;
      for (const double node : across.node)
        v.push_back(strip.lower + (strip.upper - strip.lower) * (1 + node) / 2);
      const auto rays = cast_at(v);
      for (int k = 0; k < n_rays; ++k)
        for (const auto& interval : rays[k].intervals)
          append_interval(interval, v[k], across.weight[k] * (strip.upper - strip.lower) / 2, along,
                          result);
    }
    return result;
  }

 private:
  std::vector<Vec<3>> images(const PreparedNurbs<1, 2>& curve) const {
    constexpr int n = 9;
    const Interval range = domain(curve.nurbs, 0);
    std::vector<Vec<3>> result;
    for (int k = 0; k < n; ++k) {
      const double t = k == n - 1 ? range.upper : range.lower + (range.upper - range.lower) * k / (n - 1);
      result.push_back(point(surface_, Param<2>(point(curve, Param<1>(t)))));
    }
    return result;
  }

  // Gauss points between the surface's knots.
  void append_interval(const RayInterval& interval, double v, double weight, const LineRule& along,
                       ParameterRule<2>& out) const {
    std::vector<double> ends = {interval.begin};
    for (const auto& span : surface_.spans[0])
      if (span.lower > interval.begin && span.lower < interval.end) ends.push_back(span.lower);
    ends.push_back(interval.end);
    for (size_t e = 0; e + 1 < ends.size(); ++e)
      for (size_t i = 0; i < along.node.size(); ++i) {
        const double half = (ends[e + 1] - ends[e]) / 2;
        out.u.push_back({ends[e] + half * (1 + along.node[i]), v});
        out.weight.push_back(weight * half * along.weight[i]);
      }
  }

  std::vector<Ray<2>> cast_at(const std::vector<double>& v) const {
    Rays<2> rays;
    for (const double y : v) rays.rays.push_back({Vec<2>(0, y), 1, {}, {}});
    cast(plane_, loops_, rays);
    return std::move(rays.rays);
  }

  // Values of v at which rays see something new.
  std::vector<double> strip_ends() const {
    std::vector<double> values = critical_values(plane_, loops_, 0, 1);
    const double lower = values.front(), upper = values.back(), rounding = 1e-12 * diagonal_;
    for (const auto& span : surface_.spans[1]) values.push_back(span.lower);
    std::vector<Hit<2>> hits;
    const double infinity = std::numeric_limits<double>::infinity();
    for (size_t k = 1; k < surface_.spans[0].size(); ++k)
      for (const auto* curve : curves_) {
        hits.clear();
        append_hits(*curve, Line<2>{Vec<2>(surface_.spans[0][k].lower, 0), Vec<2>::UnitY()},
                    -infinity, infinity, hits);
        for (const auto& hit : hits) values.push_back(hit.t);
      }
    std::sort(values.begin(), values.end());
    std::vector<double> ends;
    for (const double v : values)
      if (v >= lower && v <= upper && (ends.empty() || v - ends.back() > rounding))
        ends.push_back(v);
    return ends;
  }

  void find_strips() {
    const auto ends = strip_ends();
    for (size_t k = 0; k + 1 < ends.size(); ++k) {
      Strip strip{ends[k], ends[k + 1]};
      strip.at_lower = end_kind(strip, false);
      strip.at_upper = end_kind(strip, true);
      strip.straight = is_straight(strip);
      strips_.push_back(strip);
    }
  }

  // How all the intervals of a strip end: as the worst of them.
  EndKind end_kind(const Strip& strip, bool at_upper) const {
    const double d = 1e-6 * (strip.upper - strip.lower);
    std::vector<double> v;
    for (const double distance : {d, 4 * d, 16 * d})
      v.push_back(at_upper ? strip.upper - distance : strip.lower + distance);
    const auto rays = cast_at(v);
    const size_t n = rays[0].intervals.size();
    if (rays[1].intervals.size() != n || rays[2].intervals.size() != n) return EndKind::smooth;
    int n_closing = 0, n_root = 0;
    for (size_t i = 0; i < n; ++i) {
      const EndKind kind = end_kind_of(
          {rays[0].intervals[i], rays[1].intervals[i], rays[2].intervals[i]}, 1e-13 * diagonal_);
      n_closing += kind == EndKind::closing;
      n_root += kind == EndKind::root;
    }
    if (n_root + n_closing == 0) return EndKind::smooth;
    return n_closing == int(n) ? EndKind::closing : EndKind::root;
  }

  bool is_straight(const Strip& strip) const {
    const double width = strip.upper - strip.lower;
    const auto rays =
        cast_at({strip.lower + width / 4, strip.lower + width / 2, strip.upper - width / 4});
    const size_t n = rays[1].intervals.size();
    if (rays[0].intervals.size() != n || rays[2].intervals.size() != n) return false;
    for (size_t i = 0; i < n; ++i) {
      const auto &a = rays[0].intervals[i], &b = rays[1].intervals[i], &c = rays[2].intervals[i];
      const double bent =
          std::max(std::abs(a.begin + c.begin - 2 * b.begin), std::abs(a.end + c.end - 2 * b.end));
      if (bent > rounding_share * diagonal_) return false;
    }
    return true;
  }

  // A coordinate is largest on the border or where it is stationary, which it is not on a patch
  // whose control points rise strictly along a parameter.
  void find_box() {
    box_ = border_.box();
    for (const auto& piece : prepare(with_halved_spans(surface_.nurbs, 3)).pieces) {
      if (overlap(piece.lower, piece.upper) == Overlap::none) continue;
      const bool rational = piece.weights.minCoeff() < piece.weights.maxCoeff();
      for (int a = 0; a < 3; ++a)
        if (rational || !(rises(piece, a, 0) || rises(piece, a, 1))) {
          box_.lower[a] = std::min(box_.lower[a], piece.box.lower[a]);
          box_.upper[a] = std::max(box_.upper[a], piece.box.upper[a]);
        }
    }
  }

  // Whether a coordinate rises, or falls, strictly along a parameter.
  static bool rises(const BezierPiece<2, 3>& piece, int coordinate, int axis) {
    const int n_u = piece.degree[0] + 1, n = int(piece.points.cols());
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    for (int i = 0; i < n; ++i) {
      const int next = axis == 0 ? i + 1 : i + n_u;
      if (axis == 0 ? next % n_u == 0 : next >= n) continue;
      const double step = piece.points(coordinate, next) - piece.points(coordinate, i);
      least = std::min(least, step);
      largest = std::max(largest, step);
    }
    return least > 0 || largest < 0;
  }

  PreparedNurbs<2, 3> surface_;
  Boundary<2> plane_;
  Loops<2> loops_;
  double diagonal_;
  std::vector<const PreparedNurbs<1, 2>*> curves_;  // of the plane and the caps
  std::vector<Box<2>> cells_;                       // of stretches of the curves
  detail::BorderCurves border_;
  std::vector<std::vector<Vec<3>>> borders_;
  Box<3> box_;
  std::vector<Strip> strips_;
};

void check_inside_domain(const Nurbs<1, 2>& curve, const Box<2>& box, const std::string& file,
                         const std::string& field) {
  const double near = outside_share * box.diagonal();
  const auto prepared = prepare(curve);
  for (const auto& piece : prepared.pieces)
    for (int k = 0; k <= 32; ++k) {
      const Vec<2> u = point(piece, Param<1>(k / 32.0));
      if ((u.array() < box.lower.array() - near).any() ||
          (u.array() > box.upper.array() + near).any())
        throw InputError(
            file, field, "a curve through " + text(u),
            "curves in the part's domain, " + text(box.lower) + " to " + text(box.upper));
    }
}

}  // namespace

template <>
void check_trims<2>(const Nurbs<1, 2>&, const TrimLoops& trims, const std::string& file,
                    const std::string& field) {
  if (!trims.empty()) throw InputError(file, field, "trims of a curve", "none");
}

template <>
void check_trims<3>(const Nurbs<2, 3>& shape, const TrimLoops& trims, const std::string& file,
                    const std::string& field) {
  const Box<2> box = domain_box(shape);
  for (size_t l = 0; l < trims.size(); ++l) {
    const std::string loop = field + "[" + std::to_string(l) + "]";
    if (trims[l].empty())
      throw InputError(file, loop + ".curves", "no curve", "curves that close a loop");
    for (size_t c = 0; c < trims[l].size(); ++c) {
      const std::string curve = loop + ".curves[" + std::to_string(c) + "]";
      check(trims[l][c], file, curve);
      check_inside_domain(trims[l][c], box, file, curve);
    }
    const double gap = find_loops(make_boundary<2>({trims[l]})).longest_gap;
    if (gap > open_share * box.diagonal())
      throw InputError(file, loop, "a gap of " + text(gap) + " between ends",
                       "curves whose ends meet, to 1e-6 of the domain");
  }
}

template <>
std::shared_ptr<const Region<1, 2>> make_region<2>(const PreparedNurbs<1, 2>&,
                                                   const TrimLoops& trims) {
  assert(trims.empty());
  (void)trims;
  return nullptr;
}

template <>
std::shared_ptr<const Region<2, 3>> make_region<3>(const PreparedNurbs<2, 3>& part,
                                                   const TrimLoops& trims) {
  if (trims.empty()) return nullptr;
  auto region = std::make_shared<const TrimRegion>(part, trims);
  if (region->rule(1).weight.empty())
    throw InputError("", "trims", "loops that enclose nothing",
                     "loops that enclose some of the part");
  return region;
}

}  // namespace sem
