#pragma once

#include <vector>

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut::ul_split {

std::vector<TermInfo> terms(const Formulation& m);
std::vector<MethodConstant> constants(const Formulation& m, int dim);

}  // namespace taut::ul_split
