#include "sem/nurbs/surface_patch.h"

#include <cmath>

#include "sem/nurbs/bernstein.h"

namespace sem::detail {

Vec<2> SurfacePatch::speed(const Vec<2>& s) const {
  const Vec<2> size = upper - lower;
  Vec<2> result = size;
  for (int a = 0; a < 2; ++a) {
    if (ratio[a] == 1 || !(size[a] > 0)) continue;
    const double share = (s[a] - lower[a]) / size[a], r = ratio[a];
    result[a] *= (share + r * (1 - share)) * (share + r * (1 - share)) / r;
  }
  return result;
}

void balance(SurfacePatch& patch, Vec4* c, const std::array<int, 2>& degree) {
  const int stride[2] = {1, degree[0] + 1};
  for (int a = 0; a < 2; ++a) {
    const int across = stride[1 - a] * degree[1 - a], along = stride[a] * degree[a];
    const double begin = c[0][3] * c[across][3], end = c[along][3] * c[along + across][3];
    if (begin == end) continue;
    const double factor = std::pow(begin / end, 0.5 / degree[a]);
    patch.ratio[a] *= factor;
    for (int j = 0; j <= degree[1 - a]; ++j) {
      double power = 1;
      for (int i = 1; i <= degree[a]; ++i) c[j * stride[1 - a] + i * stride[a]] *= power *= factor;
    }
  }
}

void split(const SurfacePatch& patch, const Vec<2>& t, const std::array<int, 2>& degree,
           bool rational, const std::array<Vec4*, 4>& c, std::array<SurfacePatch, 4>& quarters) {
  const auto halve = [&](int from, int axis, int to) {
    split_patch<4>(c[from], degree.data(), axis, t[axis], c[to], c[from]);
  };
  halve(0, 0, 1);
  halve(0, 1, 2);
  halve(1, 1, 3);
  const bool upper[4][2] = {{true, true}, {false, true}, {true, false}, {false, false}};
  const Vec<2> middle = patch.parameter(t);
  for (int k = 0; k < 4; ++k) {
    SurfacePatch& quarter = quarters[k] = patch;
    ++quarter.halvings;
    for (int a = 0; a < 2; ++a) {
      const double r = patch.ratio[a];
      (upper[k][a] ? quarter.lower : quarter.upper)[a] = middle[a];
      quarter.ratio[a] = upper[k][a] ? r / (r + (1 - t[a]) * (1 - r)) : 1 - t[a] * (1 - r);
    }
    if (rational) balance(quarter, c[k], degree);
  }
}

}  // namespace sem::detail
