#pragma once
// How far a run has come, on standard error.

#include <string>

namespace sem {

/// A bar on a terminal, a line for every tenth in a pipe.
class Progress {
 public:
  Progress();
  /// Ends the bar's line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// share: 0 to 1, of what is being done.
  void operator()(double share, const std::string& what);

 private:
  bool terminal_, open_ = false;
  int shown_ = -1;
  std::string what_;
};

}  // namespace sem
