#pragma once

#include <memory>
#include <string_view>

#include "engine/core/isa.hpp"
#include "engine/solver/running.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

inline namespace TAUT_ISA {
/// The solver of a method, for this instruction set; nullptr if there is no such method.
std::unique_ptr<Simulation> make_solver(std::string_view method, const SolverInput& input);
}  // namespace TAUT_ISA

#if defined(__x86_64__)
namespace x86_64_v3 {
std::unique_ptr<Simulation> make_solver(std::string_view method, const SolverInput& input);
}
#endif

}  // namespace taut
