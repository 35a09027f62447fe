#include <Eigen/LU>
#include <algorithm>

#include "sem/method/distance_weights.h"
#include "sem/method/sided_weight.h"
#include "sem/nurbs/basis.h"

namespace sem {
namespace {

// Index of the second derivative ab among uu, uv, vv.
constexpr int second_index(int a, int b) { return a + b; }

// How the closest point of a part follows X.
template <int Dim>
struct FootMotion {
  Eigen::Matrix<double, Dim - 1, Dim> parameter;  // du*/dX
  Mat<Dim> position;                              // dX*/dX
};

// A foot on the curve that a part is trimmed along; none at its corners. r = X - X*.
template <int Dim>
FootMotion<Dim> motion_along(const BorderPoint<Dim - 1>& border, const Derivatives<Dim - 1, Dim>& at, const Vec<Dim>& r) {
  FootMotion<Dim> motion{Eigen::Matrix<double, Dim - 1, Dim>::Zero(), Mat<Dim>::Zero()};
  const Vec<Dim> T = at.first * border.first;
  if (std::abs(r.dot(T)) > 1e-6 * r.norm() * T.norm()) return motion;
  Vec<Dim> curvature = at.first * border.second;
  for (int a = 0; a < Dim - 1; ++a)
    for (int b = 0; b < Dim - 1; ++b)
      curvature += border.first[a] * border.first[b] * at.second[second_index(a, b)];
  motion.parameter = border.first * T.transpose() / (T.squaredNorm() - r.dot(curvature));
  motion.position = at.first * motion.parameter;
  return motion;
}

// u: the foot, or if `moved` a regular_parameter beside it; r = X - X*.
template <int Dim>
FootMotion<Dim> foot_motion(const PreparedNurbs<Dim - 1, Dim>& part, const Param<Dim - 1>& u,
                            const Derivatives<Dim - 1, Dim>& at, const Vec<Dim>& r, bool moved) {
  const double right_angle = moved ? 1e-4 : 1e-6;
  const auto is_free = [&](int a) {
    return std::abs(r.dot(at.first.col(a))) <= right_angle * r.norm() * at.first.col(a).norm();
  };
  if (part.region)
    for (int a = 0; a < Dim - 1; ++a)
      if (!is_free(a)) return motion_along<Dim>(part.region->border_near(u), at, r);
  // Directions in which the foot is stationary; in the others it is held by an end, an edge or a corner.
  Eigen::Matrix<double, Dim, Dim - 1> T = at.first;
  Eigen::Matrix<double, Dim - 1, Dim - 1> A;
  for (int a = 0; a < Dim - 1; ++a)
    for (int b = 0; b < Dim - 1; ++b)
      A(a, b) = T.col(a).dot(T.col(b)) - r.dot(at.second[second_index(a, b)]);
  for (int a = 0; a < Dim - 1; ++a) {
    if (is_free(a)) continue;
    T.col(a).setZero();
    A.row(a).setZero();
    A.col(a).setZero();
    A(a, a) = 1;
  }
  FootMotion<Dim> motion;
  motion.parameter = A.inverse() * T.transpose();
  motion.position = T * motion.parameter;
  return motion;
}

// dN/du of the unit normal, by Weingarten's equations.
template <int Dim>
Eigen::Matrix<double, Dim, Dim - 1> normal_derivative(const Derivatives<Dim - 1, Dim>& at, const Vec<Dim>& normal) {
  const Eigen::Matrix<double, Dim - 1, Dim - 1> metric = at.first.transpose() * at.first;
  Eigen::Matrix<double, Dim - 1, Dim - 1> form;
  for (int a = 0; a < Dim - 1; ++a)
    for (int b = 0; b < Dim - 1; ++b) form(a, b) = at.second[second_index(a, b)].dot(normal);
  const Eigen::Matrix<double, Dim - 1, Dim - 1> shape = metric.inverse() * form;
  return -at.first * shape;
}

// d(X - X*)/|X - X*| / dX.
template <int Dim>
Mat<Dim> direction_derivative(const Vec<Dim>& n, double d, const Mat<Dim>& foot) {
  const Mat<Dim> across = Mat<Dim>::Identity() - n * n.transpose(), slide = Mat<Dim>::Identity() - foot;
  return across * slide / d;
}

template <int Dim>
Vec<Dim> theta_gradient(const Boundary<Dim>& boundary, const Distances<Dim>& distances, int pair,
                        const Vec<Dim>& X, double cutoff, bool draft) {
  const double d = distances.closest[pair], reach = distances.reach[pair];
  if (d == 0 && distances.variant == DistanceWeight::distance_only)
    return distances.outward[distances.part[pair]] / cutoff *
           unit_normal(boundary.parts[distances.part[pair]].nurbs, distances.foot_u[pair]);
  if (d == 0) return Vec<Dim>::Zero();
  const Vec<Dim> n = (X - distances.foot[pair]) / d;
  if (!(reach < cutoff)) return -n / cutoff;
  const auto& part = boundary.parts[distances.part[pair]];
  const Param<Dim - 1> u = regular_parameter<Dim>(part.nurbs, distances.foot_u[pair]);
  const auto at = derivatives(part.nurbs, u);
  const Mat<Dim> C = foot_motion<Dim>(part, u, at, d * n, u != distances.foot_u[pair]).position;
  const Mat<Dim> dn = direction_derivative<Dim>(n, d, C);
  const auto hit = derivatives(boundary.parts[distances.hit_part[pair]].nurbs, distances.hit_u[pair]);
  const Vec<Dim> N = DimTraits<Dim>::area_normal(hit.first);
  const double r = draft ? reach + d : reach;
  const Mat<Dim> dhit = C + r * dn;
  Vec<Dim> dreach = dhit.transpose() * N;
  dreach /= -N.dot(n);
  if (draft) dreach -= n;
  return -n / reach + d / (reach * reach) * dreach;
}

}  // namespace

template <int Dim>
SideStep<Dim> side_at(const PreparedNurbs<Dim - 1, Dim>& part, const Distances<Dim>& distances, int pair,
                      const Vec<Dim>& X, double ramp) {
  const Slope step = side_step(distances.side[pair], ramp);
  const double d = distances.closest[pair];
  if (d == 0 || step.derivative == 0) return {step.value, Vec<Dim>::Zero()};
  const Vec<Dim> n = (X - distances.foot[pair]) / d;
  const Param<Dim - 1> u = regular_parameter<Dim>(part.nurbs, distances.foot_u[pair]);
  const auto at = derivatives(part.nurbs, u);
  const Vec<Dim> N = unit_normal(part.nurbs, u);
  const FootMotion<Dim> foot = foot_motion<Dim>(part, u, at, d * n, u != distances.foot_u[pair]);
  const Mat<Dim> dn = direction_derivative<Dim>(n, d, foot.position);
  const Mat<Dim> dN = normal_derivative<Dim>(at, N) * foot.parameter;
  const Vec<Dim> from_n = dn.transpose() * N, from_N = dN.transpose() * n;
  return {step.value, -step.derivative * distances.outward[distances.part[pair]] * (from_n + from_N)};
}

// theta = f(d / reach) h(side).
template <int Dim>
Vec<Dim> sided_gradient(const PreparedNurbs<Dim - 1, Dim>& part, const Distances<Dim>& distances, int pair,
                        const Vec<Dim>& X, double reach, double ramp) {
  const double d = distances.closest[pair];
  const Slope profile = distance_profile(d / reach);
  if (d == 0)
    return -profile.derivative / reach * distances.outward[distances.part[pair]] *
           unit_normal(part.nurbs, distances.foot_u[pair]);
  const Vec<Dim> n = (X - distances.foot[pair]) / d;
  const SideStep<Dim> step = side_at(part, distances, pair, X, ramp);
  return profile.derivative * step.value / reach * n + profile.value * step.gradient;
}

template <int Dim>
void distance_weight_gradients(const Boundary<Dim>& boundary, const Points<Dim>& position,
                               const Distances<Dim>& distances, DistanceWeights<Dim>& theta) {
  theta.gradient.clear();
  for (int k = 0; k < distances.n_points; ++k) {
    int pair = distances.begin[k];  // both lists are in the same order; theta leaves out pairs
    for (int e = theta.begin[k]; e < theta.begin[k + 1]; ++e) {
      while (distances.part[pair] != theta.part[e]) ++pair;
      const Vec<Dim> X = position.col(k);
      const int i = theta.part[e];
      if (distances.variant == DistanceWeight::sided)
        theta.gradient.push_back(sided_gradient<Dim>(boundary.parts[i], distances, pair, X, theta.cutoff, theta.side_ramp));
      else
        theta.gradient.push_back(theta_gradient<Dim>(boundary, distances, pair, X, theta.cutoff,
                                                     distances.variant == DistanceWeight::draft));
    }
  }
}

#define SEM_INSTANTIATE(Dim)                                                              \
  template void distance_weight_gradients<Dim>(const Boundary<Dim>&, const Points<Dim>&,  \
                                               const Distances<Dim>&, DistanceWeights<Dim>&); \
  template Vec<Dim> sided_gradient<Dim>(const PreparedNurbs<Dim - 1, Dim>&, const Distances<Dim>&, int, \
                                        const Vec<Dim>&, double, double);                    \
  template SideStep<Dim> side_at<Dim>(const PreparedNurbs<Dim - 1, Dim>&, const Distances<Dim>&, int, const Vec<Dim>&, double);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
