#pragma once
// What a scene amounts to before it is run.

#include <string>

#include "sem/scene/model.h"

namespace sem {

/// Parts, unknowns, points, moments against the boundary's truth, uncovered
/// share, condition estimates, memory, and all settings with their defaults:
/// as JSON, or as text for people.
template <int Dim>
std::string model_info(const Scene<Dim>& scene, const Model<Dim>& model, bool json);

}  // namespace sem
