#include "sem/plot/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sem {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double margin = 0.05;  // of the data's range, at both ends of a linear axis

/// The nearest 1, 2 or 5 times a decade that is not above (side < 0) or not below the value.
double round_decade(double value, int side) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  constexpr double steps[] = {1, 2, 5, 10};
  constexpr double slack = 1 + 1e-9;
  if (side > 0)
    return decade *
           *std::find_if(steps, steps + 3, [&](double s) { return s * decade * slack >= value; });
  double best = decade;
  for (const double s : steps)
    if (s * decade <= value * slack) best = s * decade;
  return best;
}

}  // namespace

DataRange::DataRange() : lower(infinity), upper(-infinity), least_positive(infinity) {}

void DataRange::include(double value) {
  if (!std::isfinite(value)) return;
  lower = std::min(lower, value);
  upper = std::max(upper, value);
  if (value > 0) least_positive = std::min(least_positive, value);
}

std::pair<double, double> axis_limits(const Axis& axis, const DataRange& data) {
  double lower, upper;
  if (axis.logarithmic) {
    const bool any = std::isfinite(data.least_positive);
    lower = axis.lower.value_or(any ? round_decade(data.least_positive, -1) : 1);
    upper = axis.upper.value_or(any ? round_decade(data.upper, 1) : 10 * lower);
    if (!(upper > lower)) upper = 10 * lower;
    return {lower, upper};
  }
  const bool any = data.lower <= data.upper;
  lower = axis.lower.value_or(any ? data.lower : 0);
  upper = axis.upper.value_or(any ? data.upper : lower + 1);
  if (!(upper > lower)) {
    const double half = lower == 0 ? 1 : 0.1 * std::abs(lower);
    if (!axis.lower) lower -= half;
    if (!axis.upper || !(upper > lower)) upper = std::max(upper, lower) + half;
  }
  const double pad = margin * (upper - lower);
  return {axis.lower ? lower : lower - pad, axis.upper ? upper : upper + pad};
}

double AxisScale::operator()(double value) const {
  const double share = logarithmic ? std::log(value / lower) / std::log(upper / lower)
                                   : (value - lower) / (upper - lower);
  const double at = begin + share * (end - begin);
  return std::isfinite(at) ? at : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace sem
