#include <algorithm>
#include <cmath>

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/hits.h"
#include "sem/nurbs/kernels.h"

// f(s) = sum_i w_i n.(P_i - origin) B_i(s) vanishes where the piece meets the
// line. A piece is halved until f is monotone, excluded, or all rounding. The
// signs at the ends of these stretches decide `crosses`; as neighbours share
// their end values, the parity of crossings of a whole part is that of its
// end points whatever the rounding in between.

namespace sem {
namespace {

constexpr int max_coefficients = max_nurbs_degree + 1;
constexpr int max_depth = 50;  // halvings of a piece

// A part of a piece: [a, b] of [0, 1].
struct Stretch {
  double f[max_coefficients];
  double a, b;
  bool touches_a, touches_b;  // whether the ends are on the line to rounding
  int depth;
};

// How well the place of a hit is known, the best last.
enum class Place { touch, flat, root, joint };

class CurveHits {
 public:
  CurveHits(const PreparedNurbs<1, 2>& part, const Line<2>& line, std::vector<Hit<2>>& out)
      : part_(part), line_(line), out_(out), first_(out.size()), power_(part.power.get()) {
    const Vec<2>& d = line.direction;
    // An exact unit axis for a line along an axis: then sides are exact.
    if (d[1] == 0)
      normal_ = {0, d[0] > 0 ? 1 : -1};
    else if (d[0] == 0)
      normal_ = {d[1] > 0 ? -1 : 1, 0};
    else
      normal_ = {-d[1], d[0]};
    const Vec<2> largest = part.box.lower.cwiseAbs().cwiseMax(part.box.upper.cwiseAbs());
    tolerance_ = (8 + part.nurbs.degree[0]) * 2.2e-16 *
                 normal_.cwiseAbs().dot(largest + line.origin.cwiseAbs());
    normal_square_ = normal_.squaredNorm();
    direction_square_ = d.squaredNorm();
    kernel_line_ = {{line.origin[0], line.origin[1]}, {normal_[0], normal_[1]}, {d[0], d[1]}};
  }

  void run() {
    const auto& pieces = part_.pieces;
    const int n = int(pieces.size());
    int last = -1;
    for (int first = 0; first < n; first += 64)
      for (auto near = near_pieces(first); near != 0; near &= near - 1) {
        const int k = first + __builtin_ctzll(near);
        const bool joined = k > 0 && last == k - 1 &&
                            pieces[k - 1].points.rightCols<1>() == pieces[k].points.col(0);
        if (!joined) open_ = false;
        if (!add_simple(k)) add_piece(pieces[k]);
        if (k == 0) first_open_ = out_.size() > first_ && touches(pieces[0], 0);
        last = k;
      }
    if (last != n - 1) open_ = false;
    // The joint that closes the curve.
    const bool closed = pieces.front().points.col(0) == pieces.back().points.rightCols<1>();
    if (closed && first_open_ && open_ && out_.size() > first_ + 1) {
      Hit<2>& hit = out_[first_];
      hit.crosses = hit.crosses != out_.back().crosses;
      hit.tangent = hit.tangent || out_.back().tangent;
      hit.along = hit.along || out_.back().along;
      out_.pop_back();
    }
  }

 private:
  // Signed distance to the line times |normal|. One expression for every
  // point of every part: equal points get equal bits.
  double side(const Vec<2>& X) const {
    return normal_[0] * (X[0] - line_.origin[0]) + normal_[1] * (X[1] - line_.origin[1]);
  }

  // Bit k: piece first + k may meet the line; at most 64.
  unsigned long long near_pieces(int first) const {
    if (power_) return detail::kernels->near_line(power_->line, kernel_line_, tolerance_, first);
    unsigned long long near = 0;
    const int n = std::min(64, int(part_.pieces.size()) - first);
    for (int k = 0; k < n; ++k)
      near |= (unsigned long long)(!misses_box(part_.pieces[first + k].box)) << k;
    return near;
  }

  bool misses_box(const Box<2>& box) const {
    double lower = 0, upper = 0;
    for (int k = 0; k < 2; ++k) {
      const double a = normal_[k] * (box.lower[k] - line_.origin[k]);
      const double b = normal_[k] * (box.upper[k] - line_.origin[k]);
      lower += std::min(a, b);
      upper += std::max(a, b);
    }
    return lower > tolerance_ || upper < -tolerance_;
  }

  bool touches(const BezierPiece<1, 2>& piece, int i) const {
    return std::abs(side(piece.points.col(i))) <= tolerance_;
  }

  // The usual case: both ends off the line, one sign change of the coefficients and so one
  // crossing. False if it is not that.
  bool add_simple(int k) {
    if (!power_) return false;
    const BezierPiece<1, 2>& piece = part_.pieces[k];
    const int n = piece.degree[0];
    double f[max_coefficients];  // without the weights, which change no sign
    for (int i = 0; i <= n; ++i) f[i] = side(piece.points.col(i));
    if (std::abs(f[0]) <= tolerance_ || std::abs(f[n]) <= tolerance_ || (f[0] > 0) == (f[n] > 0))
      return false;
    int n_changes = 0;
    for (int i = 0; i < n; ++i) n_changes += (f[i] > 0) != (f[i + 1] > 0);
    if (n_changes > 1) return false;
    detail::LineCrossing at;
    const double first = f[0] * piece.weights[0], last = f[n] * piece.weights[n];
    const double start = (first + last) / (first - last);
    if (!detail::kernels->cross_line(power_->line, kernel_line_, k, start, at)) return false;
    const double s = 0.5 + 0.5 * at.local;
    if (!(s > 0 && s < 1)) return false;
    const double across = at.across_slope * at.across_slope * direction_square_;
    const double along = at.along_slope * at.along_slope * normal_square_;
    Hit<2> hit;
    hit.t = at.along / direction_square_;
    hit.u = piece.lower + s * (piece.upper - piece.lower);
    hit.crosses = true;
    hit.along = false;
    hit.tangent = across < 1e-12 * (across + along);
    out_.push_back(hit);
    open_ = false;
    return true;
  }

  void add_piece(const BezierPiece<1, 2>& piece) {
    piece_ = &piece;
    degree_ = piece.degree[0];
    Stretch stack[max_depth + 2];
    Stretch& whole = stack[0];
    double largest_weight = 0;
    for (int i = 0; i <= degree_; ++i) {
      whole.f[i] = piece.weights[i] * side(piece.points.col(i));
      largest_weight = std::max(largest_weight, piece.weights[i]);
    }
    f_tolerance_ = tolerance_ * largest_weight;
    whole.a = 0;
    whole.b = 1;
    whole.depth = 0;
    whole.touches_a = touches(piece, 0);
    whole.touches_b = touches(piece, degree_);
    for (int n = 1; n > 0;) {
      if (finish(stack[n - 1])) {
        --n;
        continue;
      }
      Stretch& right = stack[n - 1];
      Stretch& left = stack[n];
      detail::split_half(right.f, degree_, left.f, right.f);
      left.a = right.a;
      left.b = right.a = 0.5 * (right.a + right.b);
      left.touches_a = right.touches_a;
      left.touches_b = right.touches_a = std::abs(right.f[0]) <= f_tolerance_;
      left.depth = ++right.depth;
      ++n;
    }
  }

  // Adds the hits of a stretch; false if it has to be split.
  bool finish(const Stretch& x) {
    const auto [lowest, highest] = std::minmax_element(x.f, x.f + degree_ + 1);
    if (*lowest > f_tolerance_ || *highest < -f_tolerance_) {
      open_ = false;
      return true;
    }
    const bool crosses = (x.f[0] >= 0) != (x.f[degree_] >= 0);
    if (*lowest >= -f_tolerance_ && *highest <= f_tolerance_) {
      if (x.depth == 0) {
        add_at(x.a, Place::joint, crosses, true, x.touches_a, false);
        add_at(x.b, Place::joint, false, true, false, x.touches_b);
      } else {
        add_at(x.a + flattest(x) * (x.b - x.a), Place::flat, crosses, false, x.touches_a,
               x.touches_b);
      }
      return true;
    }
    const bool monotone = std::is_sorted(x.f, x.f + degree_ + 1) ||
                          std::is_sorted(x.f, x.f + degree_ + 1, std::greater<>());
    if (!monotone && x.depth < max_depth) return false;
    if (crosses) {
      const double s = x.f[0] == 0 ? 0
                       : x.f[degree_] == 0
                           ? 1
                           : detail::single_root(x.f, degree_, x.f[0] > 0, scratch_);
      add_at(x.a + s * (x.b - x.a), Place::root, true, false, x.touches_a, x.touches_b);
    } else if (x.touches_a) {
      add_at(x.a, Place::touch, false, false, true, x.touches_b);
    } else if (x.touches_b) {
      add_at(x.b, Place::touch, false, false, false, true);
    } else {
      open_ = false;
    }
    return true;
  }

  // Where the derivative vanishes on a stretch that is all rounding, if its
  // ends say so; else the middle.
  double flattest(const Stretch& x) {
    if (degree_ < 2) return 0.5;
    double slope[max_coefficients];
    for (int i = 0; i < degree_; ++i) slope[i] = x.f[i + 1] - x.f[i];
    if ((slope[0] >= 0) == (slope[degree_ - 1] >= 0)) return 0.5;
    return detail::single_root(slope, degree_ - 1, slope[0] >= 0, scratch_);
  }

  // A hit at local parameter s. open_left, open_right: on the line to
  // rounding from the hit to that end of the stretch, so that it is the same
  // hit as the neighbouring stretch's.
  void add_at(double s, Place place, bool crosses, bool along, bool open_left, bool open_right) {
    const BezierPiece<1, 2>& piece = *piece_;
    if (s == 0 || s == 1) place = Place::joint;
    const Param<1> local(s);
    const Vec<2> X = s == 0   ? Vec<2>(piece.points.col(0))
                     : s == 1 ? Vec<2>(piece.points.col(degree_))
                              : point(piece, local);
    Hit<2> hit;
    hit.t = (line_.direction[0] * (X[0] - line_.origin[0]) +
             line_.direction[1] * (X[1] - line_.origin[1])) /
            line_.direction.squaredNorm();
    hit.u = s == 1 ? piece.upper : Param<1>(piece.lower + local * (piece.upper - piece.lower));
    hit.crosses = crosses;
    hit.along = along;
    hit.tangent = !along && is_tangent(s);
    if (open_ && open_left) {  // the same hit as the last one
      Hit<2>& last = out_.back();
      hit.crosses = hit.crosses != last.crosses;
      hit.along = hit.along || last.along;
      hit.tangent = hit.tangent || last.tangent;
      if (place <= last_place_) {
        hit.t = last.t;
        hit.u = last.u;
      }
      last = hit;
      last_place_ = std::max(last_place_, place);
    } else {
      out_.push_back(hit);
      last_place_ = place;
    }
    open_ = open_right;
  }

  bool is_tangent(double s) {
    // Direction of the curve from its de Casteljau scheme, homogeneous.
    double w[max_coefficients], x[max_coefficients], y[max_coefficients];
    for (int i = 0; i <= degree_; ++i) {
      w[i] = piece_->weights[i];
      x[i] = w[i] * (piece_->points(0, i) - line_.origin[0]);
      y[i] = w[i] * (piece_->points(1, i) - line_.origin[1]);
    }
    const auto W = detail::evaluate(w, degree_, s, scratch_);
    const auto A = detail::evaluate(x, degree_, s, scratch_);
    const auto B = detail::evaluate(y, degree_, s, scratch_);
    const Vec<2> tangent(A.slope * W.value - A.value * W.slope,
                         B.slope * W.value - B.value * W.slope);
    return std::abs(normal_.dot(tangent)) < 1e-6 * normal_.norm() * tangent.norm();
  }

  const PreparedNurbs<1, 2>& part_;
  const Line<2>& line_;
  std::vector<Hit<2>>& out_;
  size_t first_;  // of this part's hits
  Vec<2> normal_;
  double tolerance_ = 0;  // on side()
  double normal_square_ = 0, direction_square_ = 0;
  const detail::PowerForm* power_;  // null: no kernels for this part
  detail::KernelLine kernel_line_;
  // The piece being worked on.
  const BezierPiece<1, 2>* piece_ = nullptr;
  int degree_ = 0;
  double f_tolerance_ = 0;
  double scratch_[max_coefficients];
  // What the next stretch needs to know of the last hit.
  bool open_ = false, first_open_ = false;
  Place last_place_ = Place::touch;
};

}  // namespace

template <>
void append_hits<2>(const PreparedNurbs<1, 2>& part, const Line<2>& line, double t_min,
                    double t_max, std::vector<Hit<2>>& out) {
  const size_t first = out.size();
  CurveHits(part, line, out).run();
  out.erase(std::remove_if(out.begin() + first, out.end(),
                           [&](const Hit<2>& hit) { return !(hit.t >= t_min && hit.t <= t_max); }),
            out.end());
  std::sort(out.begin() + first, out.end(), [](const Hit<2>& a, const Hit<2>& b) {
    return a.t != b.t ? a.t < b.t : a.u[0] < b.u[0];
  });
}

}  // namespace sem
