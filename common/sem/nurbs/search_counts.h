#pragma once
// Internal: what searches on surfaces took, for tests of hard cases.

namespace sem::detail {

/// Of this thread so far.
struct SearchCounts {
  long closest_patches = 0;  ///< cells and patches looked at for closest points
  long hit_patches = 0;      ///< patches looked at for hits of lines
};

inline SearchCounts& search_counts() {
  thread_local SearchCounts counts;
  return counts;
}

}  // namespace sem::detail
