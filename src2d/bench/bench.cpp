// sem_bench: what the geometry kernels and the built-in scenes cost.
#include <cstdio>
#include <cstring>
#include <exception>
#include <nlohmann/json.hpp>

#include "kernels.h"
#include "sem/base/version.h"
#include "sem/scene/analysis.h"
#include "sem/scene/json_text.h"
#include "sem/scene/model.h"
#include "sem/scene/read_scene.h"
#include "sem/solve/modes.h"
#include "sem/scene/builtin.h"
#include "src2d/shapes/shape_fields.h"
#include "timing.h"

namespace {

using namespace sem;
using Json = nlohmann::ordered_json;

struct SceneTime {
  std::string name, analysis;
  int n_parts = 0, n_unknowns = 0, n_points = 0;
  std::vector<StageCost> stages;  ///< medians of a few builds, elapsed
  double preprocessing = 0;       ///< their sum, s
  double solve = 0;  ///< processor time of a step (dynamic, median) or of the whole analysis, s
};

// Medians of the stages over at least 3 builds, more while they are short.
std::unique_ptr<Model<2>> time_preprocessing(const Scene<2>& scene, SceneTime& time) {
  std::unique_ptr<Model<2>> model;
  std::vector<std::vector<double>> seconds;
  double spent = 0;
  for (int n = 0; n < 3 || (n < 15 && spent < 1); ++n) {
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

double time_step(const Scene<2>& scene, const Model<2>& model) {
  TimeStepper stepper(model.system, scene.analysis.time_step, scene.analysis.integrator);
  State state = model.initial;
  const long n = std::min(n_steps(scene.analysis), 200l);
  std::vector<double> seconds;
  for (long step = 0; step < n; ++step) {
    const double start = thread_seconds();
    require_converged(stepper.step(state).status, scene.name);
    seconds.push_back(thread_seconds() - start);
  }
  return median(seconds);
}

double time_solve(const Scene<2>& scene, const Model<2>& model) {
  if (scene.analysis.kind == AnalysisKind::dynamics) return time_step(scene, model);
  const double start = thread_seconds();
  State state = model.initial;
  require_converged(scene.analysis.kind == AnalysisKind::statics
                        ? equilibrium(model.system, scene.analysis, model.target, state).status
                        : vibration_modes(model.system, state.z, scene.analysis.n_modes).status,
                    scene.name);
  return thread_seconds() - start;
}

SceneTime time_scene(const BuiltinScene& builtin) {
  const Scene<2> scene = read_scene<2>(builtin.text, builtin.name, shapes2d::describe_shape);
  SceneTime time;
  time.name = builtin.name;
  time.analysis = scene.analysis.kind == AnalysisKind::dynamics  ? "step"
                  : scene.analysis.kind == AnalysisKind::statics ? "statics"
                                                                 : "modes";
  const auto model = time_preprocessing(scene, time);
  time.n_parts = model->discretization.boundary.n_parts();
  time.n_unknowns = model->n_unknowns();
  time.n_points = model->discretization.quadrature.size();
  time.solve = time_solve(scene, *model);
  return time;
}

void print_json(const std::vector<KernelTime>& kernels, const std::vector<SceneTime>& scenes) {
  Json json{{"version", version}, {"build_type", build_type}, {"compiler", compiler}};
  for (const auto& kernel : kernels) {
    Json entry{{"name", kernel.name}, {"ns", 1e9 * kernel.seconds}};
    if (kernel.textbook > 0) entry["textbook_ns"] = 1e9 * kernel.textbook;
    if (kernel.target > 0) entry["target_ns"] = 1e9 * kernel.target;
    json["kernels"].push_back(entry);
  }
  for (const auto& scene : scenes) {
    Json stages;
    for (const auto& stage : scene.stages) stages[stage.stage + "_ms"] = 1e3 * stage.seconds;
    json["scenes"].push_back({{"name", scene.name},
                              {"parts", scene.n_parts},
                              {"unknowns", scene.n_unknowns},
                              {"points", scene.n_points},
                              {"preprocessing_ms", 1e3 * scene.preprocessing},
                              {"stages", stages},
                              {scene.analysis + "_ms", 1e3 * scene.solve}});
  }
  std::printf("%s\n", json_text(json).c_str());
}

void print_tables(const std::vector<KernelTime>& kernels, const std::vector<SceneTime>& scenes) {
  std::printf("sem %s, %s build, %s\n\n", version, build_type, compiler);
  std::printf("%-40s %10s %10s %12s %7s\n", "geometry kernel", "ns/call", "target ns", "textbook ns",
              "ratio");
  for (const auto& kernel : kernels) {
    std::printf("%-40s %10.1f", kernel.name.c_str(), 1e9 * kernel.seconds);
    kernel.target > 0 ? std::printf(" %10.0f", 1e9 * kernel.target) : std::printf(" %10s", "");
    if (kernel.textbook > 0)
      std::printf(" %12.1f %7.2f", 1e9 * kernel.textbook, kernel.seconds / kernel.textbook);
    std::printf("\n");
  }
  std::printf("\n%-18s %6s %9s %7s %15s %20s\n", "scene", "parts", "unknowns", "points",
              "preprocess ms", "solve ms");
  for (const auto& scene : scenes)
    std::printf("%-18s %6d %9d %7d %15.2f %9.3f a %-8s\n", scene.name.c_str(), scene.n_parts,
                scene.n_unknowns, scene.n_points, 1e3 * scene.preprocessing, 1e3 * scene.solve,
                scene.analysis.c_str());
  std::printf("\npreprocessing by stage, ms\n");
  for (const auto& scene : scenes) {
    std::printf("%-18s", scene.name.c_str());
    for (const auto& stage : scene.stages)
      if (stage.seconds >= 5e-6) std::printf("  %s %.2f", stage.stage.c_str(), 1e3 * stage.seconds);
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const bool json = argc == 2 && !std::strcmp(argv[1], "--json");
  if (argc > 1 && !json) {
    std::fprintf(stderr, "usage: sem_bench [--json]\n");
    return 2;
  }
  const auto kernels = time_kernels();
  std::vector<SceneTime> scenes;
  for (const auto& builtin : builtin_scenes<2>()) scenes.push_back(time_scene(builtin));
  json ? print_json(kernels, scenes) : print_tables(kernels, scenes);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "sem_bench: %s\n", error.what());
  return 1;
}
