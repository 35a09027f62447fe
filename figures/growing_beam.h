#pragma once
// The beam that grows: half a metre and four parts a slice, points in proportion.

#include "figures/solid_model.h"

namespace sem::figures {

/// `n_slices` slices, 4 n_slices + 2 biquadratic parts, the paper's formulation with the published
/// cutoff and shared origins; about 9 x 9 points a slice.
std::unique_ptr<SolidModel> growing_beam_of(int n_slices);

}  // namespace sem::figures
