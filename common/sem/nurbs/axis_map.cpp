#include "sem/nurbs/axis_map.h"

#include <algorithm>

namespace sem::detail {

int find_span(const std::vector<double>& knots, int degree, double u) {
  int k = degree;  // the last of the spans that starts at u or before, by bisection without jumps
  for (int n = int(knots.size()) - 2 * degree - 1; n > 1;) {
    const int half = n / 2;
    k = knots[k + half] <= u ? k + half : k;
    n -= half;
  }
  while (k > degree && knots[k] == knots[k + 1]) --k;  // the end of the domain
  while (knots[k] == knots[k + 1]) ++k;
  return k;
}

void append_polar_form(const std::vector<double>& knots, int degree, int k, const double* arguments,
                       AxisMap& map) {
  map.width = degree + 1;
  map.first.push_back(k - degree);
  map.coefficient.resize(map.coefficient.size() + degree + 1, 0.0);
  double* c = map.coefficient.data() + map.coefficient.size() - degree - 1;
  c[0] = 1;
  for (int j = 1; j <= degree; ++j)
    for (int r = j - 1; r >= 0; --r) {  // c[r] is the function that starts at knot k - j + 1 + r
      const double lower = knots[k - j + 1 + r], upper = knots[k + 1 + r];
      const double s = (arguments[j - 1] - lower) / (upper - lower);
      c[r + 1] += s * c[r];
      c[r] *= 1 - s;
    }
}

AxisMap map_to_knots(const std::vector<double>& knots, int degree,
                     const std::vector<double>& finer) {
  AxisMap map;
  const int n = int(finer.size()) - degree - 1;
  for (int i = 0; i < n; ++i) {
    // The first span of the domain in the support of the new control point.
    int k = std::max(i, degree);
    while (k < n - 1 && finer[k] == finer[k + 1]) ++k;
    append_polar_form(knots, degree, find_span(knots, degree, finer[k]), &finer[i + 1], map);
  }
  return map;
}

template <int ParamDim, int Dim>
void apply(const AxisMap& map, int axis, Nurbs<ParamDim, Dim>& nurbs) {
  const int n_old = n_control(nurbs, axis), n_new = int(map.first.size());
  long stride = 1;
  for (int a = 0; a < axis; ++a) stride *= n_control(nurbs, a);
  const long n_blocks = nurbs.weights.size() / (n_old * stride);
  Points<Dim> points(Dim, n_blocks * n_new * stride);
  Eigen::VectorXd weights(points.cols());
  for (long block = 0; block < n_blocks; ++block)
    for (int i = 0; i < n_new; ++i)
      for (long inner = 0; inner < stride; ++inner) {
        const double* c = &map.coefficient[size_t(i) * map.width];
        const auto old = [&](int k) { return (block * n_old + map.first[i] + k) * stride + inner; };
        int largest = 0;
        double weight = 0;
        for (int k = 0; k < map.width; ++k) {
          weight += c[k] * nurbs.weights[old(k)];
          if (c[k] > c[largest]) largest = k;
        }
        // Differences to one of the points: equal coordinates stay equal.
        const Vec<Dim> base = nurbs.control_points.col(old(largest));
        Vec<Dim> difference = Vec<Dim>::Zero();
        for (int k = 0; k < map.width; ++k)
          if (k != largest)
            difference +=
                c[k] * nurbs.weights[old(k)] / weight * (nurbs.control_points.col(old(k)) - base);
        const long column = (block * n_new + i) * stride + inner;
        points.col(column) = base + difference;
        weights[column] = weight;
      }
  nurbs.control_points = std::move(points);
  nurbs.weights = std::move(weights);
}

template void apply(const AxisMap&, int, Nurbs<1, 2>&);
template void apply(const AxisMap&, int, Nurbs<1, 3>&);
template void apply(const AxisMap&, int, Nurbs<2, 3>&);

}  // namespace sem::detail
