#include "sem/nurbs/nurbs.h"

#include <cmath>
#include <sstream>

#include "sem/base/error.h"
#include "sem/nurbs/axis_map.h"

namespace sem {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string indexed(const std::string& field, const std::string& name, long index) {
  return field + "." + name + "[" + std::to_string(index) + "]";
}

// "" for a curve, "_u" and "_v" for a surface.
template <int ParamDim>
std::string axis_suffix(int axis) {
  return ParamDim == 1 ? "" : std::string("_") + "uvw"[axis];
}

void check_knots(const std::vector<double>& knots, int degree, const std::string& file,
                 const std::string& name) {
  const auto element = [&](size_t k) { return name + "[" + std::to_string(k) + "]"; };
  const size_t n = knots.size() - degree - 1;
  size_t repeated = 0;
  for (size_t k = 0; k < knots.size(); ++k) {
    if (!std::isfinite(knots[k])) throw InputError(file, element(k), text(knots[k]), "finite");
    if (k > 0 && knots[k] < knots[k - 1])
      throw InputError(file, element(k), text(knots[k]),
                       ">= the knot before it, " + text(knots[k - 1]));
    repeated = k > 0 && knots[k] == knots[k - 1] ? repeated + 1 : 1;
    if (repeated > size_t(degree) + 1)
      throw InputError(file, element(k), text(knots[k]) + " " + std::to_string(repeated) + " times",
                       "at most degree + 1 = " + std::to_string(degree + 1) + " times");
  }
  if (!(knots[degree] < knots[n]))
    throw InputError(file, name,
                     "an empty domain, from knot " + std::to_string(degree) + " = " +
                         text(knots[degree]) + " to knot " + std::to_string(n) + " = " +
                         text(knots[n]),
                     "a domain of positive length");
}

}  // namespace

template <int ParamDim, int Dim>
void check(const Nurbs<ParamDim, Dim>& nurbs, const std::string& file, const std::string& field) {
  long n_expected = 1;
  for (int axis = 0; axis < ParamDim; ++axis) {
    const std::string suffix = axis_suffix<ParamDim>(axis);
    const int degree = nurbs.degree[axis];
    if (degree < 1 || degree > max_nurbs_degree)
      throw InputError(file, field + ".degree" + suffix, std::to_string(degree),
                       "1 to " + std::to_string(max_nurbs_degree));
    const long n = long(nurbs.knots[axis].size()) - degree - 1;
    if (n < degree + 1)
      throw InputError(file, field + ".knots" + suffix,
                       std::to_string(nurbs.knots[axis].size()) + " knots",
                       "at least 2 (degree + 1) = " + std::to_string(2 * degree + 2));
    check_knots(nurbs.knots[axis], degree, file, field + ".knots" + suffix);
    n_expected *= n;
  }
  const long n_points = nurbs.control_points.cols();
  if (n_points != n_expected)
    throw InputError(file, field + ".control_points", std::to_string(n_points) + " control points",
                     std::to_string(n_expected) + " (number of knots - degree - 1" +
                         (ParamDim == 1 ? ")" : " along each axis, multiplied)"));
  if (nurbs.weights.size() != n_points)
    throw InputError(file, field + ".weights", std::to_string(nurbs.weights.size()) + " weights",
                     std::to_string(n_points) + ", one per control point");
  for (long i = 0; i < n_points; ++i) {
    for (int k = 0; k < Dim; ++k)
      if (!std::isfinite(nurbs.control_points(k, i)))
        throw InputError(file, indexed(field, "control_points", i) + "[" + std::to_string(k) + "]",
                         text(nurbs.control_points(k, i)), "finite");
    if (!(nurbs.weights[i] > 0) || !std::isfinite(nurbs.weights[i]))
      throw InputError(file, indexed(field, "weights", i), text(nurbs.weights[i]),
                       "finite and > 0");
  }
}

template <int ParamDim, int Dim>
std::vector<Interval> spans(const Nurbs<ParamDim, Dim>& nurbs, int axis) {
  std::vector<Interval> result;
  const auto& knots = nurbs.knots[axis];
  for (int k = nurbs.degree[axis]; k < n_control(nurbs, axis); ++k)
    if (knots[k] < knots[k + 1]) result.push_back({knots[k], knots[k + 1]});
  return result;
}

template <int ParamDim, int Dim>
bool is_closed(const Nurbs<ParamDim, Dim>& nurbs, int axis) {
  const auto& knots = nurbs.knots[axis];
  const int degree = nurbs.degree[axis];
  detail::AxisMap ends;
  for (double u : {domain(nurbs, axis).lower, domain(nurbs, axis).upper}) {
    const std::vector<double> arguments(degree, u);
    detail::append_polar_form(knots, degree, detail::find_span(knots, degree, u), arguments.data(),
                              ends);
  }
  Nurbs<ParamDim, Dim> isocurves = nurbs;  // control points of both ends
  detail::apply(ends, axis, isocurves);
  const double size =
      (nurbs.control_points.rowwise().maxCoeff() - nurbs.control_points.rowwise().minCoeff())
          .maxCoeff();
  const long stride = axis == 0 ? 1 : isocurves.weights.size() / 2;
  double ratio = -1;
  for (long i = 0; i < isocurves.weights.size(); ++i) {
    if (axis == 0 ? i % 2 == 1 : i >= stride) continue;
    const auto difference =
        isocurves.control_points.col(i) - isocurves.control_points.col(i + stride);
    if (difference.cwiseAbs().maxCoeff() > 1e-12 * size) return false;
    const double r = isocurves.weights[i] / isocurves.weights[i + stride];
    if (ratio > 0 && std::abs(r - ratio) > 1e-12 * ratio) return false;
    ratio = r;
  }
  return true;
}

#define SEM_INSTANTIATE(ParamDim, Dim)                                                      \
  template void check(const Nurbs<ParamDim, Dim>&, const std::string&, const std::string&); \
  template std::vector<Interval> spans(const Nurbs<ParamDim, Dim>&, int);                   \
  template bool is_closed(const Nurbs<ParamDim, Dim>&, int);
SEM_INSTANTIATE(1, 2)
SEM_INSTANTIATE(1, 3)
SEM_INSTANTIATE(2, 3)
#undef SEM_INSTANTIATE

}  // namespace sem
