#pragma once
// Times that do not depend on what else the machine does.

#include <time.h>

#include <algorithm>
#include <array>
#include <vector>

namespace sem {

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + long(values.size()) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Processor time of the calling thread, s.
inline double thread_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Seconds of processor time a call of one pass call(0), ..., call(n - 1). What the calls return is
/// summed up, so that the compiler cannot drop them.
template <class Call>
double one_pass(int n, const Call& call) {
  static volatile double sink = 0;
  const double start = thread_seconds();
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += call(i);
  sink = sink + sum;
  return (thread_seconds() - start) / n;
}

/// Seconds of processor time a call: the least of `n_repeats` passes, since what else the machine
/// does only adds. Several calls take turns, so that they see the same machine.
template <class... Call>
std::array<double, sizeof...(Call)> seconds_per_call(int n, int n_repeats, const Call&... call) {
  std::array<double, sizeof...(Call)> least{one_pass(n, call)...};  // fills the caches, too
  for (int repeat = 0; repeat < n_repeats; ++repeat) {
    int k = 0;
    ((least[k] = std::min(least[k], one_pass(n, call)), ++k), ...);
  }
  return least;
}

}  // namespace sem
