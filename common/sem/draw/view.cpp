#include "sem/draw/view.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace sem {
namespace {

/// m 10^e with m = 1, 2 or 5.
struct RoundStep {
  int mantissa, exponent;
  /// k steps, rounded once.
  double times(double k) const {
    const double power = std::pow(10.0, std::abs(exponent));
    return exponent < 0 ? k * mantissa / power : k * mantissa * power;
  }
};

/// Intervals of [lo, hi] may be a rounding error wider than a whole number of steps.
constexpr double slack = 1e-9;

RoundStep round_step(double lo, double hi, int n) {
  assert(lo < hi && n >= 1);
  const double least = (hi - lo) / n * (1 - slack);
  RoundStep step{1, int(std::floor(std::log10(least)))};
  for (int mantissa : {1, 2, 5}) {
    step.mantissa = mantissa;
    if (step.times(1) >= least) return step;
  }
  return {1, step.exponent + 1};
}

}  // namespace

View2::View2(const Box<2>& world, const Box<2>& canvas)
    : world_center_((world.lower + world.upper) / 2),
      canvas_center_((canvas.lower + canvas.upper) / 2) {
  // A direction without extent divides by zero to infinity and loses the comparison.
  const Vec<2> ratio = (canvas.upper - canvas.lower).cwiseQuotient(world.upper - world.lower);
  scale_ = std::min(ratio[0], ratio[1]);
  assert(std::isfinite(scale_) && scale_ > 0);
}

std::vector<Vec<2>> View2::map(std::span<const Vec<2>> world) const {
  std::vector<Vec<2>> pixels;
  pixels.reserve(world.size());
  for (const auto& x : world) pixels.push_back(map(x));
  return pixels;
}

double nice_step(double lo, double hi, int n) { return round_step(lo, hi, n).times(1); }

std::vector<double> nice_ticks(double lo, double hi, int n) {
  const RoundStep step = round_step(lo, hi, n);
  const double first = std::ceil(lo / step.times(1) - slack);
  const double last = std::floor(hi / step.times(1) + slack);
  std::vector<double> ticks;
  for (double k = first; k <= last; ++k) ticks.push_back(k == 0 ? 0.0 : step.times(k));
  return ticks;
}

std::string tick_label(double value, double step) {
  const int n_decimals = std::clamp(-int(std::floor(std::log10(step) + slack)), 0, 12);
  char digits[64];
  std::snprintf(digits, sizeof digits, "%.*f", n_decimals, std::abs(value));
  const bool zero = std::string(digits).find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !zero ? "\u2212" : "") + std::string(digits);
}

}  // namespace sem
