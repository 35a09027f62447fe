#pragma once
// A loop over independent items on a fixed number of threads. Each item
// writes its own results, so the outcome has the same bits for any number
// of threads.

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace sem {

/// Calls body(begin, end) on disjoint ranges that cover [0, n). Runs in the
/// calling thread alone if n_threads <= 1 or n is small. The first exception
/// (in the order of ranges) is rethrown.
template <class Body>
void parallel_for(int n, int n_threads, const Body& body) {
  const int n_ranges = std::clamp(n_threads, 1, std::max(1, n / 16));
  if (n_ranges == 1) {
    body(0, n);
    return;
  }
  std::vector<std::exception_ptr> errors(n_ranges);
  std::vector<std::thread> threads;
  for (int r = 0; r < n_ranges; ++r)
    threads.emplace_back([&, r] {
      try {
        body(int(long(n) * r / n_ranges), int(long(n) * (r + 1) / n_ranges));
      } catch (...) {
        errors[r] = std::current_exception();
      }
    });
  for (auto& thread : threads) thread.join();
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace sem
