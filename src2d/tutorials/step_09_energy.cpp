// Step 9: energy, stress, forces and stiffness
//
//   build/release/bin/sem2d_step_09_energy --out out/step_09           numbers, pictures
//   build/release/bin/sem2d_step_09_energy --set model=linear          for small rotations only
//   build/release/bin/sem2d_step_09_energy --interactive               drag the control points
//
// New here: what a deformation costs, and its derivatives in the control points.
//
//   (17, 18)  V = integral of Psi(F) dX = sum_k Psi(F_k) v_k,   F_k = B_k p  (step 8)
//   (19)      dV/dp = sum_k B_k^T P(F_k) v_k,   P = dPsi/dF: first Piola stress, Pa
//   (19')     K = d2V/dp2 = sum_k B_k^T dP/dF B_k v_k
//
// Finite differences check each derivative: (f(x + h) - f(x - h)) / 2h has an error of h^2 from
// what Taylor's series leaves out and of 1e-16 / h from rounding. Against h on logarithmic axes it
// is a V; a wrong derivative shows as a line that does not go down.
//
// Errata of the draft: (19) is dV/dq; with L = T - V the derivative of L is its negative, the
// force. (16) has the wrong sign too: d/dt dL/dq' - dL/dq = 0. The A_i of (18) are the v_k here.
//
// Things to try: poisson 0.49: which energies become stiff? Drag a control point across the solid:
// when does neo_log refuse, what does linear do? Why do the torques of [4] not balance with linear?
#include <cmath>

#include "sem/base/error.h"
#include "sem/lesson/lesson.h"
#include "sem/mechanics/internal_energy.h"
#include "sem/method/discretization.h"
#include "src2d/tutorials/matrices.h"
#include "src2d/tutorials/pictures.h"
#include "sem/lesson/plots.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

const std::vector<std::pair<std::string, MaterialModel>> models = {
    {"linear", MaterialModel::linear},       {"stvk", MaterialModel::stvk},
    {"corotated", MaterialModel::corotated}, {"neo_log", MaterialModel::neo_log},
    {"neo_ref", MaterialModel::neo_ref},     {"neo_iso", MaterialModel::neo_iso}};

Mat<2> turn(double degrees) { return Eigen::Rotation2Dd(degrees * M_PI / 180).toRotationMatrix(); }

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 9: energy and forces", {{-0.4, -0.9}, {5.2, 4.2}});

  std::vector<std::string> names;
  for (const auto& [name, model] : models) names.push_back(name);

  // [1] Energy densities Psi(F), J/m^3. F = R(angle) diag(stretch, 1).
  Material material{.model = MaterialModel::neo_log, .youngs_modulus = 1};
  double stretch = 1.3, angle = 30;
  const VectorXd stretches = VectorXd::LinSpaced(61, 0.3, 2),
                 angles = VectorXd::LinSpaced(61, 0, 180);
  MatrixXd by_stretch(61, 6), by_angle(61, 6);
  lesson.choice("model", material.model, models, "material from here on");
  lesson.slider("poisson", material.poisson_ratio, 0, 0.49, "ratio; E = 1 Pa");
  lesson.slider("stretch", stretch, 0.3, 2, "of F, in x");
  lesson.slider("angle", angle, -180, 180, "of F, degrees");
  lesson.step(
      "Six energy densities",
      [&](std::ostream& out) {
        const Mat<2> R = turn(angle), S = Vec<2>(stretch, 1).asDiagonal(), I = Mat<2>::Identity();
        std::vector<std::vector<std::string>> rows;
        for (int i = 0; i < 6; ++i) {
          Material m = material, linear = material;
          m.model = models[i].second;
          linear.model = MaterialModel::linear;
          const MatrixXd C0 = stress_derivative<2>(linear, I);
          rows.push_back({models[i].first, rounded(energy_density<2>(m, S), 4),
                          rounded(energy_density<2>(m, R * S), 4),
                          error_text(energy_density<2>(m, R)),
                          error_text((stress_derivative<2>(m, I) - C0).norm() / C0.norm())});
          for (int k = 0; k <= 60; ++k) {
            by_stretch(k, i) = energy_density<2>(m, Mat<2>{{stretches[k], 0}, {0, 1}});
            by_angle(k, i) = energy_density<2>(m, turn(angles[k]));
          }
        }
        out << table({"Psi of", "stretch S", "R S", "rotation R", "C(I) - linear's"}, rows);
      },
      [&](Picture& picture) {
        draw_columns(picture, {.label = "stretch"}, {.label = "Ψ / E", .lower = 0, .upper = 0.6},
                     column(stretches, 0), by_stretch, names,
                     picture.part({0, 0.03}, {0.49, 0.98}));
        draw_columns(picture, {.label = "rotation, degrees"},
                     {.label = "Ψ / E", .lower = -0.1, .upper = 3}, column(angles, 0), by_angle,
                     names, picture.part({0.5, 0.03}, {0.99, 0.98}));
      });

  // [2] P = dPsi/dF and dP/dF at that F, one entry after the other.
  std::vector<std::pair<std::string, Check>> density;
  lesson.step(
      "Stress and its derivative against finite differences",
      [&](std::ostream& out) {
        const Mat<2> F = turn(angle) * Vec<2>(stretch, 1).asDiagonal();
        const Mat<2> P = first_piola<2>(material, F);
        const MatrixXd C = stress_derivative<2>(material, F);  // 4 by 4: column k is dP / dF_k
        const auto Psi = [&](const VectorXd& f) -> VectorXd {
          return VectorXd::Constant(1, energy_density<2>(material, f.reshaped(2, 2)));
        };
        const auto stress = [&](const VectorXd& f) -> VectorXd {
          return first_piola<2>(material, f.reshaped(2, 2)).reshaped();
        };
        density = {{"P from Ψ", Check(Psi, F.reshaped(), P.reshaped().transpose())},
                   {"dP/dF from P", Check(stress, F.reshaped(), C)}};
        out << "P / E = " << list(P.reshaped<Eigen::RowMajor>())
            << "\nP:     " << text(density[0].second) << "\ndP/dF: " << text(density[1].second)
            << "\nleast eigenvalue of dP/dF: " << rounded(eigenvalues(C)[0], 3) << "\n";
      },
      [&](Picture& picture) { draw_errors(picture, density); });

  // [3] (18) for the solid of step 8.
  const Points<2> p0 = three_points();
  Points<2> p = pulled_points();
  MethodOptions options;
  options.sampling.points_per_span = 8;
  options.rays.n_rays = 32;
  options.interval.spacing = 0.1;
  options.weights.cutoff = 2;
  options.origins = OriginChoice::one;
  options.projection.degree = 2;
  const auto body = discretize<2>({three_curves(p0)}, options);
  const int n = body.quadrature.size();
  const MatrixXd B[] = {dense_gradient(body.interior, 0), dense_gradient(body.interior, 1)};
  const VectorXd& v = body.quadrature.weight;
  const auto stacked = [](const Points<2>& q) -> VectorXd { return controls_of(q).reshaped(); };
  const auto F_of = [&](const VectorXd& z, int k) {
    Mat<2> F;
    for (int b = 0; b < 2; ++b) F.col(b) = z.reshaped(2, 12) * B[b].row(k).transpose();  // F = B p
    return F;
  };
  const auto V_of = [&](const VectorXd& z) {
    double V = 0;
    for (int k = 0; k < n; ++k) V += energy_density<2>(material, F_of(z, k)) * v[k];  // (18)
    return V;
  };
  const auto library = [&](const Material& m) {
    return InternalEnergy<2>(body.interior, v, {{m}, std::vector<int>(n, 0)},
                             MatrixXd::Zero(12, 12));
  };
  VectorXd z, psi(n);
  lesson.handles("p", p, "control point, deformed");
  lesson.step(
      "The energy of a deformed solid",
      [&](std::ostream& out) {
        z = stacked(p);
        double least = 1e300;
        for (int k = 0; k < n; ++k) {
          psi[k] = energy_density<2>(material, F_of(z, k));
          least = std::min(least, F_of(z, k).determinant());
        }
        if (!std::isfinite(psi.sum()))
          throw InputError("", "p", "det F = " + rounded(least, 2) + " inside",
                           "det F > 0 everywhere for this material, or another material");
        const double V = V_of(z);
        out << n << " points, V = " << rounded(V, 5)
            << " J/m, library's - ours: " << error_text(library(material).energy(z) - V)
            << "\nV at rest: " << error_text(V_of(stacked(p0)))
            << ", least det F: " << rounded(least, 3) << "\n";
      },
      [&](Picture& picture) {
        const Points<2> x = evaluate(body.interior, z);
        const double most = std::max(psi.maxCoeff(), 1e-9);
        for (int k = 0; k < n; ++k)
          picture.dot(x.col(k), colors::viridis(psi[k] / most), 11, MarkerShape::square);
        draw_parts(picture, three_curves(p0), "", 1);
        draw_parts(picture, three_curves(p), "ABC");
        color_bar(picture, "Ψ / E = 0", rounded(most, 2));
        read_values(picture, x, psi, "Ψ / E");
      });
  // [4] (19): every point pulls at the control points that its row of B knows.
  VectorXd g;
  lesson.step(
      "Forces on the control points",
      [&](std::ostream& out) {
        MatrixXd forces = MatrixXd::Zero(2, 12);
        for (int k = 0; k < n; ++k) {
          const Mat<2> P = first_piola<2>(material, F_of(z, k));
          for (int b = 0; b < 2; ++b) forces += v[k] * P.col(b) * B[b].row(k);  // (19): B^T P v
        }
        g = forces.reshaped();
        VectorXd other(24);
        auto energy = library(material);
        energy.gradient(z, other);
        double torque = 0;
        for (int j = 0; j < 12; ++j)
          torque += DimTraits<2>::cross(z.segment<2>(2 * j), g.segment<2>(2 * j))[0];
        out << "library's - ours: " << error_text((other - g).norm())
            << "\nsum of forces: " << error_text(forces.rowwise().sum().norm())
            << ", of torques: " << error_text(torque) << "\n";
      },
      [&](Picture& picture) { draw_forces(picture, p, -g.reshaped(2, 12)); });

  // [5] (19) and (19') against differences along one direction, and what K does not resist at rest.
  std::vector<std::pair<std::string, Check>> solid;
  lesson.step(
      "The whole solid against finite differences",
      [&](std::ostream& out) {
        auto energy = library(material);
        const VectorXd d = VectorXd::LinSpaced(24, 1, 24).array().sin();  // any direction
        MatrixXd K = energy.dense_hessian(z);
        const auto V = [&](const VectorXd& t) -> VectorXd {
          return VectorXd::Constant(1, V_of(z + t[0] * d));
        };
        const auto dV = [&](const VectorXd& t) {
          VectorXd gradient(24);
          energy.gradient(z + t[0] * d, gradient);
          return gradient;
        };
        const VectorXd at = VectorXd::Zero(1);
        solid = {{"dV/dp from V", Check(V, at, MatrixXd::Constant(1, 1, g.dot(d)))},
                 {"K from dV/dp", Check(dV, at, K * d)}};
        K = energy.dense_hessian(stacked(p0));
        out << "dV/dp: " << text(solid[0].second) << "\nK:     " << text(solid[1].second)
            << "\nat rest K resists " << 24 - kernel(K, 1e-9).cols() << " of 24 motions\n";
      },
      [&](Picture& picture) { draw_errors(picture, solid); });

  // [6] p = R p0: a rigid motion. F = R everywhere (step 8), so it costs nothing - if Psi(R) = 0.
  // Linear: the energy of e = sym(R - I) = (cos - 1) I, which grows as angle to the 4th power.
  const VectorXd turned = 0.1 * Eigen::pow(10.0, Eigen::ArrayXd::LinSpaced(41, 0, 3.2));
  MatrixXd cost(41, 6);
  lesson.step(
      "Rigid motions",
      [&](std::ostream& out) {
        for (int i = 0; i < 6; ++i) {
          Material m = material;
          m.model = models[i].second;
          auto energy = library(m);
          for (int k = 0; k <= 40; ++k) cost(k, i) = energy.energy(stacked(turn(turned[k]) * p0));
          out << "  " << models[i].first
              << ": V after a turn by 1.58, 15.8, 158 degrees: " << error_text(cost(15, i)) << ", "
              << error_text(cost(27, i)) << ", " << error_text(cost(40, i)) << "\n";
        }
        out << "linear: V grows as angle to the "
            << rounded(std::log(cost(20, 0) / cost(0, 0)) / std::log(turned[20] / turned[0]), 3)
            << "\n";
      },
      [&](Picture& picture) {
        draw_columns(picture, {.label = "rotation, degrees", .logarithmic = true},
                     {.label = "V / E, m²", .lower = 1e-18, .upper = 100, .logarithmic = true},
                     column(turned, 0), cost.cwiseAbs(), names);
      });
  return lesson.run(argc, argv);
}
// Next: step_10_time, mass and motion.
