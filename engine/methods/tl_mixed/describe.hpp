#pragma once

#include <memory>
#include <vector>

#include "engine/methods/tl_mixed/formulation.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::tl_mixed {

std::vector<TermInfo> terms(const TlMixedFormulation& m);
std::vector<ConstantRow<TlMixedConstants>> constants(const TlMixedFormulation& m, int dim);
std::unique_ptr<Simulation> make(const SolverInput& input);

}  // namespace taut::tl_mixed
