#pragma once
// Stage 9: the map x(X) = Gamma(X) z and its gradient F = B z as scalar rows.

#include <array>
#include <vector>

#include "sem/method/projection.h"

namespace sem {

/// Points that depend on the same unknowns. Every component of x uses the
/// same scalar basis, so a row of Gamma or B is stored once:
///   x_a(X_k) = sum_j value(k, j) y_{columns[j], a}
///   F_ab(X_k) = sum_j gradient[b](k, j) y_{columns[j], a}
/// y are the unknowns z, followed by what parts share of them (Map::shared).
template <int Dim>
struct MapBlock {
  std::vector<int> points;                    ///< indices into the point set
  std::vector<int> columns;                   ///< of y, ascending
  Eigen::MatrixXd value;                      ///< #points by #columns
  std::array<Eigen::MatrixXd, Dim> gradient;  ///< each #points by #columns; empty if not asked for
};

/// Gamma and B at a set of points; the unknown vector z has n_columns vectors
/// of Dim, stacked: z = (z_0x, z_0y, z_1x, ...). In the paper's formulation a point depends on the control
/// points of every part that shares an origin with a part near it, but only through a few sums T z of them:
/// the blocks act on y = (z, T z).
template <int Dim>
struct Map {
  int n_points = 0, n_columns = 0;
  std::vector<MapBlock<Dim>> blocks;
  std::vector<SharedRows> shared;  ///< T: entries of y from n_columns on, in order

  int n_shared() const;
  /// Share of the entries of Gamma on z that are not zero by structure.
  double fill() const;
};

/// y = (z, T z), Dim by n_columns + n_shared. The second form does not allocate if y has that size.
template <int Dim>
Points<Dim> coefficients(const Map<Dim>& map, const Eigen::VectorXd& z);
template <int Dim>
void set_coefficients(const Map<Dim>& map, const Eigen::VectorXd& z, Points<Dim>& y);

/// The unknowns that a block's points depend on, shared rows written out; ascending.
template <int Dim>
std::vector<int> unknowns_of(const Map<Dim>& map, const MapBlock<Dim>& block);

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
/// the infinity norm of dF/dq (ties: the lower index); shared rows are written out. Renormalised: the kept
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

/// The transpose of `coefficients`, in place: adds the last n_shared columns of `sum`, carried over by T, to its
/// first n_columns.
template <int Dim>
void add_shared(const Map<Dim>& map, Points<Dim>& sum);

/// F at the block's point of this row, y = coefficients(map, z).
template <int Dim>
Mat<Dim> deformation_gradient(const MapBlock<Dim>& block, int row, const Points<Dim>& y);

}  // namespace sem
