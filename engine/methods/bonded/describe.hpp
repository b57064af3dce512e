#pragma once

#include <memory>
#include <vector>

#include "engine/methods/bonded/formulation.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::bonded {

std::vector<TermInfo> terms(const BondedFormulation& m);
std::vector<ConstantRow<BondedConstants>> constants(const BondedFormulation& m, int dim);
std::unique_ptr<Simulation> make(const SolverInput& input);

}  // namespace taut::bonded
