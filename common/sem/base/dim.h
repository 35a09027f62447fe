#pragma once
// Fixed-size types and the few facts that depend on the dimension.
//
// The core is templated on Dim (2: plane strain per unit thickness, 3) and
// compiled for both. Nothing outside this file and the geometry leaves
// branches on it.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <string>
#include <vector>

namespace sem {

/// Position, displacement, force: Dim.
template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;

/// Deformation gradient, stress: Dim by Dim.
template <int Dim>
using Mat = Eigen::Matrix<double, Dim, Dim>;

/// Parameters of a NURBS: u (curve) or (u, v) (surface).
template <int ParamDim>
using Param = Eigen::Matrix<double, ParamDim, 1>;

/// A point per column, Dim by n.
template <int Dim>
using Points = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

/// Axis-aligned box, closed.
template <int Dim>
struct Box {
  Vec<Dim> lower = Vec<Dim>::Constant(std::numeric_limits<double>::infinity());
  Vec<Dim> upper = Vec<Dim>::Constant(-std::numeric_limits<double>::infinity());

  void include(const Vec<Dim>& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  void include(const Box& other) {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
  double diagonal() const { return (upper - lower).norm(); }
};

template <int Dim>
struct DimTraits;

template <>
struct DimTraits<2> {
  static constexpr int param_dim = 1;
  static constexpr const char* name = "2D";
  static constexpr const char* volume_name = "area";
  static constexpr char axis_name[] = "xy";
  static std::vector<std::string> axes() { return {"x", "y"}; }
  /// Tells the parameters of a part apart in names: a curve has one.
  static constexpr const char* parameter_suffix[] = {""};
  /// Normal of the boundary times its line element, from dX/du: right of the
  /// direction of travel, so outward on a loop that runs anticlockwise.
  static Vec<2> area_normal(const Eigen::Matrix<double, 2, 1>& tangents) {
    return {tangents(1, 0), -tangents(0, 0)};
  }
  /// Gauss points per knot span and direction for what acts on the boundary of a condensed map, whose
  /// weights have kinks there too.
  static constexpr int boundary_points = 24;
  /// a x b: angular momentum has one component.
  static constexpr int n_rotations = 1;
  static Vec<1> cross(const Vec<2>& a, const Vec<2>& b) { return Vec<1>(a[0] * b[1] - a[1] * b[0]); }
};

template <>
struct DimTraits<3> {
  static constexpr int param_dim = 2;
  static constexpr const char* name = "3D";
  static constexpr const char* volume_name = "volume";
  static constexpr char axis_name[] = "xyz";
  static std::vector<std::string> axes() { return {"x", "y", "z"}; }
  static constexpr const char* parameter_suffix[] = {"_u", "_v"};
  /// Normal of the boundary times its area element, from dX/du, dX/dv.
  static Vec<3> area_normal(const Eigen::Matrix<double, 3, 2>& tangents) {
    const Vec<3> du = tangents.col(0), dv = tangents.col(1);
    return du.cross(dv);
  }
  static constexpr int boundary_points = 8;
  static constexpr int n_rotations = 3;
  static Vec<3> cross(const Vec<3>& a, const Vec<3>& b) { return a.cross(b); }
};

}  // namespace sem
