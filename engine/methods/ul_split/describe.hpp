#pragma once

#include <memory>
#include <vector>

#include "engine/methods/ul_split/formulation.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::ul_split {

std::vector<TermInfo> terms(const UlSplitFormulation& m);
std::vector<ConstantRow<UlSplitConstants>> constants(const UlSplitFormulation& m, int dim);
std::unique_ptr<Simulation> make(const SolverInput& input);

}  // namespace taut::ul_split
