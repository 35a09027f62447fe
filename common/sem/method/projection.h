#pragma once
// Stage 8: the projection p -> (c, t).

#include <vector>

#include "sem/method/monomials.h"
#include "sem/method/origins.h"
#include "sem/method/samples.h"

namespace sem {

enum class FitKind {
  degree_by_degree,      ///< scaled, orthogonalised within each degree, rank revealed
  degree_by_degree_raw,  ///< the same fits by the pseudo-inverse of raw monomials (public code)
  pseudo_inverse,        ///< all degrees at once, minimum norm (draft eq. 5)
};

struct ProjectionOptions {
  int degree = 1;                            ///< n, 1 to 4
  FitKind fit = FitKind::degree_by_degree;
  double rank_tolerance = 1e-8;  ///< relative pivot below which a direction is not determined
};

/// Functionals of the unknowns that several parts share: rows * p[columns].
struct SharedRows {
  std::vector<int> columns;  ///< ascending
  Eigen::MatrixXd rows;      ///< #rows by #columns
};

/// The fit of one part. Scalar: every component of p is projected by the same matrix. It acts on
/// y = (p[columns], shared rows), the part's own control points and what it shares with others: few numbers,
/// however many control points those depend on.
struct PartFit {
  std::vector<int> columns;      ///< control points, ascending
  std::vector<int> shared = {};  ///< rows among all of Projection::shared
  Eigen::MatrixXd coefficients;  ///< #monomials by #columns + #shared: c_i = coefficients * y
  Eigen::RowVectorXd translation;  ///< #columns + #shared: t_i, the centroid of the origin's set
  double scale = 1;              ///< h_i, m: c_i belongs to the monomials of (X - origin) / h_i
  std::vector<int> rank;         ///< determined directions: per degree, or one entry (pseudo-inverse)
  bool borrowed = false;         ///< the linear fit took directions from the origin's set
  double condition = 1;          ///< largest over smallest pivot kept in the first fit
};

/// Fits of all parts.
template <int Dim>
struct Projection {
  Monomials<Dim> monomials{1};
  std::vector<PartFit> parts;
  std::vector<SharedRows> shared;  ///< per origin: its centroid; the linear fit of its set, if a part borrows it
};

/// The fit of part i on control points alone: its shared rows written out.
template <int Dim>
PartFit fit_on_controls(const Projection<Dim>& projection, int i);

/// Fits the polynomial of every part to its samples, in least squares weighted
/// by the samples' weights.
///
/// Degree by degree: t first, then the linear part to q - t, the quadratic to
/// what is left, ... A straight part (X and XY coincide on y = h) keeps an
/// affine field that way, unless its origin lies on its line. Orthogonalised:
/// monomials are scaled by the samples' root mean square distance from the
/// origin, each degree's block is orthogonalised with its
/// rank revealed (least_squares.h), and directions below rank_tolerance, which the samples do not
/// determine, get zero - but in the linear part (an origin on a straight part's
/// line, where F would lose a dimension): there they follow the linear fit of all
/// samples of the origin's set, and affine fields are kept (our addition). Raw: no scaling, and only directions at rounding level
/// are cut, as a numerical pseudo-inverse does. At once (the draft): the minimum
/// norm mixes the degrees on a straight part and loses even affine fields.
/// Throws InputError (field `method.degree`) outside 1..4.
template <int Dim>
Projection<Dim> project(const Samples<Dim>& samples, const Origins<Dim>& origins,
                        const ProjectionOptions& options);

}  // namespace sem
