// The kernels themselves, see kernels.h. Included once a set of instructions.

#include "sem/nurbs/kernels.h"

namespace sem::detail {
namespace {

#define SEM_INLINE inline __attribute__((always_inline))

typedef double V4 __attribute__((vector_size(32), aligned(32), may_alias));
typedef long long M4 __attribute__((vector_size(32)));

SEM_INLINE V4 load(const double* x) { return *reinterpret_cast<const V4*>(x); }
SEM_INLINE V4 all(double x) { return V4{x, x, x, x}; }
SEM_INLINE double smaller(double a, double b) { return a < b ? a : b; }

// Bit i: lane i is true.
SEM_INLINE unsigned long long lanes(M4 mask) {
#ifdef __AVX__
  return (unsigned long long)__builtin_ia32_movmskpd256(V4(mask));
#else
  return (unsigned long long)((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}

SEM_INLINE double least_lane(V4 x) { return smaller(smaller(x[0], x[1]), smaller(x[2], x[3])); }

// The span that holds u and the local coordinate there; u outside is moved to the end of the
// domain, NaN gives NaN.
SEM_INLINE const KernelSpan* locate(const KernelAxis& axis, double u, double& t) {
  const KernelSpan* span;
  if (__builtin_expect(u >= axis.lower && u < axis.upper, 1)) {
    span = axis.first[int((u - axis.lower) * axis.buckets_per_unit)];
  } else {
    span = axis.first[0];
    u = u < axis.lower ? axis.lower : u > axis.upper ? axis.upper : u;
  }
  while (u >= span->end) ++span;
  t = (u - span->start) * span->inverse_half - 1;
  return span;
}

// Calls f with the degree, as a constant where it is a usual one.
template <int N>
struct Constant {
  SEM_INLINE constexpr operator int() const { return N; }
};
template <class F>
SEM_INLINE void with_degree(int degree, const F& f) {
  switch (degree) {
    case 1:
      return f(Constant<1>());
    case 2:
      return f(Constant<2>());
    case 3:
      return f(Constant<3>());
    default:
      return f(degree);
  }
}

SEM_INLINE V4 horner(const double* c, int degree, V4 t) {
  V4 value = load(c + 4 * degree);
  for (int j = degree - 1; j >= 0; --j) value = value * t + load(c + 4 * j);
  return value;
}

struct Slope {
  V4 value, slope;
};
SEM_INLINE Slope horner_slope(const double* c, int degree, V4 t) {
  Slope at{load(c + 4 * degree), all(0)};
  for (int j = degree - 1; j >= 0; --j) {
    at.slope = at.slope * t + at.value;
    at.value = at.value * t + load(c + 4 * j);
  }
  return at;
}

SEM_INLINE void store(V4 x, double* out) { *reinterpret_cast<V4*>(out) = x; }

// The degree as a constant, 0: any.
template <int N>
SEM_INLINE int degree_of(const KernelAxis& axis) {
  return N > 0 ? N : axis.degree;
}

template <int N>
void curve_point(const PowerForm& form, const double* u, double* point) {
  double t;
  const double* c = form.coefficient + locate(form.axis[0], u[0], t)->offset;
  const V4 A = horner(c + 4, degree_of<N>(form.axis[0]), all(t));
  store(load(c) + A * all(1 / A[3]), point);
}

template <int N>
void curve_slope(const PowerForm& form, const double* u, double* point, double* slope) {
  double t;
  const KernelSpan* span = locate(form.axis[0], u[0], t);
  const double* c = form.coefficient + span->offset;
  const Slope A = horner_slope(c + 4, degree_of<N>(form.axis[0]), all(t));
  const double inverse = 1 / A.value[3];
  const V4 X = A.value * all(inverse);
  store(load(c) + X, point);
  store((A.slope - X * all(A.slope[3])) * all(inverse * span->inverse_half), slope);
}

SEM_INLINE V4 tensor(const double* c, int p, int q, V4 s, V4 t) {
  const int row = 4 * (p + 1);
  V4 value = horner(c + q * row, p, s);
  for (int j = q - 1; j >= 0; --j) value = value * t + horner(c + j * row, p, s);
  return value;
}

template <int N>
void surface_point(const PowerForm& form, const double* u, double* point) {
  double s, t;
  const long offset = locate(form.axis[0], u[0], s)->offset + locate(form.axis[1], u[1], t)->offset;
  const double* c = form.coefficient + offset;
  const V4 A =
      tensor(c + 4, degree_of<N>(form.axis[0]), degree_of<N>(form.axis[1]), all(s), all(t));
  store(load(c) + A * all(1 / A[3]), point);
}

struct Slopes {
  V4 value, du, dv;
};
SEM_INLINE Slopes tensor_slopes(const double* c, int p, int q, V4 s, V4 t) {
  const int row = 4 * (p + 1);
  const Slope last = horner_slope(c + q * row, p, s);
  Slopes at{last.value, last.slope, all(0)};
  for (int j = q - 1; j >= 0; --j) {
    const Slope next = horner_slope(c + j * row, p, s);
    at.dv = at.dv * t + at.value;
    at.value = at.value * t + next.value;
    at.du = at.du * t + next.slope;
  }
  return at;
}

template <int N>
void surface_slopes(const PowerForm& form, const double* u, double* point, double* slopes) {
  double s, t;
  const KernelSpan *span_u = locate(form.axis[0], u[0], s), *span_v = locate(form.axis[1], u[1], t);
  const double* c = form.coefficient + span_u->offset + span_v->offset;
  const Slopes A =
      tensor_slopes(c + 4, degree_of<N>(form.axis[0]), degree_of<N>(form.axis[1]), all(s), all(t));
  const double inverse = 1 / A.value[3];
  const V4 X = A.value * all(inverse);
  store(load(c) + X, point);
  store((A.du - X * all(A.du[3])) * all(inverse * span_u->inverse_half), slopes);
  store((A.dv - X * all(A.dv[3])) * all(inverse * span_v->inverse_half), slopes + 4);
}

void surface_jets(const PowerForm& form, const double* piece, const double* local, double* jets) {
  const int p = form.axis[0].degree, q = form.axis[1].degree;
  const V4 s = all(local[0]), t = all(local[1]);
  const Slopes at = p == 3 && q == 3 ? tensor_slopes(piece + 4, 3, 3, s, t)
                                     : tensor_slopes(piece + 4, p, q, s, t);
  store(at.value, jets);
  store(at.du, jets + 4);
  store(at.dv, jets + 8);
}

SEM_INLINE void tensor_second(const double* c, int p, int q, V4 s, V4 t, V4* at) {
  for (int j = q; j >= 0; --j) {
    const double* row = c + 4 * j * (p + 1);
    V4 value = load(row + 4 * p), slope = all(0), bend = slope;  // bend: half the second derivative
    for (int i = p - 1; i >= 0; --i) {
      bend = bend * s + slope;
      slope = slope * s + value;
      value = value * s + load(row + 4 * i);
    }
    at[5] = at[5] * t + at[2];
    at[4] = at[4] * t + at[1];
    at[2] = at[2] * t + at[0];
    at[0] = at[0] * t + value;
    at[1] = at[1] * t + slope;
    at[3] = at[3] * t + bend;
  }
}

void surface_second_jets(const PowerForm& form, const double* piece, const double* local,
                         double* jets) {
  const int p = form.axis[0].degree, q = form.axis[1].degree;
  V4 at[6] = {};
  if (p == 3 && q == 3)
    tensor_second(piece + 4, 3, 3, all(local[0]), all(local[1]), at);
  else
    tensor_second(piece + 4, p, q, all(local[0]), all(local[1]), at);
  at[3] *= all(2);
  at[5] *= all(2);
  for (int m = 0; m < 6; ++m) store(at[m], jets + 4 * m);
}

SEM_INLINE double square_terms(const double* scaled, int p, int q, double* square, double* weight,
                               int* where, V4* sum) {
  const int row = 2 * p + 1, n_sums = row * (2 * q + 1);
  for (int i = 0; i < n_sums; ++i) sum[i] = all(0);
  for (int j = 0, a = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i, ++a) {
      const V4 c = load(scaled + 4 * a), twice = c + c;
      sum[2 * (j * row + i)] += c * c;
      for (int k = i + 1; k <= p; ++k)
        sum[2 * j * row + i + k] += twice * load(scaled + 4 * (a + k - i));
      for (int l = j + 1; l <= q; ++l)
        for (int k = 0; k <= p; ++k)
          sum[(j + l) * row + i + k] += twice * load(scaled + 4 * (l * (p + 1) + k));
    }
  double least = 1e308;
  for (int i = 0; i < n_sums; ++i) {
    square[i] = sum[i][0] + sum[i][1] + sum[i][2];
    weight[i] = sum[i][3];
    if (square[i] < least * weight[i]) {
      least = square[i] / weight[i];
      *where = i;
    }
  }
  return least;
}

double square_distance(const double* scaled, int p, int q, double* square, double* weight,
                       int* where) {
  *where = 0;
  V4 sum[25 * 25];
  return p == 3 && q == 3 ? square_terms(scaled, 3, 3, square, weight, where, sum)
                          : square_terms(scaled, p, q, square, weight, where, sum);
}

unsigned long long near_line(const LineForm& form, const KernelLine& line, double tolerance,
                             int first) {
  const V4 n_x = all(line.normal[0]), n_y = all(line.normal[1]);
  const V4 o_x = all(line.origin[0]), o_y = all(line.origin[1]);
  const V4 above = all(tolerance), below = all(-tolerance);
  const int n = form.n_pieces - first < 64 ? form.n_pieces - first : 64;
  const double* x = form.x + first * form.n_lanes;
  const double* y = form.y + first * form.n_lanes;
  unsigned long long near = 0;
  for (int k = 0; k < n; ++k) {
    M4 positive = ~M4{}, negative = positive;
    for (int i = 0; i < form.n_lanes; i += 4, x += 4, y += 4) {
      const V4 side = n_x * (load(x) - o_x) + n_y * (load(y) - o_y);
      positive &= side > above;
      negative &= side < below;
    }
    near |= (unsigned long long)(lanes(positive) != 15 && lanes(negative) != 15) << k;
  }
  return near;
}

double chord_squares(const ChordForm& form, double x, double y, double* square, int* nearest) {
  V4 least = all(1e308), least_square = least;
  for (int k = 0; k < form.n; k += 4) {
    const V4 a_x = all(x) - load(form.x + k), a_y = all(y) - load(form.y + k);
    const V4 d_x = load(form.step_x + k), d_y = load(form.step_y + k);
    const V4 to_start = a_x * a_x + a_y * a_y;
    V4 t = (a_x * d_x + a_y * d_y) * load(form.inverse_square + k);
    t = t > all(0) ? t : all(0);
    t = t < all(1) ? t : all(1);
    const V4 b_x = a_x - t * d_x, b_y = a_y - t * d_y;
    const V4 distance = b_x * b_x + b_y * b_y;
    store(distance, square + k);
    least_square = distance < least_square ? distance : least_square;
    least = to_start < least ? to_start : least;
  }
  const V4 bound = all(least_lane(least_square));
  *nearest = 0;
  for (int k = 0; k < form.n; k += 4)
    if (const auto equal = lanes(load(square + k) == bound)) {
      *nearest = k + __builtin_ctzll(equal);
      break;
    }
  return least_lane(least);
}

unsigned long long near_chords(const ChordForm& form, const double* square, double distance,
                               int first) {
  const int end = first + 64 < form.n ? first + 64 : form.n;
  unsigned long long near = 0;
  for (int k = first; k < end; k += 4) {
    const V4 limit = all(distance) + load(form.reach + k);
    const M4 mask = load(square + k) <= limit * limit;
    near |= lanes(mask) << (k - first);
  }
  return near;
}

constexpr int max_lanes = 16;

// Value, slope and half the second derivative.
struct Jet {
  double value, slope, bend;
};
template <class Degree>
SEM_INLINE Jet jet(const double* c, Degree degree, double t) {
  Jet at{c[degree], 0, 0};
  for (int j = degree - 1; j >= 0; --j) {
    at.bend = at.bend * t + at.slope;
    at.slope = at.slope * t + at.value;
    at.value = at.value * t + c[j];
  }
  return at;
}

// Halley's method, cubic: after a step below 1e-6 the next is rounding, if it is also one of
// Newton's (Halley's are short where the slope vanishes).
template <class Degree>
SEM_INLINE bool settle(const double* f, Degree degree, double& t, double& slope) {
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Jet at = jet(f, degree, t);
    const double square = at.slope * at.slope;
    const double step = at.value * at.slope / (square - at.value * at.bend);
    t -= step;
    if (!(t >= -1 && t <= 1)) return false;
    if (step * step < 1e-12) {
      slope = at.slope - 2 * step * at.bend;
      return at.value * at.value < 4e-12 * square;
    }
  }
  return false;
}

Signs foot_signs(const FootForm& form, double x, double y, double rounding) {
  Signs signs{0, 0};
  const double* c = form.rows;
  for (int i = 0; i < form.n_lanes; i += 4, c += 4) {
    const V4 g = load(c) - all(x) * load(c + form.n_lanes) - all(y) * load(c + 2 * form.n_lanes);
    signs.positive |= unsigned(lanes(g > all(rounding)) << i);
    signs.negative |= unsigned(lanes(g < all(-rounding)) << i);
  }
  return signs;
}

bool foot_root(const FootForm& form, double x, double y, double& s) {
  alignas(32) double g[max_lanes];
  const double* c = form.rows + 3 * form.n_lanes;
  for (int i = 0; i < form.n_lanes; i += 4, c += 4)
    store(load(c) - all(x) * load(c + form.n_lanes) - all(y) * load(c + 2 * form.n_lanes), g + i);
  double t = 2 * s - 1, slope;
  const bool settled = form.degree == 8 ? settle(g, Constant<8>(), t, slope)  // rational cubics
                       : form.degree == 5
                           ? settle(g, Constant<5>(), t, slope)  // cubics, quadratics
                           : settle(g, form.degree, t, slope);
  s = 0.5 + 0.5 * t;
  return settled;
}

bool cross_line(const LineForm& form, const KernelLine& line, int piece, double start,
                LineCrossing& crossing) {
  const double* origin = form.origin + 2 * piece;
  const double o_x = line.origin[0] - origin[0], o_y = line.origin[1] - origin[1];
  const V4 across = all(line.normal[0] * o_x + line.normal[1] * o_y);
  const V4 along = all(line.direction[0] * o_x + line.direction[1] * o_y);
  alignas(32) double f[max_lanes], g[max_lanes];
  const double* w = form.power_w + piece * form.n_lanes;
  for (int i = 0; i < form.n_lanes; i += 4) {
    const V4 x = load(form.power_x + piece * form.n_lanes + i);
    const V4 y = load(form.power_y + piece * form.n_lanes + i);
    store(all(line.normal[0]) * x + all(line.normal[1]) * y - across * load(w + i), f + i);
    store(all(line.direction[0]) * x + all(line.direction[1]) * y - along * load(w + i), g + i);
  }
  bool settled = false;
  with_degree(
      form.degree, [&](auto degree) __attribute__((always_inline)) {
        double t = start, slope = 0;
        settled = settle(f, degree, t, slope);
        const Jet G = jet(g, degree, t), W = jet(w, degree, t);
        crossing = {t, G.value / W.value, slope * W.value, G.slope * W.value - G.value * W.slope};
      });
  return settled;
}

}  // namespace

extern const Kernels SEM_KERNELS;
const Kernels SEM_KERNELS = {
    {curve_point<0>, curve_point<1>, curve_point<2>, curve_point<3>},
    {surface_point<0>, surface_point<1>, surface_point<2>, surface_point<3>},
    {curve_slope<0>, curve_slope<1>, curve_slope<2>, curve_slope<3>},
    {surface_slopes<0>, surface_slopes<1>, surface_slopes<2>, surface_slopes<3>},
    surface_jets,
    surface_second_jets,
    square_distance,
    near_line,
    chord_squares,
    near_chords,
    foot_signs,
    foot_root,
    cross_line};

}  // namespace sem::detail
