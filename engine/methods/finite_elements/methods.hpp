#pragma once

#include "engine/methods/finite_elements/formulation.hpp"

namespace taut {

/// `cfl`: time step over 2/ω, the stability limit of the stiffest element.
constexpr Formulation finite_elements_of(Formulation m) {
  m.deviator = Deviator::plane_strain;
  m.contact = ContactLaw::surface;
  m.contact_stiffness = 4;
  m.several_materials = true;
  m.cfl = 0.8;
  return m;
}

inline constexpr FiniteElementFormulation fe1{
    finite_elements_of({
        .name = "fe1",
        .paper = "Hughes1980",
        .summary = "finite elements for comparison: four nodes, in 3D eight, with mean dilatation",
        .conserves = "linear momentum, angular momentum, energy",
        .family = Family::finite_elements,
        .element_order = 1,
    }),
    {.law = Law::neo_hookean, .others = OtherLaws::all}};

inline constexpr FiniteElementFormulation fe2{
    finite_elements_of({
        .name = "fe2",
        .paper = "Hughes1980",
        .summary = "finite elements for comparison: nine nodes, in 3D 27, with linear dilatation",
        .conserves = "linear momentum, angular momentum, energy",
        .family = Family::finite_elements,
        .element_order = 2,
    }),
    {.law = Law::neo_hookean, .others = OtherLaws::all}};

namespace finite_elements {
using Methods = MethodList<fe1, fe2>;
}

}  // namespace taut
