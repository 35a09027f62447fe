#pragma once
// How wrong the probes may be: the run repeated with one setting changed at a time.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sem/scene/model.h"

namespace sem {

/// What makes the answer more exact.
enum class Refinement { quadrature, parts, degree, time_step };

/// Told of each piece of work before it begins; may be empty.
using Announce = std::function<void(const std::string& what)>;

/// What changing one setting did to the probes (to the frequencies, in a modal analysis).
struct Variation {
  std::string setting;          ///< "twice the rays and points", ...
  std::optional<Refinement> refinement = {};  ///< if it is one
  double factor = 1;            ///< change times this counts as error
  std::vector<double> change;   ///< per value: the largest difference over the times of the run
  double seconds = 0, megabytes = 0;  ///< of the run; of its model (Model::megabytes)
  std::string failure;          ///< why there is no result; then `change` is empty
};

/// An estimate of the solution's error, not a bound: what it is insensitive to
/// it does not see. The paper's map does not converge, so no refinement alone
/// can be trusted; the cutoff is varied for that reason. The condensed formulation does: if its error falls
/// at least by half with the parts halved or a degree more, it is at most twice what that changes.
struct ErrorEstimate {
  std::vector<std::string> columns;  ///< probe columns, or mode_1_rad_s, ...
  std::vector<double> value;         ///< at the end of the run
  std::vector<double> estimate;      ///< per column: the largest factor * change by any variation
  std::vector<Variation> variations;

  /// No refinement failed: one that did might have changed the most.
  bool complete() const;
};

/// Nothing to judge (no probes, and no modes): no columns, and nothing is run. Otherwise
/// repeats the analysis with: twice the rays and points; every part halved;
/// twice gamma (condensed: the clamps' penalty); 1.5 times the cutoff; one polynomial degree more (projected:
/// one less at degree 4); half the time step (dynamics; twice that change for a method of first
/// order, 4/3 of it for one of second).
template <int Dim>
ErrorEstimate estimate_error(const Scene<Dim>& scene, const std::string& file, const Announce& announce = {});
/// The same where the scene's own analysis has been run: on `model`, with `original` the values of the columns at
/// every step after the start (statics, modes: one row).
template <int Dim>
ErrorEstimate estimate_error(const Scene<Dim>& scene, const std::string& file, const Model<Dim>& model,
                             const std::vector<std::vector<double>>& original, const Announce& announce = {});

/// The scene whose error is estimated before a run: its linear response. All materials are linear, and a dynamic
/// analysis becomes the equilibrium under its loads.
template <int Dim>
Scene<Dim> linear_response(Scene<Dim> scene);

/// Makes one setting finer: parts and time step halved, one degree more, rules as above. False, and nothing
/// changed, where that cannot be: degree 4, parts whose control points pins name by index, no time step.
template <int Dim>
bool refine(Scene<Dim>& scene, Refinement refinement);

}  // namespace sem
