#pragma once

#include "engine/solver/solver_input.hpp"

namespace taut {

/// Speed of the CFL condition of methods with searched neighbours, m/s, the greatest of all materials: c0 ([Zhang2024]
/// Eq. 22, [Khayyer2024] Eq. 26) where G/K is at most `known`, that of the papers; else c0 times the ratio of
/// √((K + ζG)/ρ0) to its value there. ζ = 4/3 gives the compression wave; `enog` has the greater ζ of its Laplacian.
double step_speed(const SolverInput& input, double zeta, double known);
/// The same with ζ = 4/3, and G/K of ν = 0, [Khayyer2024] §4.3.
double step_speed(const SolverInput& input);

}  // namespace taut
