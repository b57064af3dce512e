#pragma once

#include "engine/methods/lee2016.hpp"
#include "engine/methods/tl_displacement/formulation.hpp"

namespace taut {

/// [TranDuc2023] §2.3 with the kernel of §2.1.
inline constexpr TlDisplacementFormulation icb{
    {
        .name = "icb",
        .paper = "TranDuc2023 §2.3",
        .summary = "second Piola–Kirchhoff stress, rotated with each particle: for moderate strains",
        .conserves = "linear momentum, angular momentum",
        .family = Family::tl_displacement,
        .deviator = Deviator::plane_strain,
        .kernel = KernelName::sinc,
        .contact = ContactLaw::penalty,
        .several_materials = true,
        .h_over_dp = 1.2,
    },
    {.law = Law::rotated_piola},
    {}};

inline constexpr TlDisplacementFormulation tl{
    lee2016({
        .name = "tl",
        .paper = "Lee2016 §8.4",
        .summary = "deformation gradient from positions, initial neighbours: "
                   "no tensile instability, but zigzag modes cost no energy",
        .conserves = "linear momentum, angular momentum, energy",
        .family = Family::tl_displacement,
    }),
    {.law = Law::neo_hookean, .others = OtherLaws::all},
    {}};

/// Departure: [Ganzenmueller2015] has other kernels and a linear law.
inline constexpr TlDisplacementFormulation tl_hg{
    lee2016({
        .name = "tl-hg",
        .paper = "Ganzenmueller2015",
        .summary = "tl with a stiffness of pairs against motions that the deformation gradient misses",
        .conserves = "linear momentum, angular momentum",
        .family = Family::tl_displacement,
    }),
    {.law = Law::neo_hookean, .others = OtherLaws::all},
    {.pair_force = PairForce::hourglass}};

inline constexpr TlDisplacementFormulation tl_enog{
    {
        .name = "tl-enog",
        .paper = "Wu2023",
        .summary = "damped shear forces between pairs instead of a stress divergence: no zigzag modes",
        .conserves = "linear momentum",
        .family = Family::tl_displacement,
        .citations = no_published_contact,
        .deviator = Deviator::plane_strain,
        .contact = ContactLaw::surface,
        .contact_stiffness = 2,
        .several_materials = true,
        .h_over_dp = 1.3,
    },
    {.law = Law::neo_hookean},
    {.pair_force = PairForce::shear}};

/// [Zhang2020] states neither h, the cut-off nor contact constants. With h = dp, lattice sums are accurate to 1e-3.
inline constexpr TlDisplacementFormulation tl_small_strain{
    {
        .name = "tl-small-strain",
        .paper = "Zhang2020",
        .summary = "linear strain on initial neighbours: for small strains with little rotation",
        .conserves = "linear momentum, energy",
        .family = Family::tl_displacement,
        .deviator = Deviator::plane_strain,
        .kernel = KernelName::gauss,
        .contact = ContactLaw::lennard_jones,
        .contact_stiffness = 2,
        .several_materials = true,
        .h_over_dp = 1,
    },
    {.law = Law::linear_elastic},
    {.gradient = GradientCorrection::normalised}};

namespace tl_displacement {
using Methods = MethodList<icb, tl, tl_hg, tl_enog, tl_small_strain>;
}

}  // namespace taut
