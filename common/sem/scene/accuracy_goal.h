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
  std::string limit;          ///< what stands against the refinement that would help most; empty: there is none

  double expected() const { return rounds.back().expected; }
};

/// The largest estimated error of a probe (a frequency), relative to the length of the probe's value, or to a
/// millionth of the longest of its kind, where that is more: what stays at zero has no error of its own size. A frequency
/// counts as at least 1e-5 of (speed of sound) / (size): rigid modes.
template <int Dim>
double relative_error(const Scene<Dim>& scene, const ErrorEstimate& estimate);

/// Estimates the error and makes that setting finer which changes the probes most (quadrature, parts, degree,
/// time step), until the estimate is below scene.accuracy and lacks no refinement, or what is next would exceed
/// `max_unknowns`, scene.accuracy_seconds (by the times measured so far), models of 1000 MB or a weight_tolerance of 1e-5.
/// Condensed formulation only, with at least one probe or modes: InputError (field `accuracy`) otherwise.
template <int Dim>
RefinedScene<Dim> meet_accuracy(const Scene<Dim>& scene, const std::string& file, int max_unknowns = 3000,
                                const Announce& announce = {});

}  // namespace sem
