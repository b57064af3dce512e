#pragma once

#include <memory>
#include <vector>

#include "engine/methods/ul_cauchy/formulation.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::ul_cauchy {

std::vector<TermInfo> terms(const UlCauchyFormulation& m);
std::vector<ConstantRow<UlCauchyConstants>> constants(const UlCauchyFormulation& m, int dim);
std::unique_ptr<Simulation> make(const SolverInput& input);

}  // namespace taut::ul_cauchy
