#include "sem/nurbs/basis.h"

#include <algorithm>

#include "sem/nurbs/axis_map.h"

namespace sem {
namespace {

constexpr int max_functions = max_nurbs_degree + 1;

// B-spline functions of one axis that do not vanish, with derivatives.
struct AxisBasis {
  int first = 0;  // index of the first function
  double value[3][max_functions];
};

// Cox-de Boor; derivatives from the functions of one and two degrees less.
void evaluate_axis(const std::vector<double>& knots, int degree, double u, int order,
                   AxisBasis& out) {
  const int k = detail::find_span(knots, degree, u);
  u = std::clamp(u, knots[degree], knots[knots.size() - degree - 1]);
  const double* after = knots.data() + k + 1;  // after[r], before[-r] surround the span
  const double* before = knots.data() + k;
  double lower1[max_functions], lower2[max_functions];
  double* N = out.value[0];
  N[0] = 1;
  for (int j = 1; j <= degree; ++j) {
    if (j == degree - 1 && order >= 2) std::copy(N, N + j, lower2);
    if (j == degree && order >= 1) std::copy(N, N + j, lower1);
    double carry = 0;
    for (int r = 0; r < j; ++r) {
      const double right = after[r] - u, left = u - before[r - j + 1];
      const double share = N[r] / (right + left);
      N[r] = carry + right * share;
      carry = left * share;
    }
    N[j] = carry;
  }
  out.first = k - degree;
  if (order == 0) return;
  if (order >= 2) {                // derivatives of the functions of degree - 1
    double* slope = out.value[1];  // used as scratch
    for (int r = 0; r < degree - 1; ++r)
      slope[r] = (degree - 1) * lower2[r] / (after[r] - before[r - degree + 2]);
    for (int r = 0; r < degree; ++r)
      lower2[r] = degree == 1 ? 0 : (r > 0 ? slope[r - 1] : 0) - (r < degree - 1 ? slope[r] : 0);
  }
  for (int m = 1; m <= order; ++m) {
    double* lower = m == 1 ? lower1 : lower2;
    for (int r = 0; r < degree; ++r) lower[r] *= degree / (after[r] - before[r - degree + 1]);
    for (int r = 0; r <= degree; ++r)
      out.value[m][r] = (r > 0 ? lower[r - 1] : 0) - (r < degree ? lower[r] : 0);
  }
}

// The derivatives of a tensor product up to order 2: how often to
// differentiate along each axis. Value, first, second (uu; or uu, uv, vv).
template <int ParamDim>
constexpr int n_derivatives(int order) {
  return order == 0 ? 1 : order == 1 ? 1 + ParamDim : 1 + ParamDim + n_second<ParamDim>;
}

template <int ParamDim>
struct Orders {
  int times[n_derivatives<ParamDim>(2)][ParamDim] = {};
  int pair[n_second<ParamDim>][2] = {};
  constexpr Orders() {
    int row = 1, p = 0;
    for (int a = 0; a < ParamDim; ++a) ++times[row++][a];
    for (int a = 0; a < ParamDim; ++a)
      for (int b = a; b < ParamDim; ++b, ++row, ++p) {
        ++times[row][a];
        ++times[row][b];
        pair[p][0] = a;
        pair[p][1] = b;
      }
  }
};

// Calls visit(column, products), products[m] the m-th derivative of the
// (polynomial) tensor product function.
template <int ParamDim, int Dim, class Visit>
void for_each_function(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u, int order,
                       const Visit& visit) {
  constexpr Orders<ParamDim> orders;
  std::array<AxisBasis, ParamDim> basis;
  std::array<int, ParamDim> index{}, stride;
  int column = 0, step = 1;
  for (int a = 0; a < ParamDim; ++a) {
    evaluate_axis(nurbs.knots[a], nurbs.degree[a], u[a], order, basis[a]);
    stride[a] = step;
    column += basis[a].first * step;
    step *= n_control(nurbs, a);
  }
  const int n = n_derivatives<ParamDim>(order);
  double products[n_derivatives<ParamDim>(2)] = {};
  for (int axis = 0; axis < ParamDim;) {
    for (int m = 0; m < n; ++m) {
      products[m] = 1;
      for (int a = 0; a < ParamDim; ++a)
        products[m] *= basis[a].value[orders.times[m][a]][index[a]];
    }
    visit(column, products);
    for (axis = 0; axis < ParamDim; ++axis) {  // next index, u fastest
      column += stride[axis];
      if (++index[axis] <= nurbs.degree[axis]) break;
      column -= (nurbs.degree[axis] + 1) * stride[axis];
      index[axis] = 0;
    }
  }
}

// Quotient rule, in place: numerator derivatives become those of
// numerator / W. W holds the derivatives of the denominator.
template <int ParamDim, class Value>
void divide(const double* W, int order, Value* value) {
  constexpr Orders<ParamDim> orders;
  const double inverse = 1 / W[0];
  value[0] *= inverse;
  if (order < 1) return;
  for (int a = 0; a < ParamDim; ++a) value[1 + a] = (value[1 + a] - value[0] * W[1 + a]) * inverse;
  if (order < 2) return;
  for (int p = 0; p < n_second<ParamDim>; ++p) {
    const int a = orders.pair[p][0], b = orders.pair[p][1], m = 1 + ParamDim + p;
    value[m] =
        (value[m] - value[1 + a] * W[1 + b] - value[1 + b] * W[1 + a] - value[0] * W[m]) * inverse;
  }
}

template <int ParamDim, int Dim>
void evaluate(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u, int order,
              Vec<Dim>* value) {
  const int n = n_derivatives<ParamDim>(order);
  double W[n_derivatives<ParamDim>(2)] = {};
  for (int m = 0; m < n; ++m) value[m].setZero();
  for_each_function(nurbs, u, order, [&](int column, const double* products) {
    const Vec<Dim> wP = nurbs.weights[column] * nurbs.control_points.col(column);
    for (int m = 0; m < n; ++m) {
      W[m] += products[m] * nurbs.weights[column];
      value[m] += products[m] * wP;
    }
  });
  divide<ParamDim>(W, order, value);
}

}  // namespace

template <int ParamDim, int Dim>
void evaluate_basis(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u, int order,
                    BasisValues<ParamDim>& out) {
  size_t n_functions = 1;
  for (int a = 0; a < ParamDim; ++a) n_functions *= nurbs.degree[a] + 1;
  const int n = n_derivatives<ParamDim>(order);
  out.column.resize(n_functions);
  out.value.resize(n_functions);
  std::array<double*, n_derivatives<ParamDim>(2)> rows{out.value.data()};
  for (int a = 0; a < ParamDim; ++a) {
    out.first[a].resize(order >= 1 ? n_functions : 0);
    rows[1 + a] = out.first[a].data();
  }
  for (int p = 0; p < n_second<ParamDim>; ++p) {
    out.second[p].resize(order >= 2 ? n_functions : 0);
    rows[1 + ParamDim + p] = out.second[p].data();
  }
  double W[n_derivatives<ParamDim>(2)] = {};
  size_t k = 0;
  for_each_function(nurbs, u, order, [&](int column, const double* products) {
    out.column[k] = column;
    for (int m = 0; m < n; ++m) {
      rows[m][k] = products[m] * nurbs.weights[column];
      W[m] += rows[m][k];
    }
    ++k;
  });
  for (k = 0; k < n_functions; ++k) {
    double values[n_derivatives<ParamDim>(2)];
    for (int m = 0; m < n; ++m) values[m] = rows[m][k];
    divide<ParamDim>(W, order, values);
    for (int m = 0; m < n; ++m) rows[m][k] = values[m];
  }
}

template <int ParamDim, int Dim>
Vec<Dim> point(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u) {
  Vec<Dim> value[1];
  evaluate(nurbs, u, 0, value);
  return value[0];
}

template <int ParamDim, int Dim>
Derivatives<ParamDim, Dim> derivatives(const Nurbs<ParamDim, Dim>& nurbs,
                                       const Param<ParamDim>& u) {
  Vec<Dim> value[n_derivatives<ParamDim>(2)];
  evaluate(nurbs, u, 2, value);
  Derivatives<ParamDim, Dim> result;
  result.point = value[0];
  for (int a = 0; a < ParamDim; ++a) result.first.col(a) = value[1 + a];
  for (int p = 0; p < n_second<ParamDim>; ++p) result.second[p] = value[1 + ParamDim + p];
  return result;
}

#define SEM_INSTANTIATE(P, D)                                                              \
  template void evaluate_basis(const Nurbs<P, D>&, const Param<P>&, int, BasisValues<P>&); \
  template Vec<D> point(const Nurbs<P, D>&, const Param<P>&);                              \
  template Derivatives<P, D> derivatives(const Nurbs<P, D>&, const Param<P>&);
SEM_INSTANTIATE(1, 2)
SEM_INSTANTIATE(1, 3)
SEM_INSTANTIATE(2, 3)
#undef SEM_INSTANTIATE

}  // namespace sem
