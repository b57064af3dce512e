#pragma once

#include "engine/methods/formulation.hpp"

/// The current-configuration methods of [TranDuc2023] §2.2, with its kernel of §2.1. The paper names them by
/// the "artificial stresses", among which it counts the viscosity (§3.1: a, ε and n are their parameters):
/// ccb has neither, ccbwat both.
namespace taut {

constexpr Formulation current_configuration(Formulation m) {
  m.pair_stress = PairStress::squares;
  m.deviator = Deviator::plane_strain;
  m.kernel = KernelName::sinc;
  m.contact = ContactLaw::penalty;
  m.several_materials = true;
  m.h_over_dp = 1.2;
  m.cfl = 0.4;  // the paper states no time stepping
  return m;
}

inline constexpr Formulation ccb = current_configuration({
    .name = "ccb",
    .paper = "TranDuc2023 §2.2",
    .summary = "current configuration, no cure for tension: breaks under it",
    .conserves = "linear momentum",
    .shear = Shear::cauchy_stress,
});
inline constexpr Formulation ccbwat = current_configuration({
    .name = "ccbwat",
    .paper = "TranDuc2023 §2.2",
    .summary = "ccb with artificial viscosity and stress: holds longer, bends too far",
    .conserves = "linear momentum",
    .shear = Shear::cauchy_stress,
    .artificial_stress = true,
    .viscosity = Viscosity::artificial,
});

}  // namespace taut
