#include "sem/draw/colors.h"

#include <algorithm>
#include <cmath>

namespace sem::colors {

Color viridis(double t) {
  static constexpr int n = 10;  // entries 0, 0.1, ..., 1 of the published table
  static constexpr unsigned table[n + 1] = {0x440154, 0x482576, 0x414487, 0x35608D,
                                            0x2A788E, 0x21908C, 0x22A884, 0x43BF71,
                                            0x7AD151, 0xBBDF27, 0xFDE725};
  const auto entry = [](int i) {
    const auto part = [i](int shift) { return ((table[i] >> shift) & 255) / 255.0; };
    return Color{part(16), part(8), part(0)};
  };
  if (std::isnan(t)) return gray;
  const double s = n * std::clamp(t, 0.0, 1.0);
  const int i = std::min(int(s), n - 1);
  return mix(entry(i), entry(i + 1), s - i);
}

}  // namespace sem::colors
