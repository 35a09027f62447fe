#include "sem/draw/colors.h"

#include <algorithm>
#include <cmath>

namespace sem::colors {
namespace {

constexpr int n = 10;  // a map has entries at 0, 0.1, ..., 1
using Table = unsigned[n + 1];

Color interpolated(const Table& table, double t) {
  const auto entry = [&](int i) {
    const auto part = [&](int shift) { return ((table[i] >> shift) & 255) / 255.0; };
    return Color{part(16), part(8), part(0)};
  };
  if (std::isnan(t)) return gray;
  const double s = n * std::clamp(t, 0.0, 1.0);
  const int i = std::min(int(s), n - 1);
  return mix(entry(i), entry(i + 1), s - i);
}

constexpr Table viridis_table = {0x440154, 0x482576, 0x414487, 0x35608D, 0x2A788E, 0x21908C,
                                 0x22A884, 0x43BF71, 0x7AD151, 0xBBDF27, 0xFDE725};

// Straight lines in CIELAB from (36, 9.7, -44.5) to (96, 0, 0) to (36, 50.4, 45.1).
constexpr Table diverging_table = {0x1E549C, 0x5671AE, 0x808FBF, 0xA7B0D1, 0xCDD1E2, 0xF3F3F3,
                                   0xEBCBC1, 0xDFA291, 0xCE7B63, 0xBA5237, 0xA3230A};

}  // namespace

Color viridis(double t) { return interpolated(viridis_table, t); }

Color diverging(double t) { return interpolated(diverging_table, t); }

}  // namespace sem::colors
