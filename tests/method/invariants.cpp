// Facts that hold for the map of any solid, in both dimensions.
#include "dims.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/discretization.h"
#include "solids.h"

using namespace sem;

namespace {

MethodOptions options_for(int degree, FitKind fit = FitKind::degree_by_degree) {
  MethodOptions options;
  options.rays.n_rays = 5;
  options.interval.points = 5;
  options.projection.degree = degree;
  options.projection.fit = fit;
  options.weights.cutoff = 0.8;
  return options;
}

// A fixed affine map.
template <int Dim>
Mat<Dim> some_matrix() {
  Mat<Dim> A;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) A(i, j) = (i == j) + 0.3 * std::sin(1.7 * i + 2.9 * j + 0.4);
  return A;
}

template <int Dim>
double affine_error(const Discretization<Dim>& d) {
  const Mat<Dim> A = some_matrix<Dim>();
  const Vec<Dim> b = Vec<Dim>::Constant(0.7);
  const Points<Dim> p = (A * rest_controls(d.boundary)).colwise() + b;
  const Points<Dim> expected = (A * d.quadrature.position).colwise() + b;
  double error = (evaluate(d.interior, test::stacked<Dim>(p)) - expected).cwiseAbs().maxCoeff();
  for (int axis = 0; axis < Dim; ++axis) {
    const Eigen::MatrixXd F = p * dense_gradient(d.interior, axis).transpose();
    error = std::max(error, (F.colwise() - Eigen::VectorXd(A.col(axis))).cwiseAbs().maxCoeff());
  }
  return error;
}

}  // namespace

TEST_CASE_TEMPLATE("the map and its gradient reproduce affine fields, degrees 1 to 4", T, D2, D3) {
  constexpr int Dim = T::value;
  for (int degree = 1; degree <= 4; ++degree)
    for (const FitKind fit : {FitKind::degree_by_degree, FitKind::degree_by_degree_raw}) {
      CAPTURE(degree);
      const auto d = discretize<Dim>({test::unit_box<Dim>(2)}, options_for(degree, fit));
      CHECK(affine_error(d) < 1e-11);
    }
}

TEST_CASE_TEMPLATE("the draft's inverse mixes degrees on straight parts and loses affine fields", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto at_once = [&](int degree) {
    return affine_error(discretize<Dim>({test::unit_box<Dim>(2)}, options_for(degree, FitKind::pseudo_inverse)));
  };
  CHECK(at_once(1) < 1e-11);
  CHECK(at_once(2) > 1e-2);
}

TEST_CASE_TEMPLATE("values sum to one and gradients to zero: translations are exact", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const auto variant : {DistanceWeight::published, DistanceWeight::draft, DistanceWeight::distance_only})
    for (const auto choice : {OriginChoice::one, OriginChoice::shared_parts}) {
      MethodOptions options = options_for(2);
      options.weights.variant = variant;
      options.origins = choice;
      const auto d = discretize<Dim>({test::unit_box<Dim>(2)}, options);
      const Eigen::VectorXd ones = Eigen::VectorXd::Ones(d.boundary.n_controls());
      CHECK((dense_value(d.interior) * ones).isOnes(1e-12));
      CHECK((dense_value(d.on_boundary) * ones).isOnes(1e-12));
      for (int axis = 0; axis < Dim; ++axis)
        CHECK((dense_gradient(d.interior, axis) * ones).isZero(1e-11));
    }
}

TEST_CASE_TEMPLATE("blending weights are positive and sum to one at every point", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto d = discretize<Dim>({test::unit_box<Dim>(2)}, options_for(1));
  for (int k = 0; k < d.weights.n_points(); ++k) {
    double sum = 0;
    for (int e = d.weights.begin[k]; e < d.weights.begin[k + 1]; ++e) {
      CHECK(d.weights.w[e] > 0);
      sum += d.weights.w[e];
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-14));
  }
}

TEST_CASE_TEMPLATE("Kronecker: on a part its weight is 1, at a joint the parts share equally", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto d = discretize<Dim>({test::unit_box<Dim>(2)}, options_for(1));
  Points<Dim> X(Dim, 2);
  X.col(0).setConstant(0.3);
  X(0, 0) = 0;               // inside one face
  X.col(1).setZero();        // a corner: Dim parts meet
  const auto theta = distance_weights(
      measure_distances(d.boundary, d.loops, X, DistanceWeight::published, 0.8), d.options.weights);
  const auto w = blending_weights(theta, d.boundary, X);
  REQUIRE(w.begin[1] - w.begin[0] == 1);
  CHECK(w.w[0] == 1);
  REQUIRE(w.begin[2] - w.begin[1] == Dim);
  for (int e = w.begin[1]; e < w.begin[2]; ++e) CHECK(w.w[e] == doctest::Approx(1.0 / Dim));
}

TEST_CASE_TEMPLATE("the blocks of a map are its rows: dense evaluation agrees", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto d = discretize<Dim>({test::unit_box<Dim>(2)}, options_for(3));
  const auto& map = d.interior;
  // Brute force, straight from x = sum_i w_i [m c_i + t_i].
  const Eigen::MatrixXd J = sample_jacobian(d.samples, d.boundary.n_controls());
  Eigen::MatrixXd value = Eigen::MatrixXd::Zero(map.n_points, map.n_columns);
  for (int k = 0; k < map.n_points; ++k)
    for (int e = d.weights.begin[k]; e < d.weights.begin[k + 1]; ++e) {
      const int i = d.weights.part[e];
      const PartFit fit = fit_on_controls(d.projection, i);
      const Vec<Dim> x = (d.quadrature.position.col(k) - d.origins.position.col(d.origins.of_part[i])) / fit.scale;
      for (size_t c = 0; c < fit.columns.size(); ++c) {
        double sum = fit.translation[c];
        for (int m = 0; m < d.projection.monomials.size(); ++m) {
          double monomial = 1;
          for (int a = 0; a < Dim; ++a) monomial *= std::pow(x[a], d.projection.monomials.exponent(m)[a]);
          sum += monomial * fit.coefficients(m, c);
        }
        value(k, fit.columns[c]) += d.weights.w[e] * sum;
      }
    }
  CHECK((dense_value(map) - value).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(map.fill() <= 1);
}

TEST_CASE_TEMPLATE("B is the derivative of the map with frozen weights (diffuse gradient)", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto d = discretize<Dim>({test::unit_box<Dim>(2)}, options_for(3));
  const double h = 1e-5;
  for (int axis = 0; axis < Dim; ++axis) {
    Points<Dim> before = d.quadrature.position, behind = before;
    before.row(axis).array() -= h;
    behind.row(axis).array() += h;
    const auto at = [&](const Points<Dim>& X) {
      return dense_value(blended_map(X, d.weights, d.origins, d.projection, d.boundary.n_controls(), false));
    };
    const Eigen::MatrixXd difference = (at(behind) - at(before)) / (2 * h);
    CHECK((dense_gradient(d.interior, axis) - difference).cwiseAbs().maxCoeff() < 1e-7);
  }
}

TEST_CASE_TEMPLATE("the discretisation has the same bits with 1 and 2 threads, and twice", T, D2, D3) {
  constexpr int Dim = T::value;
  MethodOptions options = options_for(2);
  options.n_threads = 1;
  const auto one = discretize<Dim>({test::unit_box<Dim>(2)}, options);
  for (const int n_threads : {1, 2, 3}) {
    options.n_threads = n_threads;
    const auto again = discretize<Dim>({test::unit_box<Dim>(2)}, options);
    CHECK(dense_value(one.interior) == dense_value(again.interior));
    CHECK(dense_gradient(one.interior, 0) == dense_gradient(again.interior, 0));
    CHECK(one.quadrature.weight == again.quadrature.weight);
  }
}

TEST_CASE_TEMPLATE("pruning keeps the largest columns, and translations if renormalised", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto full = discretize<Dim>({test::unit_box<Dim>(2)}, options_for(1));
  const int n_columns = full.boundary.n_controls();
  Map<Dim> all = full.interior;
  CHECK(prune(all, n_columns, true).relative_error < 1e-14);
  CHECK((dense_gradient(all, 0) - dense_gradient(full.interior, 0)).cwiseAbs().maxCoeff() < 1e-13);
  const int keep = n_columns / 3;
  double previous = 0;
  for (const bool renormalise : {true, false}) {
    Map<Dim> map = full.interior;
    const auto report = prune(map, keep, renormalise);
    CHECK(report.relative_error > 1e-3);
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n_columns);
    CHECK((dense_gradient(map, 0) * ones).isZero(1e-11) == renormalise);
    for (int k = 0; k < map.n_points; ++k)
      CHECK((dense_value(map).row(k).array() != 0).count() <= keep);
    previous = report.relative_error;
  }
  CHECK(previous < 1);
}

TEST_CASE_TEMPLATE("a part whose origin lies in it borrows what it cannot determine", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto d = discretize<Dim>({test::unit_box<Dim>(1)}, options_for(2));
  // Every part alone in its own set: the origin is the middle of the part. With the set of all
  // parts but the origin on the part, affine fields survive.
  std::vector<int> all(d.boundary.n_parts());
  for (size_t i = 0; i < all.size(); ++i) all[i] = int(i);
  auto origins = origins_from_sets<Dim>({all}, std::vector<int>(all.size(), 0), d.samples);
  Vec<Dim> X = Vec<Dim>::Constant(0.5);
  X[0] = 0;  // on the lower face along the first axis
  origins.position.col(0) = X;
  const auto projection = project(d.samples, origins, d.options.projection);
  int n_borrowed = 0;
  for (const auto& fit : projection.parts) n_borrowed += fit.borrowed;
  CHECK(n_borrowed == 1);
}

TEST_CASE_TEMPLATE("boundary integrals of a box are exact, whatever the orientation of its parts", T, D2, D3) {
  constexpr int Dim = T::value;
  const Vec<Dim> lower = Vec<Dim>::Constant(3), upper = Vec<Dim>::LinSpaced(Dim, 4, 6);
  auto parts = test::box<Dim>(lower, upper, 2);
  for (size_t i = 0; i < parts.size(); i += 3) parts[i] = reversed(parts[i], 0);
  const auto boundary = make_boundary<Dim>({parts});
  const auto loops = find_loops(boundary);
  const auto moments = boundary_moments(boundary, loops);
  const double volume = (upper - lower).prod();
  CHECK(moments.available);
  CHECK(moments.volume == doctest::Approx(volume).epsilon(1e-13));
  const Vec<Dim> center = (lower + upper) / 2;
  CHECK((moments.first - volume * center).norm() < 1e-11);
  const Mat<Dim> second = volume * (center * center.transpose() +
                                    Mat<Dim>(((upper - lower).cwiseAbs2() / 12).asDiagonal()));
  CHECK((moments.second - second).norm() < 1e-10);
  RayOptions rays;
  rays.n_rays = 4;
  const auto q = quadrature_on_rays(cast_rays(boundary, loops, rays), {});
  CHECK(quadrature_moments<Dim>(q.position, q.weight).volume == doctest::Approx(volume).epsilon(1e-13));
}
