// The operators beside the map: what z means for pins, outputs and rigid motions.
#include "dims.h"
#include "linear_algebra.h"
#include "sem/mechanics/quadratic_forms.h"
#include "sem/method/discretization.h"
#include "solids.h"

using namespace sem;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

template <int Dim>
Discretization<Dim> box() {
  MethodOptions options;
  options.rays.n_rays = 3;
  options.weights.cutoff = 0.8;
  return discretize<Dim>({test::unit_box<Dim>()}, options);
}

}  // namespace

TEST_CASE_TEMPLATE("paper's unknowns: each control point is one, and affine fields are exact", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto d = box<Dim>();
  REQUIRE(d.unknowns.n_controls() == d.boundary.n_controls());
  for (int c = 0; c < d.boundary.n_controls(); ++c) CHECK(unknown_of_control(d.unknowns, c) == c);
  std::srand(1);
  const Mat<Dim> A = Mat<Dim>::Random();
  const Vec<Dim> b = Vec<Dim>::Random();
  const VectorXd z = affine_field<Dim>(d.unknowns, A, b);
  const Points<Dim> p = (A * rest_controls(d.boundary)).colwise() + b;
  CHECK((control_points(d.unknowns, z) - p).cwiseAbs().maxCoeff() < 1e-14);
  const Points<Dim> x = (A * d.quadrature.position).colwise() + b;
  CHECK((evaluate(d.interior, z) - x).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE_TEMPLATE("across a sliver differences from leaders are the unknowns: the same map, and leaders lose the large entries of B", T,
                   D2, D3) {
  constexpr int Dim = T::value;
  const double thickness = 1e-6;
  Vec<Dim> size = Vec<Dim>::Ones();
  size[1] = thickness;
  MethodOptions options;
  options.rays.n_rays = 3;
  options.weights.cutoff = 0.8;
  const auto plain = discretize<Dim>({test::box<Dim>(Vec<Dim>::Zero(), size)}, options);
  options.near_differences = true;
  const auto d = discretize<Dim>({test::box<Dim>(Vec<Dim>::Zero(), size)}, options);
  CHECK(plain.unknowns.S.size() == 0);
  REQUIRE(d.unknowns.S.rows() == d.unknowns.size());

  const auto leader = leaders_of_near_controls(d.boundary);
  const Points<Dim> p = rest_controls(d.boundary);
  int n_leaders = 0;
  double of_leaders = 0, of_others = 0;  // largest entries of B
  for (int c = 0; c < int(leader.size()); ++c) {
    CHECK((p.col(c) - p.col(leader[c])).norm() < 2 * thickness);
    double& largest = leader[c] == c ? of_leaders : of_others;
    largest = std::max(largest, dense_gradient(d.interior, 1).col(c).cwiseAbs().maxCoeff());
    n_leaders += leader[c] == c;
  }
  CHECK(n_leaders == 1 << (Dim - 1));  // one at each corner of the plane
  CHECK(of_leaders < 10);
  CHECK(of_others > 0.1 / thickness);

  std::srand(4);
  const Points<Dim> moved = p + thickness * Points<Dim>::Random(Dim, p.cols());
  const MatrixXd inverse = test::least_squares(d.unknowns.S, MatrixXd::Identity(p.cols(), p.cols()));
  const VectorXd z = test::stacked<Dim>(moved * inverse.transpose());
  CHECK((control_points(d.unknowns, z) - moved).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((evaluate(d.interior, z) - evaluate(plain.interior, test::stacked<Dim>(moved))).cwiseAbs().maxCoeff() < 1e-4 * thickness);
  const Mat<Dim> A = Mat<Dim>::Random();
  const Points<Dim> x = (A * d.quadrature.position).colwise() + size;
  CHECK((evaluate(d.interior, affine_field<Dim>(d.unknowns, A, size)) - x).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("leaders: none where control points coincide or are far from each other") {
  const auto d = box<2>();  // joints coincide
  CHECK(leaders_of_near_controls(d.boundary).empty());
}

TEST_CASE_TEMPLATE("S that mixes unknowns: control points, pins and the error form follow it", T, D2, D3) {
  constexpr int Dim = T::value;
  auto d = box<Dim>();
  const int n = d.boundary.n_controls();
  const MatrixXd form = stability_matrix(d.on_boundary, d.samples, d.unknowns);

  Unknowns<Dim> same = d.unknowns;  // the identity, stored
  same.S = MatrixXd::Identity(n, n);
  CHECK((stability_matrix(d.on_boundary, d.samples, same) - form).norm() < 1e-13 * form.norm());

  // z' = T^-1 z: every operator of z times T. Unknown 0 stays control point 0, the others mix.
  std::srand(2);
  MatrixXd T_ = MatrixXd::Identity(n, n) + 0.1 * MatrixXd::Random(n, n);
  T_.row(0) = VectorXd::Unit(n, 0);
  const MatrixXd inverse = test::least_squares(T_, MatrixXd::Identity(n, n));
  Unknowns<Dim> mixed{d.unknowns.rest * inverse.transpose(), inverse * d.unknowns.one, T_};
  auto mixed_map = d.on_boundary;
  mixed_map.blocks.clear();
  auto& block = mixed_map.blocks.emplace_back();
  for (int k = 0; k < d.on_boundary.n_points; ++k) block.points.push_back(k);
  for (int c = 0; c < n; ++c) block.columns.push_back(c);
  block.value = dense_value(d.on_boundary) * T_;

  const MatrixXd expected = T_.transpose() * form * T_;
  CHECK((stability_matrix(mixed_map, d.samples, mixed) - expected).norm() < 1e-12 * expected.norm());
  CHECK(unknown_of_control(mixed, 0) == 0);
  CHECK_FALSE(unknown_of_control(mixed, 1).has_value());
  std::srand(1);
  const Mat<Dim> A = Mat<Dim>::Random();
  const Vec<Dim> b = Vec<Dim>::Random();
  const Points<Dim> p = (A * rest_controls(d.boundary)).colwise() + b;
  CHECK((control_points(mixed, affine_field<Dim>(mixed, A, b)) - p).cwiseAbs().maxCoeff() < 1e-12);
}
