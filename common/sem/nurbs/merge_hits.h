#pragma once
// Internal: hits of a line that patches of a surface found on their own.

#include <vector>

#include "sem/nurbs/hits.h"

namespace sem::detail {

struct Candidate {
  Hit<3> hit;
  double reach;  ///< size of the patch a degenerate hit stands for, 0 if it is simple
};

/// Appends the simple hits once each; degenerate ones in clusters: a tangency gives one hit, a
/// stretch along the line gives its two ends. speed: length of the line's direction. Sorts `found`.
void append_merged(const PreparedNurbs<2, 3>& part, double speed, std::vector<Candidate>& found,
                   std::vector<Hit<3>>& out);

}  // namespace sem::detail
