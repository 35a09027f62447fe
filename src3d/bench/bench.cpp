// sem_bench: what the geometry kernels and the built-in scenes cost, and how far a step is from
// what the machine allows.
#include <cstdio>
#include <cstring>
#include <exception>
#include <nlohmann/json.hpp>

#include "kernels.h"
#include "published.h"
#include "scenes.h"
#include "sem/base/version.h"
#include "sem/scene/json_text.h"

namespace {

using namespace sem;
using Json = nlohmann::ordered_json;

Json tasks_json(const SceneTime& scene, const Machine& machine) {
  Json json = Json::object();
  for (const auto& [name, task] : scene.tasks) {
    const double n = double(task.n);
    json[name] = {{"calls", task.n},
                  {"ms", 1e3 * task.seconds / n},
                  {"flops", task.work.flops / n},
                  {"bytes", task.work.bytes / n},
                  {"bound_ms", 1e3 * machine.bound(task.work) / n},
                  {"bound_by", machine.bound_by(task.work)}};
  }
  return json;
}

void print_json(const Machine& machine, const std::vector<KernelTime>& kernels,
                const std::vector<SceneTime>& scenes) {
  Json json{{"version", version}, {"build_type", build_type}, {"compiler", compiler}};
  json["machine"] = {{"flops_per_second", machine.flops}, {"bytes_per_second", machine.bytes}};
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
                              {scene.analysis + "_ms", 1e3 * scene.solve},
                              {"bound_ms", 1e3 * scene.bound(machine)},
                              {"tasks", tasks_json(scene, machine)}});
  }
  std::printf("%s\n", json_text(json).c_str());
}

void print_kernels(const std::vector<KernelTime>& kernels) {
  std::printf("%-40s %10s %10s %12s %7s\n", "geometry kernel", "ns/call", "target ns",
              "textbook ns", "ratio");
  for (const auto& kernel : kernels) {
    std::printf("%-40s %10.1f", kernel.name.c_str(), 1e9 * kernel.seconds);
    kernel.target > 0 ? std::printf(" %10.0f", 1e9 * kernel.target) : std::printf(" %10s", "");
    if (kernel.textbook > 0)
      std::printf(" %12.1f %7.2f", 1e9 * kernel.textbook, kernel.seconds / kernel.textbook);
    std::printf("\n");
  }
}

void print_scenes(const Machine& machine, const std::vector<SceneTime>& scenes) {
  std::printf("\n%-20s %6s %9s %7s %15s %20s %10s %7s\n", "scene", "parts", "unknowns", "points",
              "preprocess ms", "solve ms", "bound ms", "factor");
  for (const auto& scene : scenes) {
    std::printf("%-20s %6d %9d %7d %15.2f %9.3f a %-8s", scene.name.c_str(), scene.n_parts,
                scene.n_unknowns, scene.n_points, 1e3 * scene.preprocessing, 1e3 * scene.solve,
                scene.analysis.c_str());
    const double bound = scene.bound(machine);
    if (bound > 0) std::printf(" %10.3f %7.1f", 1e3 * bound, scene.solve / bound);
    std::printf("\n");
  }
  std::printf("\npreprocessing by stage, ms\n");
  for (const auto& scene : scenes) {
    std::printf("%-20s", scene.name.c_str());
    for (const auto& stage : scene.stages)
      if (stage.seconds >= 5e-6) std::printf("  %s %.2f", stage.stage.c_str(), 1e3 * stage.seconds);
    std::printf("\n");
  }
}

// Bounds: matrix products and factors at the machine's best rate, see Work and Machine.
void print_tasks(const Machine& machine, const std::vector<SceneTime>& scenes) {
  std::printf("\nbounds: %.1f GFlop/s (product of dense matrices), %.1f GB/s (copy), one thread\n",
              1e-9 * machine.flops, 1e-9 * machine.bytes);
  std::printf("%-20s %-14s %8s %10s %10s %10s %10s %6s %7s\n", "scene", "task", "calls", "ms/call",
              "MFlop", "MB", "bound ms", "by", "factor");
  for (const auto& scene : scenes)
    for (const auto& [name, task] : scene.tasks) {
      const double n = double(task.n), bound = machine.bound(task.work);
      std::printf("%-20s %-14s %8ld %10.4f %10.3f %10.3f %10.4f %6s %7.1f\n", scene.name.c_str(),
                  name.c_str(), task.n, 1e3 * task.seconds / n, 1e-6 * task.work.flops / n,
                  1e-6 * task.work.bytes / n, 1e3 * bound / n, machine.bound_by(task.work),
                  bound > 0 ? task.seconds / bound : 0);
    }
}

// Beside their times, the paper's of another machine; "-" where they tell none.
void print_published(const std::vector<PublishedTime>& times) {
  const auto cell = [](double value, int digits) {
    char text[32] = "-";
    if (value > 0) std::snprintf(text, sizeof text, "%.*f", digits, value);
    return std::string(text);
  };
  std::printf("%-12s %13s %8s %11s %22s %13s %9s %22s %13s\n", "", "unknowns", "points", "fill %",
              "step ms", "theirs / ours", "factor ms", "preprocessing ms", "theirs / ours");
  std::printf("%-12s %6s %6s %8s %5s %5s %11s %10s %6s %6s %9s %11s %10s %6s %6s\n", "scene",
              "theirs", "ours", "ours", "theirs", "ours", "theirs", "ours", "", "aim", "ours",
              "theirs", "ours", "", "aim");
  for (const auto& t : times) {
    double factorization = 0;
    for (const auto& [task, times_of_task] : t.own.tasks)
      if (task == "factorization") factorization = times_of_task.seconds / double(t.own.n_solves);
    std::printf("%-12s %6d %6d %8d %6s %5.0f %11.0f %10.2f %6.0f %6.0f %9.2f %11s %10.0f %6s %6s\n",
                t.name.c_str(), t.n_unknowns, t.own.n_unknowns, t.own.n_points,
                cell(t.fill, 0).c_str(), 100 * t.own.fill, 1e3 * t.step, 1e3 * t.own.solve,
                t.step / t.own.solve, t.aim, 1e3 * factorization,
                cell(1e3 * t.preprocessing, 0).c_str(), 1e3 * t.own.preprocessing,
                cell(t.preprocessing / t.own.preprocessing, 0).c_str(),
                cell(t.preprocessing_aim, 0).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const bool json = argc == 2 && !std::strcmp(argv[1], "--json");
  const bool published = argc == 2 && !std::strcmp(argv[1], "--published");
  if (argc > 1 && !json && !published) {
    std::fprintf(stderr, "usage: sem_bench [--json | --published]\n");
    return 2;
  }
  if (published) {
    print_published(time_published());
    return 0;
  }
  const auto kernels = time_kernels();
  const Machine machine = measure_machine();
  std::vector<SceneTime> scenes = time_scenes<2>();
  for (auto& scene : time_scenes<3>()) scenes.push_back(std::move(scene));
  if (json) {
    print_json(machine, kernels, scenes);
    return 0;
  }
  std::printf("sem %s, %s build, %s\n\n", version, build_type, compiler);
  print_kernels(kernels);
  print_scenes(machine, scenes);
  print_tasks(machine, scenes);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "sem_bench: %s\n", error.what());
  return 1;
}
