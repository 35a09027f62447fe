// Step 13: a full scene
//
//   build/release/bin/sem2d_step_13_scene --out out/step_13            numbers, pictures
//   build/release/bin/sem2d_step_13_scene --set degree=1 --set E=1e5   another solid
//   build/release/bin/sem2d_step_13_scene --interactive                time as a slider in [5]
//
// New here: nothing of the method; all of it together, as the program runs it:
//
//   read_scene    JSON -> Scene: solids, method, loads, pins, probes, analysis
//   build_model   Scene -> Model: steps 1 to 9 once, then M, S, V, f, pins
//   TimeStepper   the model's System and State -> State, step by step
//   Monitor       State -> a row of history.csv; FramePainter: State -> a frame
//
// The scene is the program's default one: `build/release/bin/sem2d run blob --out out/blob` does
// all of this. Compare the counts and the accuracy with its summary.json, rows with history.csv,
// [5] with frames/. `sem2d export blob > mine.json` gives the text to start your own scene from,
// `sem2d schema` every key; --set there takes the same words as the overrides in [1].
//
// Things to try: --set cutoff=0.3: what happens to uncovered points in [2]? --set rays=6: which
// error of [3] shows in [6]? --set E=3e4 --until 5: what stretches, what swings?
#include <algorithm>

#include "sem/base/error.h"
#include "sem/lesson/lesson.h"
#include "sem/scene/accuracy.h"
#include "sem/scene/analysis.h"
#include "sem/scene/estimate.h"
#include "sem/scene/monitor.h"
#include "sem/scene/read_scene.h"
#include "sem/scene/run.h"
#include "sem/scene/builtin.h"
#include "src2d/shapes/shape_fields.h"
#include "src2d/tutorials/pictures.h"
#include "sem/lesson/plots.h"

using namespace sem;
using namespace sem::tutorial;

int main(int argc, char** argv) {
  Lesson lesson("Step 13: a full scene", {{-0.5, -0.4}, {2.7, 2.7}});
  const std::vector<Color> part_colors = {red, blue, colors::categorical(2)};  // as they are called

  // [1] Text to data. Sliders are overrides, as --set of the program is.
  int degree = 2, rays = 24;
  double cutoff = 1.5, E = 3e5;
  Scene<2> scene;
  lesson.slider("degree", degree, 1, 4, "of the deformation");
  lesson.slider("rays", rays, 4, 64, "through the body");
  lesson.slider("cutoff", cutoff, 0.2, 3, "of the weights, m");
  lesson.slider("E", E, 2e4, 1e7, "Young's modulus, Pa", Lesson::Scale::logarithmic);
  lesson.step(
      "read_scene: from text to data",
      [&](std::ostream& out) {
        std::string text;
        for (const auto& builtin : builtin_scenes<2>())
          if (builtin.name == "blob") text = builtin.text;
        scene = read_scene<2>(text, "blob", shapes2d::describe_shape,
                              {"method.degree=" + std::to_string(degree),
                               "method.quadrature.rays=" + std::to_string(rays),
                               "method.weights.cutoff=" + rounded(cutoff),
                               "solids[0].material.youngs_modulus=" + rounded(E),
                               "output.error_estimate=false"});  // [6] does it itself
        out << scene.description << "\n";
        for (const auto& part : scene.solids[0].parts)
          out << "  " << part.name << ": degree " << part.shape.degree[0] << ", "
              << part.shape.control_points.cols() << " control points\n";
        out << scene.pins.size() << " pin, " << scene.probes.size() << " probes; "
            << name(scene.analysis.integrator) << ", " << n_steps(scene.analysis) << " steps of "
            << rounded(scene.analysis.time_step) << " s\na mistake, --set method.degre=2:\n";
        try {
          read_scene<2>(text, "blob", shapes2d::describe_shape, {"method.degre=2"});
        } catch (const InputError& error) {
          out << "  " << error.what() << "\n";
        }
      },
      [&](Picture& picture) {
        for (int i = 0; const auto& part : scene.solids[0].parts) {
          const Points<2>& p = part.shape.control_points;
          picture.curve(p, {.color = part_colors[i], .width = 2});
          picture.dots(p, colors::gray, 10);
          picture.hover(p, [=](int k) { return part.name + ": " + coordinates(p.col(k)) + " m"; });
          picture.label(p.col(p.cols() / 2), part.name, part_colors[i++], {14, 0}, 22);
        }
        for (const auto& probe : scene.probes) {
          picture.dot(probe.at, colors::black, 18, MarkerShape::cross);
          const double right = probe.at[0] < 1 ? -18 : 18;
          picture.label(probe.at, "probe " + probe.name, colors::black, {right, 8});
        }
        picture.note("control points of the three parts, and the probes");
      });

  // [2] All that happens once per rest shape. What it costs is counted, not timed.
  std::unique_ptr<Model<2>> model;
  lesson.step(
      "build_model: from data to operators",
      [&](std::ostream& out) {
        model = build_model(scene, "blob");
        const auto& d = model->discretization;
        int n_hits = 0, n_coefficients = 0;
        for (const auto& ray : d.rays.rays) n_hits += int(ray.hits.size());
        for (const auto& fit : d.projection.parts) n_coefficients += int(fit.coefficients.rows());
        const auto count = [](auto n) { return std::to_string(n); };
        out << table({"stage", "makes", "count"},
                     {{"make_boundary", "parts", count(d.boundary.n_parts())},
                      {"sample_boundary", "samples", count(d.samples.size())},
                      {"cast_rays", "hits", count(n_hits)},
                      {"quadrature_on_rays", "points", count(d.quadrature.size())},
                      {"blending_weights", "weights > 0", count(d.weights.w.size())},
                      {"choose_origins", "origins", count(d.origins.members.size())},
                      {"project", "coefficients (x 2)", count(n_coefficients)},
                      {"blended_map", "blocks", count(d.interior.blocks.size())},
                      {"pins", "unknowns held", count(model->system.size() - model->n_unknowns())},
                      {"System", "unknowns left", count(model->n_unknowns())}})
            << "gamma = " << rounded(model->stability_stiffness, 4) << " Pa/m, mass "
            << rounded(model->total_mass()) << " kg\n";
      },
      [&](Picture& picture) {
        const auto& d = model->discretization;
        draw_weights(picture, d, part_colors);
        for (const auto& held : model->held)
          for (const int c : held.controls)
            picture.dot(d.unknowns.rest.col(c), colors::black, 15, MarkerShape::triangle);
        picture.legend({{"parts, and points coloured by their weights", colors::gray},
                        {"pinned control points", colors::black, MarkerShape::triangle}},
                       Picture::Corner::upper_left);
      });

  // [3] What can be known of the errors before anything is solved.
  std::vector<Trace> area_errors;
  lesson.step(
      "measure_accuracy: against the boundary's own truth",
      [&](std::ostream& out) {
        const Accuracy<2> accuracy = measure_accuracy(*model);
        const auto& d = model->discretization;
        out << "area: " << rounded(accuracy.quadrature.volume) << " m^2 by points, "
            << rounded(accuracy.boundary.volume) << " by the boundary; error "
            << error_text(accuracy.volume_error)
            << "\nuncovered share: " << rounded(accuracy.uncovered_share, 3)
            << "\nundeformed map: |x - X| / size " << error_text(accuracy.identity_error, 1e-10)
            << ", |F - I| " << error_text(accuracy.identity_gradient_error, 1e-10) << "\n";
        area_errors = {{"midpoints (this scene)", {}, {}}, {"Gauss", {}, {}}};
        for (const int n : {4, 6, 8, 12, 16, 24, 32, 48, 64, 96})
          for (const bool gauss : {false, true}) {
            const RayOptions options{0, n, gauss ? RayGrid::gauss : RayGrid::midpoint};
            const auto points = quadrature_on_rays(cast_rays(d.boundary, d.loops, options), {});
            area_errors[gauss].x.push_back(n);
            area_errors[gauss].y.push_back(
                std::abs(points.weight.sum() / accuracy.boundary.volume - 1));
          }
      },
      [&](Picture& picture) {
        draw_charts(picture, {{{.label = "rays", .lower = 3, .upper = 128, .logarithmic = true},
                               {.label = "relative error of the area", .logarithmic = true},
                               area_errors}});
      });

  // [4] Time. This loop is all of `sem2d run` but for its files; `history` is history.csv.
  std::vector<State> states;
  std::vector<std::vector<double>> history;
  std::vector<std::string> columns;
  lesson.step(
      "TimeStepper and Monitor: the solid moves, the probes watch",
      [&](std::ostream& out) {
        const Monitor<2> monitor(scene, *model);
        const double dt = scene.analysis.time_step;
        State state = model->initial;
        columns = monitor.columns();
        states = {state};
        history = {monitor.row(state, Eigen::VectorXd::Zero(state.z.size()), 0, 0, 0)};
        TimeStepper stepper(model->system, dt, scene.analysis.integrator);
        auto status = Status::converged;
        while (state.step < n_steps(scene.analysis)) {
          const Eigen::VectorXd v0 = state.v;
          const StepReport report = stepper.step(state);
          status = report.status;
          if (status != Status::converged) break;
          states.push_back(state);
          history.push_back(monitor.row(state, (state.v - v0) / dt, report.iterations,
                                        report.residual, report.n_substeps));
        }
        out << state.step << " steps: " << name(status) << "\n";
        std::vector<std::vector<std::string>> rows;
        for (std::size_t r = 0; r < history.size(); r += 40) {
          rows.push_back({rounded(history[r][1], 3), rounded(history[r][6], 4)});
          for (const double value : std::span(history[r]).last(4))
            rows.back().push_back(rounded(value, 4));
        }
        out << table({columns[1], columns[6], *(columns.end() - 4), *(columns.end() - 3),
                      *(columns.end() - 2), columns.back()},
                     rows);
      },
      [&](Picture& picture) {
        std::vector<Trace> energy, probe;
        const auto add = [&](std::size_t c, std::vector<Trace>& traces) {
          Trace& trace = traces.emplace_back(Trace{columns[c], {}, {}});
          for (const auto& row : history) {
            trace.x.push_back(row[1]);
            trace.y.push_back(row[c] - history[0][c]);
          }
        };
        for (std::size_t c = 2; c < 7; ++c) add(c, energy);
        for (std::size_t c = columns.size() - 4; c < columns.size(); ++c) add(c, probe);
        draw_charts(picture, {{{.label = "time, s"}, {.label = "energy gained, J"}, energy},
                              {{.label = "time, s"}, {.label = "displacement, m"}, probe}});
      });

  // [5] A frame, drawn by what draws the program's.
  double time = 0.6;
  int shown = 0;
  lesson.slider("time", time, 0, 2, "of the frame, s");
  lesson.step(
      "FramePainter: a frame",
      [&](std::ostream& out) {
        shown = std::min(int(states.size()) - 1, int(std::lround(time / scene.analysis.time_step)));
        out << "step " << shown << ", t = " << rounded(states[shown].time, 3) << " s\n";
      },
      [&](Picture& picture) {
        draw_frame(picture, scene, *model, states[shown]);  // FramePainter(scene).draw()
      });

  // [6] The same by one call, and how far to trust it: the run repeated with one setting changed.
  ErrorEstimate estimate;
  lesson.step(
      "run_scene: the same by one call, and an estimate of its error",
      [&](std::ostream& out) {
        State last;
        const RunResult result =
            run_scene<2>(scene, {"blob", "", false, nullptr},
                         [&](const Model<2>&, const State& state, int) { last = state; });
        const double difference = (last.z - states[last.step].z).norm();
        out << result.message << "; last frame - our state: " << error_text(difference) << " m\n";
        estimate = estimate_error(scene, "blob");
        std::vector<std::vector<std::string>> rows;
        for (std::size_t c = 0; c < estimate.columns.size(); ++c)
          rows.push_back({estimate.columns[c], rounded(estimate.value[c], 4),
                          rounded(estimate.estimate[c], 2)});
        out << table({"probe", "at the end", "estimated error"}, rows);
      },
      [&](Picture& picture) {
        std::vector<std::pair<std::string, double>> bars;
        for (const auto& variation : estimate.variations) {
          const auto& change = variation.change;
          bars.push_back({variation.setting, change.empty() ? 0 : *std::max_element(change.begin(), change.end())});
        }
        draw_bars(picture, "largest change of a probe, m", bars);
      });
  return lesson.run(argc, argv);
}
// Next: step_14_convergence, or your own scene: start from `sem2d export blob > mine.json`.
