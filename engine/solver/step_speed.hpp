#pragma once

#include "engine/solver/solver_input.hpp"

namespace taut {

/// Speed for the CFL condition with searched neighbours, m/s, greatest of all materials: c0 ([Zhang2024] Eq. 22,
/// [Khayyer2024] Eq. 26), for G/K above `known` scaled with √((K + ζG)/ρ0). ζ = 4/3: compression wave; `enog`:
/// greater.
double step_speed(const SolverInput& input, double zeta, double known);
/// ζ = 4/3, G/K at ν = 0, [Khayyer2024] §4.3.
double step_speed(const SolverInput& input);

}  // namespace taut
