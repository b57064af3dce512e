#pragma once

#include "engine/methods/formulation.hpp"

namespace taut {

/// [Zhang2020] states neither h nor where the Gaussian ends, and has no numbers for its contact. h = dp: sums
/// over a square lattice are right to 1e-3 then, and not with less.
inline constexpr Formulation tl_small_strain{
    .name = "tl-small-strain",
    .paper = "Zhang2020",
    .summary = "linear strain on initial neighbours: for small strains with little rotation",
    .conserves = "linear momentum, energy",
    .family = Family::tl_displacement,
    .law = Law::linear_elastic,
    .gradient = GradientCorrection::normalised,
    .deviator = Deviator::plane_strain,
    .kernel = KernelName::gauss,
    .contact = ContactLaw::lennard_jones,
    .contact_stiffness = 2,
    .several_materials = true,
    .h_over_dp = 1,
};

}  // namespace taut
