#include "sem/method/strands.h"

#include <algorithm>
#include <array>

namespace sem {
namespace {
constexpr int most_on_strand = 64;
}

int points_for_wave(double phase, double tolerance) {
  double error = 1;
  for (int n = 1; n < most_on_strand; ++n) {
    const double pair = 2.0 * n * (2 * n - 1), squared = double(n) * n;
    error *= phase * phase * squared * squared / (pair * pair * pair) * (2 * n - 1) / (2 * n + 1);
    if (error <= tolerance) return n;
  }
  return most_on_strand;
}

const LineRule& gauss_on_strand(int n) {
  static const auto rules = [] {
    std::array<LineRule, most_on_strand> all;
    for (int count = 1; count <= most_on_strand; ++count) {
      LineRule& rule = all[count - 1] = gauss_legendre(count);
      for (double& x : rule.node) x = (1 + x) / 2;
      for (double& w : rule.weight) w /= 2;
    }
    return all;
  }();
  return rules[std::clamp(n, 1, most_on_strand) - 1];
}

}  // namespace sem
