#pragma once
// Control points that the samples do not determine: they follow the others.

#include <algorithm>

#include "sem/method/samples.h"
#include "sem/method/unknowns.h"

namespace sem {

/// Which control points follow, and whom.
///
/// Who, on a trimmed part: control points whose basis functions, on what their part is trimmed to, are combinations of
/// those of the part's other control points: pivoted Cholesky of sum_s a_s J_s^T J_s over the
/// part's samples, scaled to the diagonal that the untrimmed part has; a control point follows when
/// the square of what it adds is below 1e-6 of that. Those without any sample are among them. On
/// other parts: control points of an edge that is one point, if beside weights a million times theirs
/// nothing but this point shows them: the mean square of the basis function over the part is below
/// 1e-8 of 1/n^2, what n equal ones would have. Whom:
/// p_j = the affine map that fits the part's other control points best (least squares, of least
/// norm where they lie on a plane), at rest p_j's place; the solid's other control points where the
/// part's own lie on a plane or line that p_j is not on. So affine motions are exact, and a part
/// that bends leaves its followers on its mean plane: nothing of the surface depends on
/// them noticeably.
template <int Dim>
struct Followers {
  std::vector<int> control;               ///< ascending
  std::vector<std::vector<int>> leaders;  ///< of each, ascending; none of them follows
  std::vector<Eigen::RowVectorXd> share;  ///< of each leader; sum to 1

  bool empty() const { return control.empty(); }
  bool follows(int c) const { return std::binary_search(control.begin(), control.end(), c); }
};

template <int Dim>
Followers<Dim> find_followers(const Boundary<Dim>& boundary, const Samples<Dim>& samples);

/// Rewrites the samples' rows of J in terms of control points that do not follow.
template <int Dim>
void substitute(const Followers<Dim>& followers, Samples<Dim>& samples);

/// The paper's formulation: z are the control points that do not follow. `unknown_of` (#control
/// points) is the column of each, -1: it follows.
template <int Dim>
Unknowns<Dim> leading_unknowns(const Boundary<Dim>& boundary, const Followers<Dim>& followers,
                               std::vector<int>& unknown_of);

/// Condensed: rows of S of the followers, from those of their leaders.
template <int Dim>
void follow(const Followers<Dim>& followers, Eigen::MatrixXd& S);

}  // namespace sem
