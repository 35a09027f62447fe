#pragma once
// The body of the teaser, and how a scene moves.

#include "figures/figure.h"
#include "sem/scene/model.h"

namespace sem::figures {

/// A starfish about 3 m across, hung by the tip of one arm: five cubic NURBS curves, one
/// around each arm.
Scene<2> starfish_scene();

/// States of the scene's dynamics at ascending times. Throws InputError if a step fails.
std::vector<State> states_at(const Scene<2>& scene, Model<2>& model,
                             const std::vector<double>& times);

}  // namespace sem::figures
