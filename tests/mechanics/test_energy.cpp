// The internal energy, its derivatives and the constant matrices.
#include "dims.h"
#include "sem/mechanics/internal_energy.h"
#include "sem/mechanics/loads.h"
#include "sem/mechanics/quadratic_forms.h"
#include "solids.h"

using namespace sem;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

template <int Dim>
Discretization<Dim> small_box(int degree = 2) {
  MethodOptions options;
  options.rays.n_rays = 3;
  options.interval.points = 4;
  options.projection.degree = degree;
  options.weights.cutoff = 0.8;
  return discretize<Dim>({test::unit_box<Dim>()}, options);
}

Material material_of(MaterialModel model) { return {model, 1e3, 0.3, 100}; }

template <int Dim>
struct Fixture {
  Discretization<Dim> d = small_box<Dim>();
  VectorXd rest = test::stacked<Dim>(rest_controls(d.boundary));
  MatrixXd S = stability_matrix(d.on_boundary, d.samples, d.unknowns);

  InternalEnergy<Dim> energy(MaterialModel model, double gamma) const {
    MaterialField field{{material_of(model)}, std::vector<int>(d.quadrature.size(), 0)};
    return InternalEnergy<Dim>(d.interior, d.quadrature.weight, field, gamma * S);
  }
  // The rest shape, stretched, sheared and disturbed by fixed amounts.
  VectorXd deformed() const {
    VectorXd z = rest;
    for (int i = 0; i < z.size(); ++i) z[i] = 1.1 * z[i] + 0.05 * std::sin(3.7 * i + 0.2);
    return z;
  }
  // The rest shape turned by an angle in the plane of the first two axes, and moved.
  VectorXd turned(double angle) const {
    Mat<Dim> R = Mat<Dim>::Identity();
    R(0, 0) = R(1, 1) = std::cos(angle);
    R(1, 0) = std::sin(angle);
    R(0, 1) = -R(1, 0);
    const Points<Dim> p = (R * rest_controls(d.boundary)).colwise() + Vec<Dim>::Constant(2.5);
    return test::stacked<Dim>(p);
  }
};

const MaterialModel all_models[] = {MaterialModel::linear,  MaterialModel::stvk,    MaterialModel::corotated,
                                    MaterialModel::neo_log, MaterialModel::neo_ref, MaterialModel::neo_iso};

}  // namespace

TEST_CASE_TEMPLATE("gradient and Hessian of the energy are its finite differences", T, D2, D3) {
  constexpr int Dim = T::value;
  const Fixture<Dim> f;
  for (const auto model : all_models) {
    CAPTURE(name(model));
    auto energy = f.energy(model, 500);
    const VectorXd z = f.deformed();
    VectorXd g(z.size()), before(z.size()), behind(z.size());
    energy.gradient(z, g);
    const MatrixXd H = energy.dense_hessian(z);
    CHECK((H - H.transpose()).cwiseAbs().maxCoeff() < 1e-10 * H.cwiseAbs().maxCoeff());
    const double h = 1e-5;
    for (int i = 0; i < z.size(); i += 3) {
      VectorXd y = z;
      y[i] = z[i] + h;
      const double up = energy.energy(y);
      energy.gradient(y, behind);
      y[i] = z[i] - h;
      const double down = energy.energy(y);
      energy.gradient(y, before);
      CHECK(std::abs((up - down) / (2 * h) - g[i]) < 1e-6 * g.cwiseAbs().maxCoeff());
      CHECK(((behind - before) / (2 * h) - H.col(i)).cwiseAbs().maxCoeff() < 1e-5 * H.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE_TEMPLATE("rigid motions cost no energy and no force; linear: translations only", T, D2, D3) {
  constexpr int Dim = T::value;
  const Fixture<Dim> f;
  VectorXd g(f.rest.size());
  for (const auto model : all_models) {
    CAPTURE(name(model));
    auto energy = f.energy(model, 500);
    const double scale = energy.energy(f.deformed());
    for (const double angle : {0.0, 0.01, 1.0, 3.0}) {
      if (model == MaterialModel::linear && angle > 0) continue;
      CHECK(std::abs(energy.energy(f.turned(angle))) < 1e-12 * scale);
      energy.gradient(f.turned(angle), g);
      CHECK(g.cwiseAbs().maxCoeff() < 1e-9 * scale);
    }
    // The linear energy of a turn is of fourth order in the angle.
    if (model == MaterialModel::linear) {
      const double small = energy.energy(f.turned(0.01)), twice = energy.energy(f.turned(0.02));
      CHECK(small > 0);
      CHECK(twice / small == doctest::Approx(16).epsilon(0.01));
    }
  }
}

TEST_CASE_TEMPLATE("the stiffness is the dense brute-force sum over points", T, D2, D3) {
  constexpr int Dim = T::value;
  const Fixture<Dim> f;
  for (const auto model : {MaterialModel::linear, MaterialModel::neo_ref}) {
    auto energy = f.energy(model, 70);
    const VectorXd z = f.deformed();
    const int n = f.d.boundary.n_controls();
    std::vector<MatrixXd> G;
    for (int axis = 0; axis < Dim; ++axis) G.push_back(dense_gradient(f.d.interior, axis));
    MatrixXd expected = 70 * expand(f.S, Dim);
    for (int k = 0; k < f.d.quadrature.size(); ++k) {
      // B of point k: vec(F) = B z, columns of F stacked.
      MatrixXd B = MatrixXd::Zero(Dim * Dim, Dim * n);
      for (int axis = 0; axis < Dim; ++axis)
        for (int a = 0; a < Dim; ++a)
          for (int j = 0; j < n; ++j) B(a + Dim * axis, Dim * j + a) = G[axis](k, j);
      const VectorXd vec_F = B * z;
      const Mat<Dim> F = Eigen::Map<const Mat<Dim>>(vec_F.data());
      const MatrixXd C = stress_derivative<Dim>(material_of(model), F);
      expected += f.d.quadrature.weight[k] * B.transpose() * C * B;
    }
    const MatrixXd H = energy.dense_hessian(z);
    CHECK((H - expected).cwiseAbs().maxCoeff() < 1e-11 * expected.cwiseAbs().maxCoeff());
  }
}

TEST_CASE_TEMPLATE("mass: symmetric, positive semi-definite, total rho V, equal to the dense sum", T, D2, D3) {
  constexpr int Dim = T::value;
  const Fixture<Dim> f;
  const VectorXd mass = 100 * f.d.quadrature.weight;
  const MatrixXd M = mass_matrix(f.d.interior, mass);
  const MatrixXd G = dense_value(f.d.interior);
  CHECK((M - G.transpose() * mass.asDiagonal() * G).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(M.sum() == doctest::Approx(100).epsilon(1e-12));  // rho times the unit box
  CHECK((M - M.transpose()).cwiseAbs().maxCoeff() < 1e-13);
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd x = VectorXd::NullaryExpr(M.rows(), [&](auto i) { return std::sin(1.3 * i * (trial + 1) + trial); });
    CHECK(x.dot(M * x) >= -1e-12 * x.squaredNorm());
  }
}

TEST_CASE_TEMPLATE("stability: the boundary integral of the squared mismatch, zero for affine motions", T, D2, D3) {
  constexpr int Dim = T::value;
  const Fixture<Dim> f;
  const MatrixXd D = dense_value(f.d.on_boundary) - sample_jacobian(f.d.samples, f.d.boundary.n_controls());
  CHECK((f.S - D.transpose() * f.d.samples.weight.asDiagonal() * D).cwiseAbs().maxCoeff() < 1e-13);
  CHECK(f.d.samples.weight.sum() == doctest::Approx(2 * Dim).epsilon(1e-12));  // faces of the unit box
  const auto quadratic = [&](const VectorXd& z) {
    const Eigen::Map<const Points<Dim>> nodes(z.data(), Dim, f.S.rows());
    return (nodes * f.S).cwiseProduct(nodes).sum();
  };
  CHECK(std::abs(quadratic(f.turned(1.2))) < 1e-13);
  CHECK(quadratic(f.deformed()) > 1e-6);
}

TEST_CASE_TEMPLATE("loads: total force and moment of body, point and boundary loads", T, D2, D3) {
  constexpr int Dim = T::value;
  const Fixture<Dim> f;
  const auto total = [&](const VectorXd& load) {
    const Eigen::Map<const Points<Dim>> nodes(load.data(), Dim, f.S.rows());
    return Vec<Dim>(nodes.rowwise().sum());
  };
  Vec<Dim> g = Vec<Dim>::Zero();
  g[1] = -2;
  VectorXd load = VectorXd::Zero(f.rest.size());
  add_body_force<Dim>(f.d.interior, f.d.quadrature.weight, g, load);
  CHECK((total(load) - g).norm() < 1e-12);
  // Virtual work of a uniform body force on x -> x: g . centroid.
  CHECK(load.dot(f.rest) == doctest::Approx(g[1] * 0.5).epsilon(1e-12));

  load.setZero();
  const Vec<Dim> at = Vec<Dim>::Constant(0.3);
  add_point_force<Dim>(f.d, at, g, load);
  CHECK((total(load) - g).norm() < 1e-12);
  CHECK(load.dot(f.rest) == doctest::Approx(g.dot(at)).epsilon(1e-12));

  // A uniform pressure on a closed boundary has no resultant; its work on x -> x is -p Dim V.
  load.setZero();
  const double loaded = add_traction<Dim>(
      f.d, [](int, const Vec<Dim>&, const Vec<Dim>& normal) -> Vec<Dim> { return -3 * normal; }, load);
  CHECK(loaded == doctest::Approx(2 * Dim).epsilon(1e-12));
  CHECK(total(load).norm() < 1e-11);
  CHECK(load.dot(f.rest) == doctest::Approx(-3.0 * Dim).epsilon(1e-11));
}

TEST_CASE_TEMPLATE("prescribed boundary: rotation, shear and stretch reach the interior to 1e-10", T, D2, D3) {
  constexpr int Dim = T::value;
  for (int degree = 1; degree <= 4; ++degree) {
    const auto d = small_box<Dim>(degree);
    Mat<Dim> rotation = Mat<Dim>::Identity(), shear = rotation, stretch = rotation;
    rotation.template topLeftCorner<2, 2>() << std::cos(2.0), -std::sin(2.0), std::sin(2.0), std::cos(2.0);
    shear(0, 1) = 0.8;
    stretch(Dim - 1, Dim - 1) = 3;
    for (const Mat<Dim>& A : {rotation, shear, stretch}) {
      const Points<Dim> p = A * rest_controls(d.boundary);
      const Points<Dim> x = evaluate(d.interior, test::stacked<Dim>(p));
      CHECK((x - A * d.quadrature.position).cwiseAbs().maxCoeff() < 1e-10);
      for (int axis = 0; axis < Dim; ++axis) {
        const MatrixXd column = p * dense_gradient(d.interior, axis).transpose();
        CHECK((column.colwise() - VectorXd(A.col(axis))).cwiseAbs().maxCoeff() < 1e-10);
      }
    }
  }
}
