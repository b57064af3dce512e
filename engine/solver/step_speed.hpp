#pragma once

#include "engine/solver/solver_input.hpp"

namespace taut {

/// Speed in the CFL condition of methods with searched neighbours, m/s; the greatest of all materials. It is c0
/// ([Zhang2024] Eq. 22, [Khayyer2024] Eq. 26) for G/K up to `known`, the value in the papers. Above, c0 is
/// multiplied by the ratio of √((K + ζG)/ρ0) to its value at `known`. ζ = 4/3 gives the compression wave; `enog`
/// uses the greater ζ of its Laplacian.
double step_speed(const SolverInput& input, double zeta, double known);
/// The same with ζ = 4/3 and `known` = 1.5, which is G/K at ν = 0, [Khayyer2024] §4.3.
double step_speed(const SolverInput& input);

}  // namespace taut
