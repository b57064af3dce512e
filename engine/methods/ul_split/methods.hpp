#pragma once

#include "engine/methods/ul_split/formulation.hpp"

namespace taut {

inline constexpr UlSplitFormulation og{
    {
        .name = "og",
        .paper = "Zhang2024 §3",
        .summary =
            "nested shear stress, low-dissipation Riemann terms, no cure for tensile instability: fractures",
        .conserves = "linear momentum",
        .family = Family::ul_split,
    },
    {.shear = Shear::nested_stress, .beta_least = 0}};
inline constexpr UlSplitFormulation oas{
    {
        .name = "oas",
        .paper = "Zhang2024 §6",
        .summary = "og with Gray's artificial stress and the dissipation of enog: "
                   "fractures later, zigzag modes remain",
        .conserves = "linear momentum",
        .family = Family::ul_split,
    },
    {.shear = Shear::nested_stress, .artificial_stress = true, .epsilon = 0.3, .exponent = 4}};
inline constexpr UlSplitFormulation enog{
    {
        .name = "enog",
        .paper = "Zhang2024 §4",
        .summary = "shear acceleration from a non-nested Laplacian of the velocity: "
                   "no zigzag modes, no tensile instability",
        .conserves = "linear momentum",
        .family = Family::ul_split,
    },
    {.shear = Shear::laplacian_velocity}};
inline constexpr UlSplitFormulation enog_nonconservative{
    {
        .name = "enog-nonconservative",
        .paper = "Zhang2024 Eq. 18, Fig. 7",
        .summary = "enog with the plain Laplacian: resists rotation, as published",
        .conserves = "linear momentum",
        .family = Family::ul_split,
    },
    {.shear = Shear::laplacian_velocity_nonconservative}};

// Departure: `gnog` and `gnog_amc` have the pressure of `enog`.
inline constexpr UlSplitFormulation gnog{
    {
        .name = "gnog",
        .paper = "Zhang2024b",
        .summary = "og with the dissipation of enog, corrected velocity gradients, "
                   "and a penalty on velocities that they do not explain",
        .conserves = "linear momentum",
        .family = Family::ul_split,
    },
    {.shear = Shear::nested_with_penalty}};
inline constexpr UlSplitFormulation gnog_amc{
    {
        .name = "gnog-amc",
        .paper = "SPHinXsys2025",
        .summary = "gnog with a penalty along the line of each pair, "
                   "which its authors call angular momentum conservative",
        .conserves = "linear momentum",
        .family = Family::ul_split,
    },
    {.shear = Shear::nested_with_penalty, .central_penalty = true}};

namespace ul_split {
using Methods = MethodList<og, oas, enog, enog_nonconservative, gnog, gnog_amc>;
}

}  // namespace taut
