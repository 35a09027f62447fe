#pragma once
// "accuracy": a scene that says how exact its probes are to be, and is refined until they are.

#include "sem/scene/estimate.h"

namespace sem {

/// What was tried on the way.
struct Round {
  int n_parts = 0, degree = 0;
  double weight_tolerance = 0, time_step = 0;
  double expected = 0;  ///< relative error by the estimate
  double seconds = 0;
};

template <int Dim>
struct RefinedScene {
  Scene<Dim> scene;
  ErrorEstimate estimate;     ///< of this scene
  std::vector<Round> rounds;  ///< the last one is this scene's
  bool reached = false;

  double expected() const { return rounds.back().expected; }
};

/// The largest estimated error of a probe (a frequency), relative to the length of the probe's value.
template <int Dim>
double relative_error(const Scene<Dim>& scene, const ErrorEstimate& estimate);

/// Estimates the error and makes that setting finer which changes the probes most (quadrature, parts, degree,
/// time step), until the estimate is below scene.accuracy and lacks no refinement, or the next one would exceed `max_unknowns` or a
/// weight_tolerance of 1e-5.
/// Condensed formulation only, with at least one probe or modes: InputError (field `accuracy`) otherwise.
template <int Dim>
RefinedScene<Dim> meet_accuracy(const Scene<Dim>& scene, const std::string& file, int max_unknowns = 3000);

}  // namespace sem
