// Step 10: mass and time
//
//   build/release/bin/sem2d_step_10_time --out out/step_10      numbers, pictures
//   build/release/bin/sem2d_step_10_time --until 3 --set dt=0.002
//   build/release/bin/sem2d_step_10_time --interactive          stiffness and dt as sliders
//
// New here: what moves the solid. Earlier steps gave it a potential energy V(p) with forces and
// stiffness; this one adds the kinetic energy and steps through time.
//
//   (15)  L = T - V                                 (16)  d/dt dL/dp' - dL/dp = 0
//   (20)  T = 1/2 integral rho x'^T x' dX           over the solid
//   (21)  T = 1/2 p'^T M p'                         x(X) = Gamma(X) p, Gamma = J_Pi(X) J
//   (22)  M = integral rho Gamma^T Gamma dX
//
// Errata of the draft: (16) has a plus before dL/dp, with which everything would fall upwards: [2].
// (21) has an integral du dv over the boundary around what is integrated already, (22) lacks dX.
// "This potential energy" after (22) is the kinetic one. "Linearly implicit backward euler": [3].
//
// Things to try: --set dt=0.04: which scheme still moves as it should, and which only looks calm?
// --set E=1e6: why do the Euler schemes lose some of their order in [6]? theta = 0.6 in [4]?
#include "sem/lesson/lesson.h"
#include "sem/method/boundary_integrals.h"
#include "src2d/tutorials/hung_body.h"
#include "src2d/tutorials/matrices.h"
#include "src2d/tutorials/pictures.h"
#include "sem/lesson/plots.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

// [3] (M + dt^2 K) dv = dt (f - grad V - dt K v) on the unknowns that are not pinned.
void linearly_implicit_step(const System& system, double dt, State& state) {
  VectorXd dV(system.size());
  system.potential->gradient(state.z, dV);                            // eq. 19
  const MatrixXd K = system.potential->dense_hessian(state.z);        // its derivative
  const MatrixXd A = system.mass.dense() + dt * dt * K;
  const VectorXd b = dt * (system.load - dV - dt * K * state.v);
  state.v(system.free) += solve(A(system.free, system.free), b(system.free));
  state.z += dt * state.v;
}

// [4] Newton's method for v1 in  r = M (v1 - v0) + dt (grad V(z_m) - f) = 0, where
//     z(s) = z0 + s dt (v0 + theta (v1 - v0)),   z_m = z(theta),   z1 = z(1):
// theta = 1 is implicit Euler, theta = 1/2 implicit midpoint. Returns |r| / dt of every iterate;
// `first` becomes z1 after one iteration from z1 = z0.
std::vector<double> newton_step(const System& system, double dt, double theta, State& state,
                                VectorXd& first) {
  const auto& free = system.free;
  const VectorXd z0 = state.z, v0 = state.v;
  VectorXd v1 = (1 - 1 / theta) * v0, dV(system.size());
  const auto z = [&](double s) -> VectorXd { return z0 + s * dt * (v0 + theta * (v1 - v0)); };
  std::vector<double> residuals;
  while (residuals.size() < 20) {
    system.potential->gradient(z(theta), dV);
    const VectorXd r = (system.mass * (v1 - v0) + dt * (dV - system.load))(free);
    residuals.push_back(r.norm() / dt);
    if (residuals.back() < 1e-9 * residuals.front()) break;
    const MatrixXd K = system.potential->dense_hessian(z(theta));
    const MatrixXd A = system.mass.dense() + theta * theta * dt * dt * K;  // dr/dv1
    VectorXd step = solve(A(free, free), r);
    v1(free) -= step;
    for (int cut = 0; cut < 30 && !std::isfinite(system.potential->energy(z(theta))); ++cut)
      v1(free) += step /= 2;  // turned inside out
    if (residuals.size() == 1) first = z(1);
  }
  state.z = z(1);
  state.v = v1;
  return residuals;
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 10: mass and time", {{-1.2, -2.9}, {3.2, 1.7}});
  const Discretization<2> d = make_body();
  const int n = d.unknowns.size();
  const VectorXd point_mass = rho * d.quadrature.weight, ones = VectorXd::Ones(n);
  const State start = rest_state(d);

  // [1] The mass matrix, scalar: x and y have the same.
  MatrixXd M;
  lesson.step(
      "The mass matrix: the inside, seen from the control points",
      [&](std::ostream& out) {
        const MatrixXd Gamma = dense_value(d.interior);           // #points x #control points
        M = Gamma.transpose() * point_mass.asDiagonal() * Gamma;  // eq. 22
        const VectorXd lambda = eigenvalues(M);
        const auto truth = boundary_moments(d.boundary, d.loops);
        const Points<2> p = rest_controls(d.boundary);
        out << "M: " << n << " x " << n << ", ours - library's: "
            << error_text((M - mass_matrix(d.interior, point_mass)).norm())
            << "\nleast eigenvalue:          " << rounded(lambda.minCoeff(), 2)
            << " kg, largest: " << rounded(lambda.maxCoeff(), 4) << " kg"
            << "\nsum of entries:            " << rounded(ones.dot(M * ones)) << " kg"
            << "\nrho area by the boundary:  " << rounded(rho * truth.volume) << " kg\n";
        // Spin of 1 rad/s about the origin: x' = (-y, x), hence p' = (-p_y, p_x), eq. 21.
        out << "T of a spin of 1 rad/s:    " << rounded((p * M * p.transpose()).trace() / 2) << " J"
            << "\n1/2 moment of inertia:     " << rounded(rho * truth.second.trace() / 2) << " J\n";
      },
      [&](Picture& picture) { draw_mass(picture, d, M); });

  // [2] On z = (p_1x, p_1y, p_2x, ...) acts M with every entry times the 2 x 2 identity. Pinned
  // control points leave the system.
  double E = 1e5;
  std::unique_ptr<InternalEnergy<2>> V;
  System system;
  lesson.slider("E", E, 2e3, 1e6, "Young's modulus, Pa", Lesson::Scale::logarithmic);
  lesson.step(
      "Gravity and the equation of motion",
      [&](std::ostream& out) {
        const MatrixXd S = stability_matrix(d.on_boundary, d.samples, d.unknowns);
        V = make_energy(d, {MaterialModel::neo_log, E, 0.3, rho}, 20 * E * S);
        system = make_system(d, *V, M, rho, g, free_entries(d));  // f = integral rho Gamma^T g dX
        // (16) at rest, M p'' = f - dV/dp; the least p'', as M may be singular.
        VectorXd dV(2 * n);
        V->gradient(system.rest, dV);
        const VectorXd f = (system.load - dV)(Eigen::seq(1, 2 * n - 1, 2));
        const VectorXd a = dense_value(d.interior) * least_squares(M, f);
        out << "let go, all points start with " << rounded(a.minCoeff(), 4) << " to "
            << rounded(a.maxCoeff(), 4) << " m/s^2\nfree: " << system.free.size() << " of " << 2 * n
            << " unknowns\n";
      },
      [&](Picture& picture) {
        picture.set_view({{-0.8, -1.1}, {3, 1.7}});
        draw_vectors(picture, d, system.load, 6e-4, system.free);
        picture.legend({{"gravity on the control points", red},
                        {"pinned", colors::black, MarkerShape::triangle}},
                       Picture::Corner::lower_right);
      });

  // [3] Backward Euler takes the forces at the end of the step:
  //   M (v1 - v0) = dt (f - grad V(z1)),   z1 = z0 + dt v1.
  // Linearly implicit: grad V(z1) becomes grad V(z0) + K (z1 - z0) = grad V + dt K (v0 + dv), so
  //   (M + dt^2 K) dv = dt (f - grad V - dt K v0):   one linear system a step.
  double dt = 0.01;
  Run run;
  lesson.slider("dt", dt, 0.002, 0.04, "time step, s", Lesson::Scale::logarithmic);
  lesson.step(
      "Linearly implicit Euler, the paper's scheme",
      [&](std::ostream& out) {
        run = simulate(system, M, start, dt, 0.9, schemes[0]);  // the library's
        State ours = start;
        for (int step = 0; step < 10; ++step) linearly_implicit_step(system, dt, ours);
        out << "after 10 steps, ours - library's: "
            << error_text((ours.z - run.z[std::min<std::size_t>(10, run.z.size() - 1)]).norm(),
                          1e-9)
            << " m\n"
            << run.z.size() - 1 << " steps to " << rounded(run.time.back(), 3) << " s, "
            << run.n_cut << " cut into substeps, " << name(run.status) << "\n";
      },
      [&](Picture& picture) { draw_motion(picture, d, run.z, run.time.back()); });

  // [4] The forces of the very end (or middle) of the step. z1 = z0 as the first guess makes
  // Newton's first iterate the linearly implicit step.
  std::vector<Trace> residuals;
  lesson.step(
      "Implicit Euler and implicit midpoint by Newton's method",
      [&](std::ostream& out) {
        State moving = start;  // after a large step of the library: in full swing
        TimeStepper(system, 0.2, schemes[1]).step(moving);
        State linear = moving;
        linearly_implicit_step(system, dt, linear);
        VectorXd first;
        residuals.clear();
        for (const int k : {1, 2}) {
          State ours = moving, theirs = moving;
          auto& [label, x, y] = residuals.emplace_back(Trace{scheme_names[k], {}, {}});
          y = newton_step(system, dt, k == 1 ? 1 : 0.5, ours, first);
          for (int i = 0; i < int(y.size()); ++i) x.push_back(i);
          TimeStepper(system, dt, schemes[k]).step(theirs);
          out << scheme_names[k] << ": " << y.size() - 1 << " iterations, ours - library's "
              << error_text((ours.z - theirs.z).norm(), 1e-8) << " m\n";
          if (k == 1)
            out << "  its first iterate - linearly implicit Euler: "
                << error_text((first - linear.z).norm(), 1e-9) << " m\n";
        }
      },
      [&](Picture& picture) {
        const Axis y{.label = "|r|, N", .upper = 10 * residuals[0].y[0], .logarithmic = true};
        const double n_steps = std::max(residuals[0].x.back(), residuals[1].x.back());
        draw_charts(picture, {{count_axis("iteration", int(n_steps)), y, residuals}});
      });

  // [5] The total energy T + V - f z would stay the same. The Euler schemes lose it; without forces
  // and pins ("flight") the momentum stays too, and the angular momentum that they also lose.
  System flying;
  State thrown;
  std::vector<Trace> energy, angular;
  lesson.step(
      "Energy and momentum against time",
      [&](std::ostream& out) {
        flying = make_system(d, *V, M, 0, g, all_entries(d));
        thrown = rest_state(d, {1, 0.5}, 4);
        std::vector<std::vector<std::string>> rows;
        energy = angular = {};
        for (int k = 0; k < 3; ++k) {
          const Run swing = simulate(system, M, start, dt, 1.5, schemes[k]);
          const Run flight = simulate(flying, M, thrown, dt, 1.5, schemes[k]);
          rows.push_back({scheme_names[k], change(swing.energy, 10 * M.sum()),
                          change(flight.energy), change(flight.momentum), change(flight.angular)});
          energy.push_back({scheme_names[k], swing.time, swing.energy});
          angular.push_back({scheme_names[k], flight.time, flight.angular});
        }
        out << "largest change in 1.5 s; swing: by weight x 1 m; flight: by the first value\n"
            << table({"", "swing: energy", "flight: energy", "momentum", "angular"}, rows);
      },
      [&](Picture& picture) {
        draw_charts(
            picture,
            {{{.label = "time, s"}, {.label = "swing: energy, J"}, energy},
             {{.label = "time, s"}, {.label = "flight: angular momentum, kg m²/s"}, angular}});
      });

  // [6] Half of dt: half of the error of both Euler schemes, a quarter of the midpoint rule's.
  std::vector<Trace> errors;
  lesson.step(
      "Observed order",
      [&](std::ostream& out) {
        const auto end = [&](int count, int k) {
          return simulate(flying, M, thrown, 0.1 / count, 0.1, schemes[k]).z.back();
        };
        const VectorXd truth = end(1280, 2);
        std::vector<std::vector<std::string>> rows;
        errors.clear();
        for (int k = 0; k < 3; ++k) {
          auto& [label, x, y] = errors.emplace_back(Trace{scheme_names[k], {}, {}});
          for (const int count : {20, 40, 80, 160}) {
            const VectorXd error = end(count, k) - truth;
            x.push_back(0.1 / count);
            y.push_back(std::sqrt(error.dot(system.mass * error) / M.sum()));
          }
          rows.push_back(
              {label, rounded(y[0], 2), rounded(y[3], 2), rounded(std::log2(y[2] / y[3]), 2)});
        }
        out << "flight: error after 0.1 s against 1280 midpoint steps, m\n"
            << table({"", "20 steps", "160 steps", "order"}, rows);
      },
      [&](Picture& picture) {
        const Axis x{.label = "dt, s", .lower = 0.0005, .upper = 0.006, .logarithmic = true};
        draw_charts(picture,
                    {{x, {.label = "error, root mean square, m", .logarithmic = true}, errors}});
      });
  return lesson.run(argc, argv);
}
// Next: step_11_stability, the term without which the curves leave the map.
