// Materials: derivatives by finite differences, invariances, limits, input.
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "dims.h"
#include "linear_algebra.h"
#include "sem/base/error.h"
#include "sem/mechanics/material.h"

using namespace sem;

namespace {

constexpr MaterialModel models[] = {MaterialModel::linear,    MaterialModel::stvk,
                                    MaterialModel::corotated, MaterialModel::neo_log,
                                    MaterialModel::neo_ref,   MaterialModel::neo_iso};

bool needs_positive_volume(MaterialModel model) {
  return model == MaterialModel::neo_log || model == MaterialModel::neo_ref ||
         model == MaterialModel::neo_iso;
}

template <int Dim>
Mat<Dim> random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Mat<Dim> A;
  for (double& a : A.reshaped()) a = uniform(random);
  return A;
}

// Cayley's transform of a skew matrix.
template <int Dim>
Mat<Dim> random_rotation(std::mt19937& random) {
  const Mat<Dim> A = 2 * random_matrix<Dim>(random), S = A - A.transpose();
  const Mat<Dim> minus = Mat<Dim>::Identity() - S, plus = Mat<Dim>::Identity() + S;
  return minus.inverse() * plus;
}

// F near rest, large stretches, large rotations, strong compression.
template <int Dim>
std::vector<Mat<Dim>> sample_gradients() {
  std::mt19937 random(7);
  const Mat<Dim> I = Mat<Dim>::Identity();
  std::vector<Mat<Dim>> result = {I};
  for (const double size : {1e-6, 1e-3, 0.2})
    result.push_back(I + size * random_matrix<Dim>(random));
  for (const double stretch : {0.15, 0.6, 3.0, 8.0}) {
    Mat<Dim> S = I + 0.1 * random_matrix<Dim>(random);
    S.col(0) *= stretch;
    result.push_back(random_rotation<Dim>(random) * S);
  }
  result.push_back(random_rotation<Dim>(random));
  return result;
}

// Central differences, fourth order.
template <class Function>
std::invoke_result_t<Function, double> derivative(const Function& f, double h) {
  return ((f(-2 * h) - f(2 * h)) + 8 * (f(h) - f(-h))) / (12 * h);
}

template <int Dim>
void check_derivatives(const Material& material, const Mat<Dim>& F) {
  const Mat<Dim> P = first_piola<Dim>(material, F);
  const StressDerivative<Dim> H = stress_derivative<Dim>(material, F);
  const double scale = material.youngs_modulus * std::max(1., F.squaredNorm());
  CHECK((H - H.transpose()).norm() <= 1e-13 * H.norm());
  for (int a = 0; a < Dim * Dim; ++a) {
    const auto moved = [&](double h) {
      Mat<Dim> G = F;
      G.reshaped()(a) += h;
      return G;
    };
    const double dPsi =
        derivative([&](double h) { return energy_density<Dim>(material, moved(h)); }, 4e-4);
    CHECK(std::abs(dPsi - P.reshaped()(a)) <= 1e-7 * scale);
    const Mat<Dim> dP =
        derivative([&](double h) { return Mat<Dim>(first_piola<Dim>(material, moved(h))); }, 4e-4);
    CHECK((dP.reshaped() - H.col(a)).norm() <= 1e-7 * std::max(scale, H.norm()));
  }
}

Material make(MaterialModel model, double nu = 0.3) { return {model, 3e4, nu, 1000}; }

}  // namespace

TEST_CASE_TEMPLATE("stress and its derivative agree with finite differences", T, D2, D3) {
  for (const MaterialModel model : models)
    for (const double nu : {-0.4, 0.0, 0.3, 0.45})
      for (const Mat<T::value>& F : sample_gradients<T::value>()) {
        INFO(std::string(name(model)), " nu ", nu, " F\n", F);
        check_derivatives<T::value>(make(model, nu), F);
      }
}

TEST_CASE_TEMPLATE("models without ln J have consistent derivatives for inverted F", T, D2, D3) {
  for (const MaterialModel model : models) {
    if (needs_positive_volume(model)) continue;
    for (Mat<T::value> F : sample_gradients<T::value>()) {
      F.row(0) *= -0.7;  // also separates the singular values: the rotation is unique
      F.row(1) *= 1.3;
      INFO(std::string(name(model)), " F\n", F);
      check_derivatives<T::value>(make(model), F);
    }
  }
}

TEST_CASE_TEMPLATE("corotated is finite where the nearest rotation is not unique", T, D2, D3) {
  constexpr int Dim = T::value;
  Mat<Dim> reflection = Mat<Dim>::Identity(), collapsed = Mat<Dim>::Zero();
  reflection(Dim - 1, Dim - 1) = -1;
  Mat<Dim> needle = collapsed;
  needle(0, 0) = 2;
  for (const Mat<Dim>& F : {reflection, collapsed, needle}) {
    const Material material = make(MaterialModel::corotated);
    CHECK(std::isfinite(energy_density<Dim>(material, F)));
    CHECK(first_piola<Dim>(material, F).allFinite());
    CHECK(stress_derivative<Dim>(material, F).allFinite());
  }
}

TEST_CASE_TEMPLATE("rest is free of stress and energy", T, D2, D3) {
  constexpr int Dim = T::value;
  const Mat<Dim> I = Mat<Dim>::Identity();
  for (const MaterialModel model : models) {
    INFO(std::string(name(model)));
    CHECK(energy_density<Dim>(make(model), I) == 0);
    CHECK(first_piola<Dim>(make(model), I).norm() <= 1e-15 * make(model).youngs_modulus);
  }
}

TEST_CASE_TEMPLATE(
    "at rest every Hessian is that of linear elasticity, neo_iso's with lambda as "
    "its bulk modulus",
    T, D2, D3) {
  constexpr int Dim = T::value;
  const Mat<Dim> I = Mat<Dim>::Identity();
  for (const MaterialModel model : models) {
    const Material material = make(model);
    const double mu = material.lame_mu();
    double lambda = material.lame_lambda();
    if (model == MaterialModel::neo_iso) lambda -= 2. / 3 * mu;
    const StressDerivative<Dim> H = stress_derivative<Dim>(material, I);
    INFO(std::string(name(model)));
    for (int a = 0; a < Dim * Dim; ++a) {
      Mat<Dim> dF = Mat<Dim>::Zero();
      dF.reshaped()(a) = 1;
      const Mat<Dim> dP = lambda * dF.trace() * I + mu * (dF + dF.transpose());
      CHECK((H.col(a) - dP.reshaped()).norm() <= 1e-13 * material.youngs_modulus);
    }
  }
}

TEST_CASE_TEMPLATE("a rotation changes no energy and turns the stress, but for linear", T, D2, D3) {
  constexpr int Dim = T::value;
  std::mt19937 random(11);
  for (const MaterialModel model : models) {
    if (model == MaterialModel::linear) continue;
    const Material material = make(model);
    for (const Mat<Dim>& F : sample_gradients<Dim>()) {
      INFO(std::string(name(model)), " F\n", F);
      const Mat<Dim> R = random_rotation<Dim>(random);
      const double energy = energy_density<Dim>(material, F);
      const double scale = material.youngs_modulus * F.squaredNorm() * F.squaredNorm();
      CHECK(std::abs(energy_density<Dim>(material, R * F) - energy) <= 1e-13 * (scale + energy));
      const Mat<Dim> P = first_piola<Dim>(material, F);
      CHECK((first_piola<Dim>(material, R * F) - R * P).norm() <= 1e-13 * (scale + 20 * P.norm()));
    }
  }
  const Material linear = make(MaterialModel::linear);
  CHECK(energy_density<Dim>(linear, random_rotation<Dim>(random)) > 1e-3 * linear.youngs_modulus);
}

TEST_CASE("a plane F has the energy of space with F33 = 1, and the in-plane stress") {
  for (const MaterialModel model : models)
    for (const Mat<2>& F : sample_gradients<2>()) {
      Mat<3> F3 = Mat<3>::Identity();
      F3.topLeftCorner<2, 2>() = F;
      const Material material = make(model);
      INFO(std::string(name(model)), " F\n", F);
      const double energy = energy_density<2>(material, F);
      CHECK(energy == doctest::Approx(energy_density<3>(material, F3)).epsilon(1e-12));
      const Mat<2> P = first_piola<2>(material, F);
      const Mat<3> P3 = first_piola<3>(material, F3);
      CHECK((P - P3.topLeftCorner<2, 2>()).norm() <=
            1e-13 * (material.youngs_modulus + 10 * P3.norm()));
    }
}

TEST_CASE_TEMPLATE("energies keep their relative accuracy at strains of 1e-7", T, D2, D3) {
  constexpr int Dim = T::value;
  std::mt19937 random(3);
  const Mat<Dim> F = Mat<Dim>::Identity() + 1e-7 * random_matrix<Dim>(random);
  const Mat<Dim> G = F - Mat<Dim>::Identity();
  for (const MaterialModel model : models) {
    const Material material = make(model);
    const StressDerivative<Dim> H = stress_derivative<Dim>(material, Mat<Dim>::Identity());
    const double expected = G.reshaped().dot(H * G.reshaped()) / 2;
    INFO(std::string(name(model)));
    CHECK(energy_density<Dim>(material, F) == doctest::Approx(expected).epsilon(2e-6));
  }
}

TEST_CASE("plane neo_log is the formula of its definition") {
  Mat<2> F;
  F << 1.3, 0.4, -0.2, 0.8;
  const Material material = make(MaterialModel::neo_log);
  const double mu = material.lame_mu(), lambda = material.lame_lambda();
  const double log_J = std::log(1.3 * 0.8 + 0.2 * 0.4);
  const double expected =
      mu / 2 * (1.69 + 0.16 + 0.04 + 0.64 - 2) - mu * log_J + lambda / 2 * log_J * log_J;
  CHECK(energy_density<2>(material, F) == doctest::Approx(expected).epsilon(1e-14));
}

TEST_CASE("solid neo_ref and neo_iso are the formulas of their definition") {
  const Mat<3> F = Eigen::Vector3d(1.5, 0.9, 0.7).asDiagonal();
  const double J = 1.5 * 0.9 * 0.7, I1 = 2.25 + 0.81 + 0.49;
  const Material ref = make(MaterialModel::neo_ref), iso = make(MaterialModel::neo_iso);
  const double mu = ref.lame_mu(), volume = ref.lame_lambda() / 2 * (J - 1) * (J - 1);
  CHECK(energy_density<3>(ref, F) ==
        doctest::Approx(mu / 2 * (I1 - 3 - 2 * std::log(J)) + volume).epsilon(1e-13));
  CHECK(energy_density<3>(iso, F) ==
        doctest::Approx(mu / 2 * (std::pow(J, -2. / 3) * I1 - 3) + volume).epsilon(1e-13));
}

TEST_CASE_TEMPLATE("neo-Hookean energies are infinite for collapsed and inverted F", T, D2, D3) {
  constexpr int Dim = T::value;
  Mat<Dim> inverted = Mat<Dim>::Identity(), collapsed = Mat<Dim>::Identity();
  inverted(0, 0) = -1;
  collapsed(0, 0) = 0;
  for (const MaterialModel model : models) {
    if (!needs_positive_volume(model)) continue;
    CHECK(energy_density<Dim>(make(model), inverted) == INFINITY);
    CHECK(energy_density<Dim>(make(model), collapsed) == INFINITY);
  }
}

TEST_CASE_TEMPLATE("projection removes negative eigenvalues and nothing else", T, D2, D3) {
  constexpr int Dim = T::value;
  using Tensor = StressDerivative<Dim>;
  int n_indefinite = 0;
  for (const MaterialModel model : models)
    for (const Mat<Dim>& F : sample_gradients<Dim>()) {
      const Tensor H = stress_derivative<Dim>(make(model), F);
      const Tensor Q = project_to_psd<Dim>(H);
      const Eigen::VectorXd before = test::eigenvalues(H), after = test::eigenvalues(Q);
      INFO(std::string(name(model)), " F\n", F);
      CHECK((after - before.cwiseMax(0)).norm() <= 1e-13 * H.norm());
      if (before(0) < -1e-6 * H.norm()) ++n_indefinite;
    }
  CHECK(n_indefinite >= 4);
  const Tensor H = stress_derivative<Dim>(make(MaterialModel::linear), Mat<Dim>::Identity());
  CHECK((project_to_psd<Dim>(H) - H).norm() <= 1e-15 * H.norm());
}

TEST_CASE_TEMPLATE("Cauchy stress is symmetric and P F^T / J", T, D2, D3) {
  constexpr int Dim = T::value;
  for (const MaterialModel model : models)
    for (const Mat<Dim>& F : sample_gradients<Dim>()) {
      const Mat<Dim> sigma = cauchy_stress<Dim>(make(model), F);
      INFO(std::string(name(model)), " F\n", F);
      CHECK((sigma - sigma.transpose()).norm() <=
            1e-12 * (sigma.norm() + make(model).youngs_modulus));
      if (model == MaterialModel::linear) continue;
      const Mat<Dim> P = first_piola<Dim>(make(model), F);
      CHECK((F.determinant() * sigma * F.inverse().transpose() - P).norm() <=
            1e-12 * (P.norm() + 1));
    }
}

TEST_CASE("names of models go both ways, an unknown one names file, field and what is allowed") {
  for (const MaterialModel model : models) CHECK(material_model(name(model)) == model);
  try {
    material_model("neo_hooke", "beam.json", "solids[0].material.model");
    FAIL("accepted");
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"beam.json", "solids[0].material.model", "neo_hooke", "neo_log"})
      CHECK(text.find(part) != std::string::npos);
  }
}

TEST_CASE("material parameters outside their ranges are input errors that name the field") {
  const auto rejected = [](Material material, const std::string& member) {
    try {
      check(material, "beam.json", "material");
    } catch (const InputError& error) {
      return std::string(error.what()).find("material." + member) != std::string::npos;
    }
    return false;
  };
  const Material good{MaterialModel::stvk, 1e5, 0.3, 0};
  CHECK_NOTHROW(check(good, "beam.json", "material"));
  for (const double E : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    Material bad = good;
    bad.youngs_modulus = E;
    CHECK(rejected(bad, "youngs_modulus"));
  }
  for (const double nu : {0.5, 0.7, -1.0, double(NAN)}) {
    Material bad = good;
    bad.poisson_ratio = nu;
    CHECK(rejected(bad, "poisson_ratio"));
  }
  for (const double rho : {-1.0, double(NAN), double(INFINITY)}) {
    Material bad = good;
    bad.density = rho;
    CHECK(rejected(bad, "density"));
  }
}
