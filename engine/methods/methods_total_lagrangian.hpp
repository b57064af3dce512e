#pragma once

#include <string_view>
#include <vector>

#include "engine/method_info.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

/// What MethodInfo says of a method on the configuration of the start.
std::vector<std::string_view> total_lagrangian_terms(const Formulation& m);
std::vector<MethodConstant> total_lagrangian_constants(const Formulation& m);

}  // namespace taut
