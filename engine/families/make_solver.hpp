#pragma once

#include <memory>

#include "engine/core/isa.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

inline namespace TAUT_ISA {
/// The solver of the input's method, for this instruction set.
std::unique_ptr<Simulation> make_solver(const SolverInput& input);

/// The same if it is of this family. Defined in instantiate.hpp, and instantiated by the family's solver.cpp.
template <Family F>
std::unique_ptr<Simulation> make_solver_of(const SolverInput& input);
}  // namespace TAUT_ISA

#ifdef TAUT_KNOWS_X86_64_LEVELS
namespace x86_64_v3 {
std::unique_ptr<Simulation> make_solver(const SolverInput& input);
}
namespace x86_64_v4 {  // of families that gain from it only
std::unique_ptr<Simulation> make_solver(const SolverInput& input);
}
#endif

}  // namespace taut
