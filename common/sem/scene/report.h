#pragma once
// What a run says on the screen when it is done.

#include "sem/scene/accuracy.h"
#include "sem/scene/analysis.h"
#include "sem/scene/estimate.h"
#include "sem/scene/files.h"
#include "sem/scene/monitor.h"

namespace sem {

/// All of a run that its report looks at.
template <int Dim>
struct FinishedRun {
  const Scene<Dim>& scene;
  const Model<Dim>& model;
  const Monitor<Dim>& monitor;
  const Table& history;
  const Accuracy<Dim>& accuracy;
  const AnalysisReport& analysis;
  const ErrorEstimate& estimate;  ///< no columns: none was made
  double folded_share, frames_seconds, estimate_seconds;
};

/// A line of costs, a line of accuracy, a line for each probe or mode, and a "warning:" with its remedy for what
/// makes the numbers doubtful.
template <int Dim>
std::string report_text(const FinishedRun<Dim>& run);

}  // namespace sem
