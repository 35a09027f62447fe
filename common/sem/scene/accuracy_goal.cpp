#include "sem/scene/accuracy_goal.h"

#include <algorithm>
#include <cmath>
#include <map>

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

constexpr double most_megabytes = 1000;
constexpr double finest_rule = 1e-5;  // weight_tolerance: beyond, a rule has 100000 points and more

// Before dependent functions are left out.
template <int Dim>
int most_unknowns(const Scene<Dim>& scene) {
  return Dim * (n_parts(scene) * (Monomials<Dim>(scene.method.projection.degree).size() + 1) + Dim + 1);
}

// Columns that belong together: a vector, a stress, a frequency.
struct Group {
  int size;
  ProbeKind kind;      // of the same kind: of the same unit
  double least_value;  // what its value counts as at least, in the value's unit
};

template <int Dim>
double size_of(const Scene<Dim>& scene) {
  Box<Dim> box;
  for (const auto& solid : scene.solids)
    for (const auto& part : solid.parts)
      for (const auto& X : part.shape.control_points.colwise()) box.include(Vec<Dim>(X));
  return box.diagonal();
}

template <int Dim>
std::vector<Group> groups(const Scene<Dim>& scene, size_t n_columns) {
  if (scene.analysis.kind == AnalysisKind::modes) {
    const Material& material = scene.solids.front().material;
    const double rigid = material.density > 0 ? 1e-5 * std::sqrt(material.youngs_modulus / material.density) / size_of(scene) : 0;
    return std::vector<Group>(n_columns, Group{1, ProbeKind::displacement, rigid});
  }
  std::vector<Group> groups;
  for (const auto& probe : scene.probes)
    groups.push_back({probe.kind == ProbeKind::stress ? Dim * (Dim + 1) / 2 : Dim, probe.kind, 0});
  return groups;
}

// The largest |error| / |value| of a group.
double relative(const std::vector<Group>& groups, const std::vector<double>& error, const std::vector<double>& value) {
  const auto length = [](const std::vector<double>& list, size_t first, int n) {
    return Eigen::Map<const Eigen::VectorXd>(list.data() + first, n).norm();
  };
  std::map<ProbeKind, double> longest;
  size_t c = 0;
  for (const Group& group : groups) {
    longest[group.kind] = std::max(longest[group.kind], length(value, c, group.size));
    c += size_t(group.size);
  }
  double largest = 0;
  c = 0;
  for (const Group& group : groups) {
    const double e = length(error, c, group.size);
    const double v = std::max({length(value, c, group.size), 1e-6 * longest[group.kind], group.least_value});
    if (e > 0) largest = std::max(largest, v > 0 ? e / v : INFINITY);
    c += size_t(group.size);
  }
  return largest;
}

// What a refinement leads to: an estimate of the refined scene costs as much more than the last one as the variation
// with that refinement cost more than the cheapest.
struct Cost {
  double seconds, megabytes;
};
Cost cost_after(const ErrorEstimate& estimate, const Variation& refined, double round_seconds) {
  double seconds = refined.seconds, megabytes = refined.megabytes, most = refined.megabytes;
  for (const auto& variation : estimate.variations) {
    if (!variation.failure.empty()) continue;
    seconds = std::min(seconds, variation.seconds);
    megabytes = std::min(megabytes, variation.megabytes);
    most = std::max(most, variation.megabytes);
  }
  return {round_seconds * refined.seconds / std::max(seconds, 1e-3), most * refined.megabytes / std::max(megabytes, 1e-3)};
}

template <int Dim>
struct Next {
  std::optional<Refinement> refinement;  // the one that changes most, of those that are within the limits
  std::string limit;                     // what stands against one that changes more
};

template <int Dim>
Next<Dim> next_refinement(const RefinedScene<Dim>& now, int max_unknowns, double seconds_left) {
  const auto groups_of = groups(now.scene, now.estimate.value.size());
  Next<Dim> next;
  double largest = 0, largest_refused = 0;
  for (const auto& variation : now.estimate.variations) {
    if (!variation.refinement || !variation.failure.empty()) continue;
    const double change = variation.factor * relative(groups_of, variation.change, now.estimate.value);
    Scene<Dim> finer = now.scene;
    if (!(change > 0) || !refine(finer, *variation.refinement)) continue;
    const Cost cost = cost_after(now.estimate, variation, now.rounds.back().seconds);
    std::string limit;
    if (most_unknowns(finer) > max_unknowns) limit = std::to_string(max_unknowns) + " unknowns";
    if (finer.method.interior_rule.weight_tolerance < finest_rule) limit = "the finest quadrature";
    if (cost.megabytes > most_megabytes) limit = "1000 MB";
    if (cost.seconds > seconds_left) limit = "accuracy_seconds";
    double& best = limit.empty() ? largest : largest_refused;
    if (change <= best) continue;
    best = change;
    if (limit.empty())
      next.refinement = variation.refinement;
    else
      next.limit = limit;
  }
  return next;
}

}  // namespace

template <int Dim>
double relative_error(const Scene<Dim>& scene, const ErrorEstimate& estimate) {
  return relative(groups(scene, estimate.value.size()), estimate.estimate, estimate.value);
}

template <int Dim>
RefinedScene<Dim> meet_accuracy(const Scene<Dim>& scene, const std::string& file, int max_unknowns, const Announce& announce) {
  if (scene.method.formulation != Formulation::condensed)
    throw InputError(file, "accuracy", "a goal with formulation 'projected', which does not converge",
                     "this only with method.formulation 'condensed'");
  if (scene.probes.empty() && scene.analysis.kind != AnalysisKind::modes)
    throw InputError(file, "accuracy", "a goal without a probe", "at least one probe that is to be so exact");
  RefinedScene<Dim> result;
  result.scene = scene;
  const Stopwatch all;
  while (true) {
    const Stopwatch watch;
    const auto& method = result.scene.method;
    const std::string round_name = "round " + std::to_string(result.rounds.size() + 1) + ", " + std::to_string(n_parts(result.scene)) +
                                   " parts, degree " + std::to_string(method.projection.degree) + ": ";
    result.estimate = estimate_error(result.scene, file, [&](const std::string& what) {
      if (announce) announce(round_name + what);
    });
    Round round{n_parts(result.scene), method.projection.degree, method.interior_rule.weight_tolerance,
                scene.analysis.kind == AnalysisKind::dynamics ? result.scene.analysis.time_step : 0};
    round.expected = relative_error(result.scene, result.estimate);
    round.seconds = watch.seconds();
    result.rounds.push_back(round);
    result.reached = round.expected <= scene.accuracy && result.estimate.complete();
    if (result.reached) return result;
    const auto next = next_refinement(result, max_unknowns, scene.accuracy_seconds - all.seconds());
    result.limit = next.limit;
    if (!next.refinement) return result;
    refine(result.scene, *next.refinement);
  }
}

template double relative_error<2>(const Scene<2>&, const ErrorEstimate&);
template double relative_error<3>(const Scene<3>&, const ErrorEstimate&);
template RefinedScene<2> meet_accuracy<2>(const Scene<2>&, const std::string&, int, const Announce&);
template RefinedScene<3> meet_accuracy<3>(const Scene<3>&, const std::string&, int, const Announce&);

}  // namespace sem
