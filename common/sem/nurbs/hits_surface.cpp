#include <algorithm>
#include <cmath>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/hits.h"
#include "sem/nurbs/kernels.h"
#include "sem/nurbs/merge_hits.h"
#include "sem/nurbs/search_counts.h"
#include "sem/nurbs/surface_cells.h"

// Two functions f, g = w n.(P - origin), n perpendicular to the line, vanish
// together where the line meets the surface. A patch is split until its
// convex hull excludes a root, or its Jacobian is dominated by the diagonal
// (after multiplication by the inverse at the centre), so that it has at most
// one root and Newton finds it. What is left, down to the smallest patch, are
// tangencies and stretches along the line.

namespace sem {
namespace {

using detail::Candidate;

constexpr int max_halvings = 27;    // of each axis, for tangencies
constexpr int coarse_halvings = 9;  // once max_patches are exceeded: a line along the surface
constexpr int max_patches = 8000;   // per piece

struct Patch {
  double lower[2], upper[2];  // in [0, 1]^2 of the piece
  int halvings[2];
};

// Kept between calls so that nothing is allocated in the steady state.
struct Scratch {
  std::vector<Vec<2>> coefficients;  // of the stack: f, g
  std::vector<Patch> patches;
  std::vector<Candidate> candidates;
  std::vector<Vec<2>> whole;  // f, g of a whole piece, for degenerate hits
};

struct Jet {
  Vec<2> value;
  Mat<2> jacobian;
};

class SurfaceHits {
 public:
  SurfaceHits(const PreparedNurbs<2, 3>& part, const Line<3>& line, Scratch& scratch)
      : part_(part), line_(line), scratch_(scratch) {
    const Vec<3> d = line.direction.normalized();
    int smallest;
    d.cwiseAbs().minCoeff(&smallest);
    normals_.col(0) = d.cross(Vec<3>::Unit(smallest)).normalized();
    normals_.col(1) = d.cross(normals_.col(0));
    const Vec<3> largest = part.box.lower.cwiseAbs().cwiseMax(part.box.upper.cwiseAbs());
    const int degree = part.nurbs.degree[0] + part.nurbs.degree[1];
    tolerance_ = (16 + degree) * 2.2e-16 * (largest + line.origin.cwiseAbs()).sum();
  }

  void run() {
    scratch_.candidates.clear();
    for (size_t k = 0; k < part_.pieces.size(); ++k)
      if (!misses_box(part_.pieces[k].box) && !misses_cell(part_.cells->cells[k]))
        search(part_.pieces[k]);
  }

 private:
  bool misses_box(const Box<3>& box) const {
    const Vec<3> centre = 0.5 * (box.lower + box.upper) - line_.origin;
    const Vec<3> half = 0.5 * (box.upper - box.lower);
    for (int k = 0; k < 2; ++k)
      if (std::abs(normals_.col(k).dot(centre)) > normals_.col(k).cwiseAbs().dot(half) + tolerance_)
        return true;
    return false;
  }

  // The same for the box along the piece's tangents.
  bool misses_cell(const detail::SurfaceCell& cell) const {
    const Vec<3> centre = cell.centre - (line_.origin - part_.cells->origin);
    for (int k = 0; k < 2; ++k)
      if (std::abs(normals_.col(k).dot(centre)) >
          (cell.axes * normals_.col(k)).cwiseAbs().dot(cell.half) + tolerance_)
        return true;
    return false;
  }

  Vec<2>* coefficients(int k) { return &scratch_.coefficients[size_t(k) * n_]; }

  void reserve(int n_patches) {
    if (int(scratch_.patches.size()) < n_patches) scratch_.patches.resize(n_patches);
    if (scratch_.coefficients.size() < size_t(n_patches) * n_)
      scratch_.coefficients.resize(size_t(n_patches) * n_);
  }

  void search(const BezierPiece<2, 3>& piece) {
    piece_ = &piece;
    n_ = int(piece.weights.size());
    reserve(2 * max_halvings + 4);
    f_tolerance_ = tolerance_ * piece.weights.maxCoeff();
    Vec<2>* whole = coefficients(0);
    for (int i = 0; i < n_; ++i) {
      const Vec<3> X = piece.points.col(i) - line_.origin;
      for (int k = 0; k < 2; ++k) whole[i][k] = piece.weights[i] * normals_.col(k).dot(X);
    }
    edges_known_ = false;
    scratch_.patches[0] = {{0, 0}, {1, 1}, {0, 0}};
    n_patches_ = 0;
    bool along = false;
    for (int n = 1; n > 0;) {
      Patch& right = scratch_.patches[n - 1];
      Vec<2>* c = coefficients(n - 1);
      if (finish(right, c)) {
        along = along || n_patches_ > max_patches;
        --n;
        continue;
      }
      const int axis = axis_to_split(right, c);
      Patch& left = scratch_.patches[n];
      left = right;
      left.upper[axis] = right.lower[axis] = 0.5 * (right.lower[axis] + right.upper[axis]);
      ++right.halvings[axis];
      ++left.halvings[axis];
      detail::split_patch<2>(c, piece.degree.data(), axis, 0.5, coefficients(n), c);
      ++n;
    }
    detail::search_counts().hit_patches += n_patches_;
    if (along) add_edges();
  }

  // Edges of the piece that are one point (poles): all of such an edge is a root if the point is on
  // the line.
  void find_collapsed_edges() {
    const int n_u = piece_->degree[0] + 1;
    const int corner[2] = {n_ - n_u, n_u - 1};  // first point of the far edge of each axis, 1 and 0
    for (int axis = 0; axis < 2; ++axis)
      for (int side = 0; side < 2; ++side) {
        const int first = side == 0 ? 0 : corner[1 - axis], step = axis == 0 ? n_u : 1;
        bool collapsed = true;
        for (int k = 1; k <= piece_->degree[1 - axis]; ++k)
          collapsed &= (piece_->points.col(first + k * step) - piece_->points.col(first))
                           .cwiseAbs()
                           .maxCoeff() <= tolerance_;
        collapsed_[axis][side] = collapsed;
      }
  }

  bool touches_collapsed_edge(const Patch& patch) {
    if (!edges_known_) find_collapsed_edges();
    edges_known_ = true;
    for (int axis = 0; axis < 2; ++axis)
      if ((collapsed_[axis][0] && patch.lower[axis] == 0) ||
          (collapsed_[axis][1] && patch.upper[axis] == 1))
        return true;
    return false;
  }

  // Whether a linear combination of f and g has no root by its hull.
  bool excluded(const Vec<2>* c, double a, double b) const {
    double lowest = a * c[0][0] + b * c[0][1], highest = lowest;
    for (int i = 1; i < n_; ++i) {
      const double value = a * c[i][0] + b * c[i][1];
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    const double tolerance = (std::abs(a) + std::abs(b)) * f_tolerance_;
    return lowest > tolerance || highest < -tolerance;
  }

  Jet evaluate(const Vec<2>* c, const Vec<2>& s) const {
    double B[2][2][max_nurbs_functions];
    for (int a = 0; a < 2; ++a)
      detail::bernstein_basis(piece_->degree[a], s[a], 1, max_nurbs_functions, B[a][0]);
    Jet jet{Vec<2>::Zero(), Mat<2>::Zero()};
    for (int j = 0, i = 0; j <= piece_->degree[1]; ++j)
      for (int k = 0; k <= piece_->degree[0]; ++k, ++i) {
        const Vec<2>& value = c[i];
        jet.value += B[0][0][k] * B[1][0][j] * value;
        jet.jacobian.col(0) += B[0][1][k] * B[1][0][j] * value;
        jet.jacobian.col(1) += B[0][0][k] * B[1][1][j] * value;
      }
    return jet;
  }

  // f, g and their derivatives at s of a patch, by the powers of the whole piece if there are any.
  Jet evaluate_patch(const Patch& patch, const Vec<2>* c, const Vec<2>& s) const {
    if (!part_.power) return evaluate(c, s);
    const detail::PowerForm& power = *part_.power;
    const Vec<2> lower(patch.lower[0], patch.lower[1]);
    const Vec<2> size = Vec<2>(patch.upper[0], patch.upper[1]) - lower;
    const double* coefficients = power.coefficient + (piece_ - part_.pieces.data()) * power.stride;
    const Vec<2> local = 2 * (lower + s.cwiseProduct(size)) - Vec<2>::Ones();
    alignas(32) double jets[12];
    detail::kernels->surface_jets(power, coefficients, local.data(), jets);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3>, 0, Eigen::OuterStride<4>> A(jets);
    const Eigen::Map<const Vec<3>, 0, Eigen::InnerStride<4>> W(jets + 3);
    const Vec<3> R = line_.origin - Eigen::Map<const Vec<3>>(coefficients);
    const Eigen::Matrix<double, 2, 3> f =
        normals_.transpose() * A - (normals_.transpose() * R) * W.transpose();
    return {f.col(0), f.rightCols<2>() * (2 * size).asDiagonal()};
  }

  // True if the patch is done: excluded, or its hits are added.
  bool finish(const Patch& patch, const Vec<2>* c) {
    ++n_patches_;
    if (excluded(c, 1, 0) || excluded(c, 0, 1)) return true;
    const Mat<2> J = evaluate_patch(patch, c, {0.5, 0.5}).jacobian;
    const double determinant = J.determinant();
    if (std::abs(determinant) > 1e-9 * J.squaredNorm()) {
      Mat<2> inverse;
      inverse << J(1, 1), -J(0, 1), -J(1, 0), J(0, 0);
      inverse /= determinant;
      if (excluded(c, inverse(0, 0), inverse(0, 1)) || excluded(c, inverse(1, 0), inverse(1, 1)))
        return true;
      if (at_most_one(c, inverse) && add_simple(patch, c)) return true;
    }
    // The combination with the least gradient, for patches near a tangency.
    const Mat<2> M = J * J.transpose();
    const double half = (M(0, 0) - M(1, 1)) / 2, both = std::hypot(half, M(0, 1)) + std::abs(half);
    if (both > 0 && (half > 0 ? excluded(c, -M(0, 1), both) : excluded(c, -both, M(0, 1))))
      return true;
    const int limit = n_patches_ > max_patches ? coarse_halvings : max_halvings;
    if (std::min(patch.halvings[0], patch.halvings[1]) < limit &&
        std::max(patch.halvings[0], patch.halvings[1]) < max_halvings)
      return false;
    add_degenerate(patch);
    return true;
  }

  // Diagonal dominance of inverse * Jacobian over the whole patch.
  bool at_most_one(const Vec<2>* c, const Mat<2>& inverse) const {
    double least[2] = {1e300, 1e300}, largest[2] = {0, 0};
    const int n_u = piece_->degree[0] + 1;
    for (int i = 0; i < n_; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const int next = axis == 0 ? i + 1 : i + n_u;
        if (axis == 0 ? next % n_u == 0 : next >= n_) continue;
        const Vec<2> difference = c[next] - c[i];
        const Vec<2> slope = piece_->degree[axis] * (inverse * difference);
        least[axis] = std::min(least[axis], slope[axis]);
        largest[1 - axis] = std::max(largest[1 - axis], std::abs(slope[1 - axis]));
      }
    return least[0] > largest[0] && least[1] > largest[1];
  }

  // Newton on a patch with at most one root; false if that settles nothing.
  bool add_simple(const Patch& patch, const Vec<2>* c) {
    Vec<2> s(0.5, 0.5);
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Jet jet = evaluate_patch(patch, c, s);
      const Vec<2> step = jet.jacobian.inverse() * jet.value;
      s -= step;
      if (!(s.cwiseAbs().maxCoeff() < 4)) return false;
      // Newton squares the error: after such a step the next is rounding.
      if (step.cwiseAbs().maxCoeff() < 1e-9) break;
    }
    // A root outside by rounding is a root on the boundary of the patch.
    if ((s.array() < 0).any() || (s.array() > 1).any())
      s = least_squares(c, s.cwiseMax(0.0).cwiseMin(1.0), {0, 0}, {1, 1});
    Vec<2> global;
    for (int a = 0; a < 2; ++a)
      global[a] =
          s[a] == 1 ? patch.upper[a] : patch.lower[a] + s[a] * (patch.upper[a] - patch.lower[a]);
    return add(global, 0);
  }

  // Least |(f, g)| in a box by Gauss-Newton; coordinates that would leave it
  // stay on its boundary.
  Vec<2> least_squares(const Vec<2>* c, Vec<2> s, const Vec<2>& lower, const Vec<2>& upper) const {
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Jet jet = evaluate(c, s);
      Mat<2> A = jet.jacobian.transpose() * jet.jacobian;
      const Vec<2> b = jet.jacobian.transpose() * jet.value;
      A.diagonal().array() += 1e-15 * A.trace() + 1e-300;
      Vec<2> step = A.inverse() * b;
      for (int a = 0; a < 2; ++a)
        if ((s[a] == lower[a] && step[a] > 0) || (s[a] == upper[a] && step[a] < 0)) {
          step[a] = 0;
          step[1 - a] = b[1 - a] / A(1 - a, 1 - a);
          break;
        }
      const Vec<2> next = (s - step).cwiseMax(lower).cwiseMin(upper);
      const bool done = (next - s).cwiseAbs().maxCoeff() < 1e-16;
      s = next;
      if (done) break;
    }
    return s;
  }

  // On a patch too small to tell more: a touching point.
  void add_degenerate(const Patch& patch) {
    const Vec<2> lower(patch.lower[0], patch.lower[1]), upper(patch.upper[0], patch.upper[1]);
    const Vec<2> s = least_squares(whole_coefficients(), 0.5 * (lower + upper), lower, upper);
    Box<3> box;
    box.include(point(*piece_, Param<2>(lower)));
    box.include(point(*piece_, Param<2>(upper)));
    add(s, std::max(box.diagonal(), 1e-7 * part_.box.diagonal()));
  }

  // Where a stretch along the line leaves the piece: its corners, and the
  // roots of f or g on its edges (sampled signs, then bisection).
  void add_edges() {
    const Vec<2>* whole = whole_coefficients();
    constexpr int n_samples = 64;
    const double reach = part_.box.diagonal() / n_samples;
    for (int axis = 0; axis < 2; ++axis)
      for (int side = 0; side < 2; ++side) {
        Vec<2> s = Vec<2>::Constant(side), last_value = Vec<2>::Zero();
        for (int k = 0; k <= n_samples; ++k) {
          s[axis] = double(k) / n_samples;
          const Vec<2> value = evaluate(whole, s).value;
          if (k == 0 || k == n_samples) add(s, reach);
          for (int f = 0; k > 0 && f < 2; ++f) {
            if ((last_value[f] > 0) == (value[f] > 0)) continue;
            Vec<2> root = s;
            double a = double(k - 1) / n_samples, b = s[axis];
            for (int halving = 0; halving < 60; ++halving) {
              root[axis] = 0.5 * (a + b);
              ((evaluate(whole, root).value[f] > 0) == (value[f] > 0) ? b : a) = root[axis];
            }
            add(root, reach);
          }
          last_value = value;
        }
      }
  }

  const Vec<2>* whole_coefficients() {
    scratch_.whole.resize(n_);
    for (int i = 0; i < n_; ++i) {
      const Vec<3> X = piece_->points.col(i) - line_.origin;
      for (int k = 0; k < 2; ++k)
        scratch_.whole[i][k] = piece_->weights[i] * normals_.col(k).dot(X);
    }
    return scratch_.whole.data();
  }

  // Adds a hit at local parameters if it is on the line to rounding, also of the parameters: with
  // very unequal weights a surface moves by more than positions are rounded to from one double to
  // the next.
  bool add(const Vec<2>& s, double reach) {
    const Vec<3> X = point(*piece_, Param<2>(s)) - line_.origin;
    Candidate candidate;
    Hit<3>& hit = candidate.hit;
    hit.t = X.dot(line_.direction) / line_.direction.squaredNorm();
    double rounding = 4 * tolerance_;
    for (int a = 0; a < 2; ++a)
      hit.u[a] = s[a] == 1 ? piece_->upper[a]
                           : piece_->lower[a] + s[a] * (piece_->upper[a] - piece_->lower[a]);
    const auto slopes = point_slopes(part_, hit.u).first;
    for (int a = 0; a < 2; ++a)
      rounding += 2.2e-16 * s[a] * (piece_->upper[a] - piece_->lower[a]) * slopes.col(a).norm();
    if ((normals_.transpose() * X).cwiseAbs().maxCoeff() > rounding) return false;
    const Vec<3> normal = DimTraits<3>::area_normal(slopes);
    hit.tangent =
        std::abs(normal.dot(line_.direction)) <= 1e-6 * normal.norm() * line_.direction.norm();
    hit.crosses = !hit.tangent;
    hit.along = false;
    // All points this close to a tangency are on the line to rounding.
    candidate.reach = hit.tangent ? std::max(reach, 1e-6 * part_.box.diagonal()) : reach;
    scratch_.candidates.push_back(candidate);
    return true;
  }

  int axis_to_split(const Patch& patch, const Vec<2>* c) {
    double variation[2] = {0, 0};
    const int n_u = piece_->degree[0] + 1;
    for (int i = 0; i < n_; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const int next = axis == 0 ? i + 1 : i + n_u;
        if (axis == 0 ? next % n_u == 0 : next >= n_) continue;
        for (int k = 0; k < 2; ++k)
          variation[axis] =
              std::max(variation[axis], piece_->degree[axis] * std::abs(c[next][k] - c[i][k]));
      }
    // Not the longest way in the plane alone: keep patches of bounded shape. At a pole that would
    // split the edge that is one point for ever.
    if (std::abs(patch.halvings[0] - patch.halvings[1]) > 3 && !touches_collapsed_edge(patch))
      return patch.halvings[0] < patch.halvings[1] ? 0 : 1;
    return variation[0] >= variation[1] ? 0 : 1;
  }

  const PreparedNurbs<2, 3>& part_;
  const Line<3>& line_;
  Scratch& scratch_;
  Eigen::Matrix<double, 3, 2> normals_;
  double tolerance_ = 0, f_tolerance_ = 0;
  const BezierPiece<2, 3>* piece_ = nullptr;
  int n_ = 0, n_patches_ = 0;
  bool edges_known_ = false, collapsed_[2][2] = {};  // of the piece; [axis][side]
};

}  // namespace

template <>
void append_hits<3>(const PreparedNurbs<2, 3>& part, const Line<3>& line, double t_min,
                    double t_max, std::vector<Hit<3>>& out) {
  thread_local Scratch scratch;
  SurfaceHits(part, line, scratch).run();
  const size_t first = out.size();
  detail::append_merged(part, line.direction.norm(), scratch.candidates, out);
  out.erase(std::remove_if(out.begin() + first, out.end(),
                           [&](const Hit<3>& hit) { return !(hit.t >= t_min && hit.t <= t_max); }),
            out.end());
  if (part.region)
    out.erase(std::remove_if(out.begin() + first, out.end(),
                             [&](const Hit<3>& hit) { return !part.region->contains(hit.u); }),
              out.end());
  std::sort(out.begin() + first, out.end(), [](const Hit<3>& a, const Hit<3>& b) {
    return a.t != b.t ? a.t < b.t : a.u[0] < b.u[0];
  });
}

}  // namespace sem
