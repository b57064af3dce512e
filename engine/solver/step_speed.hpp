#pragma once

#include "engine/solver/solver_input.hpp"

namespace taut {

/// Speed in the CFL condition of methods with searched neighbours, m/s; the greatest of all materials. For G/K up to
/// `known` it is c0 ([Zhang2024] Eq. 22, [Khayyer2024] Eq. 26). Above, c0 is multiplied by the ratio of √((K + ζG)/ρ0)
/// to its value at `known`.
double step_speed(const SolverInput& input, double zeta, double known);
/// The same with ζ = 4/3 (compression wave) and `known` = 1.5, which is G/K at ν = 0, [Khayyer2024] §4.3.
double step_speed(const SolverInput& input);

}  // namespace taut
