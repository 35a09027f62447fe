#pragma once
// What a scene amounts to before it is run.

#include <string>

#include "sem/scene/estimate.h"

namespace sem {

/// Parts, unknowns, points, moments against the boundary's truth, uncovered
/// share, condition estimates, memory, cost and error of every stage so far and predicted ones of the analysis
/// (cost: assembly and factorisation at rest as often as is usual; error: estimate_error of the linear_response,
/// which takes several times what the model took), and all settings with their defaults, as JSON; or
/// info_text of that for people. `file`: where the scene comes from, for messages. `announce`: of the estimate.
template <int Dim>
std::string model_info(const Scene<Dim>& scene, const Model<Dim>& model, bool json,
                       const std::string& file = "", const Announce& announce = {});

}  // namespace sem
