#include <algorithm>
#include <cmath>

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/closest.h"

// Branch and bound on patches. The squared distance is q / v, q = |w (P-X)|^2
// and v = w^2 in Bernstein form, so min q_i / v_i is a lower bound; it is
// sharp to second order in the size of the patch. Upper bounds come from
// projected Newton. A patch is split at the minimum found, where the bound of
// all four quarters is nearly attained.

namespace sem {
namespace {

constexpr int max_functions = max_nurbs_degree + 1;
constexpr int max_patches = 50000;  // only a curve of equally close points needs so many

struct Patch {
  double lower[2], upper[2];  // in [0, 1]^2 of the piece
  double bound;               // lower bound of the distance
};

// Kept between calls so that nothing is allocated in the steady state.
struct Scratch {
  std::vector<double> coefficients;  // of the stack: w (P - X), w
  std::vector<Patch> patches;
  std::vector<double> square, weight_square;
  std::vector<std::pair<double, int>> order;
};

class SurfaceClosest {
 public:
  SurfaceClosest(const PreparedNurbs<2, 3>& part, const Vec<3>& X, double cutoff, Scratch& scratch)
      : part_(part), X_(X), scratch_(scratch), least_(cutoff), size_(part.box.diagonal()) {
    best_.u.setConstant(std::numeric_limits<double>::quiet_NaN());
    best_.point.setConstant(std::numeric_limits<double>::quiet_NaN());
    best_.distance = std::numeric_limits<double>::infinity();
  }

  ClosestPoint<3> run() {
    auto& order = scratch_.order;
    order.clear();
    for (size_t k = 0; k < part_.pieces.size(); ++k) {
      const Box<3>& box = part_.pieces[k].box;
      const Vec<3> outside = (box.lower - X_).cwiseMax(X_ - box.upper).cwiseMax(0.0);
      order.push_back({outside.norm(), int(k)});
    }
    std::sort(order.begin(), order.end());
    for (const auto& [bound, k] : order)
      if (!hopeless(bound)) search(part_.pieces[k]);
    return best_;
  }

 private:
  // Nothing better than the best point by more than the tolerance.
  bool hopeless(double bound) const {
    if (std::isinf(best_.distance)) return bound > least_;
    return bound >= least_ - 1e-14 * (least_ + size_);
  }

  double* coefficients(int k) { return &scratch_.coefficients[size_t(k) * 4 * n_]; }

  void reserve(int n_patches) {
    if (int(scratch_.patches.size()) < n_patches) scratch_.patches.resize(n_patches);
    if (scratch_.coefficients.size() < size_t(n_patches) * 4 * n_)
      scratch_.coefficients.resize(size_t(n_patches) * 4 * n_);
  }

  void search(const BezierPiece<2, 3>& piece) {
    piece_ = &piece;
    n_ = int(piece.weights.size());
    reserve(4);
    for (int i = 0; i < n_; ++i) {
      Eigen::Map<Eigen::Vector4d> c(coefficients(0) + 4 * i);
      c << piece.weights[i] * (piece.points.col(i) - X_), piece.weights[i];
    }
    scratch_.patches[0] = {{0, 0}, {1, 1}, lower_bound(coefficients(0))};
    descend({0.5, 0.5});
    for (int n = 1, n_patches = 0; n > 0;) {
      const Patch patch = scratch_.patches[n - 1];
      const double width[2] = {patch.upper[0] - patch.lower[0], patch.upper[1] - patch.lower[1]};
      if (hopeless(patch.bound) || std::max(width[0], width[1]) < 1e-11 ||
          ++n_patches > max_patches) {
        --n;
        continue;
      }
      const Vec<2> start = start_of_descent(patch, coefficients(n - 1));
      descend(start);
      if (hopeless(patch.bound)) {
        --n;
        continue;
      }
      split(patch, n);
      n += 3;
      // The most promising patch on top.
      int top = n - 1;
      for (int k = n - 4; k < n; ++k)
        if (scratch_.patches[k].bound < scratch_.patches[top].bound) top = k;
      if (top != n - 1) {
        std::swap(scratch_.patches[top], scratch_.patches[n - 1]);
        std::swap_ranges(coefficients(top), coefficients(top) + 4 * n_, coefficients(n - 1));
      }
    }
  }

  // Replaces patch n - 1 by four, split at the best point if it is inside.
  void split(const Patch& patch, int n) {
    reserve(n + 3);
    double s[2];
    for (int a = 0; a < 2; ++a) {
      const double width = patch.upper[a] - patch.lower[a];
      s[a] = best_piece_ == piece_ ? (best_local_[a] - patch.lower[a]) / width : 0.5;
      if (!(s[a] > 0.02 && s[a] < 0.98)) s[a] = 0.5;
    }
    const int* degree = piece_->degree.data();
    const int i = n - 1;
    detail::split_patch(coefficients(i), degree, 0, s[0], 4, coefficients(n), coefficients(i));
    detail::split_patch(coefficients(i), degree, 1, s[1], 4, coefficients(n + 1), coefficients(i));
    detail::split_patch(coefficients(n), degree, 1, s[1], 4, coefficients(n + 2), coefficients(n));
    const int upper_u[4] = {1, 0, 1, 0}, upper_v[4] = {1, 1, 0, 0};
    for (int k = 0; k < 4; ++k) {
      Patch& child = scratch_.patches[i + k];
      child = patch;
      for (int a = 0; a < 2; ++a) {
        const double middle = patch.lower[a] + s[a] * (patch.upper[a] - patch.lower[a]);
        ((a == 0 ? upper_u[k] : upper_v[k]) ? child.lower[a] : child.upper[a]) = middle;
      }
      child.bound = std::max(patch.bound, lower_bound(coefficients(i + k)));
    }
  }

  // min q_i / v_i over the Bernstein coefficients of degree (2p, 2q).
  double lower_bound(const double* c) {
    const int p = piece_->degree[0], q = piece_->degree[1], row = 2 * p + 1;
    auto& square = scratch_.square;
    auto& weight_square = scratch_.weight_square;
    square.assign(size_t(row) * (2 * q + 1), 0.0);
    weight_square.assign(square.size(), 0.0);
    const double* Bp = detail::binomials(p);
    const double* Bq = detail::binomials(q);
    for (int j = 0; j <= q; ++j)
      for (int l = 0; l <= q; ++l)
        for (int i = 0; i <= p; ++i)
          for (int k = 0; k <= p; ++k) {
            const double* a = c + 4 * (j * (p + 1) + i);
            const double* b = c + 4 * (l * (p + 1) + k);
            const double factor = Bp[i] * Bp[k] * Bq[j] * Bq[l];
            const int m = (j + l) * row + i + k;
            square[m] += factor * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
            weight_square[m] += factor * a[3] * b[3];
          }
    double least = std::numeric_limits<double>::infinity();
    for (size_t m = 0; m < square.size(); ++m)
      least = std::min(least, square[m] / weight_square[m]);
    return std::sqrt(std::max(0.0, least));
  }

  // The corner or centre of a patch closest to X.
  Vec<2> start_of_descent(const Patch& patch, const double* c) const {
    const int p = piece_->degree[0];
    const int corner[4] = {0, p, n_ - 1 - p, n_ - 1};
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
      Eigen::Map<const Vec<3>> a(c + 4 * corner[k]);
      const double square = a.squaredNorm() / (c[4 * corner[k] + 3] * c[4 * corner[k] + 3]);
      if (square < least) {
        least = square;
        nearest = k;
      }
    }
    const double share = 0.1;  // into the patch, off a minimum already found at its corner
    Vec<2> s;
    for (int a = 0; a < 2; ++a) {
      const bool upper = a == 0 ? nearest % 2 == 1 : nearest >= 2;
      const double x = upper ? 1 - share : share;
      s[a] = patch.lower[a] + x * (patch.upper[a] - patch.lower[a]);
    }
    return s;
  }

  struct Jet {
    Vec<3> offset;  // C - X
    Eigen::Matrix<double, 3, 2> first;
    Vec<3> second[3];  // uu, uv, vv
  };

  Jet evaluate(const Vec<2>& s) const {
    double B[2][3][max_functions];
    for (int a = 0; a < 2; ++a)
      detail::bernstein_basis(piece_->degree[a], s[a], 2, max_functions, B[a][0]);
    constexpr int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    Eigen::Matrix<double, 4, 6> A = Eigen::Matrix<double, 4, 6>::Zero();
    for (int j = 0, i = 0; j <= piece_->degree[1]; ++j)
      for (int k = 0; k <= piece_->degree[0]; ++k, ++i) {
        const double w = piece_->weights[i];
        const Vec<3> a = w * (piece_->points.col(i) - X_);
        for (int m = 0; m < 6; ++m) {
          const double product = B[0][order[m][0]][k] * B[1][order[m][1]][j];
          A.col(m).head<3>() += product * a;
          A(3, m) += product * w;
        }
      }
    const double w = A(3, 0);
    Jet jet;
    jet.offset = A.col(0).head<3>() / w;
    for (int a = 0; a < 2; ++a)
      jet.first.col(a) = (A.col(1 + a).head<3>() - A(3, 1 + a) * jet.offset) / w;
    for (int m = 0; m < 3; ++m) {
      const int a = m == 2 ? 1 : 0, b = m == 0 ? 0 : 1;
      jet.second[m] = (A.col(3 + m).head<3>() - A(3, 1 + a) * jet.first.col(b) -
                       A(3, 1 + b) * jet.first.col(a) - A(3, 3 + m) * jet.offset) /
                      w;
    }
    return jet;
  }

  // Newton with Gauss-Newton as a fallback, kept inside the piece.
  void descend(Vec<2> s) {
    Jet jet = evaluate(s);
    for (int iteration = 0; iteration < 40; ++iteration) {
      const Vec<2> gradient = jet.first.transpose() * jet.offset;
      Mat<2> normal = jet.first.transpose() * jet.first;
      const double damping = 1e-14 * normal.trace() + 1e-300;
      normal.diagonal().array() += damping;
      Mat<2> hessian = normal;
      hessian(0, 0) += jet.offset.dot(jet.second[0]);
      hessian(1, 1) += jet.offset.dot(jet.second[2]);
      hessian(0, 1) = hessian(1, 0) += jet.offset.dot(jet.second[1]);
      bool fixed[2];
      for (int a = 0; a < 2; ++a)
        fixed[a] = (s[a] <= 0 && gradient[a] > 0) || (s[a] >= 1 && gradient[a] < 0);
      const bool convex = (fixed[0] || hessian(0, 0) > 0) && (fixed[1] || hessian(1, 1) > 0) &&
                          (fixed[0] || fixed[1] || hessian.determinant() > 0);
      const Vec<2> step = solve(convex ? hessian : normal, gradient, fixed);
      const double old = jet.offset.squaredNorm();
      const double least_length = 1e-13 / (1e-300 + step.cwiseAbs().maxCoeff());
      Vec<2> next;
      for (double length = 1; length == 1 || length > least_length; length *= 0.5) {
        next = (s - length * step).cwiseMax(0.0).cwiseMin(1.0);
        jet = evaluate(next);
        if (jet.offset.squaredNorm() <= old) break;
      }
      const double moved = (next - s).cwiseAbs().maxCoeff();
      if (jet.offset.squaredNorm() > old) {
        jet = evaluate(s);
        break;
      }
      s = next;
      if (moved < 1e-15) break;
      if (iteration == 8 && jet.offset.norm() > 2 * least_ + size_) break;
    }
    offer(s, jet.offset);
  }

  static Vec<2> solve(const Mat<2>& A, const Vec<2>& b, const bool* fixed) {
    if (fixed[0] && fixed[1]) return Vec<2>::Zero();
    if (fixed[0]) return {0, b[1] / A(1, 1)};
    if (fixed[1]) return {b[0] / A(0, 0), 0};
    return A.inverse() * b;
  }

  void offer(const Vec<2>& s, const Vec<3>& offset) {
    const double distance = offset.norm();
    if (!(distance <= least_) || distance == best_.distance) return;
    least_ = best_.distance = distance;
    best_.point = X_ + offset;
    for (int a = 0; a < 2; ++a)
      best_.u[a] = s[a] == 1 ? piece_->upper[a]
                             : piece_->lower[a] + s[a] * (piece_->upper[a] - piece_->lower[a]);
    best_local_ = s;
    best_piece_ = piece_;
  }

  const PreparedNurbs<2, 3>& part_;
  const Vec<3> X_;
  Scratch& scratch_;
  double least_, size_;
  ClosestPoint<3> best_;
  Vec<2> best_local_;
  const BezierPiece<2, 3>* best_piece_ = nullptr;
  const BezierPiece<2, 3>* piece_ = nullptr;
  int n_ = 0;
};

}  // namespace

template <>
ClosestPoint<3> closest_point(const PreparedNurbs<2, 3>& part, const Vec<3>& X, double cutoff) {
  thread_local Scratch scratch;
  return SurfaceClosest(part, X, cutoff, scratch).run();
}

}  // namespace sem
