#pragma once

#include <vector>

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut::bonded {

std::vector<TermInfo> terms(const Formulation& m);
std::vector<MethodConstant> constants(const Formulation& m, int dim);

}  // namespace taut::bonded
