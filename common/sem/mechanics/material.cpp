#include "sem/mechanics/material.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "sem/base/error.h"
#include "sem/base/orthogonal_columns.h"
#include "sem/solve/symmetric_eigen.h"

namespace sem {
namespace {

constexpr MaterialModel all_models[] = {MaterialModel::linear,    MaterialModel::stvk,
                                        MaterialModel::corotated, MaterialModel::neo_log,
                                        MaterialModel::neo_ref,   MaterialModel::neo_iso};

// --- Geometry leaves: what differs between the plane and space.

// det(I + G) - 1 - tr G: no cancellation for small G.
double volume_change_beyond_trace(const Mat<2>& G) { return G.determinant(); }
double volume_change_beyond_trace(const Mat<3>& G) {
  const double minors = G(0, 0) * G(1, 1) - G(0, 1) * G(1, 0) + G(1, 1) * G(2, 2) -
                        G(1, 2) * G(2, 1) + G(2, 2) * G(0, 0) - G(2, 0) * G(0, 2);
  return minors + G.determinant();
}

// dJ/dF = J F^-T, defined for every F.
Mat<2> cofactor(const Mat<2>& F) {
  Mat<2> C;
  C << F(1, 1), -F(1, 0), -F(0, 1), F(0, 0);
  return C;
}
Mat<3> cofactor(const Mat<3>& F) {
  Mat<3> C;
  for (int j = 0; j < 3; ++j) C.col(j) = F.col((j + 1) % 3).cross(F.col((j + 2) % 3));
  return C;
}

Mat<3> cross_matrix(const Vec<3>& a) {
  Mat<3> A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

// d2J/dF2.
StressDerivative<2> cofactor_derivative(const Mat<2>&) {
  StressDerivative<2> H = StressDerivative<2>::Zero();
  H(0, 3) = H(3, 0) = 1;
  H(1, 2) = H(2, 1) = -1;
  return H;
}
StressDerivative<3> cofactor_derivative(const Mat<3>& F) {
  StressDerivative<3> H = StressDerivative<3>::Zero();
  for (int j = 0; j < 3; ++j) {
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    H.block<3, 3>(3 * j, 3 * k) = -cross_matrix(F.col(l));
    H.block<3, 3>(3 * j, 3 * l) = cross_matrix(F.col(k));
  }
  return H;
}

// The rotation R nearest to F, det R = +1 also if det F < 0, and dR/dF. With
// S = R^T F symmetric and the generators W_a of rotations,
// dR/dF = sum_ab vec(R W_a) [(tr S I - S)^-1]_ab vec(R W_b)^T;
// the eigenvalues of tr S I - S are sums of two (signed) singular values and
// are kept above `smallest_sum`.
constexpr double smallest_sum = 1e-6;

Mat<2> rotation(const Mat<2>& F) {
  const double c = F(0, 0) + F(1, 1), s = F(1, 0) - F(0, 1), h = std::hypot(c, s);
  Mat<2> R = Mat<2>::Identity();
  if (h > 0) R << c / h, -s / h, s / h, c / h;
  return R;
}
StressDerivative<2> rotation_derivative(const Mat<2>& F) {
  const Mat<2> R = rotation(F);
  const double trace = std::max((R.transpose() * F).trace(), smallest_sum);
  const Eigen::Vector4d t(R(0, 1), R(1, 1), -R(0, 0), -R(1, 0));
  return t * t.transpose() / trace;
}

struct SignedSvd {  // F = U diag(s) V^T, det U = det V = 1, s[2] has the sign of det F
  Mat<3> U, V;
  Vec<3> s;
};
SignedSvd signed_svd(const Mat<3>& F) {
  Mat<3> A = F, V;  // A = F V = U diag(s)
  orthogonalise_columns(A, V);
  if (V.determinant() < 0) {
    A.col(2) = -A.col(2);
    V.col(2) = -V.col(2);
  }
  const double a = A.col(0).norm(), b = A.col(1).norm();
  const Vec<3> u = a > 0 ? Vec<3>(A.col(0) / a) : Vec<3>(V.col(0));
  const Vec<3> v = b > 1e-15 * a ? Vec<3>(A.col(1) / b) : u.unitOrthogonal();
  const Vec<3> w = u.cross(v);
  Mat<3> U;
  U << u, v, w;
  return {U, V, {a, b, w.dot(A.col(2))}};
}
Mat<3> rotation(const Mat<3>& F) {
  const SignedSvd svd = signed_svd(F);
  return svd.U * svd.V.transpose();
}
StressDerivative<3> rotation_derivative(const Mat<3>& F) {
  const auto [U, V, s] = signed_svd(F);
  StressDerivative<3> D = StressDerivative<3>::Zero();
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const Mat<3> twist = U.col(a) * V.col(b).transpose() - U.col(b) * V.col(a).transpose();
    const auto t = twist.reshaped();
    D += t * t.transpose() / std::max(s(a) + s(b), smallest_sum);
  }
  return D;
}

// --- Dimension-free from here on.

// x - log(1 + x), accurate for small x; +infinity for x <= -1.
double minus_log1p(double x) {
  if (x <= -1) return std::numeric_limits<double>::infinity();
  if (std::abs(x) > 0.1) return x - std::log1p(x);
  // log(1 + x) = 2 atanh(r), x - 2 r = x r.
  const double r = x / (2 + x), r2 = r * r;
  const double tail = r2 * (1. / 3 + r2 * (1. / 5 + r2 * (1. / 7 + r2 * (1. / 9 + r2 / 11))));
  return r * (x - 2 * tail);
}

// Volume change and what the invariants need, from G = F - I.
template <int Dim>
struct Strain {
  explicit Strain(const Mat<Dim>& F) : G(F - Mat<Dim>::Identity()) {
    beyond_trace = volume_change_beyond_trace(G);
    j = G.trace() + beyond_trace;
  }
  Mat<Dim> G;
  double beyond_trace;  // j - tr G
  double j;             // J - 1
};

// The neo-Hookean energies are mu/2 a(J) I1 + b(J) with I1 = tr F^T F (plane
// strain: + 1). Values and derivatives with respect to J.
struct VolumeTerms {
  double a, da, dda, db, ddb;
};
VolumeTerms volume_terms(const Material& material, double J) {
  const double mu = material.lame_mu(), lambda = material.lame_lambda();
  switch (material.model) {
    case MaterialModel::neo_log:
      return {1, 0, 0, (lambda * std::log(J) - mu) / J,
              (lambda * (1 - std::log(J)) + mu) / (J * J)};
    case MaterialModel::neo_ref:
      return {1, 0, 0, lambda * (J - 1) - mu / J, lambda + mu / (J * J)};
    default: {
      assert(material.model == MaterialModel::neo_iso);
      const double a = std::pow(J, -2. / 3);
      return {a, -2. / 3 * a / J, 10. / 9 * a / (J * J), lambda * (J - 1), lambda};
    }
  }
}

template <int Dim>
double first_invariant(const Mat<Dim>& F) {
  return F.squaredNorm() + (3 - Dim);
}

// Written in G = F - I so that what is left near rest is not a difference of
// large numbers: I1 - 3 = 2 tr G + |G|^2 and tr G = j - beyond_trace.
template <int Dim>
double neo_hookean_energy(const Material& material, const Mat<Dim>& F) {
  const Strain<Dim> strain(F);
  const double mu = material.lame_mu(), lambda = material.lame_lambda(), j = strain.j;
  if (!(j > -1)) return std::numeric_limits<double>::infinity();
  const double distortion = strain.G.squaredNorm() - 2 * strain.beyond_trace;  // I1 - 3 - 2 j
  if (material.model == MaterialModel::neo_iso) {
    const double t = std::expm1(std::log1p(j) / 3);  // J^(1/3) - 1
    const double a = 1 / ((1 + t) * (1 + t));
    return mu / 2 * a * (distortion + t * t * (3 + 2 * t)) + lambda / 2 * j * j;
  }
  const double volume = material.model == MaterialModel::neo_log ? std::log1p(j) : j;
  return mu / 2 * distortion + mu * minus_log1p(j) + lambda / 2 * volume * volume;
}

template <int Dim>
Mat<Dim> neo_hookean_stress(const Material& material, const Mat<Dim>& F) {
  const double J = F.determinant(), mu = material.lame_mu();
  assert(J > 0);
  const VolumeTerms terms = volume_terms(material, J);
  return mu * terms.a * F + (mu / 2 * terms.da * first_invariant(F) + terms.db) * cofactor(F);
}

template <int Dim>
StressDerivative<Dim> neo_hookean_derivative(const Material& material, const Mat<Dim>& F) {
  const double J = F.determinant(), mu = material.lame_mu(), I1 = first_invariant(F);
  assert(J > 0);
  const VolumeTerms terms = volume_terms(material, J);
  const Mat<Dim> C = cofactor(F);
  const auto f = F.reshaped(), c = C.reshaped();
  StressDerivative<Dim> H = (mu / 2 * terms.da * I1 + terms.db) * cofactor_derivative(F);
  H.diagonal().array() += mu * terms.a;
  H += (mu / 2 * terms.dda * I1 + terms.ddb) * c * c.transpose();
  H += mu * terms.da * (f * c.transpose() + c * f.transpose());
  return H;
}

// lambda/2 tr(e)^2 + mu e:e, e symmetric.
template <int Dim>
double quadratic_energy(const Material& material, const Mat<Dim>& e) {
  return material.lame_lambda() / 2 * e.trace() * e.trace() + material.lame_mu() * e.squaredNorm();
}
template <int Dim>
Mat<Dim> quadratic_stress(const Material& material, const Mat<Dim>& e) {
  return material.lame_lambda() * e.trace() * Mat<Dim>::Identity() + 2 * material.lame_mu() * e;
}
template <int Dim>
Mat<Dim> small_strain(const Mat<Dim>& F) {
  return (F + F.transpose()) / 2 - Mat<Dim>::Identity();
}
template <int Dim>
Mat<Dim> green_strain(const Mat<Dim>& F) {
  const Mat<Dim> G = F - Mat<Dim>::Identity();
  return (G + G.transpose() + G.transpose() * G) / 2;
}

// d(F S(E))/dF for S = lambda tr(E) I + 2 mu E with dE = sym(F^T dF). With
// F = I and S = 0: the elasticity tensor.
template <int Dim>
StressDerivative<Dim> quadratic_derivative(const Material& material, const Mat<Dim>& F,
                                           const Mat<Dim>& S) {
  const double lambda = material.lame_lambda(), mu = material.lame_mu();
  const Mat<Dim> B = F * F.transpose();
  StressDerivative<Dim> H = lambda * F.reshaped() * F.reshaped().transpose();
  for (int l = 0; l < Dim; ++l)
    for (int k = 0; k < Dim; ++k)
      for (int j = 0; j < Dim; ++j)
        for (int i = 0; i < Dim; ++i) {
          double& h = H(i + Dim * j, k + Dim * l);
          h += mu * F(i, l) * F(k, j);
          if (j == l) h += mu * B(i, k);
          if (i == k) h += S(j, l);
        }
  return H;
}

template <int Dim>
StressDerivative<Dim> corotated_derivative(const Material& material, const Mat<Dim>& F) {
  const double mu = material.lame_mu(), lambda = material.lame_lambda();
  const Mat<Dim> C = cofactor(F);
  const auto c = C.reshaped();
  StressDerivative<Dim> H = -2 * mu * rotation_derivative(F);
  H.diagonal().array() += 2 * mu;
  H += lambda * (c * c.transpose() + Strain<Dim>(F).j * cofactor_derivative(F));
  return H;
}

// One matrix type for both dimensions, sized by its argument: compiled once.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;

SmallMatrix without_negative_eigenvalues(SmallMatrix H) {
  const auto [values, vectors] = symmetric_eigen(H, H.rows());
  for (Eigen::Index k = 0; k < values.size() && values(k) < 0; ++k)
    H.noalias() -= (values(k) * vectors.col(k)) * vectors.col(k).transpose();
  return H;
}

}  // namespace

const char* name(MaterialModel model) {
  switch (model) {
    case MaterialModel::linear:
      return "linear";
    case MaterialModel::stvk:
      return "stvk";
    case MaterialModel::corotated:
      return "corotated";
    case MaterialModel::neo_log:
      return "neo_log";
    case MaterialModel::neo_ref:
      return "neo_ref";
    case MaterialModel::neo_iso:
      return "neo_iso";
  }
  return "";
}

MaterialModel material_model(const std::string& text, const std::string& file,
                             const std::string& field) {
  std::string allowed;
  for (const MaterialModel model : all_models) {
    if (text == name(model)) return model;
    allowed += (allowed.empty() ? "" : ", ") + std::string(name(model));
  }
  throw InputError(file, field, "'" + text + "'", allowed);
}

void check(const Material& material, const std::string& file, const std::string& field) {
  const auto require = [&](bool ok, const char* member, double value, const char* allowed) {
    if (!ok || !std::isfinite(value))
      throw InputError(file, (field.empty() ? "" : field + ".") + member, std::to_string(value),
                       allowed);
  };
  const double E = material.youngs_modulus, nu = material.poisson_ratio, rho = material.density;
  require(E > 0, "youngs_modulus", E, "a finite number > 0, Pa");
  require(nu > -1 && nu < 0.5, "poisson_ratio", nu, "a number > -1 and < 0.5");
  require(rho >= 0, "density", rho, "a finite number >= 0, kg/m^3");
}

bool is_quadratic(MaterialModel model) { return model == MaterialModel::linear; }

template <int Dim>
double energy_density(const Material& material, const Mat<Dim>& F) {
  switch (material.model) {
    case MaterialModel::linear:
      return quadratic_energy<Dim>(material, small_strain(F));
    case MaterialModel::stvk:
      return quadratic_energy<Dim>(material, green_strain(F));
    case MaterialModel::corotated: {
      const double j = Strain<Dim>(F).j;
      return material.lame_mu() * (F - rotation(F)).squaredNorm() +
             material.lame_lambda() / 2 * j * j;
    }
    default:
      return neo_hookean_energy(material, F);
  }
}

template <int Dim>
Mat<Dim> first_piola(const Material& material, const Mat<Dim>& F) {
  switch (material.model) {
    case MaterialModel::linear:
      return quadratic_stress<Dim>(material, small_strain(F));
    case MaterialModel::stvk:
      return F * quadratic_stress<Dim>(material, green_strain(F));
    case MaterialModel::corotated:
      return 2 * material.lame_mu() * (F - rotation(F)) +
             material.lame_lambda() * Strain<Dim>(F).j * cofactor(F);
    default:
      return neo_hookean_stress(material, F);
  }
}

template <int Dim>
StressDerivative<Dim> stress_derivative(const Material& material, const Mat<Dim>& F) {
  switch (material.model) {
    case MaterialModel::linear:
      return quadratic_derivative<Dim>(material, Mat<Dim>::Identity(), Mat<Dim>::Zero());
    case MaterialModel::stvk:
      return quadratic_derivative<Dim>(material, F,
                                       quadratic_stress<Dim>(material, green_strain(F)));
    case MaterialModel::corotated:
      return corotated_derivative(material, F);
    default:
      return neo_hookean_derivative(material, F);
  }
}

template <int Dim>
StressDerivative<Dim> project_to_psd(const StressDerivative<Dim>& H) {
  return without_negative_eigenvalues(H);
}

template <int Dim>
Mat<Dim> cauchy_stress(const Material& material, const Mat<Dim>& F) {
  const Mat<Dim> P = first_piola<Dim>(material, F);
  if (material.model == MaterialModel::linear) return P;
  return P * F.transpose() / F.determinant();
}

#define SEM_INSTANTIATE(Dim)                                                               \
  template double energy_density<Dim>(const Material&, const Mat<Dim>&);                   \
  template Mat<Dim> first_piola<Dim>(const Material&, const Mat<Dim>&);                    \
  template StressDerivative<Dim> stress_derivative<Dim>(const Material&, const Mat<Dim>&); \
  template StressDerivative<Dim> project_to_psd<Dim>(const StressDerivative<Dim>&);        \
  template Mat<Dim> cauchy_stress<Dim>(const Material&, const Mat<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
