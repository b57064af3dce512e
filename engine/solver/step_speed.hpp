#pragma once

#include "engine/solver/solver_input.hpp"

namespace taut {

/// Speed in the CFL condition with searched neighbours, m/s, greatest of all materials: c0 ([Zhang2024] Eq. 22,
/// [Khayyer2024] Eq. 26) if G/K is at most `known`, as in the papers; else scaled with √((K + ζG)/ρ0). ζ = 4/3:
/// compression wave; `enog`: greater ζ.
double step_speed(const SolverInput& input, double zeta, double known);
/// With ζ = 4/3 and G/K at ν = 0, [Khayyer2024] §4.3.
double step_speed(const SolverInput& input);

}  // namespace taut
