#include <Eigen/LU>
#include <algorithm>

#include "sem/method/distance_weights.h"
#include "sem/nurbs/basis.h"

namespace sem {
namespace {

// Index of the second derivative ab among uu, uv, vv.
constexpr int second_index(int a, int b) { return a + b; }

// dX*/dX of the closest point of a part.
template <int Dim>
Mat<Dim> foot_derivative(const Nurbs<Dim - 1, Dim>& shape, const Param<Dim - 1>& u, const Vec<Dim>& X) {
  const auto at = derivatives(shape, u);
  const Vec<Dim> r = X - at.point;
  // Directions in which the foot is stationary; in the others it is held by an end, an edge or a corner.
  Eigen::Matrix<double, Dim, Dim - 1> T = at.first;
  Eigen::Matrix<double, Dim - 1, Dim - 1> A;
  for (int a = 0; a < Dim - 1; ++a)
    for (int b = 0; b < Dim - 1; ++b)
      A(a, b) = T.col(a).dot(T.col(b)) - r.dot(at.second[second_index(a, b)]);
  for (int a = 0; a < Dim - 1; ++a) {
    if (std::abs(r.dot(T.col(a))) <= 1e-6 * r.norm() * T.col(a).norm()) continue;
    T.col(a).setZero();
    A.row(a).setZero();
    A.col(a).setZero();
    A(a, a) = 1;
  }
  return T * A.inverse() * T.transpose();
}

template <int Dim>
Vec<Dim> theta_gradient(const Boundary<Dim>& boundary, const Distances<Dim>& distances, int pair,
                        const Vec<Dim>& X, double cutoff, bool draft) {
  const double d = distances.closest[pair], reach = distances.reach[pair];
  if (d == 0) return Vec<Dim>::Zero();
  const Vec<Dim> n = (X - distances.foot[pair]) / d;
  if (!(reach < cutoff)) return -n / cutoff;
  const Mat<Dim> C = foot_derivative<Dim>(boundary.parts[distances.part[pair]].nurbs, distances.foot_u[pair], X);
  const Mat<Dim> I = Mat<Dim>::Identity();
  const Mat<Dim> dn = (I - n * n.transpose()) * (I - C) / d;
  const auto hit = derivatives(boundary.parts[distances.hit_part[pair]].nurbs, distances.hit_u[pair]);
  const Vec<Dim> N = DimTraits<Dim>::area_normal(hit.first);
  const double r = draft ? reach + d : reach;
  Vec<Dim> dreach = -(C + r * dn).transpose() * N / N.dot(n);
  if (draft) dreach -= n;
  return -n / reach + d / (reach * reach) * dreach;
}

}  // namespace

template <int Dim>
void distance_weight_gradients(const Boundary<Dim>& boundary, const Points<Dim>& position,
                               const Distances<Dim>& distances, DistanceWeight variant,
                               DistanceWeights<Dim>& theta) {
  theta.gradient.clear();
  for (int k = 0; k < distances.n_points; ++k) {
    int pair = distances.begin[k];  // both lists are in the same order; theta leaves out pairs
    for (int e = theta.begin[k]; e < theta.begin[k + 1]; ++e) {
      while (distances.part[pair] != theta.part[e]) ++pair;
      theta.gradient.push_back(theta_gradient<Dim>(boundary, distances, pair, position.col(k), theta.cutoff,
                                                   variant == DistanceWeight::draft));
    }
  }
}

#define SEM_INSTANTIATE(Dim)                                                              \
  template void distance_weight_gradients<Dim>(const Boundary<Dim>&, const Points<Dim>&,  \
                                               const Distances<Dim>&, DistanceWeight, DistanceWeights<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)

}  // namespace sem
