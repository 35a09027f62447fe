#pragma once
// A whole run: model, analysis, files.

#include <functional>
#include <string>

#include "sem/scene/model.h"

namespace sem {

struct RunOptions {
  std::string file;    ///< the scene's, for error messages
  std::string folder;  ///< outputs; empty: none are written
  bool resume = false; ///< go on from the folder's checkpoint
  /// Called now and then: share done, what is being done.
  std::function<void(double, const std::string&)> progress;
};

/// Draws or writes one frame, numbered from 0: the state (in modes: the rest shape plus the mode).
/// Not called if the scene's frame_rate is 0.
template <int Dim>
using FrameCallback = std::function<void(const Model<Dim>&, const State&, int frame)>;

struct RunResult {
  bool ok = true;
  std::string message;       ///< one line for the user: what was done, or why the run stopped
  std::string report;        ///< a few lines for the user: cost and accuracy
  std::string summary_json;  ///< what summary.json holds
  int n_frames = 0;          ///< all there are now; 0 without a callback
};

/// Runs the scene's analysis. Writes history.csv, summary.json, final_state.json
/// (the parts with their deformed control points) and, in dynamics,
/// checkpoint.bin; frames go to the callback, if any. A run that is resumed
/// continues bit for bit; its files are those of an uninterrupted run but for
/// the times in summary.json. Throws InputError.
template <int Dim>
RunResult run_scene(const Scene<Dim>& scene, const RunOptions& options,
                    const FrameCallback<Dim>& on_frame);

}  // namespace sem
