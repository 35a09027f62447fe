#include "sem/nurbs/refine.h"

#include <algorithm>
#include <cassert>

#include "sem/nurbs/axis_map.h"

namespace sem {
namespace {

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> with_map(const Nurbs<ParamDim, Dim>& nurbs, int axis,
                              const detail::AxisMap& map, int degree, std::vector<double> knots) {
  Nurbs<ParamDim, Dim> result = nurbs;
  detail::apply(map, axis, result);
  result.degree[axis] = degree;
  result.knots[axis] = std::move(knots);
  return result;
}

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> with_knots(const Nurbs<ParamDim, Dim>& nurbs, int axis,
                                std::vector<double> finer) {
  const int degree = nurbs.degree[axis];
  const auto map = detail::map_to_knots(nurbs.knots[axis], degree, finer);
  return with_map(nurbs, axis, map, degree, std::move(finer));
}

// The knots of the part of the domain in [lower, upper], clamped there.
std::vector<double> clamped_knots(const std::vector<double>& knots, int degree, double lower,
                                  double upper) {
  std::vector<double> result(degree + 1, lower);
  for (double knot : knots)
    if (knot > lower && knot < upper) result.push_back(knot);
  result.insert(result.end(), degree + 1, upper);
  return result;
}

// Every distinct knot once more, cut so that the domain stays the same.
std::vector<double> elevated_knots(const std::vector<double>& knots, int degree) {
  std::vector<double> all;
  for (size_t k = 0; k < knots.size(); ++k) {
    all.push_back(knots[k]);
    if (k + 1 == knots.size() || knots[k + 1] != knots[k]) all.push_back(knots[k]);
  }
  const double lower = knots[degree], upper = knots[knots.size() - degree - 1];
  const auto last_lower = std::upper_bound(all.begin(), all.end(), lower) - 1;
  const auto first_upper = std::lower_bound(all.begin(), all.end(), upper);
  return {last_lower - (degree + 1), first_upper + (degree + 2)};
}

detail::AxisMap elevation_map(const std::vector<double>& knots, int degree,
                              const std::vector<double>& elevated) {
  detail::AxisMap map, term;
  const int n = int(elevated.size()) - degree - 2;
  std::vector<double> arguments(degree);
  for (int i = 0; i < n; ++i) {
    int k = std::max(i, degree + 1);
    while (k < n - 1 && elevated[k] == elevated[k + 1]) ++k;
    const int span = detail::find_span(knots, degree, elevated[k]);
    // Mean of the polar form over the ways to leave out one of the knots.
    map.width = degree + 1;
    map.first.push_back(span - degree);
    map.coefficient.resize(map.coefficient.size() + map.width, 0.0);
    for (int omitted = 0; omitted <= degree; ++omitted) {
      for (int j = 0, m = 0; j <= degree; ++j)
        if (j != omitted) arguments[m++] = elevated[i + 1 + j];
      term.first.clear();
      term.coefficient.clear();
      detail::append_polar_form(knots, degree, span, arguments.data(), term);
      for (int c = 0; c <= degree; ++c)
        map.coefficient[size_t(i) * map.width + c] += term.coefficient[c] / (degree + 1);
    }
  }
  return map;
}

}  // namespace

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> insert_knot(const Nurbs<ParamDim, Dim>& nurbs, int axis, double u, int times) {
  std::vector<double> finer = nurbs.knots[axis];
  assert(u >= domain(nurbs, axis).lower && u <= domain(nurbs, axis).upper);
  finer.insert(std::upper_bound(finer.begin(), finer.end(), u), times, u);
  assert(std::count(finer.begin(), finer.end(), u) <= nurbs.degree[axis] + 1);
  // At an end, drop what the new knots push out of the domain.
  const Interval range = domain(nurbs, axis);
  const int degree = nurbs.degree[axis];
  const auto lower = std::upper_bound(finer.begin(), finer.end(), range.lower) - 1 - degree;
  const auto upper = std::lower_bound(finer.begin(), finer.end(), range.upper) + degree + 1;
  return with_knots(nurbs, axis, {lower, upper});
}

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> elevate_degree(const Nurbs<ParamDim, Dim>& nurbs, int axis, int times) {
  Nurbs<ParamDim, Dim> result = nurbs;
  for (int k = 0; k < times; ++k) {
    const int degree = result.degree[axis];
    auto knots = elevated_knots(result.knots[axis], degree);
    const auto map = elevation_map(result.knots[axis], degree, knots);
    result = with_map(result, axis, map, degree + 1, std::move(knots));
  }
  return result;
}

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> clamped(const Nurbs<ParamDim, Dim>& nurbs, int axis) {
  const Interval range = domain(nurbs, axis);
  return with_knots(nurbs, axis,
                    clamped_knots(nurbs.knots[axis], nurbs.degree[axis], range.lower, range.upper));
}

template <int ParamDim, int Dim>
std::array<Nurbs<ParamDim, Dim>, 2> split_at(const Nurbs<ParamDim, Dim>& nurbs, int axis,
                                             double u) {
  const Interval range = domain(nurbs, axis);
  assert(u > range.lower && u < range.upper);
  const auto& knots = nurbs.knots[axis];
  const int degree = nurbs.degree[axis];
  return {with_knots(nurbs, axis, clamped_knots(knots, degree, range.lower, u)),
          with_knots(nurbs, axis, clamped_knots(knots, degree, u, range.upper))};
}

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> reversed(const Nurbs<ParamDim, Dim>& nurbs, int axis) {
  const Interval range = domain(nurbs, axis);
  const int n = n_control(nurbs, axis);
  auto knots = nurbs.knots[axis];
  std::reverse(knots.begin(), knots.end());
  for (double& knot : knots)  // the ends of the domain stay bit for bit
    knot = knot == range.lower   ? range.upper
           : knot == range.upper ? range.lower
                                 : range.lower + (range.upper - knot);
  detail::AxisMap map;
  map.width = 1;
  for (int i = n - 1; i >= 0; --i) map.first.push_back(i);
  map.coefficient.assign(n, 1.0);
  return with_map(nurbs, axis, map, nurbs.degree[axis], std::move(knots));
}

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> with_domain(const Nurbs<ParamDim, Dim>& nurbs, int axis, Interval interval) {
  const Interval old = domain(nurbs, axis);
  Nurbs<ParamDim, Dim> result = nurbs;
  for (double& knot : result.knots[axis]) {
    const double s = (knot - old.lower) / (old.upper - old.lower);
    knot = (1 - s) * interval.lower + s * interval.upper;
  }
  return result;
}

#define SEM_INSTANTIATE(P, D)                                                    \
  template Nurbs<P, D> insert_knot(const Nurbs<P, D>&, int, double, int);        \
  template Nurbs<P, D> elevate_degree(const Nurbs<P, D>&, int, int);             \
  template Nurbs<P, D> clamped(const Nurbs<P, D>&, int);                         \
  template std::array<Nurbs<P, D>, 2> split_at(const Nurbs<P, D>&, int, double); \
  template Nurbs<P, D> reversed(const Nurbs<P, D>&, int);                        \
  template Nurbs<P, D> with_domain(const Nurbs<P, D>&, int, Interval);
SEM_INSTANTIATE(1, 2)
SEM_INSTANTIATE(1, 3)
SEM_INSTANTIATE(2, 3)
#undef SEM_INSTANTIATE

}  // namespace sem
