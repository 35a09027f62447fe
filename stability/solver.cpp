#include "stability/case.h"

namespace sem::stability {

std::vector<Case> solver_cases() { return {}; }

}  // namespace sem::stability
