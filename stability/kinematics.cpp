#include "stability/case.h"

namespace sem::stability {

std::vector<Case> kinematics_cases() { return {}; }

}  // namespace sem::stability
