#pragma once

#include "engine/methods/bonded/formulation.hpp"

namespace taut {

inline constexpr BondedFormulation oenog{
    {
        .name = "oenog",
        .paper = "none: ours",
        .summary = "objective ENOG: forces rotate with the initial pairs and derive from an energy; "
                   "no neighbour search within a body",
        .conserves = "linear momentum, angular momentum",
        .family = Family::bonded,
        .deviator = Deviator::plane_strain,
        .contact = ContactLaw::surface,
        .contact_stiffness = 2,
        .several_materials = true,
        .h_over_dp = 0.8,     // 8 neighbours on a square lattice
        .h_over_dp_3d = 0.9,  // 26 on a cubic lattice
        .cfl = 0.64,          // over dp/(c_p + |v|max)
    },
    {.law = Law::neo_hookean, .others = OtherLaws::all}};

namespace bonded {
using Methods = MethodList<oenog>;
}

}  // namespace taut
