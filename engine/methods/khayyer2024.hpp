#pragma once

#include "engine/methods/formulation.hpp"

/// The step-by-step improvement of [Khayyer2024]. AV: artificial viscosity, AS: artificial stress, R:
/// second-order Riemann term in place of AV, TIC: tensile instability control in place of AS inside, d (δ):
/// density diffusion.
namespace taut {

/// What all of them share, [Khayyer2024] §2.
constexpr Formulation ladder(Formulation step) {
  step.artificial_stress = true;
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
    .summary = "Gray's method: Cauchy stress, artificial viscosity and stress, XSPH; damps what swings",
    .conserves = "linear momentum",
    .shear = Shear::cauchy_stress,
    .viscosity = Viscosity::artificial,
});
inline constexpr Formulation ulsph_av_as = ladder({
    .name = "ulsph-av-as",
    .paper = "Khayyer2024 §3.1",
    .summary = "with corrected kernel gradients: keeps swinging",
    .conserves = "linear momentum",
    .shear = Shear::cauchy_stress,
    .viscosity = Viscosity::artificial,
    .corrected = true,
});
inline constexpr Formulation d_ulsph_av_as = ladder({
    .name = "d-ulsph-av-as",
    .paper = "Khayyer2024 §3.2",
    .summary = "ulsph-av-as with density diffusion: smoother pressure",
    .conserves = "linear momentum",
    .shear = Shear::cauchy_stress,
    .viscosity = Viscosity::artificial,
    .corrected = true,
    .density_diffusion = true,
});
inline constexpr Formulation d_ulsph_av_tic = ladder({
    .name = "d-ulsph-av-tic",
    .paper = "Khayyer2024 §3.4",
    .summary = "d-ulsph-av-as with tensile control instead of artificial stress inside",
    .conserves = "nothing exactly",
    .shear = Shear::cauchy_stress,
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
    .shear = Shear::cauchy_stress,
    .viscosity = Viscosity::riemann,
    .corrected = true,
    .density_diffusion = true,
});
inline constexpr Formulation ulsph_r_tic = ladder({
    .name = "ulsph-r-tic",
    .paper = "Khayyer2024 §4.4",
    .summary = "d-ulsph-r-tic without density diffusion: noisy pressure in a collision",
    .conserves = "nothing exactly",
    .shear = Shear::cauchy_stress,
    .viscosity = Viscosity::riemann,
    .corrected = true,
    .tensile_control = true,
});
inline constexpr Formulation d_ulsph_r_tic = ladder({
    .name = "d-ulsph-r-tic",
    .paper = "Khayyer2024 §3",
    .summary = "all four improvements: correction, density diffusion, Riemann term, tensile control",
    .conserves = "nothing exactly",
    .shear = Shear::cauchy_stress,
    .viscosity = Viscosity::riemann,
    .corrected = true,
    .density_diffusion = true,
    .tensile_control = true,
});

}  // namespace taut
