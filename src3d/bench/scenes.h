#pragma once
// What a built-in scene costs: preparation by stage, the solve by task.

#include <string>
#include <vector>

#include "sem/scene/scene.h"
#include "sem/solve/work.h"

namespace sem {

/// What this machine does at best, on one thread, measured.
struct Machine {
  double flops = 0;  ///< a second, of a product of dense matrices that fit the caches (dense_kernels.h)
  double bytes = 0;  ///< a second, read and written while copying more than the caches hold: matrices that stay in
                     ///< them are faster

  /// The time that work takes at least, s.
  double bound(const Work& work) const { return std::max(work.flops / flops, work.bytes / bytes); }
  const char* bound_by(const Work& work) const { return work.flops / flops >= work.bytes / bytes ? "flops" : "bytes"; }
};
Machine measure_machine();

struct TaskTime {
  std::string name;
  Task task;  ///< of the whole run
};

struct SceneTime {
  std::string name, analysis;
  int n_parts = 0, n_unknowns = 0, n_points = 0;
  std::vector<StageCost> stages;  ///< medians of a few builds, elapsed
  double fill = 1;                ///< of the Hessian's factor: share of the entries of a full one
  double preprocessing = 0;       ///< their sum, s
  double solve = 0;               ///< processor time of a step (dynamic, median) or of the whole analysis, s
  long n_solves = 1;              ///< steps that `tasks` are of, or 1
  std::vector<TaskTime> tasks;

  /// The least time of all tasks of a step or analysis, s.
  double bound(const Machine& machine) const;
};

/// A scene built, and its analysis run: dynamic ones for 200 steps or 5 s of processor time. Throws
/// std::runtime_error if it fails.
template <int Dim>
SceneTime time_scene(const Scene<Dim>& scene);

/// The built-in scenes of a dimension; of 3D those that are dynamic.
template <int Dim>
std::vector<SceneTime> time_scenes();

}  // namespace sem
