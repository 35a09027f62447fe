#pragma once
// Stage 2: boundary samples q = J p.

#include <vector>

#include "sem/method/boundary.h"

namespace sem {

enum class SampleWeight {
  measure,  ///< arc length or area
  uniform,  ///< all samples of the model count the same, as in the draft's eq. 4; same total
};

enum class SampleRule {
  gauss_lobatto,  ///< ends of spans included
  gauss,          ///< Gauss-Legendre: interior points, where normals and gradients are unique
};

struct SamplingOptions {
  int points_per_span = 0;  ///< points per knot span and direction; 0: NURBS degree + 1
  SampleWeight weight = SampleWeight::measure;
  SampleRule rule = SampleRule::gauss_lobatto;
  /// Spans at a part's ends are cut at 1/2, 1/4, ... of their length from it, so often: what grows towards joints is
  /// integrated well (untrimmed parts).
  int end_halvings = 0;
};

/// Samples of all parts, ordered by part.
template <int Dim>
struct Samples {
  Points<Dim> position;                 ///< Dim by #samples, rest position X = J p0
  Eigen::VectorXd weight;               ///< #samples, m (2D) or m^2 (3D); sums to the boundary's measure
  std::vector<Param<Dim - 1>> u;        ///< #samples
  std::vector<int> part;                ///< #samples
  std::vector<int> first;               ///< #parts + 1: where a part's samples start
  // Scalar rows of J (eq. 9): sample s = sum_e value[e] * p_{column[e]}, e in [row[s], row[s+1]).
  std::vector<int> row, column;
  std::vector<double> value;

  int size() const { return int(part.size()); }
};

/// By default Gauss-Lobatto points in every knot span, ends included, so that a span's
/// ends are samples (both one-sided limits where the part may jump). With degree + 1 points per span
/// J determines p wherever a span's basis does; two more are taken where the part's tangents vanish at an
/// end, so that a sample there has no weight (a patch with a collapsed edge, a cusp). Trimmed parts: the rule of
/// their region (trims.h) with as many points. Throws InputError if points_per_span is 1 or negative.
template <int Dim>
Samples<Dim> sample_boundary(const Boundary<Dim>& boundary, const SamplingOptions& options);

/// J as a dense scalar matrix, #samples by n_controls.
template <int Dim>
Eigen::MatrixXd sample_jacobian(const Samples<Dim>& samples, int n_controls);

}  // namespace sem
