#pragma once
// Internal: what prepared NURBS are evaluated from, see kernels.h. Plain data.

namespace sem::detail {

/// A knot span [start, end): local coordinate t = (u - start) * inverse_half - 1 in [-1, 1].
struct KernelSpan {
  double end;  ///< infinity for the last one
  double start, inverse_half;
  long offset;  ///< what it adds to the place of a piece's coefficients
};

/// Finds the span of a parameter: that of its bucket, then onwards. Buckets of equal width cover
/// the domain; for uniform knots they are the spans.
struct KernelAxis {
  double lower, upper;  ///< domain
  double buckets_per_unit;
  const KernelSpan* const* first;  ///< per bucket
  int degree;
};

/// What hits of plane curves need, per piece: n_lanes (degree + 1 rounded up to a multiple of 4)
/// values each of the control points' x and y (the last repeated), and of the power coefficients
/// of (x - origin_x) w, (y - origin_y) w and w (zeros appended).
struct LineForm {
  const double *x, *y;
  const double *power_x, *power_y, *power_w, *origin;
  int n_pieces, degree, n_lanes;
};

struct PowerForm;
using PointKernel = void (*)(const PowerForm&, const double* u, double* point);
using SlopeKernel = void (*)(const PowerForm&, const double* u, double* point, double* slopes);

/// Homogeneous coordinates of every piece as polynomials in the local coordinates:
/// (C - origin) w and w = sum_ij c_ij t_u^i t_v^j, i fastest. Entries are (x, y, z, w), z = 0 in
/// the plane; 4 doubles of the origin come first, then the c_ij. What the kernels write has 4
/// doubles a vector, the last without meaning, and is aligned to 32 bytes.
struct PowerForm {
  KernelAxis axis[2];  ///< curves: one
  const double* coefficient;
  long stride;  ///< from a piece's coefficients to the next one's, u fastest
  PointKernel point;
  SlopeKernel slopes;
  LineForm line;  ///< curves in the plane
};

}  // namespace sem::detail
