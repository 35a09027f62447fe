#include "sem/nurbs/basis.h"

#include <algorithm>
#include <type_traits>

#include "sem/nurbs/axis_map.h"

namespace sem {
namespace {


// B-spline functions of one axis that do not vanish, with derivatives.
struct AxisBasis {
  int first;  // index of the first function
  double value[3][max_nurbs_functions];
};

// Cox-de Boor; derivatives from the functions of one and two degrees less.
// Those appear on the way divided by the lengths of their supports. The
// lengths are inverted apart, so that the recurrence does not wait for it.
// `degree`: an int, or a constant for loops without branches.
template <int Order, class Degree>
void evaluate_axis(const std::vector<double>& knots, Degree degree, double u, AxisBasis& out) {
  const int k = detail::find_span(knots, degree, u);
  u = std::clamp(u, knots[degree], knots[knots.size() - degree - 1]);
  const double* after = knots.data() + k + 1;  // after[r], before[-r] surround the span
  const double* before = knots.data() + k;
  double inverse[max_nurbs_functions], share[max_nurbs_functions], lower[max_nurbs_functions];
  double* N = out.value[0];
  out.first = k - degree;
  N[0] = 1;
  for (int j = 1; j <= degree; ++j) {
    if (Order >= 2 && j == degree) std::copy(share, share + j - 1, lower);
    for (int r = 0; r < j; ++r) inverse[r] = 1 / (after[r] - before[r - j + 1]);
    double carry = 0;
    for (int r = 0; r < j; ++r) {
      share[r] = N[r] * inverse[r];
      N[r] = carry + (after[r] - u) * share[r];
      carry = (u - before[r - j + 1]) * share[r];
    }
    N[j] = carry;
  }
  // Derivative: the difference of neighbours, each over the length of its support.
  const auto differences = [](const double* in, int n, int factor, double* result) {
    double last = 0;
    for (int r = 0; r < n; ++r) {
      result[r] = factor * (last - in[r]);
      last = in[r];
    }
    result[n] = factor * last;
  };
  if constexpr (Order >= 1) differences(share, degree, degree, out.value[1]);
  if constexpr (Order >= 2) {
    differences(lower, degree - 1, degree - 1, share);
    for (int r = 0; r < degree; ++r) share[r] *= inverse[r];
    differences(share, degree, degree, out.value[2]);
  }
}

template <int Order>
void evaluate_usual_axis(const std::vector<double>& knots, int degree, double u, AxisBasis& out) {
  switch (degree) {
    case 1: return evaluate_axis<Order>(knots, std::integral_constant<int, 1>(), u, out);
    case 2: return evaluate_axis<Order>(knots, std::integral_constant<int, 2>(), u, out);
    case 3: return evaluate_axis<Order>(knots, std::integral_constant<int, 3>(), u, out);
    default: return evaluate_axis<Order>(knots, degree, u, out);
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

// The tensor product functions that do not vanish at a parameter, row by
// row: a row runs along the first axis.
template <int Order, int ParamDim>
struct TensorBasis {
  static constexpr Orders<ParamDim> orders{};
  static constexpr int n = n_derivatives<ParamDim>(Order);
  std::array<AxisBasis, ParamDim> axis;
  std::array<int, ParamDim> degree, n_controls;

  template <int Dim>
  TensorBasis(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u) : degree(nurbs.degree) {
    for (int a = 0; a < ParamDim; ++a) {
      n_controls[a] = n_control(nurbs, a);
      evaluate_usual_axis<Order>(nurbs.knots[a], degree[a], u[a], axis[a]);
    }
  }

  // Calls visit(column, others) for each row: the first control point, and
  // for each derivative the product of the functions of the other axes.
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    std::array<int, ParamDim> index{};
    for (int a = 0; a < ParamDim;) {
      int column = 0;
      for (int b = ParamDim - 1; b >= 0; --b)
        column = column * n_controls[b] + axis[b].first + index[b];
      double others[n];
      for (int m = 0; m < n; ++m) {
        others[m] = 1;
        for (int b = 1; b < ParamDim; ++b) others[m] *= axis[b].value[orders.times[m][b]][index[b]];
      }
      visit(column, others);
      for (a = 1; a < ParamDim; ++a) {  // next row
        if (++index[a] <= degree[a]) break;
        index[a] = 0;
      }
    }
  }
};

// Quotient rule, in place: derivatives of A become those of A / W; both are
// given divided by W.
template <int Order, int ParamDim, class Value>
void divide(const double* W, Value* A) {
  constexpr Orders<ParamDim> orders;
  if constexpr (Order >= 1)
    for (int a = 0; a < ParamDim; ++a) A[1 + a] -= A[0] * W[1 + a];
  if constexpr (Order >= 2)
    for (int p = 0; p < n_second<ParamDim>; ++p) {
      const int a = orders.pair[p][0], b = orders.pair[p][1], m = 1 + ParamDim + p;
      A[m] -= A[1 + a] * W[1 + b] + A[1 + b] * W[1 + a] + A[0] * W[m];
    }
}

template <int Order, int ParamDim, int Dim>
void evaluate(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u, Vec<Dim>* value) {
  using Basis = TensorBasis<Order, ParamDim>;
  const Basis basis(nurbs, u);
  double W[Basis::n] = {};
  for (int m = 0; m < Basis::n; ++m) value[m].setZero();
  const auto& along = basis.axis[0].value;
  basis.for_each_row([&](int column, const double* others) {
    double row_weight[Order + 1] = {};
    Vec<Dim> row[Order + 1];
    for (auto& sum : row) sum.setZero();
    for (int k = 0; k <= basis.degree[0]; ++k) {
      const double w = nurbs.weights[column + k];
      const Vec<Dim> P = nurbs.control_points.col(column + k);
      for (int t = 0; t <= Order; ++t) {
        const double product = along[t][k] * w;
        row_weight[t] += product;
        row[t] += product * P;
      }
    }
    for (int m = 0; m < Basis::n; ++m) {
      W[m] += others[m] * row_weight[Basis::orders.times[m][0]];
      value[m] += others[m] * row[Basis::orders.times[m][0]];
    }
  });
  const double inverse = 1 / W[0];
  for (int m = 0; m < Basis::n; ++m) {
    W[m] *= inverse;
    value[m] *= inverse;
  }
  divide<Order, ParamDim>(W, value);
}

template <int Order, int ParamDim, int Dim>
void evaluate_rows(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u, int* columns,
                   double* const* rows) {
  using Basis = TensorBasis<Order, ParamDim>;
  const Basis basis(nurbs, u);
  const auto& along = basis.axis[0].value;
  double W[Basis::n] = {};
  basis.for_each_row([&](int column, const double* others) {
    double row[Order + 1] = {};
    for (int k = 0; k <= basis.degree[0]; ++k)
      for (int t = 0; t <= Order; ++t) row[t] += along[t][k] * nurbs.weights[column + k];
    for (int m = 0; m < Basis::n; ++m) W[m] += others[m] * row[Basis::orders.times[m][0]];
  });
  const double inverse = 1 / W[0];
  for (double& w : W) w *= inverse;
  int i = 0;
  basis.for_each_row([&](int column, const double* others) {
    for (int k = 0; k <= basis.degree[0]; ++k, ++i) {
      const double w = nurbs.weights[column + k] * inverse;
      double value[Basis::n];
      for (int m = 0; m < Basis::n; ++m)
        value[m] = others[m] * (along[Basis::orders.times[m][0]][k] * w);
      divide<Order, ParamDim>(W, value);
      columns[i] = column + k;
      for (int m = 0; m < Basis::n; ++m) rows[m][i] = value[m];
    }
  });
}

// Calls f with the order as a compile-time constant.
template <class F>
void with_order(int order, const F& f) {
  if (order == 0)
    f(std::integral_constant<int, 0>());
  else if (order == 1)
    f(std::integral_constant<int, 1>());
  else
    f(std::integral_constant<int, 2>());
}

}  // namespace

template <int ParamDim, int Dim>
void evaluate_basis(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u, int order,
                    BasisValues<ParamDim>& out) {
  size_t n_functions = 1;
  for (int a = 0; a < ParamDim; ++a) n_functions *= nurbs.degree[a] + 1;
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
  with_order(order, [&](auto constant) {
    evaluate_rows<constant()>(nurbs, u, out.column.data(), rows.data());
  });
}

template <int ParamDim, int Dim>
Vec<Dim> point(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u) {
  Vec<Dim> value[1];
  evaluate<0>(nurbs, u, value);
  return value[0];
}

template <int ParamDim, int Dim>
Derivatives<ParamDim, Dim> derivatives(const Nurbs<ParamDim, Dim>& nurbs, const Param<ParamDim>& u,
                                       int order) {
  Derivatives<ParamDim, Dim> result;
  with_order(order, [&](auto constant) {
    constexpr int n = n_derivatives<ParamDim>(constant());
    Vec<Dim> value[n_derivatives<ParamDim>(2)];
    evaluate<constant()>(nurbs, u, value);
    for (int m = n; m < n_derivatives<ParamDim>(2); ++m) value[m].setZero();
    result.point = value[0];
    for (int a = 0; a < ParamDim; ++a) result.first.col(a) = value[1 + a];
    for (int p = 0; p < n_second<ParamDim>; ++p) result.second[p] = value[1 + ParamDim + p];
  });
  return result;
}

#define SEM_INSTANTIATE(P, D)                                                              \
  template void evaluate_basis(const Nurbs<P, D>&, const Param<P>&, int, BasisValues<P>&); \
  template Vec<D> point(const Nurbs<P, D>&, const Param<P>&);                              \
  template Derivatives<P, D> derivatives(const Nurbs<P, D>&, const Param<P>&, int);
SEM_INSTANTIATE(1, 2)
SEM_INSTANTIATE(1, 3)
SEM_INSTANTIATE(2, 3)
#undef SEM_INSTANTIATE

}  // namespace sem
