#pragma once

#include "engine/methods/ul_cauchy/formulation.hpp"

/// engine/METHODS.md explains the parts of the names.
namespace taut {

inline constexpr Citation khayyer2024_citations[] = {{"pressure", "[Khayyer2024] Eq. 5", ""}};

/// Settings of [Khayyer2024] §2.
constexpr UlCauchyFormulation ladder(Formulation step, UlCauchySwitches switches) {
  step.family = Family::ul_cauchy;
  step.citations = khayyer2024_citations;
  switches.artificial_stress = true;
  switches.epsilon = 0.15;
  switches.exponent = 8;
  switches.transport_velocity = true;
  step.deviator = Deviator::plane_strain;
  step.contact = ContactLaw::impulse;
  step.several_materials = true;
  step.h_over_dp = 1.2;
  step.cfl = 0.5;  // [Khayyer2024] §2.3 has 1
  return {step, switches};
}

inline constexpr UlCauchyFormulation ulsph_av_as_uncorrected = ladder(
    {
        .name = "ulsph-av-as-uncorrected",
        .paper = "Khayyer2024 §2",
        .summary = "Gray's method: Cauchy stress, artificial viscosity and stress, XSPH; damps oscillations",
        .conserves = "linear momentum",
    },
    {.viscosity = Viscosity::artificial});
inline constexpr UlCauchyFormulation ulsph_av_as = ladder(
    {
        .name = "ulsph-av-as",
        .paper = "Khayyer2024 §3.1",
        .summary = "Gray's method with corrected kernel gradients: does not damp oscillations",
        .conserves = "linear momentum",
    },
    {.viscosity = Viscosity::artificial, .corrected = true});
inline constexpr UlCauchyFormulation d_ulsph_av_as = ladder(
    {
        .name = "d-ulsph-av-as",
        .paper = "Khayyer2024 §3.2",
        .summary = "ulsph-av-as with density diffusion: smoother pressure",
        .conserves = "linear momentum",
    },
    {.viscosity = Viscosity::artificial, .corrected = true, .density_diffusion = true});
inline constexpr UlCauchyFormulation d_ulsph_av_tic = ladder(
    {
        .name = "d-ulsph-av-tic",
        .paper = "Khayyer2024 §3.4",
        .summary = "d-ulsph-av-as with tensile control inside and artificial stress only at surfaces",
        .conserves = "nothing exactly",
    },
    {.viscosity = Viscosity::artificial,
     .corrected = true,
     .density_diffusion = true,
     .tensile_control = true});
inline constexpr UlCauchyFormulation d_ulsph_r_as = ladder(
    {
        .name = "d-ulsph-r-as",
        .paper = "Khayyer2024 §3.3",
        .summary = "d-ulsph-av-as with a second-order Riemann term instead of artificial viscosity: "
                   "noisy in tension",
        .conserves = "linear momentum",
    },
    {.viscosity = Viscosity::riemann, .corrected = true, .density_diffusion = true});
inline constexpr UlCauchyFormulation ulsph_r_tic = ladder(
    {
        .name = "ulsph-r-tic",
        .paper = "Khayyer2024 §4.4",
        .summary = "d-ulsph-r-tic without density diffusion: noisy pressure in a collision",
        .conserves = "nothing exactly",
    },
    {.viscosity = Viscosity::riemann, .corrected = true, .tensile_control = true});
inline constexpr UlCauchyFormulation d_ulsph_r_tic = ladder(
    {
        .name = "d-ulsph-r-tic",
        .paper = "Khayyer2024 §3",
        .summary = "all four improvements: correction, density diffusion, Riemann term, tensile control",
        .conserves = "nothing exactly",
    },
    {.viscosity = Viscosity::riemann, .corrected = true, .density_diffusion = true, .tensile_control = true});

inline constexpr Citation tranduc2023_citations[] = {
    {"pressure", "[TranDuc2023] §2.4", ""},
    {"stress rate", "[TranDuc2023] Eq. 2.4", ""},
    {"artificial viscosity", "[TranDuc2023] §2.2", ""},
    {"artificial stress", "[TranDuc2023] §2.2", ""},
    {"time", "none stated: as in [Khayyer2024]",
     "naive: ccb and ccbwat follow the transcription for a plate of two materials hit by a disc"},
};

/// Settings of [TranDuc2023] §2.1 and §2.2.
constexpr UlCauchyFormulation current_configuration(Formulation m, UlCauchySwitches switches = {}) {
  m.family = Family::ul_cauchy;
  m.citations = tranduc2023_citations;
  switches.pair_stress = PairStress::squares;
  switches.continuity = Continuity::masses;
  m.deviator = Deviator::plane_strain;
  m.kernel = KernelName::sinc;
  m.contact = ContactLaw::penalty;
  m.several_materials = true;
  m.h_over_dp = 1.2;
  m.cfl = 0.4;  // the paper states no time stepping
  return {m, switches};
}

inline constexpr UlCauchyFormulation ccb = current_configuration({
    .name = "ccb",
    .paper = "TranDuc2023 §2.2",
    .summary = "current configuration, no cure for tensile instability: fractures in tension",
    .conserves = "linear momentum",
});
/// The "artificial stresses" of [TranDuc2023] include viscosity (§3.1).
inline constexpr UlCauchyFormulation ccbwat = current_configuration(
    {
        .name = "ccbwat",
        .paper = "TranDuc2023 §2.2",
        .summary = "ccb with artificial viscosity and stress: fractures later, bends too far",
        .conserves = "linear momentum",
    },
    {.artificial_stress = true, .epsilon = 0.3, .exponent = 6, .viscosity = Viscosity::artificial});

namespace ul_cauchy {
using Methods = MethodList<ulsph_av_as_uncorrected, ulsph_av_as, d_ulsph_av_as, d_ulsph_av_tic, d_ulsph_r_as,
                           ulsph_r_tic, d_ulsph_r_tic, ccb, ccbwat>;
}

}  // namespace taut
