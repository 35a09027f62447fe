#include "stability/case.h"

namespace sem::stability {

std::vector<Case> mechanics_cases() { return {}; }

}  // namespace sem::stability
