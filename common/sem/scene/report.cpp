#include "sem/scene/report.h"

#include <cmath>

#include "sem/base/text_lines.h"
#include "sem/base/version.h"
#include "sem/scene/accuracy_goal.h"
#include "sem/scene/summary.h"

namespace sem {
namespace {

// Shares and relative errors from which on the user is warned.
constexpr double doubtful_volume = 0.05, doubtful_share = 0.01, doubtful_value = 0.2;

// "0.0123 (0.4 %)": an error in the unit of the value, and by the size of the value.
std::string with_percent(double error, double value) {
  char text[60];
  const double share = error / std::abs(value);
  if (share < 1)
    std::snprintf(text, sizeof text, "%.2g (%.2g %%)", error, 100 * share);
  else
    std::snprintf(text, sizeof text, "%.2g", error);
  return text;
}

template <int Dim>
class Report {
 public:
  explicit Report(const FinishedRun<Dim>& run) : run_(run) {}

  std::string text() {
    cost();
    accuracy();
    if (run_.scene.analysis.kind == AnalysisKind::modes) modes();
    else probes();
    warnings();
    return text_;
  }

 private:
  template <class... Values>
  void add(const char* format, const Values&... values) {
    append_formatted(text_, format, values...);
  }

  bool stopped() const { return run_.analysis.status != Status::converged; }

  void cost() {
    double preparing = 0;
    for (const auto& stage : run_.model.cost) preparing += stage.seconds;
    add("cost:     %d unknowns, %d points; preparation %.3g s, ", run_.model.n_unknowns(),
        run_.model.discretization.quadrature.size(), preparing);
    if (run_.scene.analysis.kind == AnalysisKind::dynamics && run_.analysis.n_steps > 0)
      add("%ld steps of %.3g ms", run_.analysis.n_steps, 1e3 * run_.analysis.seconds / double(run_.analysis.n_steps));
    else
      add("analysis %.3g s", run_.analysis.seconds);
    if (run_.frames_seconds > 0) add(", frames %.3g s", run_.frames_seconds);
    if (!run_.estimate.columns.empty()) add(", error estimate %.3g s", run_.estimate_seconds);
    add(" (%s build)\n", build_type);
  }

  void accuracy() {
    const auto& a = run_.accuracy;
    if (a.boundary.available)
      add("accuracy: %s off by %.2g (relative), second moments by %.2g; ", DimTraits<Dim>::volume_name, a.volume_error,
          a.second_moment_error);
    else
      add("accuracy: %s not checked (parts overlap, or leave gaps); ", DimTraits<Dim>::volume_name);
    add("uncovered %.2g\n", a.uncovered_share);
  }

  // ", estimated error ..." of a value, if there is one.
  std::string estimated(const std::string& column, double value) const {
    for (size_t c = 0; c < run_.estimate.columns.size(); ++c)
      if (run_.estimate.columns[c] == column) return ", estimated error " + with_percent(run_.estimate.estimate[c], value);
    return "";
  }

  void probes() {
    const auto& names = run_.monitor.probe_columns();
    if (stopped() && !names.empty()) add("%s", "          values before it stopped:\n");
    const size_t first = run_.history.columns().size() - names.size();
    for (size_t probe = 0; probe < names.size(); ++probe) {
      const double value = run_.history.row(run_.history.size() - 1)[first + probe];
      char shown[40];
      std::snprintf(shown, sizeof shown, "%.6g", value);
      add("          %s = %s", names[probe].c_str(), std::isfinite(value) ? shown : "no value");
      const auto truth = run_.monitor.probe_truths()[probe];
      if (truth && !stopped()) add(", truth %.6g: error %s", *truth, with_percent(std::abs(value - *truth), *truth).c_str());
      add("%s\n", estimated(names[probe], value).c_str());
    }
  }

  void modes() {
    for (int m = 0; m < run_.history.size(); ++m)
      add("          mode %d: omega = %.6g rad/s%s\n", m + 1, run_.history.row(m)[1],
          estimated("mode_" + std::to_string(m + 1) + "_rad_s", run_.history.row(m)[1]).c_str());
  }

  void warnings() {
    const auto& a = run_.accuracy;
    const char* volume = DimTraits<Dim>::volume_name;
    const bool condensed = run_.model.discretization.options.formulation == Formulation::condensed;
    if (a.boundary.available && a.volume_error > doubtful_volume)
      add("warning:  the rays see another %s than the boundary encloses: it crosses itself, parts lie twice, or rays are few\n", volume);
    if (a.gap_share > doubtful_share)
      add("warning:  a gap in the boundary is closed by a straight cap, at which %.2g %% of the %s ends\n", 100 * a.gap_share, volume);
    if (a.uncovered_share > doubtful_share)
      add("warning:  %.2g %% of the %s is out of all parts' reach and follows the closest one; raise method.weights.cutoff\n",
          100 * a.uncovered_share, volume);
    const auto weights = run_.scene.method.weights.variant;
    if (condensed && (weights == DistanceWeight::published || weights == DistanceWeight::draft))
      add("%s", "warning:  weights found by rays jump inside the solid, which takes many points and does not converge; method.weights.distance \"sided\" does\n");
    if (run_.folded_share > 0)
      add("warning:  the map is folded at the end: %.2g %% of the %s is turned inside out, its strains mean nothing; %s\n",
          100 * run_.folded_share, volume,
          condensed ? "finer parts or a smaller load may help" : "\"formulation\": \"condensed\" or a smaller load may help");
    for (const auto& variation : run_.estimate.variations)
      if (!variation.failure.empty()) add("warning:  the estimate lacks '%s': no result\n", variation.setting.c_str());
    if (!run_.estimate.columns.empty() && relative_error(run_.scene, run_.estimate) > doubtful_value)
      add("warning:  values may be off by %.2g %% of their size; %s\n", 100 * relative_error(run_.scene, run_.estimate),
          condensed ? "refine: method.degree, parts, or \"accuracy\"" : "\"formulation\": \"condensed\" converges");
  }

  const FinishedRun<Dim>& run_;
  std::string text_;
};

}  // namespace

template <int Dim>
std::string report_text(const FinishedRun<Dim>& run) {
  return Report<Dim>(run).text();
}

template std::string report_text<2>(const FinishedRun<2>&);
template std::string report_text<3>(const FinishedRun<3>&);

}  // namespace sem
