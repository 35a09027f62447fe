#include "sem/program/progress.h"

#include <unistd.h>

#include <cstdio>

namespace sem {

Progress::Progress() : terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() {
  if (open_) std::fprintf(stderr, "\n");
}

// Of what says only that it began no share is known.
void Progress::operator()(double share, const std::string& what) {
  const int now = int(share * (terminal_ ? 40 : 10));
  if (now == shown_ && what == what_) return;
  shown_ = now;
  if (share == 0) {
    std::fprintf(stderr, terminal_ ? "\r%-70s" : "%s ...\n", what.c_str());
    open_ = terminal_;
  } else if (terminal_) {
    std::fprintf(stderr, "\r%-22s [%-40s] %3d %%", what.c_str(), std::string(now, '#').c_str(),
                 int(100 * share));
    open_ = true;
  } else {
    std::fprintf(stderr, "%s %d %%\n", what.c_str(), int(100 * share));
  }
  what_ = what;
}

}  // namespace sem
