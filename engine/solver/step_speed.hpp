#pragma once

#include "engine/solver/solver_input.hpp"

namespace taut {

/// Speed in the CFL condition with searched neighbours, m/s, maximum over materials: c0 ([Zhang2024] Eq. 22,
/// [Khayyer2024] Eq. 26) if G/K is at most `known`, the papers' value. Above, c0 is scaled by √((K + ζG)/ρ0) relative
/// to its value at `known`. ζ = 4/3 gives the compression wave; `enog` uses the greater ζ of its Laplacian.
double step_speed(const SolverInput& input, double zeta, double known);
/// As above with ζ = 4/3 and `known` = G/K at ν = 0, [Khayyer2024] §4.3.
double step_speed(const SolverInput& input);

}  // namespace taut
