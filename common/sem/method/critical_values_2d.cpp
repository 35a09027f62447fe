#include <algorithm>
#include <cmath>

#include "sem/method/critical_values.h"
#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/hits.h"

namespace sem {
namespace {

constexpr double relative_rounding = 1e-12;
// Bernstein coefficients of Y' W - Y W', the numerator of the derivative of the coordinate Y / W
// along an axis, times 1 / degree: 2 degree of them.
std::vector<double> slope_numerator(const BezierPiece<1, 2>& piece, int axis) {
  const int p = piece.degree[0];
  const Eigen::VectorXd& W = piece.weights;
  const Eigen::VectorXd Y =
      (piece.points.row(axis).transpose().array() - piece.box.lower[axis]) * W.array();
  std::vector<double> c(2 * p, 0.0);
  const double* of_difference = detail::binomials(p - 1);
  const double* of_value = detail::binomials(p);
  const double* of_product = detail::binomials(2 * p - 1);
  for (int i = 0; i < p; ++i)
    for (int j = 0; j <= p; ++j)
      c[i + j] += of_difference[i] * of_value[j] / of_product[i + j] *
                  ((Y[i + 1] - Y[i]) * W[j] - Y[j] * (W[i + 1] - W[i]));
  return c;
}

// Ends and extrema of a piece along an axis.
void append_turns(const BezierPiece<1, 2>& piece, int axis, std::vector<double>& values) {
  values.push_back(piece.points(axis, 0));
  values.push_back(piece.points(axis, piece.points.cols() - 1));
  std::vector<double> c = slope_numerator(piece, axis), roots;
  const double largest = piece.weights.maxCoeff();
  const double rounding =
      1e-15 * (piece.box.upper[axis] - piece.box.lower[axis]) * largest * largest;
  for (double& value : c)
    if (std::abs(value) <= rounding) value = 0;
  detail::append_roots(c, 0, 1, roots);
  for (const double s : roots) values.push_back(point(piece, Param<1>(s))[axis]);
}

std::vector<double> distinct_values(std::vector<double> values, double rounding) {
  std::sort(values.begin(), values.end());
  std::vector<double> result;
  for (const double value : values)
    if (result.empty() || value - result.back() > rounding) result.push_back(value);
  return result;
}

// The order in which a ray meets the monotone branches of the shapes. Between extrema every branch
// is met once, and a shape's branches keep their order in its parameter.
class BranchOrder {
 public:
  BranchOrder(const Boundary<2>& boundary, const Loops<2>& loops, int ray_axis)
      : ray_axis_(ray_axis), rounding_(relative_rounding * boundary.box.diagonal()) {
    for (const auto& part : boundary.parts) shapes_.push_back(&part);
    for (const auto& cap : loops.caps) shapes_.push_back(&cap);
  }

  std::vector<std::pair<int, int>> at(double transverse) const {
    struct Meeting {
      double t;
      std::pair<int, int> branch;
    };
    Vec<2> origin = Vec<2>::Zero();
    origin[1 - ray_axis_] = transverse;
    const double infinity = std::numeric_limits<double>::infinity();
    std::vector<Meeting> meetings;
    std::vector<Hit<2>> hits;
    for (int s = 0; s < int(shapes_.size()); ++s) {
      const auto& box = shapes_[s]->box;
      if (transverse < box.lower[1 - ray_axis_] || transverse > box.upper[1 - ray_axis_]) continue;
      hits.clear();
      append_hits(*shapes_[s], Line<2>{origin, Vec<2>::Unit(ray_axis_)}, -infinity, infinity, hits);
      std::sort(hits.begin(), hits.end(),
                [](const Hit<2>& a, const Hit<2>& b) { return a.u[0] < b.u[0]; });
      for (int k = 0; k < int(hits.size()); ++k) meetings.push_back({hits[k].t, {s, k}});
    }
    std::sort(meetings.begin(), meetings.end(),
              [](const Meeting& a, const Meeting& b) { return a.t < b.t; });
    // Branches that coincide do so in the order of their names.
    for (size_t k = 0; k + 1 < meetings.size(); ++k)
      for (size_t j = k + 1; j > 0 && meetings[j].t - meetings[j - 1].t < rounding_ &&
                             meetings[j].branch < meetings[j - 1].branch;
           --j)
        std::swap(meetings[j].branch, meetings[j - 1].branch);
    std::vector<std::pair<int, int>> order;
    for (const auto& meeting : meetings) order.push_back(meeting.branch);
    return order;
  }

 private:
  int ray_axis_;
  double rounding_;
  std::vector<const PreparedNurbs<1, 2>*> shapes_;
};

// Appends the places between lower and upper where branches change their order.
void append_crossings(const BranchOrder& order, double lower, double upper, double rounding,
                      std::vector<double>& values) {
  constexpr int n_samples = 8, most_crossings = 64;
  double from = lower + 1e-3 * (upper - lower);
  auto before = order.at(from);
  for (int k = 1; k <= n_samples; ++k) {
    const double to = lower + (upper - lower) * (k == n_samples ? 0.999 : double(k) / n_samples);
    const auto behind = order.at(to);
    for (int found = 0; before != behind && found < most_crossings && to - from > rounding;
         ++found) {
      double a = from, b = to;  // the first change, if several
      while (b - a > 0.01 * rounding && a < (a + b) / 2 && (a + b) / 2 < b)
        (order.at((a + b) / 2) == before ? a : b) = (a + b) / 2;
      values.push_back((a + b) / 2);
      from = std::min(to, b + rounding);
      before = order.at(from);
    }
    from = to;
    before = behind;
  }
}

}  // namespace

template <>
std::vector<double> critical_values<2>(const Boundary<2>& boundary, const Loops<2>& loops,
                                       int ray_axis, int transverse_axis) {
  const double rounding = relative_rounding * boundary.box.diagonal();
  std::vector<double> values;
  for (const auto& part : boundary.parts)
    for (const auto& piece : part.pieces) append_turns(piece, transverse_axis, values);
  for (const auto& cap : loops.caps) append_turns(cap.pieces.front(), transverse_axis, values);
  const std::vector<double> turns = distinct_values(values, rounding);
  const BranchOrder order(boundary, loops, ray_axis);
  for (size_t k = 0; k + 1 < turns.size(); ++k)
    append_crossings(order, turns[k], turns[k + 1], rounding, values);
  return distinct_values(values, rounding);
}

}  // namespace sem
