#include "sem/scene/run.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "sem/base/error.h"
#include "sem/base/stopwatch.h"
#include "sem/base/text_lines.h"
#include "sem/base/version.h"
#include "sem/scene/accuracy.h"
#include "sem/scene/accuracy_goal.h"
#include "sem/scene/analysis.h"
#include "sem/scene/checkpoint.h"
#include "sem/scene/estimate.h"
#include "sem/scene/files.h"
#include "sem/scene/json_text.h"
#include "sem/scene/monitor.h"
#include "sem/scene/report.h"
#include "sem/scene/summary.h"
#include "sem/solve/modes.h"

namespace sem {
namespace {

using Json = nlohmann::ordered_json;

// What a checkpoint depends on: all settings but names, outputs and how long the run goes on.
template <int Dim>
std::string settings_fingerprint(const Scene<Dim>& scene) {
  Json settings;
  scene_to_json(scene, settings);
  for (const char* key : {"name", "description", "output"}) settings.erase(key);
  settings["method"].erase("threads");
  settings["analysis"].erase("duration");
  return fingerprint(settings.dump());
}

// The parts with the control points of a state, as a scene's `solids` has them.
template <int Dim>
std::string deformed_parts(const Scene<Dim>& scene, const Model<Dim>& model, const State& state) {
  Json json;
  scene_to_json(scene, json);
  Json& solids = json["solids"];
  int part = 0;
  const auto& boundary = model.discretization.boundary;
  const Points<Dim> p = control_points(model.discretization.unknowns, state.z);
  for (auto& solid : solids)
    for (auto& entry : solid["parts"]) {
      auto& points = entry["control_points"];
      for (int c = boundary.first_control[part]; c < boundary.first_control[part + 1]; ++c)
        points[c - boundary.first_control[part]] = std::vector<double>(p.col(c).begin(), p.col(c).end());
      ++part;
    }
  return json_text(Json{{"step", state.step}, {"time_s", state.time}, {"solids", solids}});
}

template <int Dim>
class Run {
 public:
  // refined: where the scene comes from if it has a goal of accuracy, else null.
  Run(const Scene<Dim>& scene, const RunOptions& options, const FrameCallback<Dim>& on_frame,
      const RefinedScene<Dim>* refined)
      : scene_(scene), options_(options), on_frame_(on_frame), refined_(refined) {}

  RunResult run() {
    if (options_.resume && scene_.analysis.kind != AnalysisKind::dynamics)
      throw InputError(options_.file, "--resume", "an analysis that is not dynamic", "a dynamic one: only these have checkpoints");
    progress(0, "preparing");
    model_ = build_model(scene_, options_.file);
    if (!options_.folder.empty() && !options_.resume) make_folder(options_.folder);
    accuracy_ = measure_accuracy(*model_);
    monitor_ = std::make_unique<Monitor<Dim>>(scene_, *model_);
    state_ = model_->initial;
    switch (scene_.analysis.kind) {
      case AnalysisKind::statics: run_statics(); break;
      case AnalysisKind::dynamics: run_dynamics(); break;
      case AnalysisKind::modes: run_modes(); break;
    }
    if (refined_) {
      estimate_ = refined_->estimate;
      for (const auto& round : refined_->rounds) estimate_seconds_ += round.seconds;
      append_formatted(result_.message, "; accuracy %.3g %s, %.2g expected", scene_.accuracy,
                       refined_->reached ? "met" : "NOT met", refined_->expected());
      if (!refined_->reached && !refined_->limit.empty()) result_.message += " (limit: " + refined_->limit + ")";
    }
    if (scene_.analysis.kind != AnalysisKind::modes) {
      const Stopwatch watch;
      folded_share_ = folded_share(*model_, state_.z);
      folds_seconds_ = watch.seconds();
    }
    write_results();  // whatever happens to the estimate
    if (!refined_ && scene_.output.error_estimate && result_.ok) {
      const Stopwatch watch;
      estimate_ = estimate_error(scene_, options_.file, *model_, values(), [&](const std::string& what) {
        progress(0, "estimating the error: " + what);
      });
      estimate_seconds_ = watch.seconds();
      write_results();
    }
    return result_;
  }

 private:
  void progress(double share, const std::string& what) const {
    if (options_.progress) options_.progress(share, what);
  }

  std::string path(const char* name) const { return options_.folder + "/" + name; }

  void frame(const State& state, int number) {
    if (!on_frame_ || scene_.output.frame_rate == 0) return;
    const Stopwatch watch;
    on_frame_(*model_, state, number);
    result_.n_frames = number + 1;
    output_seconds_ += watch.seconds();
  }

  void finish(const AnalysisReport& report, const std::string& done) {
    report_ = report;
    result_.ok = report.status == Status::converged;
    result_.message = result_.ok ? done : std::string("stopped: ") + describe(report.status);
  }

  void run_statics() {
    const AnalysisReport report = equilibrium(model_->system, scene_.analysis, model_->target, state_, model_->path);
    history_ = std::make_unique<Table>(monitor_->columns());
    history_->add(monitor_->row(state_, {}, int(report.iterations), report.residual, 1));
    frame(state_, 0);
    finish(report, "equilibrium after " + std::to_string(report.iterations) + " iterations");
  }

  void run_modes() {
    const Stopwatch watch;
    const Modes modes = vibration_modes(model_->system, state_.z, scene_.analysis.n_modes);
    AnalysisReport report;
    report.seconds = watch.seconds();
    report.status = modes.status;
    history_ = std::make_unique<Table>(
        std::vector<std::string>{"mode", "omega_rad_s", "frequency_Hz", "residual"});
    for (int m = 0; m < modes.omega.size(); ++m) {
      history_->add({m + 1.0, modes.omega[m], modes.omega[m] / (2 * M_PI), modes.residuals[m]});
      report.residual = std::max(report.residual, modes.residuals[m]);
      State shape = state_;
      shape.step = m + 1;
      const double largest = modes.shapes.col(m).cwiseAbs().maxCoeff();
      shape.z += 0.1 * model_->discretization.boundary.box.diagonal() / largest * modes.shapes.col(m);
      frame(shape, m);
    }
    finish(report, std::to_string(modes.omega.size()) + " modes");
  }

  void run_dynamics() {
    const std::string settings = settings_fingerprint(scene_);
    const double dt = scene_.analysis.time_step;
    const long last = n_steps(scene_.analysis);
    history_ = std::make_unique<Table>(monitor_->columns());
    if (options_.resume) {
      resume(settings, last);
    } else {
      history_->add(monitor_->row(state_, Eigen::VectorXd::Zero(state_.z.size()), 0, 0, 0));
      next_frame();
    }
    const double interval = scene_.output.checkpoint_interval;
    const long stride = interval > 0 ? std::max(1L, std::lround(interval / dt)) : last;
    const AnalysisReport report =
        march(model_->system, scene_.analysis, state_, [&](const State& now, const StepInfo& info) {
          history_->add(monitor_->row(now, info.acceleration, info.iterations, info.residual, info.n_substeps));
          next_frame();
          if (now.step % stride == 0 && now.step < last) checkpoint(settings);
          progress(double(now.step) / double(last), "simulating");
        }, model_->set_load());
    checkpoint(settings);
    const std::string reached = "t = " + exact_text(state_.time) + " s";
    finish(report, std::to_string(state_.step) + " steps to " + reached);
    if (!result_.ok) result_.message += " (step " + std::to_string(state_.step + 1) + ", after " + reached + ")";
  }

  void resume(const std::string& settings, long last) {
    const std::string file = path("checkpoint.bin");
    const Checkpoint saved = read_checkpoint(file, settings);
    if (saved.columns != history_->columns() || saved.state.z.size() != state_.z.size())
      throw InputError(file, "content", "other columns or another number of unknowns", "a checkpoint of this scene");
    if (saved.state.step > last)
      throw InputError(file, "step", std::to_string(saved.state.step), "at most the " + std::to_string(last) + " of the duration");
    state_ = saved.state;
    for (const auto& row : saved.history) history_->add(row);
    result_.n_frames = on_frame_ ? n_frames_until(state_.step) : 0;
  }

  // Frame f belongs to the first step at or after f / frame_rate; a step has at most one.
  int n_frames_until(long step) const {
    const double per_step = std::min(1.0, scene_.output.frame_rate * scene_.analysis.time_step);
    return per_step > 0 ? int((double(step) + 1e-6) * per_step) + 1 : 0;
  }
  void next_frame() {
    const int n = n_frames_until(state_.step);
    if (state_.step == 0 || n > n_frames_until(state_.step - 1)) frame(state_, n - 1);
  }

  // What an estimate judges, of every step after the start.
  std::vector<std::vector<double>> values() const {
    const AnalysisKind kind = scene_.analysis.kind;
    if (kind == AnalysisKind::modes) {
      std::vector<double> omega;
      for (int m = 0; m < history_->size(); ++m) omega.push_back(history_->row(m)[1]);
      return {omega};
    }
    std::vector<std::vector<double>> rows;
    for (int r = kind == AnalysisKind::dynamics ? 1 : 0; r < history_->size(); ++r) {
      const auto& row = history_->row(r);
      rows.emplace_back(row.end() - std::ptrdiff_t(monitor_->probe_columns().size()), row.end());
    }
    return rows;
  }

  void checkpoint(const std::string& settings) {
    if (options_.folder.empty()) return;
    Checkpoint checkpoint{settings, state_, history_->columns(), {}};
    for (int r = 0; r < history_->size(); ++r) checkpoint.history.push_back(history_->row(r));
    write_file(path("history.csv"), history_->text());
    write_checkpoint(path("checkpoint.bin"), checkpoint);
  }

  // ---- summary

  std::vector<StageCost> all_cost() const {
    std::vector<StageCost> cost = model_->cost;
    cost.push_back({"analysis", report_.seconds});
    if (scene_.analysis.kind != AnalysisKind::modes) cost.push_back({"folds", folds_seconds_});
    cost.push_back({"frames", output_seconds_});
    if (refined_ || scene_.output.error_estimate) cost.push_back({"error estimate", estimate_seconds_});
    return cost;
  }

  std::vector<StageError> all_errors() const {
    auto errors = stage_errors(model_->cost, accuracy_);
    errors.push_back({"analysis", report_.residual, "worst residual, by the forces"});
    if (scene_.analysis.kind != AnalysisKind::modes)
      errors.push_back({"folds", folded_share_, "share of the inside that is turned inside out"});
    if (!estimate_.columns.empty())
      errors.push_back({"error estimate", relative_error(scene_, estimate_), "largest estimated error of a probe or frequency, by its value"});
    return errors;
  }

  Json summary() const {
    const auto& d = model_->discretization;
    Json json;
    json["program"] = {{"version", version}, {"build_type", build_type}, {"compiler", compiler}};
    json["status"] = name(report_.status);
    json["message"] = result_.message;
    json["sizes"] = {{"parts", d.boundary.n_parts()},
                     {"unknowns", model_->n_unknowns()},
                     {"boundary_samples", d.samples.size()},
                     {"quadrature_points", d.quadrature.size()},
                     {"origins", d.origins.members.size()},
                     {"cutoff_m", d.theta.cutoff},
                     {"stability_stiffness_Pa_per_m", model_->stability_stiffness},
                     {"map_fill", d.interior.fill()},
                     {"mass_kg", model_->total_mass()},
                     {"frames", result_.n_frames}};
    json["stages"] = stages_json(all_cost(), all_errors());
    json["solver"] = solver_json(report_);
    json["accuracy"] = to_json(accuracy_);
    if (scene_.analysis.kind != AnalysisKind::modes) {
      json["accuracy"]["folded_share"] = folded_share_;
      json["accuracy"]["largest_boundary_mismatch"] = column_maximum(*history_, "boundary_mismatch");
    }
    if (scene_.analysis.kind == AnalysisKind::dynamics) json["accuracy"]["energy"] = energy_json(*history_);
    if (!estimate_.columns.empty())
      json["accuracy"]["solution"] = estimate_json(estimate_, monitor_->probe_truths());
    if (refined_) json["accuracy"]["goal"] = goal_json();
    scene_to_json(scene_, json["settings"]);
    return json;
  }

  Json goal_json() const {
    Json json = {{"asked", scene_.accuracy}, {"expected", refined_->expected()}, {"met", refined_->reached}};
    for (const auto& round : refined_->rounds) {
      json["rounds"].push_back({{"parts", round.n_parts},
                                {"degree", round.degree},
                                {"weight_tolerance", round.weight_tolerance},
                                {"expected", round.expected},
                                {"seconds", round.seconds}});
      if (round.time_step > 0) json["rounds"].back()["time_step_s"] = round.time_step;
    }
    return json;
  }

  void write_results() {
    result_.summary_json = json_text(summary());
    result_.report = report_text<Dim>({scene_, *model_, *monitor_, *history_, accuracy_, report_, estimate_, folded_share_,
                                       output_seconds_, estimate_seconds_});
    if (options_.folder.empty()) return;
    write_file(path("history.csv"), history_->text());
    write_file(path("final_state.json"), deformed_parts(scene_, *model_, state_));
    write_file(path("summary.json"), result_.summary_json);
  }

  const Scene<Dim>& scene_;
  const RunOptions& options_;
  const FrameCallback<Dim>& on_frame_;
  std::unique_ptr<Model<Dim>> model_;
  std::unique_ptr<Monitor<Dim>> monitor_;
  std::unique_ptr<Table> history_;
  Accuracy<Dim> accuracy_;
  ErrorEstimate estimate_;
  AnalysisReport report_;
  State state_;
  RunResult result_;
  const RefinedScene<Dim>* refined_;
  double output_seconds_ = 0, estimate_seconds_ = 0, folds_seconds_ = 0, folded_share_ = 0;
};

}  // namespace

template <int Dim>
RunResult run_scene(const Scene<Dim>& scene, const RunOptions& options, const FrameCallback<Dim>& on_frame) {
  if (scene.accuracy == 0) return Run<Dim>(scene, options, on_frame, nullptr).run();
  const RefinedScene<Dim> refined = meet_accuracy(scene, options.file, 3000, [&](const std::string& what) {
    if (options.progress) options.progress(0, "refining, " + what);
  });
  return Run<Dim>(refined.scene, options, on_frame, &refined).run();
}

template RunResult run_scene<2>(const Scene<2>&, const RunOptions&, const FrameCallback<2>&);
template RunResult run_scene<3>(const Scene<3>&, const RunOptions&, const FrameCallback<3>&);

}  // namespace sem
