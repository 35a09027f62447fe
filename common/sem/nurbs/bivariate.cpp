#include "sem/nurbs/bivariate.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sem/nurbs/bernstein.h"

namespace sem::detail {
namespace {

constexpr int most_halvings = 30;   // of regular patches
constexpr int coarse_halvings = 4;  // where there are too many: a curve of zeros
constexpr int most_patches = 3000;
constexpr int most_degree = 3 * max_nurbs_degree;

// (n over k) of a degree as a sum of two.
double share_of(int i, int p, int j, int q) {
  return binomials(p)[i] * binomials(q)[j] / binomials(p + q)[i + j];
}

struct ZeroPatch {
  Vec<2> lower, upper;
  int halvings;
  std::vector<Vec<2>> c;
};

class ZeroFinder {
 public:
  ZeroFinder(const Bivariate& f, const Bivariate& g, const Vec<2>& rounding)
      : degree_(f.degree), rounding_(rounding) {
    assert(f.degree == g.degree);
    for (size_t i = 0; i < f.c.size(); ++i) whole_.push_back({f.c[i], g.c[i]});
  }

  std::vector<CommonZero> run() {
    Vec<2> largest = Vec<2>::Zero();
    for (const auto& value : whole_) largest = largest.cwiseMax(value.cwiseAbs());
    if ((largest.array() <= rounding_.array()).any()) return {};
    std::vector<ZeroPatch> open = {{Vec<2>::Zero(), Vec<2>::Ones(), 0, whole_}};
    int n_patches = 0;
    while (!open.empty()) {
      ZeroPatch patch = std::move(open.back());
      open.pop_back();
      const int limit = ++n_patches > most_patches ? coarse_halvings : most_halvings;
      if (!finish(patch, limit)) quarter(patch, open);
    }
    return std::move(zeros_);
  }

 private:
  bool excluded(const std::vector<Vec<2>>& c, const Vec<2>& combination) const {
    double least = combination.dot(c[0]), largest = least;
    for (const auto& value : c) {
      const double v = combination.dot(value);
      least = std::min(least, v);
      largest = std::max(largest, v);
    }
    const double rounding = combination.cwiseAbs().dot(rounding_);
    return least > rounding || largest < -rounding;
  }

  // Value and Jacobian of the whole.
  void evaluate(const Vec<2>& s, Vec<2>& value, Mat<2>& jacobian) const {
    double B[2][2][most_degree];
    for (int a = 0; a < 2; ++a) bernstein_basis(degree_[a], s[a], 1, most_degree, B[a][0]);
    value.setZero();
    jacobian.setZero();
    for (int j = 0, i = 0; j <= degree_[1]; ++j)
      for (int k = 0; k <= degree_[0]; ++k, ++i) {
        value += B[0][0][k] * B[1][0][j] * whole_[i];
        jacobian.col(0) += B[0][1][k] * B[1][0][j] * whole_[i];
        jacobian.col(1) += B[0][0][k] * B[1][1][j] * whole_[i];
      }
  }

  // Whether the inverse at the middle makes the Jacobian diagonally dominant: at most one zero.
  bool at_most_one(const std::vector<Vec<2>>& c, const Mat<2>& inverse) const {
    Vec<2> least = Vec<2>::Constant(1e300), largest = Vec<2>::Zero();
    const int n_u = degree_[0] + 1, n = int(c.size());
    for (int i = 0; i < n; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const int next = axis == 0 ? i + 1 : i + n_u;
        if (axis == 0 ? next % n_u == 0 : next >= n) continue;
        const Vec<2> slope = degree_[axis] * (inverse * (c[next] - c[i]));
        least[axis] = std::min(least[axis], slope[axis]);
        largest[1 - axis] = std::max(largest[1 - axis], std::abs(slope[1 - axis]));
      }
    return (least.array() > largest.array()).all();
  }

  bool finish(const ZeroPatch& patch, int limit) {
    if (excluded(patch.c, {1, 0}) || excluded(patch.c, {0, 1})) return true;
    const Vec<2> size = patch.upper - patch.lower, middle = (patch.lower + patch.upper) / 2;
    Vec<2> value;
    Mat<2> J;
    evaluate(middle, value, J);
    J = J * size.asDiagonal();
    const double determinant = J.determinant();
    if (std::abs(determinant) > 1e-9 * J.squaredNorm()) {
      const Mat<2> inverse = J.inverse();
      if (excluded(patch.c, inverse.row(0)) || excluded(patch.c, inverse.row(1))) return true;
      if (at_most_one(patch.c, inverse)) {
        add(middle, patch, true);
        return true;
      }
    }
    if (patch.halvings < limit) return false;
    add(middle, patch, false);
    return true;
  }

  // The zero next to s by Newton's method (least squares where it is not regular), if it lies in
  // the patch to rounding.
  void add(Vec<2> s, const ZeroPatch& patch, bool regular) {
    const Vec<2> size = patch.upper - patch.lower;
    const double slack = regular ? 1e-9 : 0.5;
    for (int iteration = 0; iteration < 40; ++iteration) {
      Vec<2> value;
      Mat<2> J;
      evaluate(s, value, J);
      Vec<2> step;
      if (regular) {
        step = J.inverse() * value;
      } else {
        J = rounding_.cwiseInverse().asDiagonal() * J;
        Mat<2> A = J.transpose() * J;
        A.diagonal().array() += 1e-12 * A.trace() + 1e-300;
        step = A.inverse() * (J.transpose() * value.cwiseQuotient(rounding_));
      }
      s = (s - step).cwiseMax(-0.1).cwiseMin(1.1);
      if (!(step.cwiseAbs().maxCoeff() > 1e-15)) break;
    }
    if (!s.allFinite() || (s.array() < patch.lower.array() - slack * size.array()).any() ||
        (s.array() > patch.upper.array() + slack * size.array()).any())
      return;
    s = s.cwiseMax(0.0).cwiseMin(1.0);
    if (!regular) {
      Vec<2> value;
      Mat<2> J;
      evaluate(s, value, J);
      if ((value.cwiseAbs().array() > 100 * rounding_.array()).any()) return;
    }
    zeros_.push_back({s, regular});
  }

  void quarter(ZeroPatch& patch, std::vector<ZeroPatch>& open) const {
    std::vector<ZeroPatch> parts = {std::move(patch)};
    for (int axis = 0; axis < 2; ++axis)
      for (size_t k = 0, n = parts.size(); k < n; ++k) {
        ZeroPatch left = parts[k];
        split_patch<2>(parts[k].c.data(), degree_.data(), axis, 0.5, left.c.data(),
                       parts[k].c.data());
        left.upper[axis] = parts[k].lower[axis] = (left.lower[axis] + left.upper[axis]) / 2;
        parts.push_back(std::move(left));
      }
    for (auto& part : parts) {
      ++part.halvings;
      open.push_back(std::move(part));
    }
  }

  std::array<int, 2> degree_;
  Vec<2> rounding_;
  std::vector<Vec<2>> whole_;
  std::vector<CommonZero> zeros_;
};

}  // namespace

Bivariate product(const Bivariate& f, const Bivariate& g) {
  Bivariate h{{f.degree[0] + g.degree[0], f.degree[1] + g.degree[1]}, {}};
  const int n = h.degree[0] + 1;
  h.c.assign(size_t(n) * (h.degree[1] + 1), 0);
  for (int j = 0; j <= f.degree[1]; ++j)
    for (int l = 0; l <= g.degree[1]; ++l) {
      const double of_t = share_of(j, f.degree[1], l, g.degree[1]);
      for (int i = 0; i <= f.degree[0]; ++i)
        for (int k = 0; k <= g.degree[0]; ++k)
          h.c[(j + l) * n + i + k] += of_t * share_of(i, f.degree[0], k, g.degree[0]) *
                                      f.c[j * (f.degree[0] + 1) + i] *
                                      g.c[l * (g.degree[0] + 1) + k];
    }
  return h;
}

Bivariate sum(const Bivariate& f, const Bivariate& g, double share) {
  assert(f.degree == g.degree);
  Bivariate h = f;
  for (size_t i = 0; i < h.c.size(); ++i) h.c[i] += share * g.c[i];
  return h;
}

Bivariate derivative(const Bivariate& f, int axis) {
  if (f.degree[axis] == 0) return {f.degree, std::vector<double>(f.c.size(), 0.0)};
  Bivariate h = f;
  h.c.clear();
  --h.degree[axis];
  const int n_u = f.degree[0] + 1, stride = axis == 0 ? 1 : n_u;
  for (int j = 0; j <= h.degree[1]; ++j)
    for (int i = 0; i <= h.degree[0]; ++i)
      h.c.push_back(f.degree[axis] * (f.c[j * n_u + i + stride] - f.c[j * n_u + i]));
  return h;
}

Bivariate raised(const Bivariate& f, const std::array<int, 2>& degree) {
  const std::array<int, 2> by = {degree[0] - f.degree[0], degree[1] - f.degree[1]};
  return product(f, {by, std::vector<double>(size_t(by[0] + 1) * (by[1] + 1), 1.0)});
}

std::vector<CommonZero> common_zeros(const Bivariate& f, const Bivariate& g,
                                     const Vec<2>& rounding) {
  return ZeroFinder(f, g, rounding).run();
}

}  // namespace sem::detail
