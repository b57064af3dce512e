#pragma once

#include "engine/methods/formulation.hpp"

/// [TranDuc2023], with its kernel of §2.1 and its penalty contact.
namespace taut {

inline constexpr Citation tranduc2023_citations[] = {
    {"pressure", "[TranDuc2023] §2.4", ""},
    {"stress rate", "[TranDuc2023] Eq. 2.4", ""},
    {"artificial viscosity", "[TranDuc2023] §2.2", ""},
    {"artificial stress", "[TranDuc2023] §2.2", ""},
    {"time", "none stated: as in [Khayyer2024]",
     "naive: the current configuration, a clamped plate of two materials and a disc that hits it"},
};

/// The current-configuration methods of §2.2. The paper names them by the "artificial stresses", among which
/// it counts the viscosity (§3.1: a, ε and n are their parameters): ccb has neither, ccbwat both.
constexpr Formulation current_configuration(Formulation m) {
  m.family = Family::ul_cauchy;
  m.citations = tranduc2023_citations;
  m.pair_stress = PairStress::squares;
  m.continuity = Continuity::masses;
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
    .summary = "current configuration, no cure for tensile instability: fractures in tension",
    .conserves = "linear momentum",
});
inline constexpr Formulation ccbwat = current_configuration({
    .name = "ccbwat",
    .paper = "TranDuc2023 §2.2",
    .summary = "ccb with artificial viscosity and stress: fractures later, bends too far",
    .conserves = "linear momentum",
    .artificial_stress = true,
    .epsilon = 0.3,
    .exponent = 6,
    .viscosity = Viscosity::artificial,
});

/// On the initial configuration.
inline constexpr Formulation icb{
    .name = "icb",
    .paper = "TranDuc2023 §2.3",
    .summary = "second Piola–Kirchhoff stress, rotated with each particle: for moderate strains",
    .conserves = "linear momentum, angular momentum",
    .family = Family::tl_displacement,
    .law = Law::rotated_piola,
    .deviator = Deviator::plane_strain,
    .kernel = KernelName::sinc,
    .contact = ContactLaw::penalty,
    .several_materials = true,
    .h_over_dp = 1.2,
};

}  // namespace taut
