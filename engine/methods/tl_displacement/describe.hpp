#pragma once

#include <memory>
#include <vector>

#include "engine/methods/tl_displacement/formulation.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::tl_displacement {

std::vector<TermInfo> terms(const TlDisplacementFormulation& m);
std::vector<ConstantRow<TlDisplacementConstants>> constants(const TlDisplacementFormulation& m, int dim);
std::unique_ptr<Simulation> make(const SolverInput& input);

}  // namespace taut::tl_displacement
