#include "sem/method/border_curves.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/hits.h"

namespace sem::detail {
namespace {

constexpr double relative_error = 1e-13;
constexpr int max_halvings = 12;

// Parameters at which the curve has joints or crosses a knot line of the surface.
std::vector<double> cut_parameters(const PreparedNurbs<2, 3>& surface,
                                   const PreparedNurbs<1, 2>& curve) {
  std::vector<double> cuts;
  for (const auto& piece : curve.pieces) {
    cuts.push_back(piece.lower[0]);
    cuts.push_back(piece.upper[0]);
  }
  std::vector<Hit<2>> hits;
  const double infinity = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis)
    for (size_t k = 1; k < surface.spans[axis].size(); ++k) {
      hits.clear();
      const Vec<2> origin = surface.spans[axis][k].lower * Vec<2>::Unit(axis);
      append_hits(curve, Line<2>{origin, Vec<2>::Unit(1 - axis)}, -infinity, infinity, hits);
      for (const auto& hit : hits) cuts.push_back(hit.u[0]);
    }
  std::sort(cuts.begin(), cuts.end());
  const double near = 1e-12 * (cuts.back() - cuts.front());
  cuts.erase(
      std::unique(cuts.begin(), cuts.end(), [&](double a, double b) { return b - a <= near; }),
      cuts.end());
  return cuts;
}

// The matrix that makes Bernstein coefficients of values at `node`.
template <int N>
struct Interpolation {
  std::array<double, N> node;
  Eigen::Matrix<double, N, N> coefficients;

  Interpolation() {
    Eigen::Matrix<double, N, N> values;
    for (int i = 0; i < N; ++i) {
      node[i] = (1 - std::cos(std::numbers::pi * i / (N - 1))) / 2;
      std::array<double, N> basis;
      bernstein_basis(N - 1, node[i], 0, N, basis.data());
      for (int k = 0; k < N; ++k) values(i, k) = basis[k];
    }
    coefficients = values.inverse();
  }
};

template <class Points>
Vec<3> bernstein_point(const Points& points, double s) {
  constexpr int n = Points::ColsAtCompileTime;
  std::array<double, n> basis;
  bernstein_basis(n - 1, s, 0, n, basis.data());
  return points * Eigen::Map<const Eigen::Matrix<double, n, 1>>(basis.data());
}

double distance_to(const Box<3>& box, const Vec<3>& X) {
  return (box.lower - X).cwiseMax(X - box.upper).cwiseMax(0.0).norm();
}

}  // namespace

BorderCurves::BorderCurves(const PreparedNurbs<2, 3>& surface,
                           const std::vector<const PreparedNurbs<1, 2>*>& curves) {
  for (int c = 0; c < int(curves.size()); ++c) {
    const auto cuts = cut_parameters(surface, *curves[c]);
    for (size_t k = 0; k + 1 < cuts.size(); ++k)
      add(surface, *curves[c], c, cuts[k], cuts[k + 1], 0);
  }
  for (const auto& piece : pieces_) box_.include(piece.box);
}

void BorderCurves::add(const PreparedNurbs<2, 3>& surface, const PreparedNurbs<1, 2>& curve,
                       int index, double lower, double upper, int halvings) {
  static const Interpolation<degree + 1> interpolation;
  const auto image = [&](double s) {
    return point(surface, Param<2>(point(curve, Param<1>(lower + s * (upper - lower)))));
  };
  Piece piece;
  piece.curve = index;
  piece.lower = lower;
  piece.upper = upper;
  piece.center = image(0.5);
  Eigen::Matrix<double, degree + 1, 3> values;
  for (int i = 0; i <= degree; ++i)
    values.row(i) = (image(interpolation.node[i]) - piece.center).transpose();
  piece.points = (interpolation.coefficients * values).transpose();
  const double tolerance = relative_error * surface.box.diagonal();
  double error = 0;
  for (int i = 0; i < degree; ++i) {
    const double s = (interpolation.node[i] + interpolation.node[i + 1]) / 2;
    error = std::max(error, (bernstein_point(piece.points, s) + piece.center - image(s)).norm());
  }
  if (error > tolerance && halvings < max_halvings) {
    const double middle = (lower + upper) / 2;
    add(surface, curve, index, lower, middle, halvings + 1);
    add(surface, curve, index, middle, upper, halvings + 1);
    return;
  }
  for (int i = 0; i <= degree; ++i) piece.box.include(Vec<3>(piece.points.col(i) + piece.center));
  // Products of Bernstein polynomials are convolutions of coefficients times binomials.
  const double *of_value = binomials(degree), *of_slope = binomials(degree - 1),
               *of_product = binomials(2 * degree - 1);
  piece.foot.setZero();
  piece.slope.setZero();
  for (int j = 0; j < degree; ++j) {
    const Vec<3> slope = degree * of_slope[j] * (piece.points.col(j + 1) - piece.points.col(j));
    for (int i = 0; i <= degree; ++i) {
      piece.foot[i + j] += of_value[i] / of_product[i + j] * piece.points.col(i).dot(slope);
      piece.slope.col(i + j) += of_value[i] / of_product[i + j] * slope;
    }
  }
  pieces_.push_back(piece);
}

ClosestPoint<3> BorderCurves::closest(const PreparedNurbs<2, 3>& surface,
                                      const std::vector<const PreparedNurbs<1, 2>*>& curves,
                                      const Vec<3>& X, double cutoff) const {
  thread_local std::vector<std::pair<double, int>> order;
  thread_local std::vector<double> foot, candidates;
  order.clear();
  for (size_t k = 0; k < pieces_.size(); ++k) {
    const double bound = distance_to(pieces_[k].box, X);
    if (bound <= cutoff) order.push_back({bound, int(k)});
  }
  std::sort(order.begin(), order.end());
  double least = cutoff, t = 0;
  const Piece* best = nullptr;
  for (const auto& [bound, k] : order) {
    if (bound > least) break;
    const Piece& piece = pieces_[k];
    const Vec<3> Y = X - piece.center;
    foot.resize(2 * degree);
    for (int i = 0; i < 2 * degree; ++i) foot[i] = piece.foot[i] - piece.slope.col(i).dot(Y);
    candidates = {0, 1};
    append_roots(foot, 0, 1, candidates);
    for (const double s : candidates) {
      const double distance = (bernstein_point(piece.points, s) - Y).norm();
      if (!(distance < least) && (best || distance > least)) continue;
      least = distance;
      best = &piece;
      t = piece.lower + s * (piece.upper - piece.lower);
    }
  }
  ClosestPoint<3> closest;
  closest.distance = std::numeric_limits<double>::infinity();
  closest.u.setConstant(std::numeric_limits<double>::quiet_NaN());
  closest.point.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (!best) return closest;
  // Newton on the curve itself, from the polynomial's answer.
  const auto& curve = *curves[best->curve];
  for (int step = 0;; ++step) {
    const auto c = derivatives(curve.nurbs, Param<1>(t));
    const auto S = derivatives(surface.nurbs, Param<2>(c.point));
    const Vec<3> r = S.point - X;
    if (!(r.norm() <= closest.distance)) break;
    closest = {Param<2>(c.point), S.point, r.norm()};
    const Vec<2> a = c.first;
    const Vec<3> T = S.first * a;
    const Vec<3> C = S.first * c.second[0] + a[0] * a[0] * S.second[0] +
                     2 * a[0] * a[1] * S.second[1] + a[1] * a[1] * S.second[2];
    const double slope = r.dot(T), curvature = T.squaredNorm() + r.dot(C);
    if (step == 3 || !(curvature > 0)) break;
    t = std::clamp(t - slope / curvature, best->lower, best->upper);
  }
  return closest;
}

}  // namespace sem::detail
