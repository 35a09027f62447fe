// Step 7 in space: a whole scene in motion
//
//   build/release/bin/sem3d_step_07_motion --out out/step_07                   numbers, pictures
//   build/release/bin/sem3d_step_07_motion --set integrator=implicit_midpoint  keeps the energy
//   build/release/bin/sem3d_step_07_motion --interactive                       time as a slider
//
// New here: nothing of the method; all of it together, as `sem3d run torus` does it. A soft torus,
// hung at its top, falls and swings:
//
//   read_scene, build_model   text -> data -> M, S, V, f, pins: once
//   TimeStepper               (M + dt^2 K) dv = -dt (grad V - f + dt K v)        every step
//   Monitor                   state -> energies, momentum, probes
//
// Truths: the volume 2 pi^2 R r^2; the pins' and the weight's momentum is the body's; halving the
// time step halves the error of a method of first order and quarters that of one of second.
//
// Things to try: --set E=5e4: how far does it fall? --set dt=0.05 with each integrator.
// `build/release/bin/sem3d run torus --out out/torus` for the films.
#include <cmath>

#include "sem/base/stopwatch.h"
#include "sem/lesson/lesson.h"
#include "sem/scene/monitor.h"
#include "sem/solve/integrators.h"
#include "src3d/tutorials/scenes.h"
#include "src3d/tutorials/solid_view.h"

using namespace sem;
using namespace sem::tutorial;

namespace {

// All states, the first included, and how it ended.
struct Motion {
  std::vector<State> states;
  Status status = Status::converged;
};

Motion march(const Model<3>& model, Integrator integrator, double dt, double duration) {
  Motion motion{{model.initial}};
  TimeStepper stepper(model.system, dt, integrator);
  State state = model.initial;
  const int n = int(std::lround(duration / dt));
  while (state.step < n && motion.status == Status::converged) {
    motion.status = stepper.step(state).status;
    if (motion.status == Status::converged) motion.states.push_back(state);
  }
  return motion;
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 7 in space: a whole scene in motion", {{0, 0}, {1, 1}});
  SolidView view(lesson, 25, 20);

  // [1] From text to operators.
  double E = 2e5;
  int parts = 4;
  Scene<3> scene;
  std::unique_ptr<Model<3>> model;
  std::unique_ptr<SolidPainter> painter;
  lesson.slider("E", E, 2e4, 1e7, "Young's modulus, Pa", Lesson::Scale::logarithmic);
  lesson.slider("parts", parts, 3, 8, "around the torus");
  lesson.step(
      "A scene and its model",
      [&](std::ostream& out) {
        scene = builtin_scene("torus", {"solids[0].material.youngs_modulus=" + rounded(E),
                                        "method.quadrature.spacing=0.16",
                                        "solids[0].shape.parts=[" + std::to_string(parts) + ",1]"});
        model = build_model(scene, "torus");
        painter = std::make_unique<SolidPainter>(scene);
        const auto& d = model->discretization;
        const auto count = [](auto n) { return std::to_string(n); };
        const double truth = 2 * M_PI * M_PI * 1 * 0.35 * 0.35;
        out << scene.description << "\n"
            << table({"stage", "makes", "count"},
                     {{"make_boundary", "parts", count(d.boundary.n_parts())},
                      {"sample_boundary", "samples", count(d.samples.size())},
                      {"quadrature_on_rays", "points", count(d.quadrature.size())},
                      {"blending_weights", "weights > 0", count(d.weights.w.size())},
                      {"choose_origins", "origins", count(d.origins.members.size())},
                      {"pins", "unknowns held", count(model->system.size() - model->n_unknowns())},
                      {"System", "unknowns left", count(model->n_unknowns())}})
            << "volume " << rounded(d.quadrature.weight.sum(), 5)
            << " m^3, 2 pi^2 R r^2 = " << rounded(truth, 5) << "; mass "
            << rounded(model->total_mass(), 5) << " kg\n";
      },
      [&](Picture& picture) {
        const auto& d = model->discretization;
        render::RenderScene shown;
        add_parts(shown, d.boundary, [&](int i) {
          return colors::mix(part_color(i), colors::white, 0.3).with_alpha(0.3);
        });
        add_balls(shown, d.quadrature.position, 0.02, [&](int k) {
          Color mixed{0, 0, 0};
          for (int e = d.weights.begin[k]; e < d.weights.begin[k + 1]; ++e) {
            const Color c = part_color(d.weights.part[e]);
            const double w = d.weights.w[e];
            mixed = {mixed.r + w * c.r, mixed.g + w * c.g, mixed.b + w * c.b};
          }
          return mixed;
        });
        const Points<3> p = rest_controls(d.boundary);
        for (const auto& held : model->held)
          for (const int c : held.controls) shown.spheres.push_back({p.col(c), 0.035, ink});
        view.draw(picture, shown);
        picture.note(
            "points in the colours of the parts that they follow; black: pinned control points");
      });

  // [2] Time. Newton's second law for the whole body, dP/dt = weight + force of the pins: what the
  // last step leaves of it. To rounding with implicit_euler; the linearly implicit one solves one
  // linear system and leaves an error of second order; the midpoint rule has its forces half-way.
  Integrator integrator = Integrator::linearly_implicit_euler;
  double dt = 0.02;
  constexpr double duration = 1;
  Motion motion;
  std::vector<Trace> energy;
  lesson.choice("integrator", integrator,
                {{"linearly_implicit_euler", Integrator::linearly_implicit_euler},
                 {"implicit_euler", Integrator::implicit_euler},
                 {"implicit_midpoint", Integrator::implicit_midpoint}});
  lesson.slider("dt", dt, 0.005, 0.1, "time step, s");
  lesson.step(
      "It falls and swings: energies",
      [&](std::ostream& out) {
        motion = march(*model, integrator, dt, duration);
        energy = {{"kinetic", {}, {}}, {"elastic", {}, {}}, {"weight", {}, {}}, {"all", {}, {}}};
        const Energies first = energies(model->system, motion.states[0]);
        for (const auto& state : motion.states) {
          const Energies now = energies(model->system, state);
          const double value[] = {now.kinetic, now.potential, now.load - first.load,
                                  now.total - first.total};
          for (int k = 0; k < 4; ++k) {
            energy[k].x.push_back(state.time);
            energy[k].y.push_back(value[k]);
          }
        }
        out << motion.states.size() - 1 << " steps: " << name(motion.status) << "\n";
        if (motion.states.size() < 2) return;
        std::vector<std::vector<std::string>> rows;
        for (std::size_t k = 0; k < motion.states.size();
             k += std::max<std::size_t>(1, motion.states.size() / 5)) {
          rows.push_back({rounded(energy[0].x[k], 3)});
          for (int e = 0; e < 4; ++e) rows.back().push_back(rounded(energy[e].y[k], 3, 1e4));
        }
        const auto& system = model->system;
        const State &last = motion.states.back(), &before = motion.states[motion.states.size() - 2];
        const Eigen::VectorXd a = (last.v - before.v) / dt;
        Eigen::VectorXd Ma(a.size());
        system.mass.multiply(a, Ma);
        const auto total = [&](const Eigen::VectorXd& f) {
          return Vec<3>(Eigen::Map<const Points<3>>(f.data(), 3, f.size() / 3) *
                        model->discretization.unknowns.one);
        };
        const Vec<3> pins = total(reaction(system, last.z, a)), weight = total(system.load);
        out << table({"t, s", "kinetic, J", "elastic", "weight", "all"}, rows)
            << "last step: pins carry " << rounded(pins[2] / 1e3, 4) << " kN, weight "
            << rounded(weight[2] / 1e3, 4) << " kN; dP/dt - both: "
            << error_text((total(Ma) - pins - weight).norm() / weight.norm(), 1e-9)
            << " of the weight\n";
      },
      [&](Picture& picture) {
        draw_charts(picture, {{{.label = "time, s"}, {.label = "energy gained, J"}, energy}});
      });

  // [3] A frame, drawn by what draws the program's.
  double time = 0.4;
  int shown_step = 0;
  lesson.slider("time", time, 0, duration, "of the frame, s");
  lesson.step(
      "A frame",
      [&](std::ostream& out) {
        shown_step = std::min(int(motion.states.size()) - 1, int(std::lround(time / dt)));
        const auto values = Monitor<3>(scene, *model).probes(motion.states[shown_step], {});
        out << "t = " << rounded(motion.states[shown_step].time, 3) << " s: the bottom is "
            << rounded(-values[2], 4) << " m lower\n";
      },
      [&](Picture& picture) {
        view.draw_frame(picture, *painter, *model, motion.states[shown_step]);
      });

  // [4] Against itself: the probe at t = 0.2 s with dt, dt/2, ...; differences fall by 2 or by 4.
  std::vector<Trace> differences;
  lesson.step(
      "Halving the time step: the order",
      [&](std::ostream& out) {
        differences.clear();
        std::vector<std::vector<std::string>> rows;
        for (const auto which :
             {Integrator::linearly_implicit_euler, Integrator::implicit_midpoint}) {
          std::vector<double> values;
          for (int k = 0; k < 3; ++k) {
            const auto run = march(*model, which, 0.02 / (1 << k), 0.2);
            values.push_back(Monitor<3>(scene, *model).probes(run.states.back(), {})[2]);
          }
          differences.push_back({name(which), {}, {}});
          rows.push_back({name(which)});
          for (int k = 0; k < 2; ++k) {
            differences.back().x.push_back(0.02 / (1 << k));
            differences.back().y.push_back(std::abs(values[k + 1] - values[k]));
            rows.back().push_back(rounded(differences.back().y.back(), 2));
          }
          rows.back().push_back(
              rounded(std::log2(differences.back().y[0] / differences.back().y[1]), 2));
        }
        out << "the bottom at t = 0.2 s: |u_z(dt / 2) - u_z(dt)|, m\n"
            << table({"", "dt = 0.02", "0.01", "order"}, rows);
      },
      [&](Picture& picture) {
        draw_charts(
            picture,
            {{{.label = "time step, s", .lower = 0.004, .upper = 0.025, .logarithmic = true},
              {.label = "change by halving it, m", .logarithmic = true},
              differences}});
      });

  // [5] What a step costs: a growing beam, 1 m and 4 parts a slice. Parts far apart share no
  // points, so their blocks of the Hessian are zero, and so are most of its factor. Times are of
  // this machine: in the picture only.
  std::vector<Trace> cost;
  lesson.step(
      "What a step costs: a growing beam",
      [&](std::ostream& out) {
        cost = {{"Hessian", {}, {}}, {"factorisation", {}, {}}, {"all of the step", {}, {}}};
        std::vector<std::vector<std::string>> rows;
        for (const int n : {2, 4, 8, 16}) {
          const std::string slices = std::to_string(n);
          const auto beam = build_model(
              builtin_scene("beam",
                            {"solids[0].shape.upper=[" + slices + ",1,1]",
                             "solids[0].shape.parts=[" + slices + ",1,1]",
                             "method.origins=shared_parts", "method.quadrature.rays=4",
                             "method.quadrature.points=" + std::to_string(4 * n), "probes=[]"}),
              "beam");
          State state = beam->initial;
          TimeStepper stepper(beam->system, 0.02, Integrator::linearly_implicit_euler);
          constexpr int n_steps = 2;
          const Stopwatch watch;
          for (int step = 0; step < n_steps; ++step) stepper.step(state);
          const double all = watch.seconds();
          const Counters spent = stepper.counters();
          const double times[] = {spent.hessians.seconds, spent.factorizations.seconds, all};
          for (int k = 0; k < 3; ++k) {
            cost[k].x.push_back(beam->n_unknowns());
            cost[k].y.push_back(1e3 * times[k] / n_steps);
          }
          const double m = beam->n_unknowns();
          rows.push_back({std::to_string(4 * n + 2), std::to_string(beam->n_unknowns()),
                          rounded(100 * beam->system.mass.plan()->fill(), 3) + " %",
                          rounded(1e-6 * spent.factorizations.work.flops / double(spent.factorizations.n), 4),
                          rounded(m * m * m / 3e6, 4)});
        }
        out << table({"parts", "unknowns", "stored of K", "Mflop to factor it", "if it were full"},
                     rows);
      },
      [&](Picture& picture) {
        draw_charts(picture, {{{.label = "unknowns", .logarithmic = true},
                               {.label = "time, ms", .logarithmic = true},
                               cost}});
      });
  return lesson.run(argc, argv);
}
// Next: step_08_convergence, a known answer.
