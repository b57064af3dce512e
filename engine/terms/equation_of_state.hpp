#pragma once

#include "engine/core/pack.hpp"

namespace taut::inline TAUT_ISA {

/// p = c0² (ρ − ρ0)                                                          [Zhang2024] Eq. 4
/// Pa, positive in compression.
template <class T>
T pressure(const T& rho, double rho0, double c0) {
  return c0 * c0 * (rho - rho0);
}

}  // namespace taut::inline TAUT_ISA
