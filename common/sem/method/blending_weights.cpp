#include "sem/method/blending_weights.h"

#include "sem/nurbs/closest.h"

namespace sem {
namespace {

template <int Dim>
int closest_part(const Boundary<Dim>& boundary, const Vec<Dim>& X) {
  int best = 0;
  double distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < boundary.n_parts(); ++i) {
    const double d = closest_point(boundary.parts[i], X, distance).distance;
    if (d < distance) {
      distance = d;
      best = i;
    }
  }
  return best;
}

}  // namespace

template <int Dim>
BlendingWeights<Dim> blending_weights(const DistanceWeights<Dim>& theta, const Boundary<Dim>& boundary,
                                      const Points<Dim>& position) {
  BlendingWeights<Dim> weights;
  weights.n_parts = theta.n_parts;
  weights.begin.push_back(0);
  const int n_points = int(theta.begin.size()) - 1;
  const bool with_gradient = !theta.gradient.empty();
  for (int k = 0; k < n_points; ++k) {
    double sum = 0;
    Vec<Dim> gradient = Vec<Dim>::Zero();
    for (int e = theta.begin[k]; e < theta.begin[k + 1]; ++e) {
      sum += theta.theta[e];
      if (with_gradient) gradient += theta.gradient[e];
    }
    for (int e = theta.begin[k]; e < theta.begin[k + 1]; ++e) {
      const double w = theta.theta[e] / sum;
      weights.part.push_back(theta.part[e]);
      weights.w.push_back(w);
      if (with_gradient) weights.gradient.push_back((theta.gradient[e] - w * gradient) / sum);
    }
    if (sum == 0) {
      weights.part.push_back(closest_part<Dim>(boundary, position.col(k)));
      weights.w.push_back(1);
      if (with_gradient) weights.gradient.push_back(Vec<Dim>::Zero());
      weights.uncovered.push_back(k);
    }
    weights.begin.push_back(int(weights.part.size()));
  }
  return weights;
}

template BlendingWeights<2> blending_weights<2>(const DistanceWeights<2>&, const Boundary<2>&,
                                                const Points<2>&);
template BlendingWeights<3> blending_weights<3>(const DistanceWeights<3>&, const Boundary<3>&,
                                                const Points<3>&);

}  // namespace sem
