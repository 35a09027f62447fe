#pragma once
// Stage 9: the map x(X) = Gamma(X) z and its gradient F = B z as scalar rows.

#include <array>
#include <vector>

#include "sem/method/projection.h"

namespace sem {

/// Points that depend on the same unknowns. Every component of x uses the
/// same scalar basis, so a row of Gamma or B is stored once:
///   x_a(X_k) = sum_j value(k, j) z_{columns[j], a}
///   F_ab(X_k) = sum_j gradient[b](k, j) z_{columns[j], a}
template <int Dim>
struct MapBlock {
  std::vector<int> points;                    ///< indices into the point set
  std::vector<int> columns;                   ///< active unknowns (scalar, 0..n-1), ascending
  Eigen::MatrixXd value;                      ///< #points by #columns
  std::array<Eigen::MatrixXd, Dim> gradient;  ///< each #points by #columns; empty if not asked for
};

/// Gamma and B at a set of points; the unknown vector z has n_columns vectors
/// of Dim, stacked: z = (z_0x, z_0y, z_1x, ...).
template <int Dim>
struct Map {
  int n_points = 0, n_columns = 0;
  std::vector<MapBlock<Dim>> blocks;

  /// Share of stored entries among n_points * n_columns.
  double fill() const;
};

/// The blended map of the control points, draft eq. 2-6 with a translation per
/// origin: x(X) = sum_i w_i [m(X - Xbar_i) c_i + t_i]. The gradient is the
/// paper's diffuse one, grad w left out of it (draft eq. 12), unless the
/// weights have their gradients: then it is that of x(X). n_columns: the
/// number of control points.
template <int Dim>
Map<Dim> blended_map(const Points<Dim>& position, const BlendingWeights<Dim>& weights,
                     const Origins<Dim>& origins, const Projection<Dim>& projection, int n_columns,
                     bool with_gradient, int n_threads = 1);

struct PruneReport {
  double relative_error = 0;  ///< Frobenius norm of what was dropped (after renormalising) over that of B
  int kept = 0;               ///< columns per point
};

/// Draft eq. 14: keeps the n_keep columns of each point that are largest in
/// the infinity norm of dF/dq (ties: the lower index). Renormalised: the kept
/// values again sum to 1 and the gradients to 0, by an equal share for each, so
/// that translations stay exact; without it they do not.
template <int Dim>
PruneReport prune(Map<Dim>& map, int n_keep, bool renormalise);

/// Dense scalar matrices of a map, for tests and small problems: n_points by n_columns.
template <int Dim>
Eigen::MatrixXd dense_value(const Map<Dim>& map);
template <int Dim>
Eigen::MatrixXd dense_gradient(const Map<Dim>& map, int axis);

/// x at the map's points for unknowns z: Dim by #points.
template <int Dim>
Points<Dim> evaluate(const Map<Dim>& map, const Eigen::VectorXd& z);

/// sum_k values.col(k) Gamma_k, Dim by n_columns: the transpose of `evaluate`. values: Dim by #points.
template <int Dim>
Points<Dim> evaluate_transposed(const Map<Dim>& map, const Points<Dim>& values);

/// F for unknowns z at the block's point of this row.
template <int Dim>
Mat<Dim> deformation_gradient(const MapBlock<Dim>& block, int row, const Eigen::VectorXd& z);

}  // namespace sem
