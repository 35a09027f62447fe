#include "src3d/picture/surface_stress.h"

#include <algorithm>
#include <cmath>

namespace sem {

Eigen::VectorXd near_mean(const Points<3>& places, const Points<3>& points,
                          const Eigen::VectorXd& values, int n_nearest) {
  Eigen::VectorXd result(places.cols());
  std::vector<std::pair<double, int>> nearest;  // the least distances squared so far, a heap
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    nearest.clear();
    for (int k = 0; k < points.cols(); ++k) {
      const double d = (points.col(k) - places.col(i)).squaredNorm();
      if (int(nearest.size()) == n_nearest && d >= nearest.front().first) continue;
      if (int(nearest.size()) == n_nearest) {
        std::pop_heap(nearest.begin(), nearest.end());
        nearest.pop_back();
      }
      nearest.emplace_back(d, k);
      std::push_heap(nearest.begin(), nearest.end());
    }
    if (nearest.empty()) {
      result[i] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    std::sort_heap(nearest.begin(), nearest.end());
    result[i] = values[nearest.front().second];
    const double first = std::sqrt(nearest.front().first), last = std::sqrt(nearest.back().first);
    if (std::isnan(result[i]) || first <= 1e-9 * last) continue;
    double sum = 0, weights = 0;
    for (const auto& [square, k] : nearest) {
      if (std::isnan(values[k])) continue;
      // A little more than r, so that points all equally far count alike.
      const double weight = 1 / std::sqrt(square) - 1 / (1.001 * last);
      sum += weight * weight * values[k];
      weights += weight * weight;
    }
    result[i] = sum / weights;
  }
  return result;
}

}  // namespace sem
