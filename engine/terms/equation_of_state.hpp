#pragma once

#include "engine/core/pack.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Pressure, Pa, positive in compression.
template <class T>
T pressure(const T& rho, double rho0, double c0) {
  return c0 * c0 * (rho - rho0);
}
inline constexpr TermInfo equation_of_state_info{
    "pressure", "p = c0² (ρ − ρ0)", "[Zhang2024] Eq. 4", "terms/equation_of_state.hpp:pressure",
    "equation of state: pressure is positive in compression, with slope c0²"};

}  // namespace taut
