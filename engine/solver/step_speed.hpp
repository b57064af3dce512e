#pragma once

#include "engine/solver/solver_input.hpp"

namespace taut {

/// CFL speed of methods with searched neighbours, m/s; the greatest of all materials. Up to G/K = `known` it is c0
/// ([Zhang2024] Eq. 22, [Khayyer2024] Eq. 26); above, c0 times the ratio of √((K + ζG)/ρ0) to its value at `known`.
double step_speed(const SolverInput& input, double zeta, double known);
/// With ζ = 4/3 (compression wave) and `known` = 1.5 (ν = 0), [Khayyer2024] §4.3.
double step_speed(const SolverInput& input);

}  // namespace taut
