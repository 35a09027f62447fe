#pragma once
// Times that do not depend on what else the machine does.

#include <time.h>

#include <algorithm>
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

/// Seconds of processor time a call: the median over `n_repeats` passes of n calls call(0), ...,
/// call(n - 1). What the calls return is summed up, so that the compiler cannot drop them.
template <class Call>
double seconds_per_call(int n, int n_repeats, const Call& call) {
  static volatile double sink = 0;
  std::vector<double> times;
  for (int repeat = 0; repeat <= n_repeats; ++repeat) {
    const double start = thread_seconds();
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += call(i);
    sink = sink + sum;
    if (repeat > 0) times.push_back((thread_seconds() - start) / n);  // the first fills the caches
  }
  return median(times);
}

}  // namespace sem
