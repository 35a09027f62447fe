#include "sem/scene/accuracy_goal.h"

#include <algorithm>
#include <cmath>

#include "sem/base/error.h"
#include "sem/base/stopwatch.h"
#include "sem/method/monomials.h"

namespace sem {
namespace {

template <int Dim>
int n_parts(const Scene<Dim>& scene) {
  int n = 0;
  for (const auto& solid : scene.solids) n += int(solid.parts.size());
  return n;
}

constexpr double finest_rule = 1e-5;  // weight_tolerance: beyond, a rule has 100000 points and more

// Before dependent functions are left out.
template <int Dim>
int most_unknowns(const Scene<Dim>& scene) {
  return Dim * (n_parts(scene) * (Monomials<Dim>(scene.method.projection.degree).size() + 1) + Dim + 1);
}

// Sizes of the groups of columns that belong together: a vector, a stress, a frequency.
template <int Dim>
std::vector<int> groups(const Scene<Dim>& scene, size_t n_columns) {
  if (scene.analysis.kind == AnalysisKind::modes) return std::vector<int>(n_columns, 1);
  std::vector<int> sizes;
  for (const auto& probe : scene.probes)
    sizes.push_back(probe.kind == ProbeKind::stress ? Dim * (Dim + 1) / 2 : Dim);
  return sizes;
}

// The largest |error| / |value| of a group.
double relative(const std::vector<int>& sizes, const std::vector<double>& error, const std::vector<double>& value) {
  double largest = 0;
  size_t c = 0;
  for (const int size : sizes) {
    double e = 0, v = 0;
    for (const size_t end = c + size; c < end; ++c) {
      e += error[c] * error[c];
      v += value[c] * value[c];
    }
    if (e > 0) largest = std::max(largest, v > 0 ? std::sqrt(e / v) : INFINITY);
  }
  return largest;
}

// The refinement that changes most, among those that can be made within the limit.
template <int Dim>
std::optional<Refinement> best_refinement(const Scene<Dim>& scene, const ErrorEstimate& estimate, int max_unknowns) {
  const auto sizes = groups(scene, estimate.value.size());
  std::optional<Refinement> best;
  double largest = 0;
  for (const auto& variation : estimate.variations) {
    if (!variation.refinement || !variation.failure.empty()) continue;
    Scene<Dim> finer = scene;
    const double change = variation.factor * relative(sizes, variation.change, estimate.value);
    if (change <= largest || !refine(finer, *variation.refinement) || most_unknowns(finer) > max_unknowns) continue;
    if (finer.method.interior_rule.weight_tolerance < finest_rule) continue;
    best = variation.refinement;
    largest = change;
  }
  return best;
}

}  // namespace

template <int Dim>
double relative_error(const Scene<Dim>& scene, const ErrorEstimate& estimate) {
  return relative(groups(scene, estimate.value.size()), estimate.estimate, estimate.value);
}

template <int Dim>
RefinedScene<Dim> meet_accuracy(const Scene<Dim>& scene, const std::string& file, int max_unknowns) {
  if (scene.method.formulation != Formulation::condensed)
    throw InputError(file, "accuracy", "a goal with formulation 'projected', which does not converge",
                     "this only with method.formulation 'condensed'");
  if (scene.probes.empty() && scene.analysis.kind != AnalysisKind::modes)
    throw InputError(file, "accuracy", "a goal without a probe", "at least one probe that is to be so exact");
  RefinedScene<Dim> result;
  result.scene = scene;
  while (true) {
    const Stopwatch watch;
    result.estimate = estimate_error(result.scene, file);
    const auto& method = result.scene.method;
    Round round{n_parts(result.scene), method.projection.degree, method.interior_rule.weight_tolerance,
                scene.analysis.kind == AnalysisKind::dynamics ? result.scene.analysis.time_step : 0};
    round.expected = relative_error(result.scene, result.estimate);
    round.seconds = watch.seconds();
    result.rounds.push_back(round);
    result.reached = round.expected <= scene.accuracy && result.estimate.complete();
    if (result.reached) return result;
    const auto next = best_refinement(result.scene, result.estimate, max_unknowns);
    if (!next) return result;
    refine(result.scene, *next);
  }
}

template double relative_error<2>(const Scene<2>&, const ErrorEstimate&);
template double relative_error<3>(const Scene<3>&, const ErrorEstimate&);
template RefinedScene<2> meet_accuracy<2>(const Scene<2>&, const std::string&, int);
template RefinedScene<3> meet_accuracy<3>(const Scene<3>&, const std::string&, int);

}  // namespace sem
