#include "scenes.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "sem/scene/analysis.h"
#include "sem/scene/builtin.h"
#include "sem/scene/model.h"
#include "sem/scene/read_scene.h"
#include "sem/solve/dense_kernels.h"
#include "sem/solve/integrators.h"
#include "sem/solve/modes.h"
#include "src2d/shapes/shape_fields.h"
#include "src3d/shapes/shape_fields.h"
#include "sem/base/timing.h"

namespace sem {
namespace {

template <int Dim>
Scene<Dim> read(const BuiltinScene& builtin) {
  if constexpr (Dim == 2)
    return read_scene<2>(builtin.text, builtin.name, shapes2d::describe_shape);
  else
    return read_scene<3>(builtin.text, builtin.name, shapes3d::describe_shape);
}

// Medians of the stages over at least 3 builds, more while they are short; one if they are long.
template <int Dim>
std::unique_ptr<Model<Dim>> time_preprocessing(const Scene<Dim>& scene, SceneTime& time) {
  std::unique_ptr<Model<Dim>> model;
  std::vector<std::vector<double>> seconds;
  double spent = 0;
  for (int n = 0; n < 1 || (n < 3 && spent < 3) || (n < 15 && spent < 1); ++n) {
    model = build_model(scene, scene.name);
    seconds.resize(model->cost.size());
    for (size_t s = 0; s < seconds.size(); ++s) {
      seconds[s].push_back(model->cost[s].seconds);
      spent += model->cost[s].seconds;
    }
  }
  for (size_t s = 0; s < seconds.size(); ++s) {
    time.stages.push_back({model->cost[s].stage, median(seconds[s])});
    time.preprocessing += time.stages.back().seconds;
  }
  return model;
}

void require_converged(Status status, const std::string& scene) {
  if (status != Status::converged) throw std::runtime_error(scene + ": " + describe(status));
}

void set_tasks(const Counters& counters, SceneTime& time) {
  time.tasks = {{"energy", counters.energies},
                {"gradient", counters.gradients},
                {"Hessian", counters.hessians},
                {"factorization", counters.factorizations},
                {"solve", counters.solves}};
  std::erase_if(time.tasks, [](const TaskTime& t) { return t.task.n == 0; });
}

template <int Dim>
void time_steps(const Scene<Dim>& scene, const Model<Dim>& model, SceneTime& time) {
  TimeStepper stepper(model.system, scene.analysis.time_step, scene.analysis.integrator);
  State state = model.initial;
  std::vector<double> seconds;
  double spent = 0;
  for (time.n_solves = 0; time.n_solves < std::min(n_steps(scene.analysis), 200l) && spent < 5; ++time.n_solves) {
    const double start = thread_seconds();
    require_converged(stepper.step(state).status, scene.name);
    seconds.push_back(thread_seconds() - start);
    spent += seconds.back();
  }
  set_tasks(stepper.counters(), time);
  time.solve = median(seconds);
}

template <int Dim>
void time_solve(const Scene<Dim>& scene, const Model<Dim>& model, SceneTime& time) {
  if (scene.analysis.kind == AnalysisKind::dynamics) return time_steps(scene, model, time);
  const double start = thread_seconds();
  State state = model.initial;
  if (scene.analysis.kind == AnalysisKind::statics) {
    const AnalysisReport report = equilibrium(model.system, scene.analysis, model.target, state);
    require_converged(report.status, scene.name);
    set_tasks(report.counters, time);
  } else {
    require_converged(vibration_modes(model.system, state.z, scene.analysis.n_modes).status, scene.name);
  }
  time.solve = thread_seconds() - start;
}

// The least of a few calls.
template <class Call>
double seconds_at_best(const Call& call) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 20; ++i) {
    const Stopwatch watch;
    call();
    least = std::min(least, watch.seconds());
  }
  return least;
}

}  // namespace

Machine measure_machine() {
  double flops = 0;
  for (const int n : {96, 128, 256, 512}) {
    std::vector<double> A(n * n, 1), B(n * n, 1), C(n * n, 0);
    const double product = seconds_at_best([&] {
      dense_kernels().add_product(C.data(), n, A.data(), n, B.data(), n, n, n, n);
    });
    flops = std::max(flops, 2.0 * n * n * n / product);
  }
  const size_t size = size_t(64) << 20;
  std::vector<char> from(size, 1), to(size, 0);
  const double copy = seconds_at_best([&] { std::memcpy(to.data(), from.data(), size); });
  return {flops, 2 * double(size) / copy};
}

double SceneTime::bound(const Machine& machine) const {
  double sum = 0;
  for (const auto& timed : tasks) sum += machine.bound(timed.task.work);
  return sum / double(n_solves);
}

template <int Dim>
SceneTime time_scene(const Scene<Dim>& scene) {
  SceneTime time;
  time.name = scene.name;
  time.analysis = scene.analysis.kind == AnalysisKind::dynamics  ? "step"
                  : scene.analysis.kind == AnalysisKind::statics ? "statics"
                                                                 : "modes";
  const auto model = time_preprocessing(scene, time);
  time.n_parts = model->discretization.boundary.n_parts();
  time.n_unknowns = model->n_unknowns();
  time.n_points = model->discretization.quadrature.size();
  const auto plan = model->system.potential->new_hessian().plan();
  if (plan) time.fill = plan->fill();
  time_solve(scene, *model, time);
  return time;
}

template <int Dim>
std::vector<SceneTime> time_scenes() {
  std::vector<SceneTime> times;
  for (const auto& builtin : builtin_scenes<Dim>()) {
    Scene<Dim> scene = read<Dim>(builtin);
    scene.name = builtin.name;
    if (Dim == 2 || scene.analysis.kind == AnalysisKind::dynamics) times.push_back(time_scene(scene));
  }
  return times;
}

template SceneTime time_scene(const Scene<2>&);
template SceneTime time_scene(const Scene<3>&);
template std::vector<SceneTime> time_scenes<2>();
template std::vector<SceneTime> time_scenes<3>();

}  // namespace sem
