#pragma once
// NURBS evaluation as in Piegl and Tiller, The NURBS Book: algorithms A2.1,
// A2.2, eq. 2.7, 4.2, 4.12, A4.1 and A4.3, without allocation. What the
// library's own evaluation is compared with, output for output.

#include <algorithm>

#include "sem/nurbs/nurbs.h"

namespace sem::textbook {

/// Values and first derivatives of the degree + 1 basis functions that do not vanish at u.
struct AxisBasis {
  int first;  ///< index of the first of them
  double value[max_nurbs_degree + 1], slope[max_nurbs_degree + 1];
};

/// A2.1: index of the knot span that holds u.
inline int find_span(const std::vector<double>& knots, int degree, double u) {
  const auto end = knots.end() - degree - 1;
  if (u >= *end) return int(end - knots.begin()) - 1;
  return int(std::upper_bound(knots.begin() + degree, end, u) - knots.begin()) - 1;
}

/// A2.2; with slopes also eq. 2.7, from the functions of one degree less.
inline void evaluate_axis(const std::vector<double>& knots, int degree, double u, bool slopes,
                          AxisBasis& basis) {
  const int span = find_span(knots, degree, u);
  basis.first = span - degree;
  double left[max_nurbs_degree + 1], right[max_nurbs_degree + 1];
  double* N = basis.value;
  N[0] = 1;
  for (int j = 1; j <= degree; ++j) {
    if (slopes && j == degree)
      for (int k = 0; k <= degree; ++k) {
        const double* knot = &knots[span - degree + k];
        const double before = k > 0 ? N[k - 1] / (knot[degree] - knot[0]) : 0;
        const double after = k < degree ? N[k] / (knot[degree + 1] - knot[1]) : 0;
        basis.slope[k] = degree * (before - after);
      }
    left[j] = u - knots[span + 1 - j];
    right[j] = knots[span + j] - u;
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      const double ratio = N[r] / (right[r + 1] + left[j - r]);
      N[r] = saved + right[r + 1] * ratio;
      saved = left[j - r] * ratio;
    }
    N[j] = saved;
  }
}

/// Position (A4.1) and, with derivatives, dX/du (A4.2 for order 1) of a curve.
template <int Dim>
Vec<Dim> curve(const Nurbs<1, Dim>& nurbs, double u, Vec<Dim>* du = nullptr) {
  AxisBasis basis;
  evaluate_axis(nurbs.knots[0], nurbs.degree[0], u, du != nullptr, basis);
  Vec<Dim> A = Vec<Dim>::Zero(), dA = Vec<Dim>::Zero();
  double W = 0, dW = 0;
  for (int k = 0; k <= nurbs.degree[0]; ++k) {
    const double w = nurbs.weights[basis.first + k];
    const Vec<Dim> wP = w * nurbs.control_points.col(basis.first + k);
    A += basis.value[k] * wP;
    W += basis.value[k] * w;
    if (du) {
      dA += basis.slope[k] * wP;
      dW += basis.slope[k] * w;
    }
  }
  const Vec<Dim> X = A / W;
  if (du) *du = (dA - dW * X) / W;
  return X;
}

/// Position (A4.3) and, with derivatives, dX/du and dX/dv (A4.4 for order 1) of a surface.
inline Vec<3> surface(const Nurbs<2, 3>& nurbs, const Param<2>& uv,
                      Eigen::Matrix<double, 3, 2>* first = nullptr) {
  AxisBasis u, v;
  evaluate_axis(nurbs.knots[0], nurbs.degree[0], uv[0], first != nullptr, u);
  evaluate_axis(nurbs.knots[1], nurbs.degree[1], uv[1], first != nullptr, v);
  const int n_u = n_control(nurbs, 0);
  Eigen::Vector4d A = Eigen::Vector4d::Zero(), A_u = A, A_v = A;  // w X, w
  for (int l = 0; l <= nurbs.degree[1]; ++l) {
    Eigen::Vector4d row = Eigen::Vector4d::Zero(), row_u = row;
    for (int k = 0; k <= nurbs.degree[0]; ++k) {
      const int c = u.first + k + n_u * (v.first + l);
      const double w = nurbs.weights[c];
      Eigen::Vector4d wP;
      wP << w * nurbs.control_points.col(c), w;
      row += u.value[k] * wP;
      if (first) row_u += u.slope[k] * wP;
    }
    A += v.value[l] * row;
    if (first) {
      A_u += v.value[l] * row_u;
      A_v += v.slope[l] * row;
    }
  }
  const Vec<3> X = A.head<3>() / A[3];
  if (first) *first << (A_u.head<3>() - A_u[3] * X) / A[3], (A_v.head<3>() - A_v[3] * X) / A[3];
  return X;
}

/// Rational functions of a curve (eq. 4.2) and their slopes: degree + 1 of each.
template <int Dim>
void curve_basis(const Nurbs<1, Dim>& nurbs, double u, int* column, double* R, double* R_u) {
  AxisBasis basis;
  evaluate_axis(nurbs.knots[0], nurbs.degree[0], u, true, basis);
  double W = 0, W_u = 0;
  for (int k = 0; k <= nurbs.degree[0]; ++k) {
    column[k] = basis.first + k;
    const double w = nurbs.weights[column[k]];
    W += R[k] = basis.value[k] * w;
    W_u += R_u[k] = basis.slope[k] * w;
  }
  const double inverse = 1 / W;
  for (int k = 0; k <= nurbs.degree[0]; ++k) {
    R[k] *= inverse;
    R_u[k] = (R_u[k] - R[k] * W_u) * inverse;
  }
}

/// Rational functions of a surface (eq. 4.12) and their derivatives, u fastest.
inline void surface_basis(const Nurbs<2, 3>& nurbs, const Param<2>& uv, int* column, double* R,
                          double* R_u, double* R_v) {
  AxisBasis u, v;
  evaluate_axis(nurbs.knots[0], nurbs.degree[0], uv[0], true, u);
  evaluate_axis(nurbs.knots[1], nurbs.degree[1], uv[1], true, v);
  const int n_u = n_control(nurbs, 0);
  double W = 0, W_u = 0, W_v = 0;
  int i = 0;
  for (int l = 0; l <= nurbs.degree[1]; ++l)
    for (int k = 0; k <= nurbs.degree[0]; ++k, ++i) {
      column[i] = u.first + k + n_u * (v.first + l);
      const double w = nurbs.weights[column[i]];
      W += R[i] = u.value[k] * v.value[l] * w;
      W_u += R_u[i] = u.slope[k] * v.value[l] * w;
      W_v += R_v[i] = u.value[k] * v.slope[l] * w;
    }
  const double inverse = 1 / W;
  for (int k = 0; k < i; ++k) {
    R[k] *= inverse;
    R_u[k] = (R_u[k] - R[k] * W_u) * inverse;
    R_v[k] = (R_v[k] - R[k] * W_v) * inverse;
  }
}

}  // namespace sem::textbook
