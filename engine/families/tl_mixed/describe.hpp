#pragma once

#include <vector>

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut::tl_mixed {

std::vector<TermInfo> terms(const Formulation& m);
std::vector<MethodConstant> constants(const Formulation& m, int dim);

}  // namespace taut::tl_mixed
