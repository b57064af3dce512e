#pragma once

#include <memory>
#include <vector>

#include "engine/methods/finite_elements/formulation.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::finite_elements {

std::vector<TermInfo> terms(const FiniteElementFormulation& m);
std::vector<ConstantRow<FiniteElementConstants>> constants(const FiniteElementFormulation& m, int dim);
std::unique_ptr<Simulation> make(const SolverInput& input);

}  // namespace taut::finite_elements
