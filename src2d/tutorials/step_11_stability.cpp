// Step 11: the stability term
//
//   build/release/bin/sem2d_step_11_stability --out out/step_11        numbers, pictures
//   build/release/bin/sem2d_step_11_stability --until 1 --set p=0.6,1.9
//   build/release/bin/sem2d_step_11_stability --interactive            drag p, move gamma
//
// New here: the energy that section 1.7 of the draft leaves empty. The map x(X) = Gamma(X) p
// follows fits, not the curves: on the boundary it gives x(X(u)), while the curve stands at J(u) p.
// Nothing so far notices when the two part. The error (stability) energy does:
//
//   V_S = gamma/2 integral |x(X(u)) - J(u) p|^2 da = gamma/2 p^T S p        gamma in Pa/m
//   T_S = (rho l)/2 integral |x'(X(u)) - J(u) p'|^2 da = (rho l)/2 p'^T S p'   l in m, an option
//
// with D = Gamma - J at the boundary samples and S = sum a_s D_s^T D_s. The draft's introduction
// asks for both ("augment our kinetic and potential energies with a stability term (ref VEM)"), its
// figure 3 shows the springs, but it has no formula: these two are the published ones.
//
// Things to try: --set degree=1: now the system is singular. --set p=-0.6,2: the map hardly follows
// a single control point. --set gamma=1e-3: it hangs, but from where? --set l=1: at what price?
#include "sem/lesson/lesson.h"
#include "sem/mechanics/loads.h"
#include "sem/solve/modes.h"
#include "sem/solve/statics.h"
#include "src2d/tutorials/hung_body.h"
#include "src2d/tutorials/matrices.h"
#include "src2d/tutorials/pictures.h"
#include "sem/lesson/plots.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

constexpr double E = 1e6;  // Pa
const Material linear{MaterialModel::linear, E, 0.3, rho};
const Mat<2> F0{{1.3, 0.4}, {-0.2, 0.8}};  // of an affine field

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 11: the stability term", {{-1.2, -0.9}, {3.2, 2.4}});
  Discretization<2> d = make_body();
  const int n = d.unknowns.size(), pulled = 10;
  const double perimeter = d.samples.weight.sum(), h = perimeter / d.boundary.n_parts();
  const VectorXd rest = rest_state(d).z;

  // [1] Pull the first control point of a part away: its curve follows, the map hardly.
  Vec<2> at = d.unknowns.rest.col(pulled) + Vec<2>(0.1, 0.5);
  double gamma_h = 40, gamma = 0;  // gamma h / E, Pa/m; h: mean length of a part
  int degree = 2;
  MatrixXd S, S2, M;
  Points<2> on_map, on_curve;
  VectorXd energy;
  lesson.handle("p", at, "a control point");
  lesson.slider("gamma", gamma_h, 1e-4, 1e6, "gamma h / E", Lesson::Scale::logarithmic);
  lesson.slider("degree", degree, 1, 3, "of the polynomials");
  lesson.step(
      "Springs between the map and the curve",
      [&](std::ostream& out) {
        d = make_body(degree);
        M = mass_matrix<2>(d.interior, rho * d.quadrature.weight);
        gamma = gamma_h * E / h;
        VectorXd z = rest;
        z.segment<2>(2 * pulled) = at;
        const Eigen::Map<const Points<2>> p(z.data(), 2, n);
        const MatrixXd Gamma = dense_value(d.on_boundary), J = sample_jacobian(d.samples, n);
        on_map = p * Gamma.transpose();  // x(X(u)) = Gamma p
        on_curve = p * J.transpose();    // J p
        const VectorXd& a = d.samples.weight;
        energy =
            gamma / 2 * a.cwiseProduct((on_map - on_curve).colwise().squaredNorm().transpose());
        S = (Gamma - J).transpose() * a.asDiagonal() * (Gamma - J);
        S2 = expand(S, 2);  // for z = (p_1x, p_1y, ...)
        const auto V = make_energy(d, linear, gamma * S);
        out << d.samples.size() << " springs of gamma = " << rounded(gamma, 4) << " Pa/m hold "
            << rounded(energy.sum(), 5) << " J\ngamma/2 p^T S p / that - 1: "
            << error_text(gamma / 2 * z.dot(S2 * z) / energy.sum() - 1, 1e-9)
            << "\nlibrary's / that - 1:       "
            << error_text(V->stability_energy(z) / energy.sum() - 1, 1e-9)
            << "\nlargest distance: " << rounded((on_map - on_curve).colwise().norm().maxCoeff(), 4)
            << " m\n";
      },
      [&](Picture& picture) {
        draw_springs(picture, d.samples, on_map, on_curve, energy);
        picture.dot(at, colors::black, 14);
        picture.label(at, "p", colors::black);
      });

  // [2] K = V'' at rest. Which motions does it not see?
  MatrixXd K(2 * n, 2 * n);
  VectorXd motion;
  lesson.step(
      "Motions without energy: the kernel of K",
      [&](std::ostream& out) {
        K = make_energy(d, linear, MatrixXd::Zero(n, n))->dense_hessian(rest);
        const MatrixXd M2 = expand(M, 2), zero = kernel(K), soft = kernel(K, 1e-6);
        const auto massless = kernel(zero.transpose() * M2 * zero, 1e-9).cols();
        out << 2 * n << " motions, without energy " << zero.cols() << ": 3 rigid ones, " << massless
            << " moving no point of the inside, " << zero.cols() - massless - 3
            << " moving points\nstiffness < 1e-6 of the largest: " << soft.cols()
            << "\nwith gamma S: " << kernel(K + gamma * S2).cols() << " without energy, "
            << kernel(K + gamma * S2, 1e-6).cols() << " soft\n";
        motion = heaviest_motion(d, M2, soft);  // orthogonal to the rigid ones
      },
      [&](Picture& picture) {
        draw_charts(picture,
                    {{{.label = "number of the motion"},
                      {.label = "eigenvalue of K / the largest", .logarithmic = true},
                      {spectrum("without", K), spectrum("with γ S", K + gamma * S2)}}},
                    picture.part({0.01, 0.02}, {0.55, 0.97}));
        draw_displacement(picture, d, motion);
      });

  // [3] Hung on its right end and let go, three times; and in equilibrium.
  double l_h = 0.1;
  std::vector<std::pair<std::string, VectorXd>> ends = {
      {"γ = 0, l = 0", {}}, {"γ = 0, l > 0", {}}, {"γ > 0, l = 0", {}}};
  lesson.slider("l", l_h, 1e-3, 10, "kinetic length l / h", Lesson::Scale::logarithmic);
  lesson.step(
      "Watch it fail",
      [&](std::ostream& out) {
        std::vector<std::vector<std::string>> rows;
        for (int k = 0; k < 3; ++k) {
          const auto V =
              make_energy(d, {MaterialModel::neo_log, E, 0.3, rho}, (k == 2 ? gamma : 0) * S);
          const MatrixXd mass = M + (k == 1 ? rho * l_h * h : 0) * S;
          System system = make_system(d, *V, mass, rho, g, free_entries(d));
          const Run run = simulate(system, mass, rest_state(d), 0.01, 0.4, schemes[0]);
          auto& [label, end] = ends[k];
          end = run.z.back();
          State hung = rest_state(d);
          system.load *= 0.1;
          const Status equilibrium = solve_static(system, hung).status;
          const double square = std::max(0.0, end.dot(S2 * end)) / perimeter;
          rows.push_back({label, std::to_string(run.z.size() - 1), name(run.status),
                          rounded(std::sqrt(square), 2, 1e6),
                          rounded((end - rest).cwiseAbs().maxCoeff(), 2), name(equilibrium)});
        }
        out << table({"", "steps", "status", "mismatch, m", "moved, m", "equilibrium"}, rows);
      },
      [&](Picture& picture) { draw_hung(picture, d, ends); });

  // [4] Static sag, (K + gamma S) u = f, from too soft to too stiff.
  Trace sag, mismatch;
  lesson.step(
      "Too soft, too stiff: what gamma does to the answer",
      [&](std::ostream& out) {
        const auto V = make_energy(d, linear, S);
        const System system = make_system(d, *V, M, rho, g, free_entries(d));
        const auto& free = system.free;
        VectorXd probe = VectorXd::Zero(2 * n);  // -u_y of the map where part 4 begins
        add_point_force<2>(d, d.samples.position.col(d.samples.first[3]), {0, -1}, probe);
        const VectorXd f = system.load(free), row = probe(free);
        const MatrixXd K_free = K(free, free), S_free = S2(free, free);
        sag = mismatch = {};
        std::vector<std::vector<std::string>> rows;
        for (int k = -16; k <= 32; ++k) {
          const double g_h = std::pow(10, k / 4.0);
          const MatrixXd A = K_free + g_h * E / h * S_free;
          const VectorXd u = solve(A, f);
          sag.x.push_back(g_h);
          sag.y.push_back(row.dot(u));
          mismatch.x.push_back(g_h);
          mismatch.y.push_back(std::sqrt(u.dot(S_free * u) / perimeter));
          if (k % 8 != 0) continue;
          const VectorXd lambda = eigenvalues(A);
          rows.push_back({rounded(g_h, 1), rounded(sag.y.back(), 4), rounded(mismatch.y.back(), 2),
                          rounded(lambda.maxCoeff() / lambda.minCoeff(), 2)});
        }
        out << table({"gamma h / E", "sag, m", "mismatch, m", "condition number"}, rows);
        const MatrixXd N = kernel(S_free);  // gamma = infinity: curves that follow the map exactly
        const VectorXd y = solve(N.transpose() * K_free * N, N.transpose() * f);
        out << "infinity leaves " << N.cols() << " of " << free.size() << " unknowns: sag "
            << rounded(row.dot(N * y), 4) << " m\n";
      },
      [&](Picture& picture) {
        const Axis x{.label = "γ h / E", .logarithmic = true};
        draw_charts(picture,
                    {{x, {.label = "sag of the left end, m", .logarithmic = true}, {sag}, gamma_h},
                     {x, {.label = "mismatch, m", .logarithmic = true}, {mismatch}, gamma_h}});
      });

  // [5] Frequencies, K phi = omega^2 M phi, nothing pinned.
  std::vector<Trace> omega;
  lesson.step(
      "Frequencies against gamma, and the kinetic term",
      [&](std::ostream& out) {
        const auto modes = [&](double at_gamma, double l) {
          const auto V = make_energy(d, linear, at_gamma * S);
          const System system = make_system(d, *V, M + rho * l * S, rho, g, all_entries(d));
          return vibration_modes(system, rest, 2 * n);
        };
        std::vector<std::vector<std::string>> rows;
        for (const double l : {0.0, l_h}) {
          const Modes now = modes(gamma, l * h);
          rows.push_back({rounded(l, 2), std::to_string(now.n_massless),
                          std::to_string(now.omega.size()), rounded(now.omega[3], 3),
                          rounded(now.omega.maxCoeff(), 3)});
        }
        out << table({"l / h", "massless", "modes", "lowest elastic, rad/s", "highest"}, rows);
        omega.clear();
        for (int k = -8; k <= 16; k += 2) {
          const Modes now = modes(std::pow(10, k / 4.0) * E / h, l_h * h);
          omega.resize(now.omega.size() - 3);
          for (int i = 3; i < now.omega.size(); ++i) {
            omega[i - 3].x.push_back(std::pow(10, k / 4.0));
            omega[i - 3].y.push_back(now.omega[i]);
          }
        }
      },
      [&](Picture& picture) {
        draw_charts(picture, {{{.label = "γ h / E", .logarithmic = true},
                               {.label = "frequencies with l > 0, rad/s", .logarithmic = true},
                               omega,
                               gamma_h}});
      });

  // [6] A virtual element's form is a(Pi u, Pi v) + s((I - Pi) u, (I - Pi) v). Here the elastic
  // energy sees Gamma p alone, V_S sees D p alone. Consistency: no V_S for what the fit reproduces.
  // Stability: V_S where a() is blind, see [2]. Complementary dynamics calls motions with D p = 0
  // the rig and wants all other motion orthogonal to them.
  VectorXd rig, complement;
  lesson.step(
      "Relatives: virtual elements, complementary dynamics",
      [&](std::ostream& out) {
        const auto V = make_energy(d, linear, gamma * S);
        const double exact = d.quadrature.weight.sum() * energy_density<2>(linear, F0);
        out << "consistency: V(affine) / exact - 1: "
            << error_text(V->energy(affine_field<2>(d.unknowns, F0, {1, 2})) / exact - 1, 1e-9)
            << "\n";
        const MatrixXd N = kernel(S2), metric = expand(M + rho * h * S, 2);  // l = h: no kernel
        VectorXd u = VectorXd::Zero(2 * n);
        u.segment<2>(2 * pulled) = at - d.unknowns.rest.col(pulled);
        rig = N * solve(N.transpose() * metric * N, N.transpose() * metric * u);
        complement = u - rig;
        out << "rig: " << N.cols() << " of " << 2 * n << " motions; of the pulled p it has "
            << rounded(100 * rig.dot(metric * rig) / u.dot(metric * u), 3)
            << " % in kinetic energy\nrig . M complement: "
            << error_text(rig.dot(metric * complement) / u.dot(metric * u), 1e-9) << "\n";
      },
      [&](Picture& picture) {
        draw_states(picture, d,
                    {{"rest", colors::gray, rest},
                     {"rig: curves follow the map", blue, rest + rig},
                     {"complement: all that V_S sees", red, rest + complement}});
      });
  return lesson.run(argc, argv);
}
// Next: step_12_neighbours, other methods on the same solid.
