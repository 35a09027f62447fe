#include <algorithm>
#include <cmath>

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/foot_cells.h"

// Cells whose chord is farther than the best point found are skipped. On the
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
      : part_(part), feet_(*part.feet), X_(X), least_(cutoff), size_(part.box.diagonal()) {
    const auto& pieces = part.pieces;
    near_u_ = 1e-6 * (pieces.back().upper[0] - pieces.front().lower[0]);
    best_.u[0] = best_.point[0] = best_.point[1] = std::numeric_limits<double>::quiet_NaN();
    best_.distance = std::numeric_limits<double>::infinity();
  }

  ClosestPoint<2> run() {
    const auto& chords = feet_.chords;
    thread_local std::vector<Lanes> scratch;
    if (scratch.size() < size_t(chords.n / 4)) scratch.resize(chords.n / 4);
    double* const square = scratch[0].value;
    // Bounds from the start points of the cells and from the chord that is closest.
    int nearest;
    const double to_start = detail::kernels->chord_squares(chords, X_[0], X_[1], square, &nearest);
    const double bound = std::min(std::sqrt(to_start) * (1 + 1e-15),
                                  std::sqrt(square[nearest]) + chords.reach[nearest]);
    if (bound < least_) least_ = bound;
    limit();
    const int promising = std::min(nearest, int(feet_.cells.size()) - 1);
    if (near(promising, square)) search(feet_.cells[promising]);
    for (int first = 0; first < chords.n; first += 64)
      for (auto bits = detail::kernels->near_chords(chords, square, least_ + tie_, first);
           bits != 0; bits &= bits - 1) {
        const int k = first + __builtin_ctzll(bits);
        if (k != promising && k < int(feet_.cells.size()) && near(k, square))
          search(feet_.cells[k]);
      }
    return best_;
  }

 private:
  struct alignas(32) Lanes {
    double value[4];
  };

  bool near(int cell, const double* square) const {
    const double distance = least_ + tie_ + feet_.chords.reach[cell];
    return square[cell] <= distance * distance;
  }

  void limit() { tie_ = 1e-14 * (least_ + size_); }

  void search(const detail::FootCell& cell) {
    const BezierPiece<1, 2>& piece = part_.pieces[cell.piece];
    const Vec<2> R = X_ - 0.5 * (piece.box.lower + piece.box.upper);
    const double r = std::abs(R[0]) + std::abs(R[1]);
    const double rounding = 4e-16 * (cell.largest + r * cell.largest_slope);
    if (cell.form.rows && search_simple(cell, R, rounding)) return;
    Stretch stack[max_depth + 2];
    Stretch& whole = stack[0];
    const int degree = int(cell.foot.cols()) - 1;
    for (int k = 0; k <= degree; ++k) {
      const double* f = cell.foot.data() + 3 * k;
      whole.g[k] = f[0] - (f[1] * R[0] + f[2] * R[1]);
    }
    whole.a = cell.a;
    whole.b = cell.b;
    whole.depth = 0;
    if (cell.a == 0 && whole.g[0] >= -rounding) add(piece, 0);
    if (cell.b == 1 && whole.g[degree] <= rounding) add(piece, 1);
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

  // The usual case: the coefficients change from - to + once, or never. Otherwise false.
  bool search_simple(const detail::FootCell& cell, const Vec<2>& R, double rounding) {
    const BezierPiece<1, 2>& piece = part_.pieces[cell.piece];
    const auto [positive, negative] = detail::kernels->foot_signs(cell.form, R[0], R[1], rounding);
    const unsigned last = 1u << cell.form.degree;
    const bool falls = positive == 0 && negative != 0, rises = negative == 0 && positive != 0;
    // Both ends off zero: no second root there.
    const bool once = (negative & 1) && (positive & last) && negative < (positive & -positive);
    if (!falls && !rises && !once) return false;
    if (once) {
      double s = 0.5;
      if (!detail::kernels->foot_root(cell.form, R[0], R[1], s)) return false;
      add(piece, cell.a + s * (cell.b - cell.a));
    }
    // The ends of the piece, and where a cell begins or ends at a minimum to rounding.
    if (!(negative & 1) && (cell.a == 0 || (rises && !(positive & 1)))) add(piece, cell.a);
    if (!(positive & last) && (cell.b == 1 || (falls && !(negative & last)))) add(piece, cell.b);
    return true;
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
      // A minimum where the stretch was split off its neighbour: - here and + there, or the
      // reverse.
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
  const detail::FootCells& feet_;
  const Vec<2> X_;
  double least_;  // upper bound of the distance
  double size_, tie_ = 0, near_u_ = 0;
  ClosestPoint<2> best_;
  double scratch_[max_coefficients];
};

}  // namespace

template <>
ClosestPoint<2> closest_point(const PreparedNurbs<1, 2>& part, const Vec<2>& X, double cutoff) {
  return CurveClosest(part, X, cutoff).run();
}

}  // namespace sem
