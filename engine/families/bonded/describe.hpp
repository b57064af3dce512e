#pragma once

#include <memory>
#include <vector>

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::bonded {

std::vector<TermInfo> terms(const Formulation& m);
std::vector<MethodConstant> constants(const Formulation& m, int dim);
std::unique_ptr<Simulation> make(const SolverInput& input);

}  // namespace taut::bonded
