#pragma once

#include "engine/methods/formulation.hpp"

/// The step-by-step improvement of [Khayyer2024]. AV: artificial viscosity, AS: artificial stress, R:
/// second-order Riemann term in place of AV, TIC: tensile instability control in place of AS inside, d (δ):
/// density diffusion.
namespace taut {

inline constexpr Citation khayyer2024_citations[] = {{"pressure", "[Khayyer2024] Eq. 5", ""}};

/// What all of them share, [Khayyer2024] §2.
constexpr Formulation ladder(Formulation step) {
  step.family = Family::ul_cauchy;
  step.citations = khayyer2024_citations;
  step.artificial_stress = true;
  step.epsilon = 0.15;
  step.exponent = 8;
  step.transport_velocity = true;
  step.deviator = Deviator::plane_strain;
  step.contact = ContactLaw::impulse;
  step.several_materials = true;
  step.h_over_dp = 1.2;
  step.cfl = 0.5;
  return step;
}

inline constexpr Formulation ulsph_av_as_uncorrected = ladder({
    .name = "ulsph-av-as-uncorrected",
    .paper = "Khayyer2024 §2",
    .summary = "Gray's method: Cauchy stress, artificial viscosity and stress, XSPH; damps oscillations",
    .conserves = "linear momentum",
    .viscosity = Viscosity::artificial,
});
inline constexpr Formulation ulsph_av_as = ladder({
    .name = "ulsph-av-as",
    .paper = "Khayyer2024 §3.1",
    .summary = "Gray's method with corrected kernel gradients: does not damp oscillations",
    .conserves = "linear momentum",
    .viscosity = Viscosity::artificial,
    .corrected = true,
});
inline constexpr Formulation d_ulsph_av_as = ladder({
    .name = "d-ulsph-av-as",
    .paper = "Khayyer2024 §3.2",
    .summary = "ulsph-av-as with density diffusion: smoother pressure",
    .conserves = "linear momentum",
    .viscosity = Viscosity::artificial,
    .corrected = true,
    .density_diffusion = true,
});
inline constexpr Formulation d_ulsph_av_tic = ladder({
    .name = "d-ulsph-av-tic",
    .paper = "Khayyer2024 §3.4",
    .summary = "d-ulsph-av-as with tensile control instead of artificial stress inside",
    .conserves = "nothing exactly",
    .viscosity = Viscosity::artificial,
    .corrected = true,
    .density_diffusion = true,
    .tensile_control = true,
});
inline constexpr Formulation d_ulsph_r_as = ladder({
    .name = "d-ulsph-r-as",
    .paper = "Khayyer2024 §3.3",
    .summary =
        "d-ulsph-av-as with a second-order Riemann term instead of artificial viscosity: noisy in tension",
    .conserves = "linear momentum",
    .viscosity = Viscosity::riemann,
    .corrected = true,
    .density_diffusion = true,
});
inline constexpr Formulation ulsph_r_tic = ladder({
    .name = "ulsph-r-tic",
    .paper = "Khayyer2024 §4.4",
    .summary = "d-ulsph-r-tic without density diffusion: noisy pressure in a collision",
    .conserves = "nothing exactly",
    .viscosity = Viscosity::riemann,
    .corrected = true,
    .tensile_control = true,
});
inline constexpr Formulation d_ulsph_r_tic = ladder({
    .name = "d-ulsph-r-tic",
    .paper = "Khayyer2024 §3",
    .summary = "all four improvements: correction, density diffusion, Riemann term, tensile control",
    .conserves = "nothing exactly",
    .viscosity = Viscosity::riemann,
    .corrected = true,
    .density_diffusion = true,
    .tensile_control = true,
});

}  // namespace taut
