#include "sem/nurbs/surface_foot.h"

#include <algorithm>
#include <cmath>

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/kernels.h"

namespace sem::detail {
namespace {

Vec<2> solve(const Mat<2>& A, const Vec<2>& b, const bool* fixed) {
  if (fixed[0] && fixed[1]) return Vec<2>::Zero();
  if (fixed[0]) return {0, b[1] / A(1, 1)};
  if (fixed[1]) return {b[0] / A(0, 0), 0};
  return A.inverse() * b;
}

bool is_convex(const Mat<2>& A, const bool* fixed) {
  return (fixed[0] || A(0, 0) > 0) && (fixed[1] || A(1, 1) > 0) &&
         (fixed[0] || fixed[1] || A.determinant() > 0);
}

void set_gradient(const SurfacePatch& patch, SurfaceFoot& foot) {
  foot.gradient = foot.jet.gradient();
  for (int a = 0; a < 2; ++a)
    foot.fixed[a] = (foot.s[a] <= patch.lower[a] && foot.gradient[a] >= 0) ||
                    (foot.s[a] >= patch.upper[a] && foot.gradient[a] <= 0);
}

}  // namespace

Mat<2> SurfaceJet::hessian() const {
  Mat<2> H = first.transpose() * first;
  H(0, 0) += offset.dot(second[0]);
  H(1, 1) += offset.dot(second[2]);
  H(0, 1) = H(1, 0) += offset.dot(second[1]);
  return H;
}

void SurfaceFeet::set_piece(const BezierPiece<2, 3>& piece) {
  if (piece_ == &piece) return;
  piece_ = &piece;
  if (part_.power) return;
  coefficients_.resize(piece.weights.size());
  for (int i = 0; i < piece.weights.size(); ++i)
    coefficients_[i] << piece.weights[i] * (piece.points.col(i) - X_), piece.weights[i];
}

// w (C - X), w and their derivatives u, v, uu, uv, vv.
void SurfaceFeet::evaluate_powers(const Vec<2>& s, Vec4* A) const {
  const PowerForm& power = *part_.power;
  const double* coefficients = power.coefficient + (piece_ - part_.pieces.data()) * power.stride;
  const double local[2] = {2 * s[0] - 1, 2 * s[1] - 1};
  alignas(32) double jets[24];
  kernels->surface_second_jets(power, coefficients, local, jets);
  const Vec<3> R = X_ - Eigen::Map<const Vec<3>>(coefficients);
  constexpr double scale[6] = {1, 2, 2, 4, 4, 4};
  for (int m = 0; m < 6; ++m) {
    A[m] = scale[m] * Eigen::Map<const Vec4>(jets + 4 * m);
    A[m].head<3>() -= A[m][3] * R;
  }
}

void SurfaceFeet::evaluate_bernstein(const Vec<2>& s, Vec4* A) const {
  double B[2][3][max_nurbs_functions];
  for (int a = 0; a < 2; ++a)
    bernstein_basis(piece_->degree[a], s[a], 2, max_nurbs_functions, B[a][0]);
  constexpr int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (int m = 0; m < 6; ++m) A[m].setZero();
  const Vec4* c = coefficients_.data();
  for (int j = 0; j <= piece_->degree[1]; ++j) {
    Vec4 row[3] = {Vec4::Zero(), Vec4::Zero(), Vec4::Zero()};
    for (int k = 0; k <= piece_->degree[0]; ++k, ++c)
      for (int t = 0; t < 3; ++t) row[t] += B[0][t][k] * *c;
    for (int m = 0; m < 6; ++m) A[m] += B[1][order[m][1]][j] * row[order[m][0]];
  }
}

SurfaceJet SurfaceFeet::evaluate(const Vec<2>& s) const {
  Vec4 A[6];
  part_.power ? evaluate_powers(s, A) : evaluate_bernstein(s, A);
  SurfaceJet jet;
  const double inverse = 1 / A[0][3];
  for (auto& derivative : A) derivative *= inverse;
  jet.offset = A[0].head<3>();
  for (int a = 0; a < 2; ++a) jet.first.col(a) = A[1 + a].head<3>() - A[1 + a][3] * jet.offset;
  for (int m = 0; m < 3; ++m) {
    const int a = m == 2 ? 1 : 0, b = m == 0 ? 0 : 1;
    jet.second[m] = A[3 + m].head<3>() - A[1 + a][3] * jet.first.col(b) -
                    A[1 + b][3] * jet.first.col(a) - A[3 + m][3] * jet.offset;
  }
  return jet;
}

SurfaceFoot SurfaceFeet::start(const Vec<2>& s, const SurfacePatch& patch) const {
  SurfaceFoot foot;
  foot.s = s;
  foot.jet = evaluate(s);
  set_gradient(patch, foot);
  return foot;
}

bool SurfaceFeet::step(SurfaceFoot& foot, const SurfacePatch& patch) const {
  if (foot.settled) return false;
  foot.settled = true;
  const SurfaceJet& jet = foot.jet;
  Mat<2> normal = jet.first.transpose() * jet.first;
  const double damping = 1e-14 * normal.trace() + 1e-300;
  normal.diagonal().array() += damping;
  Mat<2> hessian = jet.hessian();
  hessian.diagonal().array() += damping;
  const bool convex = is_convex(hessian, foot.fixed);
  const Vec<2> step = solve(convex ? hessian : normal, foot.gradient, foot.fixed);
  const double old = jet.offset.squaredNorm();
  const double least_length = 1e-13 / (1e-300 + step.cwiseAbs().maxCoeff());
  double length = 1;
  Vec<2> next;
  SurfaceJet there;
  for (; length == 1 || length > least_length; length *= 0.5) {
    next = (foot.s - length * step).cwiseMax(patch.lower).cwiseMin(patch.upper);
    there = evaluate(next);
    if (there.offset.squaredNorm() <= old) break;
  }
  if (there.offset.squaredNorm() > old) return false;
  const double moved = (next - foot.s).cwiseAbs().maxCoeff();
  foot.s = next;
  foot.jet = there;
  set_gradient(patch, foot);
  // Newton squares the error, and the distance's is its square again; see polish().
  foot.settled = moved < (convex && length == 1 ? 1e-5 : 1e-15);
  return true;
}

bool SurfaceFeet::polish(Vec<2>& s) const {
  const SurfaceJet jet = evaluate(s);
  const Vec<2> gradient = jet.gradient();
  const Mat<2> hessian = jet.hessian();
  bool fixed[2];
  for (int a = 0; a < 2; ++a)
    fixed[a] = (s[a] == 0 && gradient[a] >= 0) || (s[a] == 1 && gradient[a] <= 0);
  if (!is_convex(hessian, fixed)) return false;
  const Vec<2> step = solve(hessian, gradient, fixed);
  const double length = step.cwiseAbs().maxCoeff();
  if (!(length > 1e-16 && length < 1e-4)) return false;
  s = (s - step).cwiseMax(0.0).cwiseMin(1.0);
  return true;
}

}  // namespace sem::detail
