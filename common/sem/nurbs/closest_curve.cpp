#include <algorithm>
#include <cmath>

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/closest.h"

// Pieces whose box is farther than the best point found are skipped. On the
// others, all local minima of the distance are found: the roots of the
// polynomial `foot` where it changes from - to +, isolated by Descartes' rule
// of signs in Bernstein form.

namespace sem {
namespace {

constexpr int max_coefficients = 3 * max_nurbs_degree;
constexpr int max_depth = 45;  // halvings of a piece

struct Stretch {
  double g[max_coefficients];
  double a, b;
  int depth;
};

class CurveClosest {
 public:
  CurveClosest(const PreparedNurbs<1, 2>& part, const Vec<2>& X, double cutoff)
      : part_(part), X_(X), least_(cutoff), size_(part.box.diagonal()) {
    const auto& pieces = part.pieces;
    near_u_ = 1e-6 * (pieces.back().upper[0] - pieces.front().lower[0]);
    best_.u[0] = best_.point[0] = best_.point[1] = std::numeric_limits<double>::quiet_NaN();
    best_.distance = std::numeric_limits<double>::infinity();
  }

  ClosestPoint<2> run() {
    const auto& pieces = part_.pieces;
    // A first bound from the joints, and the most promising piece.
    double least_square = least_ * least_, least_bound = std::numeric_limits<double>::infinity();
    const BezierPiece<1, 2>* promising = nullptr;
    for (const auto& piece : pieces) {
      least_square = std::min(least_square, (piece.points.col(0) - X_).squaredNorm());
      const double bound = square_to_box(piece.box);
      if (bound < least_bound) {
        least_bound = bound;
        promising = &piece;
      }
    }
    least_ = std::sqrt(least_square);
    limit();
    if (promising && least_bound <= limit_square_) search(*promising);
    for (const auto& piece : pieces)
      if (&piece != promising && square_to_box(piece.box) <= limit_square_) search(piece);
    return best_;
  }

 private:
  double square_to_box(const Box<2>& box) const {
    const double x = std::max({box.lower[0] - X_[0], 0.0, X_[0] - box.upper[0]});
    const double y = std::max({box.lower[1] - X_[1], 0.0, X_[1] - box.upper[1]});
    return x * x + y * y;
  }

  void limit() {
    tie_ = 1e-14 * (least_ + size_);
    limit_square_ = (least_ + tie_) * (least_ + tie_);
  }

  void search(const BezierPiece<1, 2>& piece) {
    Stretch stack[max_depth + 2];
    Stretch& whole = stack[0];
    const int degree = int(piece.foot.cols()) - 1;
    const Vec<2> R = X_ - 0.5 * (piece.box.lower + piece.box.upper);
    const double r = std::abs(R[0]) + std::abs(R[1]);
    double scale = 0;
    for (int k = 0; k <= degree; ++k) {
      const double* f = piece.foot.data() + 3 * k;
      whole.g[k] = f[0] - (f[1] * R[0] + f[2] * R[1]);
      scale = std::max(scale, std::abs(f[0]) + r * (std::abs(f[1]) + std::abs(f[2])));
    }
    whole.a = 0;
    whole.b = 1;
    whole.depth = 0;
    const double rounding = 4e-16 * scale;
    if (whole.g[0] >= -rounding) add(piece, 0);
    if (whole.g[degree] <= rounding) add(piece, 1);
    for (int n = 1; n > 0;) {
      if (finish(piece, stack[n - 1], degree, rounding)) {
        --n;
        continue;
      }
      Stretch& right = stack[n - 1];
      Stretch& left = stack[n];
      detail::split_half(right.g, degree, left.g, right.g);
      left.a = right.a;
      left.b = right.a = 0.5 * (right.a + right.b);
      left.depth = ++right.depth;
      ++n;
    }
  }

  // Adds the local minima of a stretch; false if it has to be split.
  bool finish(const BezierPiece<1, 2>& piece, const Stretch& x, int degree, double rounding) {
    int n_changes = 0, sign = 0, first_sign = 0;
    for (int k = 0; k <= degree; ++k) {
      const int next = x.g[k] > rounding ? 1 : x.g[k] < -rounding ? -1 : 0;
      if (next == 0) continue;
      if (sign == 0) first_sign = next;
      if (sign * next < 0) ++n_changes;
      sign = next;
    }
    if (first_sign == 0) {  // constant distance
      add(piece, x.a);
      return true;
    }
    if (n_changes == 0 || (n_changes == 1 && first_sign > 0)) {
      // A minimum where the stretch was split off its neighbour: - here and + there, or the reverse.
      if (first_sign > 0 && std::abs(x.g[0]) <= rounding) add(piece, x.a);
      if (sign < 0 && std::abs(x.g[degree]) <= rounding) add(piece, x.b);
      return true;
    }
    if (n_changes > 1 && x.depth < max_depth) return false;
    const double s = n_changes > 1 ? 0.5 : detail::single_root(x.g, degree, false, scratch_);
    add(piece, x.a + s * (x.b - x.a));
    return true;
  }

  void add(const BezierPiece<1, 2>& piece, double s) {
    ClosestPoint<2> candidate;
    candidate.point = s == 0   ? Vec<2>(piece.points.col(0))
                      : s == 1 ? Vec<2>(piece.points.col(piece.degree[0]))
                               : point(piece, Param<1>(s));
    candidate.distance = (candidate.point - X_).norm();
    if (candidate.distance > least_ + tie_) return;
    candidate.u = s == 1 ? piece.upper : Param<1>(piece.lower + s * (piece.upper - piece.lower));
    const bool clearly_closer = !(best_.distance <= candidate.distance + tie_);
    const bool same_place = std::abs(candidate.u[0] - best_.u[0]) <= near_u_;
    const bool before = candidate.u[0] < best_.u[0];
    const bool preferred = same_place ? candidate.distance < best_.distance ||
                                            (candidate.distance == best_.distance && before)
                                      : before;
    if (clearly_closer || preferred) best_ = candidate;
    if (candidate.distance < least_) {
      least_ = candidate.distance;
      limit();
    }
  }

  const PreparedNurbs<1, 2>& part_;
  const Vec<2> X_;
  double least_;  // upper bound of the distance
  double size_, tie_ = 0, limit_square_ = 0, near_u_ = 0;
  ClosestPoint<2> best_;
  double scratch_[max_coefficients];
};

}  // namespace

template <>
ClosestPoint<2> closest_point(const PreparedNurbs<1, 2>& part, const Vec<2>& X, double cutoff) {
  return CurveClosest(part, X, cutoff).run();
}

}  // namespace sem
