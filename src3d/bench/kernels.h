#pragma once
// Times of the geometry kernels.

#include <string>
#include <vector>

namespace sem {

struct KernelTime {
  std::string name;
  double seconds = 0;   ///< a call
  double textbook = 0;  ///< the same by textbook.h, s; 0: there is no textbook version
  double target = 0;    ///< what this project aims at on a quiet machine, s; 0: nothing
};

/// Evaluation, hits and closest points at random places of a cubic rational
/// curve with 16 control points and a bicubic rational surface with 8 x 8.
/// Throws std::logic_error if library and textbook disagree by more than 1e-12.
std::vector<KernelTime> time_kernels();

}  // namespace sem
