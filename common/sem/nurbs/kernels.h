#pragma once
// Internal: the inner loops over prepared tables. kernels_body.h is compiled
// twice, for any processor and for x86-64 with AVX2 and FMA; the better one is
// chosen when the program starts. Plain data only, so that no inline function
// of another header is compiled with these instructions and used elsewhere.

#include "sem/nurbs/kernel_forms.h"

namespace sem::detail {

/// A line: zeros of normal.(X - origin); places along it direction.(X - origin).
struct KernelLine {
  double origin[2], normal[2], direction[2];
};

/// Where a piece crosses a line: local coordinate in [-1, 1], place along the line, and the
/// tangent's components along normal and direction, up to a common factor.
struct LineCrossing {
  double local, along, across_slope, along_slope;
};

/// Chords of a curve in the plane: start, step to the end, 1 / its square (0 if it is 0), and how
/// far the curve may be from the chord; n rounded up to a multiple of 4 by repeating the last.
struct ChordForm {
  const double *x, *y, *step_x, *step_y, *inverse_square, *reach;
  int n;
};

/// Polynomials c - (a x + b y) of one degree: rows of n_lanes (degree + 1 rounded up to a multiple
/// of 4, zeros appended) with the Bernstein coefficients of c, a and b, then those of the powers
/// of 2 s - 1.
struct FootForm {
  const double* rows;
  int degree, n_lanes;
};

/// Bit i: coefficient i is above, below a bound of its rounding.
struct Signs {
  unsigned positive, negative;
};

/// One instruction set's. Evaluation: by the degree (of both axes), 0 for any.
struct Kernels {
  PointKernel curve_point[4], surface_point[4];
  SlopeKernel curve_slope[4], surface_slopes[4];
  /// Value and derivatives s, t (6: also ss, st, tt) of a piece's homogeneous coordinates, 4
  /// doubles each, at local coordinates; `piece` is where its coefficients are.
  void (*surface_jets)(const PowerForm&, const double* piece, const double* local, double* jets);
  void (*surface_second_jets)(const PowerForm&, const double* piece, const double* local,
                              double* jets);
  /// Bernstein coefficients, times their binomials, of x^2 + y^2 + z^2 and of w^2 from those of
  /// (x, y, z, w) of degrees p, q, which `scaled` holds times their binomials: (2 p + 1)(2 q + 1)
  /// each. Returns the least quotient of the two and where it is.
  double (*square_distance)(const double* scaled, int p, int q, double* square, double* weight,
                            int* where);
  /// Bit k: the control points of piece first + k are not all farther than the tolerance on one
  /// side of the line. At most 64 pieces.
  unsigned long long (*near_line)(const LineForm&, const KernelLine&, double tolerance, int first);
  /// The squared distance of (x, y) from every chord; returns the least one from their start
  /// points, and the chord that is nearest.
  double (*chord_squares)(const ChordForm&, double x, double y, double* square, int* nearest);
  /// Bit k: chord first + k (at most 64) is within `distance` + its reach, by these squares.
  unsigned long long (*near_chords)(const ChordForm&, const double* square, double distance,
                                    int first);
  Signs (*foot_signs)(const FootForm&, double x, double y, double rounding);
  /// The root in [0, 1] near `s`; false if Halley's steps leave it. Degree at most 15.
  bool (*foot_root)(const FootForm&, double x, double y, double& s);
  /// The crossing of a piece whose coefficients are monotone with a sign change; `start` is where
  /// to begin. False if Newton's (Halley's) steps do not settle inside [-1, 1].
  bool (*cross_line)(const LineForm&, const KernelLine&, int piece, double start, LineCrossing&);
};

extern const Kernels portable_kernels;
extern const Kernels avx2_kernels;  ///< only call after a check of the processor; x86-64 only

/// The kernels for this processor.
extern const Kernels* kernels;

}  // namespace sem::detail
