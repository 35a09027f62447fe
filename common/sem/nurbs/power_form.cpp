#include "sem/nurbs/power_form.h"

#include <algorithm>
#include <cmath>

#include "sem/nurbs/bernstein.h"

namespace sem::detail {
namespace {

constexpr int max_power_degree = 12;
constexpr double largest_growth = 32;

// What the form points into: owned once, by all copies of a prepared NURBS, and never changed.
template <int ParamDim>
struct Tables {
  PowerForm form{};
  struct alignas(32) Lanes {
    double value[4];
  };
  std::vector<Lanes> power, line;
  std::array<std::vector<KernelSpan>, ParamDim> spans;
  std::array<std::vector<const KernelSpan*>, ParamDim> first;  // per bucket
};

using Coefficients = Eigen::Matrix<double, 4, Eigen::Dynamic>;  // x, y, z, w

// `stride`: from the coefficients of one span to those of the next.
KernelAxis make_axis(const std::vector<Interval>& intervals, int degree, long stride,
                     std::vector<KernelSpan>& spans, std::vector<const KernelSpan*>& first) {
  const int n = int(intervals.size());
  double least = intervals[0].upper - intervals[0].lower;
  for (const auto& [lower, upper] : intervals) {
    least = std::min(least, upper - lower);
    spans.push_back({upper, lower, 2 / (upper - lower), long(spans.size()) * stride});
  }
  spans.back().end = std::numeric_limits<double>::infinity();
  const double lower = intervals.front().lower, upper = intervals.back().upper;
  // As many as keep the spans of a bucket few; one a span where knots are uniform.
  const int n_buckets = int(std::clamp(std::round((upper - lower) / least), double(n), 8.0 * n));
  const double per_unit = n_buckets / (upper - lower);
  // By the expression of the kernels, which grows with u: rounding does not matter.
  const auto bucket = [&](double u) { return int((u - lower) * per_unit); };
  first.assign(n_buckets + 2, spans.data());
  for (int k = 1; k < n; ++k) {
    const double knot = intervals[k].lower;
    // The bucket of the knot may begin before it.
    const bool shared = bucket(std::nextafter(knot, lower)) == bucket(knot);
    for (int b = bucket(knot) + (shared ? 1 : 0); b < int(first.size()); ++b) first[b] = &spans[k];
  }
  return {lower, upper, per_unit, first.data(), degree};
}

// How much larger the terms of the powers are than their sum, at the ends and between.
double growth(const Coefficients& c, const int* degree, double size) {
  double largest = 0;
  constexpr double place[] = {0, 0.5, 1};
  const int n_u = degree[0] + 1;
  for (const double a : place)
    for (const double b : place)
      for (int corner = 0; corner < 4; ++corner) {
        const double s = corner & 1 ? -a : a, t = corner & 2 ? -b : b;
        double weight = 0, terms = 0, weight_terms = 0;
        for (int i = 0; i < c.cols(); ++i) {
          const double power = std::pow(s, i % n_u) * std::pow(t, i / n_u);
          weight += power * c(3, i);
          weight_terms += std::abs(power * c(3, i));
          terms += std::abs(power) * c.col(i).head<3>().cwiseAbs().maxCoeff();
        }
        if (!(weight > 0)) return std::numeric_limits<double>::infinity();
        largest = std::max(largest, std::max(weight_terms, terms / size) / weight);
      }
  return largest;
}

template <int ParamDim, int Dim>
Coefficients power_coefficients(const BezierPiece<ParamDim, Dim>& piece, const Vec<Dim>& origin,
                                const Eigen::MatrixXd* powers) {
  const int n = int(piece.weights.size());
  Coefficients c = Coefficients::Zero(4, n);
  for (int i = 0; i < n; ++i) {
    c.col(i).template head<Dim>() = piece.weights[i] * (piece.points.col(i) - origin);
    c(3, i) = piece.weights[i];
  }
  for (int axis = 0, stride = 1; axis < ParamDim; stride *= piece.degree[axis] + 1, ++axis) {
    const Coefficients bernstein = c;
    const int order = piece.degree[axis] + 1;
    c.setZero();
    for (int to = 0; to < n; ++to) {
      const int j = to / stride % order, first = to - j * stride;
      for (int i = 0; i < order; ++i)
        c.col(to) += powers[axis](j, i) * bernstein.col(first + i * stride);
    }
  }
  return c;
}

// Arrays one after the other in one aligned block.
void make_line_form(const PreparedNurbs<1, 2>& part, const std::vector<Coefficients>& power,
                    Tables<1>& tables) {
  const int degree = part.nurbs.degree[0], n_lanes = (degree + 4) / 4 * 4;
  const int n = int(part.pieces.size()), size = n * n_lanes;
  auto& storage = tables.line;
  storage.assign(5 * size / 4 + (n + 1) / 2, {});
  double* const x = storage[0].value;
  double *const y = x + size, *const power_x = y + size, *const power_y = power_x + size,
                *const power_w = power_y + size, *const origin = power_w + size;
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < n_lanes; ++i) {
      x[k * n_lanes + i] = part.pieces[k].points(0, std::min(i, degree));
      y[k * n_lanes + i] = part.pieces[k].points(1, std::min(i, degree));
    }
    for (int i = 0; i <= degree; ++i) {
      power_x[k * n_lanes + i] = power[k](0, i);
      power_y[k * n_lanes + i] = power[k](1, i);
      power_w[k * n_lanes + i] = power[k](3, i);
    }
    const auto& box = part.pieces[k].box;
    for (int a = 0; a < 2; ++a) origin[2 * k + a] = 0.5 * (box.lower[a] + box.upper[a]);
  }
  tables.form.line = {x, y, power_x, power_y, power_w, origin, n, degree, n_lanes};
}

template <int ParamDim, int Dim>
void make_line_form(const PreparedNurbs<ParamDim, Dim>&, const std::vector<Coefficients>&,
                    Tables<ParamDim>&) {}

}  // namespace

Eigen::MatrixXd powers_of_bernstein(int degree) {
  Eigen::MatrixXd result(degree + 1, degree + 1);
  for (int i = 0; i <= degree; ++i) {
    Eigen::VectorXd polynomial = Eigen::VectorXd::Zero(degree + 1);
    polynomial[0] = std::ldexp(binomials(degree)[i], -degree);
    for (int factor = 0; factor < degree; ++factor) {  // times 1 + t (i of them) or 1 - t
      const double sign = factor < i ? 1 : -1;
      for (int j = degree; j > 0; --j) polynomial[j] += sign * polynomial[j - 1];
    }
    result.col(i) = polynomial;
  }
  return result;
}

template <int ParamDim, int Dim>
std::shared_ptr<const PowerForm> make_power_form(const PreparedNurbs<ParamDim, Dim>& part) {
  std::array<Eigen::MatrixXd, ParamDim> powers;
  int degrees[2] = {0, 0};
  for (int a = 0; a < ParamDim; ++a) {
    degrees[a] = part.nurbs.degree[a];
    if (degrees[a] > max_power_degree) return nullptr;
    powers[a] = powers_of_bernstein(degrees[a]);
  }
  const double size = part.box.diagonal();
  const int n = int(part.pieces[0].weights.size());
  std::vector<Coefficients> coefficients;
  auto tables = std::make_shared<Tables<ParamDim>>();
  for (const auto& piece : part.pieces) {
    const Vec<Dim> origin = 0.5 * (piece.box.lower + piece.box.upper);
    coefficients.push_back(power_coefficients(piece, origin, powers.data()));
    if (!(growth(coefficients.back(), degrees, size) <= largest_growth)) return nullptr;
    auto& storage = tables->power;
    storage.push_back({});
    for (int a = 0; a < Dim; ++a) storage.back().value[a] = origin[a];
    for (int i = 0; i < n; ++i) {
      const auto c = coefficients.back().col(i);
      storage.push_back({c[0], c[1], c[2], c[3]});
    }
  }
  PowerForm& form = tables->form;
  long stride = form.stride = 4 * (n + 1);
  for (int a = 0; a < ParamDim; ++a) {
    form.axis[a] = make_axis(part.spans[a], degrees[a], stride, tables->spans[a], tables->first[a]);
    stride *= long(part.spans[a].size());
  }
  form.coefficient = tables->power[0].value;
  const bool same_degree = ParamDim == 1 || degrees[0] == degrees[1];
  const int known_degree = same_degree && degrees[0] <= 3 ? degrees[0] : 0;
  form.point = (ParamDim == 1 ? kernels->curve_point : kernels->surface_point)[known_degree];
  form.slopes = (ParamDim == 1 ? kernels->curve_slope : kernels->surface_slopes)[known_degree];
  make_line_form(part, coefficients, *tables);
  return std::shared_ptr<const PowerForm>(tables, &tables->form);
}

template std::shared_ptr<const PowerForm> make_power_form(const PreparedNurbs<1, 2>&);
template std::shared_ptr<const PowerForm> make_power_form(const PreparedNurbs<1, 3>&);
template std::shared_ptr<const PowerForm> make_power_form(const PreparedNurbs<2, 3>&);

}  // namespace sem::detail
