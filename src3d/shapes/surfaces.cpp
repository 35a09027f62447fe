#include "src3d/shapes/surfaces.h"

#include <algorithm>
#include <cmath>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/refine.h"

namespace sem::shapes3d {
namespace {

constexpr double same_knot = 1e-12;  // of a domain of length 1

using Homogeneous = Eigen::Matrix<double, 4, Eigen::Dynamic>;

template <int ParamDim>
Homogeneous homogeneous(const Nurbs<ParamDim, 3>& nurbs) {
  Homogeneous P(4, nurbs.weights.size());
  P << nurbs.control_points * nurbs.weights.asDiagonal(), nurbs.weights.transpose();
  return P;
}

template <int ParamDim>
void set_homogeneous(const Homogeneous& P, Nurbs<ParamDim, 3>& nurbs) {
  nurbs.weights = P.row(3).transpose();
  nurbs.control_points = P.topRows<3>().array().rowwise() / P.row(3).array();
}

// Inserts the knots of `other` along an axis that the NURBS has not, or not as often.
template <int ParamDim>
Nurbs<ParamDim, 3> with_knots_of(Nurbs<ParamDim, 3> nurbs, int axis,
                                 const std::vector<double>& other) {
  for (size_t k = 0; k < other.size(); ++k) {
    const double u = other[k];
    if (k > 0 && other[k - 1] == u) continue;
    const auto count = [u](const std::vector<double>& knots) {
      return int(std::count(knots.begin(), knots.end(), u));
    };
    const int missing = count(other) - count(nurbs.knots[axis]);
    if (missing > 0) nurbs = insert_knot(nurbs, axis, u, missing);
  }
  return nurbs;
}

// Knots of b that are those of a but for rounding become equal to them.
void snap_knots(const std::vector<double>& a, std::vector<double>& b) {
  for (double& u : b)
    for (const double known : a)
      if (std::abs(u - known) < same_knot) u = known;
}

// Control points (i, j) of a surface from curves j, along u.
Patch from_rows(const std::vector<Curve>& rows, int degree_v, std::vector<double> knots_v) {
  Patch patch;
  const Eigen::Index n = rows[0].control_points.cols(), m = Eigen::Index(rows.size());
  patch.degree = {rows[0].degree[0], degree_v};
  patch.knots = {rows[0].knots[0], std::move(knots_v)};
  patch.control_points.resize(3, n * m);
  patch.weights.resize(n * m);
  for (Eigen::Index j = 0; j < m; ++j) {
    patch.control_points.middleCols(j * n, n) = rows[j].control_points;
    patch.weights.segment(j * n, n) = rows[j].weights;
  }
  return patch;
}

std::vector<double> linear_knots() { return {0, 0, 1, 1}; }

Patch transposed(const Patch& patch) {
  Patch result = patch;
  std::swap(result.degree[0], result.degree[1]);
  std::swap(result.knots[0], result.knots[1]);
  const int n = n_control(patch, 0), m = n_control(patch, 1);
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      result.control_points.col(j + i * m) = patch.control_points.col(i + j * n);
      result.weights[j + i * m] = patch.weights[i + j * n];
    }
  return result;
}

// Mean over the control points of the chord lengths along v, from 0 to 1 (P&T eq. 10.8). strips[k]:
// compatible curves of one surface.
std::vector<double> section_parameters(const std::vector<std::vector<Curve>>& strips) {
  const int n = int(strips[0].size());
  std::vector<double> v(n, 0.0);
  int n_chains = 0;
  for (const auto& curves : strips)
    for (Eigen::Index i = 0; i < curves[0].control_points.cols(); ++i) {
      std::vector<double> chord(n, 0.0);
      for (int k = 1; k < n; ++k)
        chord[k] = chord[k - 1] +
                   (curves[k].control_points.col(i) - curves[k - 1].control_points.col(i)).norm();
      if (!(chord.back() > 0)) continue;
      for (int k = 0; k < n; ++k) v[k] += chord[k] / chord.back();
      ++n_chains;
    }
  for (int k = 0; k < n; ++k) v[k] = n_chains > 0 ? v[k] / n_chains : double(k) / (n - 1);
  v.back() = 1;
  return v;
}

// P&T eq. 9.8.
std::vector<double> averaged_knots(const std::vector<double>& v, int degree) {
  const int n = int(v.size());
  std::vector<double> knots(degree + 1, 0.0);
  for (int j = 1; j < n - degree; ++j) {
    double sum = 0;
    for (int i = j; i < j + degree; ++i) sum += v[i];
    knots.push_back(sum / degree);
  }
  knots.insert(knots.end(), degree + 1, 1.0);
  return knots;
}

// X with N X = Q by elimination without pivots: N is totally positive.
Eigen::MatrixXd eliminate(Eigen::MatrixXd N, Eigen::MatrixXd Q) {
  const Eigen::Index n = N.rows();
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const double factor = N(i, k) / N(k, k);
      if (factor == 0) continue;
      N.row(i) -= factor * N.row(k);
      Q.row(i) -= factor * Q.row(k);
    }
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    for (Eigen::Index j = k + 1; j < n; ++j) Q.row(k) -= N(k, j) * Q.row(j);
    Q.row(k) /= N(k, k);
  }
  return Q;
}

// The surface of degree q in v through compatible curves at the parameters v.
Patch skinned(std::vector<Curve> rows, const std::vector<double>& v, int q) {
  const int n = int(rows.size());
  const std::vector<double> knots = averaged_knots(v, q);
  Curve basis;
  basis.degree = {q};
  basis.knots = {knots};
  basis.control_points.setZero(3, n);
  basis.weights.setOnes(n);
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(n, n);
  BasisValues<1> values;
  for (int k = 0; k < n; ++k) {
    evaluate_basis(basis, Param<1>(v[k]), 0, values);
    for (size_t j = 0; j < values.column.size(); ++j) N(k, values.column[j]) = values.value[j];
  }
  const Eigen::Index n_controls = rows[0].control_points.cols();
  Eigen::MatrixXd Q(n, 4 * n_controls);
  for (int k = 0; k < n; ++k) {
    const Homogeneous P = homogeneous(rows[k]);
    Q.row(k) = Eigen::Map<const Eigen::RowVectorXd>(P.data(), P.size());
  }
  const Eigen::MatrixXd solution = eliminate(N, Q);
  for (int k = 1; k + 1 < n; ++k) {  // the ends are the end sections, bit for bit
    const Eigen::RowVectorXd row = solution.row(k);
    set_homogeneous<1>(Eigen::Map<const Homogeneous>(row.data(), 4, n_controls), rows[k]);
  }
  return from_rows(rows, q, knots);
}

Patch bilinear(const Homogeneous& corners) {
  Patch patch;
  patch.degree = {1, 1};
  patch.knots = {linear_knots(), linear_knots()};
  set_homogeneous(corners, patch);
  return patch;
}

}  // namespace

Vec<2> direction(double angle) {
  const double quarters = std::round(angle / (M_PI / 2));
  const double rest = angle - quarters * (M_PI / 2);
  const bool exact = std::abs(rest) < 1e-15 * std::max(1.0, std::abs(angle));
  const double c = exact ? 1 : std::cos(rest), s = exact ? 0 : std::sin(rest);
  switch (((int(quarters) % 4) + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

Curve in_space(const Nurbs<1, 2>& curve, const Vec<3>& origin, const Vec<3>& e1, const Vec<3>& e2) {
  Curve result;
  result.degree = curve.degree;
  result.knots = curve.knots;
  result.weights = curve.weights;
  result.control_points =
      (e1 * curve.control_points.row(0) + e2 * curve.control_points.row(1)).colwise() + origin;
  return result;
}

Curve mapped(const Curve& curve, const Mat<3>& A, const Vec<3>& b) {
  Curve result = curve;
  result.control_points = (A * curve.control_points).colwise() + b;
  return result;
}

std::vector<Curve> compatible(std::vector<Curve> curves) {
  int degree = 1;
  for (const Curve& curve : curves) degree = std::max(degree, curve.degree[0]);
  for (Curve& curve : curves) {
    curve = with_domain(clamped(curve, 0), 0, {0, 1});
    curve = elevate_degree(curve, 0, degree - curve.degree[0]);
  }
  // All knots into the first, then all of its knots into the others.
  for (size_t k = 1; k < curves.size(); ++k) {
    snap_knots(curves[0].knots[0], curves[k].knots[0]);
    curves[0] = with_knots_of(curves[0], 0, curves[k].knots[0]);
  }
  for (size_t k = 1; k < curves.size(); ++k) {
    snap_knots(curves[0].knots[0], curves[k].knots[0]);
    curves[k] = with_knots_of(curves[k], 0, curves[0].knots[0]);
  }
  return curves;
}

Patch ruled(const Curve& a, const Curve& b) {
  return from_rows(compatible({a, b}), 1, linear_knots());
}

Patch fan(const Curve& curve, const Vec<3>& apex) {
  return ruled(curve, mapped(curve, Mat<3>::Zero(), apex));
}

Patch extruded(const Curve& curve, const Vec<3>& by) {
  return ruled(curve, mapped(curve, Mat<3>::Identity(), by));
}

Patch revolved(const Curve& curve, double from, double to) {
  const int n_pieces = std::max(1, int(std::ceil((to - from) / (M_PI / 2) - 1e-9)));
  const double piece = (to - from) / n_pieces, middle_weight = direction(piece / 2)[0];
  std::vector<double> knots(3, 0.0);
  std::vector<Curve> rows;
  const Curve profile = with_domain(clamped(curve, 0), 0, {0, 1});
  for (int k = 0; k <= 2 * n_pieces; ++k) {
    const Vec<2> e = direction(from + piece * k / 2);
    const double w = k % 2 ? middle_weight : 1;
    // (x, y, z) at the angle; control points between two places stand on both tangents.
    Mat<3> turn = Mat<3>::Identity();
    turn.topLeftCorner<2, 2>() << e[0] / w, -e[1] / w, e[1] / w, e[0] / w;
    Curve row = mapped(profile, turn, Vec<3>::Zero());
    row.weights *= w;
    rows.push_back(std::move(row));
    if (k % 2 == 0 && k > 0 && k < 2 * n_pieces)
      knots.insert(knots.end(), 2, double(k / 2) / n_pieces);
  }
  knots.insert(knots.end(), 3, 1.0);
  return transposed(from_rows(rows, 2, knots));
}

std::vector<Patch> lofted(const std::vector<std::vector<Curve>>& sections, int degree) {
  std::vector<std::vector<Curve>> strips;
  for (size_t k = 0; k < sections[0].size(); ++k) {
    std::vector<Curve> curves;
    for (const auto& section : sections) curves.push_back(section[k]);
    strips.push_back(compatible(std::move(curves)));
  }
  const int n = int(sections.size()), q = std::min(degree, n - 1);
  const std::vector<double> v = section_parameters(strips);
  std::vector<Patch> patches;
  for (auto& curves : strips) patches.push_back(skinned(std::move(curves), v, q));
  return patches;
}

Patch coons(const Curve& lower, const Curve& upper, const Curve& left, const Curve& right) {
  Patch along = ruled(lower, upper), across = transposed(ruled(left, right));
  const Homogeneous ends_lower = homogeneous(lower), ends_upper = homogeneous(upper);
  Homogeneous corners(4, 4);
  corners << ends_lower.leftCols<1>(), ends_lower.rightCols<1>(), ends_upper.leftCols<1>(),
      ends_upper.rightCols<1>();
  Patch both = bilinear(corners);
  for (Patch* patch : {&along, &across, &both}) {
    *patch =
        elevate_degree(*patch, 0, std::max(along.degree[0], across.degree[0]) - patch->degree[0]);
    *patch =
        elevate_degree(*patch, 1, std::max(along.degree[1], across.degree[1]) - patch->degree[1]);
  }
  for (Patch* patch : {&across, &both}) *patch = with_knots_of(*patch, 0, along.knots[0]);
  for (Patch* patch : {&along, &both}) *patch = with_knots_of(*patch, 1, across.knots[1]);
  set_homogeneous<2>(homogeneous(along) + homogeneous(across) - homogeneous(both), along);
  return along;
}

std::vector<Patch> split(const Patch& patch, int n_u, int n_v) {
  std::vector<Patch> pieces = {patch};
  for (const int axis : {1, 0}) {
    const int n = axis == 0 ? n_u : n_v;
    std::vector<Patch> finer;
    for (const Patch& piece : pieces) {
      const auto [lower, upper] = domain(piece, axis);
      Patch rest = piece;
      for (int k = 1; k < n; ++k) {
        const auto halves = split_at(rest, axis, lower + (upper - lower) * k / n);
        finer.push_back(halves[0]);
        rest = halves[1];
      }
      finer.push_back(rest);
    }
    pieces = std::move(finer);
  }
  return pieces;
}

Patch elevated(Patch patch, int degree) {
  for (int axis = 0; axis < 2; ++axis)
    patch = elevate_degree(patch, axis, std::max(0, degree - patch.degree[axis]));
  return patch;
}

}  // namespace sem::shapes3d
