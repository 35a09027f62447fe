#pragma once
// What the unknowns z are, beside the map x(X) = Gamma(X) z and F = B z: z consists of n vectors of
// Dim, stacked; every component uses the same scalar operators. Pins, loads, outputs and initial
// velocities go through these, so that another choice of unknowns changes nothing of them.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sem/method/boundary.h"

namespace sem {

template <int Dim>
struct Unknowns {
  Points<Dim> rest;     ///< Dim by n: z of x(X) = X, m
  Eigen::VectorXd one;  ///< n: z of the scalar field 1
  Eigen::MatrixXd S;    ///< #control points by n, boundary output p = S z; empty: the identity

  int size() const { return int(rest.cols()); }
  int n_controls() const { return S.size() > 0 ? int(S.rows()) : size(); }
};

/// The paper's formulation: z are the control points, S is the identity and is not stored.
template <int Dim>
Unknowns<Dim> control_point_unknowns(const Boundary<Dim>& boundary);

/// Every control point's leader. In clusters of control points that are within 1e-5 of the body's size but not all the
/// same, as across a sliver, the first of each part leads the part's others, the first of all leads these; else each
/// leads itself. Empty if all do.
template <int Dim>
std::vector<int> leaders_of_near_controls(const Boundary<Dim>& boundary);

/// The paper's formulation where control points are that near: z are the control points that lead themselves and
/// the others' differences from their leaders. Across a sliver B on control points has entries of 1 / thickness that cancel in what
/// moves both sides together, down to the rounding of a stiffness beside which inertia vanishes; in these unknowns
/// the large entries are those of the differences alone.
template <int Dim>
Unknowns<Dim> difference_unknowns(const Boundary<Dim>& boundary, const std::vector<int>& leader);

/// p = S z, Dim by #control points; z has Dim * n entries.
template <int Dim>
Points<Dim> control_points(const Unknowns<Dim>& unknowns, const Eigen::VectorXd& z);

/// The unknown (0..n-1) that is a control point by itself (a unit row of S), so that a pin of the
/// one takes the other out of the system; none if the control point depends on several.
template <int Dim>
std::optional<int> unknown_of_control(const Unknowns<Dim>& unknowns, int control);

/// z of the affine field x(X) = A X + b, exact wherever the map reproduces X and 1.
template <int Dim>
Eigen::VectorXd affine_field(const Unknowns<Dim>& unknowns, const Mat<Dim>& A, const Vec<Dim>& b);

}  // namespace sem
